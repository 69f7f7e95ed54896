//! Bubblewrap, where it is installed: a file system that can be read and not written, no network.

use crate::system::can_start;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::{Mutex, OnceLock};

/// What keeps programs from writing elsewhere and from the network.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Sandbox {
    /// Bubblewrap, at this place.
    Bubblewrap(PathBuf),
    /// Nothing, and why.
    None(String),
}

/// What there is on this machine; tried once a process.
pub fn sandbox() -> &'static Sandbox {
    static FOUND: OnceLock<Sandbox> = OnceLock::new();
    FOUND.get_or_init(|| match in_path("bwrap") {
        None => Sandbox::None("bubblewrap (`bwrap`) is not installed".into()),
        Some(path) => {
            let mut tried = Command::new(&path);
            tried.args(outer()).args(["--unshare-net", "--", "true"]);
            let tried = tried.stdin(Stdio::null()).stdout(Stdio::null()).output();
            match tried {
                Ok(out) if out.status.success() => Sandbox::Bubblewrap(path),
                Ok(out) => {
                    let why = String::from_utf8_lossy(&out.stderr);
                    let why = why.trim().escape_debug();
                    Sandbox::None(format!("bubblewrap cannot be used here ({why})"))
                }
                Err(why) => Sandbox::None(format!("bubblewrap cannot be started ({why})")),
            }
        }
    })
}

/// Programs that a host brings along: name and place.
static BROUGHT: Mutex<Vec<(String, PathBuf)>> = Mutex::new(Vec::new());

/// Takes a program of this name from here, whatever PATH says: for a host that brings it along.
pub fn bring(name: String, path: PathBuf) {
    let mut brought = BROUGHT.lock().expect("bug: poisoned");
    brought.retain(|(known, _)| *known != name);
    brought.push((name, path));
}

/// The program of a name: what the host brings along, else in PATH.
pub(super) fn in_path(name: &str) -> Option<PathBuf> {
    let brought = BROUGHT.lock().expect("bug: poisoned").clone();
    let own = brought.into_iter().find(|(known, _)| known == name);
    if let Some((_, path)) = own.filter(|(_, path)| is_program(path)) {
        return Some(path);
    }
    let path = std::env::var_os("PATH")?;
    let file = |folder: PathBuf| Some(folder.join(name)).filter(|file| is_program(file));
    std::env::split_paths(&path).find_map(file)
}

/// Whether a file can be started.
pub(super) fn is_program(file: &Path) -> bool {
    std::fs::metadata(file).is_ok_and(|m| m.is_file() && can_start(&m))
}

fn outer() -> Vec<OsString> {
    let mut words = vec!["--ro-bind", "/", "/", "--dev-bind", "/dev", "/dev"];
    if Path::new("/dev/shm").is_dir() {
        words.extend(["--tmpfs", "/dev/shm"]);
    }
    words.push("--die-with-parent");
    words.into_iter().map(OsString::from).collect()
}

/// The words before a command: it may write into the folder `root`, but not into what it reads there.
pub(super) fn words(bubblewrap: &Path, root: &Path, network: bool) -> Vec<OsString> {
    let mut words = vec![bubblewrap.as_os_str().to_owned()];
    words.extend(outer());
    let mut bind = |how: &str, path: &Path| {
        words.push(how.into());
        words.extend([path.as_os_str().to_owned(), path.as_os_str().to_owned()]);
    };
    bind("--bind", root);
    bind("--ro-bind", &root.join("in"));
    bind("--ro-bind", &root.join("here"));
    if !network {
        words.push("--unshare-net".into());
    }
    words.push("--".into());
    words
}
