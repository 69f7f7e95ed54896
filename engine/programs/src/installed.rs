//! Programs as they are installed: where one is, and what belongs to it.

use std::ffi::OsStr;
use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::{Component, Path, PathBuf};
use std::sync::Mutex;
use system::can_start;

/// Folders of the system's own programs.
pub(crate) const SYSTEM: [&str; 9] = [
    "/usr",
    "/bin",
    "/sbin",
    "/lib",
    "/lib32",
    "/lib64",
    "/libx32",
    "/nix/store",
    "/gnu/store",
];

/// A program that a host brings along: name, place, folders that it reads.
type Brought = (String, PathBuf, Vec<PathBuf>);

static BROUGHT: Mutex<Vec<Brought>> = Mutex::new(Vec::new());

/// Takes a program of this name from here, whatever is in PATH, and lets it read some folders: for a host
/// that brings it along.
pub fn bring(name: String, path: PathBuf, reads: Vec<PathBuf>) {
    let mut brought = BROUGHT.lock().expect("bug: poisoned");
    brought.retain(|(known, ..)| *known != name);
    brought.push((name, path, reads));
}

/// The program of a name: what the host brings along, else in PATH.
pub(crate) fn in_path(name: &str) -> Option<PathBuf> {
    let brought = BROUGHT.lock().expect("bug: poisoned").clone();
    let own = brought.into_iter().find(|(known, ..)| known == name);
    if let Some((_, path, _)) = own.filter(|(_, path, _)| is_program(path)) {
        return Some(path);
    }
    let path = std::env::var_os("PATH")?;
    let file = |folder: PathBuf| Some(folder.join(name)).filter(|file| is_program(file));
    std::env::split_paths(&path).find_map(file)
}

/// Whether a file can be started.
fn is_program(file: &Path) -> bool {
    std::fs::metadata(file).is_ok_and(|m| m.is_file() && can_start(&m))
}

/// Whether a path is among the system's own.
pub(crate) fn is_system(path: &Path) -> bool {
    SYSTEM.iter().any(|folder| path.starts_with(folder))
}

/// What a program needs that is none of the system's.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct Installed {
    /// Files and folders.
    pub(crate) paths: Vec<PathBuf>,
    /// Links: where, and to what, as written.
    pub(crate) links: Vec<(PathBuf, PathBuf)>,
}

impl Installed {
    /// Without what is in a folder, which is shown already.
    pub(crate) fn without(mut self, folder: &Path) -> Installed {
        self.paths.retain(|path| !path.starts_with(folder));
        self.links.retain(|(path, _)| !path.starts_with(folder));
        self
    }
}

/// How many links and interpreters are followed from one program to the next, as the kernel does.
const MOST_LINKS: usize = 40;

/// What a program needs: itself, the links to it, the folder that it is installed in, and the same of the
/// program that its first line names. `hidden` is what no installation may show.
pub(crate) fn needed(program: &Path, hidden: &Path) -> Installed {
    let mut all = Installed::default();
    let brought = BROUGHT.lock().expect("bug: poisoned").clone();
    let own = brought.into_iter().find(|(_, path, _)| path == program);
    let reads = own.map_or(vec![], |(.., reads)| reads);
    all.paths
        .extend(reads.into_iter().filter(|path| !is_system(path)));
    let mut next = Some(program.to_owned());
    for _ in 0..MOST_LINKS {
        let Some(path) = next.take() else { break };
        let covered = is_system(&path) || all.paths.iter().any(|shown| path.starts_with(shown));
        let folder = (!covered).then(|| installation(&path, hidden)).flatten();
        let target = std::fs::read_link(&path).ok();
        match (covered, folder, &target) {
            (true, ..) => {}
            (_, Some(folder), _) => all.paths.push(folder),
            (_, None, Some(target)) => all.links.push((path.clone(), target.clone())),
            (_, None, None) => all.paths.push(path.clone()),
        }
        next = match target {
            Some(target) => Some(plain(&path.parent().unwrap_or(Path::new("/")).join(target))),
            None => interpreter(&path),
        };
    }
    all
}

