//! Which foreign programs are installed, and which versions of them.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Mutex;

/// The answer of a program to the question after its version; asked once a process.
///
/// `ask` are the question's arguments, `read_version` finds the version in the answer.
pub(crate) fn version(
    name: &'static str,
    ask: &[&str],
    read_version: impl FnOnce(&str) -> Option<String>,
) -> Option<String> {
    static VERSIONS: Mutex<BTreeMap<&str, String>> = Mutex::new(BTreeMap::new());
    let mut all = VERSIONS.lock().expect("bug: poisoned");
    if let Some(known) = all.get(name) {
        return Some(known.clone());
    }
    let mut command = Command::new(name);
    let out = command.args(ask).stdin(Stdio::null()).output().ok()?;
    let version = read_version(&String::from_utf8_lossy(&[out.stdout, out.stderr].concat()))?;
    all.insert(name, version.clone());
    Some(version)
}

/// Where a program is installed.
pub(crate) fn found(name: &str) -> Option<PathBuf> {
    let folders = std::env::var_os("PATH")?;
    let mut files = std::env::split_paths(&folders).map(|folder| folder.join(name));
    files.find(|file| file.is_file())
}

/// The library of a name that a program is linked to, by the loader of Linux.
pub(crate) fn linked(program: &Path, library: &str) -> Option<PathBuf> {
    let mut command = Command::new(program);
    // ld.so(8): lists the libraries and does not run the program.
    command.env("LD_TRACE_LOADED_OBJECTS", "1");
    let out = command.stdin(Stdio::null()).output().ok()?;
    let text = String::from_utf8_lossy(&out.stdout).into_owned();
    let line = text.lines().find(|l| l.trim_start().starts_with(library))?;
    let path = line.split_once("=> ")?.1.split_whitespace().next()?;
    Some(PathBuf::from(path))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_installed_is_found_and_what_is_not_has_no_version() {
        assert_eq!(version("no-such-program", &[], |_| None), None);
        assert_eq!(found("no-such-program"), None);
        let shell = found("sh").unwrap();
        assert!(linked(&shell, "libc.").is_none_or(|l| l.is_file()));
        assert_eq!(linked(&shell, "no-such-library"), None);
        let found = version("sh", &["-c", "echo sh version 1.2 of today"], |text| {
            Some(text.split_whitespace().nth(2)?.to_owned())
        });
        assert_eq!(found.as_deref(), Some("1.2"));
    }
}
