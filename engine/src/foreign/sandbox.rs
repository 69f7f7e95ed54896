//! Bubblewrap, where it is installed: namespaces of a program's own, no capability, and of the file system
//! only what it was given.

use super::installed::{Installed, SYSTEM, in_path, is_system};
use super::places::{ETC, INSIDE, READ, SHM, TMP, WORK, WRITE};
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

/// What keeps programs apart from the rest of a machine.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Sandbox {
    /// Bubblewrap, at this place.
    Bubblewrap(PathBuf),
    /// Nothing, and why.
    None(String),
}

/// Whether programs run in one.
fn boxed() -> bool {
    matches!(sandbox(), Sandbox::Bubblewrap(_))
}

/// Where a program sees what lies in its folder `root`.
pub(super) fn shown(root: &Path, path: &Path) -> PathBuf {
    match path.strip_prefix(root) {
        Ok(inner) if boxed() => Path::new(INSIDE).join(inner),
        _ => path.to_owned(),
    }
}

/// Where on this machine lies what a program sees at a path.
pub(super) fn hosted(root: &Path, path: &Path) -> PathBuf {
    match path.strip_prefix(INSIDE) {
        Ok(inner) if boxed() => root.join(inner),
        _ => path.to_owned(),
    }
}

/// Whether no program may run without a sandbox.
static REQUIRED: AtomicBool = AtomicBool::new(false);

/// From now on no program of this process runs without a full sandbox.
pub fn require_sandbox() {
    REQUIRED.store(true, Ordering::Relaxed);
}

/// Whether programs may run here, as far as the sandbox goes; else why not.
pub(super) fn suffices() -> Result<(), String> {
    match sandbox() {
        Sandbox::None(why) if REQUIRED.load(Ordering::Relaxed) => Err(why.clone()),
        _ => Ok(()),
    }
}

/// What there is on this machine; tried once a process.
pub fn sandbox() -> &'static Sandbox {
    &found().0
}

/// The sandbox, and whether it can keep programs from user namespaces of their own (bubblewrap 0.8).
fn found() -> &'static (Sandbox, bool) {
    static FOUND: OnceLock<(Sandbox, bool)> = OnceLock::new();
    FOUND.get_or_init(|| match in_path("bwrap") {
        None => {
            let why = "bubblewrap (`bwrap`) is not installed";
            (Sandbox::None(why.into()), false)
        }
        Some(path) => match tried(&path, true) {
            Ok(()) => (Sandbox::Bubblewrap(path), true),
            Err(_) => match tried(&path, false) {
                Ok(()) => (Sandbox::Bubblewrap(path), false),
                Err(why) => (Sandbox::None(why), false),
            },
        },
    })
}

fn tried(bubblewrap: &Path, locked: bool) -> Result<(), String> {
    let mut words = apart(locked, false);
    words.extend(system());
    let mut tried = Command::new(bubblewrap);
    tried.args(words).args(["--", "true"]);
    let tried = tried.stdin(Stdio::null()).stdout(Stdio::null()).output();
    match tried {
        Ok(out) if out.status.success() => Ok(()),
        Ok(out) => {
            let why = String::from_utf8_lossy(&out.stderr);
            let why = why.trim().escape_debug();
            Err(format!("bubblewrap cannot be used here ({why})"))
        }
        Err(why) => Err(format!("bubblewrap cannot be started ({why})")),
    }
}

fn said(words: &[&str]) -> Vec<OsString> {
    words.iter().map(OsString::from).collect()
}

/// Namespaces, capabilities, session.
fn apart(locked: bool, network: bool) -> Vec<OsString> {
    let mut words = said(&[
        "--unshare-user",
        "--unshare-pid",
        "--unshare-ipc",
        "--unshare-uts",
        "--unshare-cgroup-try",
        "--hostname",
        "sandbox",
        "--cap-drop",
        "ALL",
        "--new-session",
        "--die-with-parent",
    ]);
    if locked {
        words.push("--disable-userns".into());
    }
    if !network {
        words.push("--unshare-net".into());
    }
    words
}