/// The folders in PATH that are none of the system's, as they are installed: what is there a user has as
/// programs, and a program may start another.
pub(crate) fn on_path(path: &OsStr, hidden: &Path) -> Vec<PathBuf> {
    let home = std::env::home_dir().unwrap_or_default();
    let mut all: Vec<PathBuf> = Vec::new();
    for folder in std::env::split_paths(path) {
        let whole = installation(&folder.join("program"), hidden);
        let fits = !hidden.starts_with(&folder) && !home.starts_with(&folder);
        let shown = whole.unwrap_or(folder);
        let own = shown.is_absolute() && !is_system(&shown) && shown.is_dir() && fits;
        if own && !all.contains(&shown) {
            all.push(shown);
        }
    }
    all
}

/// The folder that a program is installed in: programs in `bin`, beside it `lib`; or `shims`, which start the
/// programs of the version that is wanted. The home folder, folders above it and what many programs share in
/// it are none, nor is what holds the hidden folder.
fn installation(program: &Path, hidden: &Path) -> Option<PathBuf> {
    let programs = program.parent()?;
    let folder = programs.parent()?;
    let named = match programs.file_name()?.to_str()? {
        "bin" | "sbin" => folder.join("lib").is_dir(),
        "shims" => true,
        _ => false,
    };
    let home = std::env::home_dir().unwrap_or_default();
    let personal = home.starts_with(folder) || folder == home.join(".local");
    let fits = named && !personal && !hidden.starts_with(folder);
    fits.then(|| folder.to_owned())
}

/// A path without `.` and `..`, as far as its text shows.
fn plain(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            Component::ParentDir => _ = plain.pop(),
            Component::CurDir => {}
            part => plain.push(part),
        }
    }
    plain
}

/// How much of a first line the kernel looks at. \[bytes\]
const FIRST_LINE_BYTES: u64 = 256;

/// The program that runs a script.
fn interpreter(script: &Path) -> Option<PathBuf> {
    let mut line = Vec::new();
    let mut first = BufReader::new(File::open(script).ok()?).take(FIRST_LINE_BYTES);
    first.read_until(b'\n', &mut line).ok()?;
    let line = String::from_utf8(line.strip_prefix(b"#!")?.to_vec()).ok()?;
    let program = line.split_whitespace().next()?;
    program.starts_with('/').then(|| PathBuf::from(program))
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::os::unix::fs::symlink;

    #[test]
    fn a_program_brings_its_installation_and_no_folder_of_a_users() {
        let place = tempfile::tempdir().unwrap();
        let at = |name: &str| place.path().join(name);
        for folder in [
            "env/bin",
            "env/lib",
            "base/bin",
            "base/lib",
            "work/cache/exec",
            "work/bin",
            "work/lib",
        ] {
            std::fs::create_dir_all(at(folder)).unwrap();
        }
        let hidden = at("work/cache");
        std::fs::write(at("base/bin/python3"), "").unwrap();
        symlink(at("base/bin/python3"), at("env/bin/python3")).unwrap();
        let script = format!("#!{}\n", at("env/bin/python3").display());
        std::fs::write(at("env/bin/stage"), script).unwrap();
        assert_eq!(
            needed(&at("env/bin/stage"), &hidden).paths,
            [at("env"), at("base")]
        );
        let path =
            std::env::join_paths([at("env/bin"), at("work/bin"), at("work"), "/usr/bin".into()]);
        assert_eq!(
            on_path(&path.unwrap(), &hidden),
            [at("env"), at("work/bin")]
        );
        // Beside the cache are captures.
        std::fs::write(at("work/bin/tool"), "#!/bin/sh\n").unwrap();
        assert_eq!(
            needed(&at("work/bin/tool"), &hidden).paths,
            [at("work/bin/tool")]
        );
        symlink("../bin/tool", at("work/lib/tool")).unwrap();
        let linked = needed(&at("work/lib/tool"), &hidden);
        assert_eq!(
            linked.links,
            [(at("work/lib/tool"), PathBuf::from("../bin/tool"))]
        );
        assert_eq!(linked.paths, [at("work/bin/tool")]);
        assert_eq!(
            needed(Path::new("/usr/bin/env"), &hidden),
            Installed::default()
        );
    }
}
