//! Bubblewrap, where it is installed: namespaces of a program's own, no capability, and of the file system
//! only what it was given. Without it the kernel alone (`launcher.rs`).

use crate::installed::{SYSTEM, in_path};
use crate::launcher;
use crate::places::{ETC, INSIDE, READ, SHM, TMP, WORK, WRITE};
use crate::view::{ETC_FILES, ETC_NETWORK, View};
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

/// What keeps programs apart from the rest of a machine.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Sandbox {
    /// Bubblewrap, at this place.
    Bubblewrap(PathBuf),
    /// The kernel alone (Landlock, seccomp): some of what bubblewrap does.
    Kernel {
        /// The program that confines itself and becomes another.
        launcher: PathBuf,
        /// Why there is no bubblewrap.
        why: String,
        /// Whether signals to processes outside are kept back, too.
        signals: bool,
    },
    /// Nothing, and why.
    None(String),
}

impl Sandbox {
    /// What a program can do all the same, and why, in a sentence; `None` where it is a full sandbox.
    pub fn lacks(&self) -> Option<String> {
        match self {
            Sandbox::Bubblewrap(_) => None,
            Sandbox::Kernel { why, signals, .. } => {
                let signals = if *signals {
                    ""
                } else {
                    ", and can send them signals"
                };
                Some(format!(
                    "{why}: Landlock keeps the pipeline's programs from files that they are not given and from the \
                     network; they see names of files and processes{signals}"
                ))
            }
            Sandbox::None(why) => Some(format!(
                "{why}: the pipeline's programs can reach the network, and read and write wherever you can"
            )),
        }
    }
}

/// Whether programs run in bubblewrap.
pub(crate) fn boxed() -> bool {
    matches!(sandbox(), Sandbox::Bubblewrap(_))
}

/// Where a program sees what is in its folder `root`.
pub(crate) fn shown(root: &Path, path: &Path) -> PathBuf {
    match path.strip_prefix(root) {
        Ok(inner) if boxed() => Path::new(INSIDE).join(inner),
        _ => path.to_owned(),
    }
}

/// Where on this machine is what a program sees at a path.
pub(crate) fn hosted(root: &Path, path: &Path) -> PathBuf {
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
pub(crate) fn suffices() -> Result<(), String> {
    match sandbox().lacks() {
        Some(lacks) if REQUIRED.load(Ordering::Relaxed) => Err(lacks),
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
        None => (
            confined("bubblewrap (`bwrap`) is not installed".into()),
            false,
        ),
        Some(path) => match tried(&path, true) {
            Ok(()) => (Sandbox::Bubblewrap(path), true),
            Err(_) => match tried(&path, false) {
                Ok(()) => (Sandbox::Bubblewrap(path), false),
                Err(why) => (confined(why), false),
            },
        },
    })
}

/// What there is without bubblewrap.
fn confined(why: String) -> Sandbox {
    match launcher::tried() {
        Some(Ok((launcher, signals))) => Sandbox::Kernel {
            launcher,
            why,
            signals,
        },
        Some(Err(neither)) => Sandbox::None(format!("{why} ({neither})")),
        None => Sandbox::None(why),
    }
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

fn printed(words: &[&str]) -> Vec<OsString> {
    words.iter().map(OsString::from).collect()
}

/// Namespaces, capabilities, session.
fn apart(locked: bool, network: bool) -> Vec<OsString> {
    let mut words = printed(&[
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

/// The system's programs, `/proc`, `/dev`: read-only, `/proc` too, whose settings belong to root by number.
fn system() -> Vec<OsString> {
    let mut words = Vec::new();
    for folder in SYSTEM {
        match std::fs::read_link(folder) {
            Ok(target) => words.extend(["--symlink".into(), target.into(), folder.into()]),
            Err(_) => words.extend(printed(&["--ro-bind-try", folder, folder])),
        }
    }
    for file in ETC_FILES {
        words.extend(printed(&["--ro-bind-try", file, file]));
    }
    words.extend(printed(&[
        "--proc",
        "/proc",
        "--remount-ro",
        "/proc",
        "--dev",
        "/dev",
    ]));
    words.extend(printed(&["--dir", "/run", "--dir", "/var/tmp"]));
    words
}

/// The words before a command: what it sees, and that it may write to its own folders in `root` alone.
pub(crate) fn words(bubblewrap: &Path, root: &Path, view: &View<'_>) -> Vec<OsString> {
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
    words.extend(printed(&[
        "--remount-ro",
        "/dev",
        "--remount-ro",
        "/",
        "--",
    ]));
    words
}