/// Files of the system's that programs need.
const ETC_FILES: [&str; 4] = [
    "/etc/ld.so.cache",
    "/etc/ld.so.conf",
    "/etc/ld.so.conf.d",
    "/etc/alternatives",
];
/// Files without which nobody reaches a network; certificates, and not the keys that lie beside them.
const ETC_NETWORK: [&str; 12] = [
    "/etc/resolv.conf",
    "/etc/hosts",
    "/etc/nsswitch.conf",
    "/etc/ssl/certs",
    "/etc/ssl/openssl.cnf",
    "/etc/pki/tls/certs",
    "/etc/pki/tls/cert.pem",
    "/etc/pki/ca-trust",
    "/etc/ca-certificates",
    "/etc/crypto-policies",
    "/etc/services",
    "/etc/protocols",
];

/// The system's programs, `/proc`, `/dev`: read-only, `/proc` too, whose settings belong to root by number.
fn system() -> Vec<OsString> {
    let mut words = Vec::new();
    for folder in SYSTEM {
        match std::fs::read_link(folder) {
            Ok(target) => words.extend(["--symlink".into(), target.into(), folder.into()]),
            Err(_) => words.extend(said(&["--ro-bind-try", folder, folder])),
        }
    }
    for file in ETC_FILES {
        words.extend(said(&["--ro-bind-try", file, file]));
    }
    words.extend(said(&[
        "--proc",
        "/proc",
        "--remount-ro",
        "/proc",
        "--dev",
        "/dev",
    ]));
    words.extend(said(&["--dir", "/run", "--dir", "/var/tmp"]));
    words
}

/// What a program sees beside its own folders.
pub(super) struct View<'a> {
    /// What its installation needs.
    pub(super) installed: &'a Installed,
    /// What the node says that it reads.
    pub(super) reads: &'a [String],
    /// What nobody sees: the store.
    pub(super) hidden: &'a Path,
    /// Whether it may reach the network.
    pub(super) network: bool,
}

impl View<'_> {
    /// The folders in PATH that a program sees.
    pub(super) fn path(&self, path: &OsStr) -> OsString {
        let seen = |folder: &PathBuf| {
            let shown = self
                .installed
                .paths
                .iter()
                .any(|shown| folder.starts_with(shown));
            is_system(folder) || shown || self.reads.iter().any(|shown| folder.starts_with(shown))
        };
        let folders = std::env::split_paths(path).filter(seen);
        std::env::join_paths(folders).unwrap_or_default()
    }
}

/// The words before a command: what it sees, and that it may write to its own folders in `root` alone.
pub(super) fn words(bubblewrap: &Path, root: &Path, view: &View<'_>) -> Vec<OsString> {
    let mut words = vec![bubblewrap.as_os_str().to_owned()];
    words.extend(apart(found().1, view.network));
    words.extend(system());
    let mut bind = |how: &str, from: &Path, to: &Path| {
        words.extend([
            how.into(),
            from.as_os_str().to_owned(),
            to.as_os_str().to_owned(),
        ]);
    };
    bind("--bind", &root.join(TMP), Path::new("/tmp"));
    bind("--bind", &root.join(SHM), Path::new("/dev/shm"));
    for name in ["passwd", "group"] {
        bind(
            "--ro-bind",
            &root.join(ETC).join(name),
            &Path::new("/etc").join(name),
        );
    }
    for file in ETC_NETWORK.iter().filter(|_| view.network) {
        bind("--ro-bind-try", Path::new(file), Path::new(file));
    }
    for (at, target) in &view.installed.links {
        bind("--symlink", target, at);
    }
    let reads = view.reads.iter().map(Path::new);
    for path in view
        .installed
        .paths
        .iter()
        .map(PathBuf::as_path)
        .chain(reads)
    {
        bind("--ro-bind", path, path);
    }
    let shows = |path: &Path| view.hidden.starts_with(path);
    if view.installed.paths.iter().any(|path| shows(path)) {
        words.extend(["--tmpfs".into(), view.hidden.as_os_str().to_owned()]);
    }
    let mut bind = |how: &str, name: &str| {
        let to = Path::new(INSIDE).join(name);
        words.extend([
            how.into(),
            root.join(name).into_os_string(),
            to.into_os_string(),
        ]);
    };
    bind("--ro-bind", READ);
    bind("--bind", WRITE);
    bind("--bind", WORK);
    words.extend([
        "--chdir".into(),
        Path::new(INSIDE).join(WORK).into_os_string(),
    ]);
    words.extend(said(&["--remount-ro", "/dev", "--remount-ro", "/", "--"]));
    words
}
