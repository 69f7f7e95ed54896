//! Without bubblewrap, on Linux: our own program is started in place of the pipeline's, keeps itself from all that a
//! node is not given, and becomes it. What bubblewrap does beside that is described where programs run.

use crate::confine::{Given, confine};
use crate::installed::SYSTEM;
use crate::places::{READ, SHM, TMP, WORK, WRITE};
use crate::view::{ETC_FILES, ETC_NETWORK, View};
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};
use std::sync::OnceLock;

/// The first word of a command line that is a launcher's.
const WORD: &str = "--confined";
/// Keeps itself from everything, and prints from what.
const TRY: &str = "--try";
/// What is printed where signals out of the confinement are kept back, too.
const SIGNALS: &str = "signals";
/// The code by which a shell reports that a command cannot be started.
const NOT_STARTED: u8 = 126;

/// This program, if its `main` asks [`launched`].
static PROGRAM: OnceLock<PathBuf> = OnceLock::new();

/// Whether it works here, and keeps signals back, too; else why not. `None` where no launcher was named.
pub(crate) fn tried() -> Option<Result<(PathBuf, bool), String>> {
    let program = PROGRAM.get()?;
    let mut command = Command::new(program);
    let command = command.args([WORD, TRY]).stdin(Stdio::null());
    let out = match command.output() {
        Ok(out) => out,
        Err(why) => return Some(Err(why.to_string())),
    };
    let text = |bytes: &[u8]| {
        String::from_utf8_lossy(bytes)
            .trim()
            .escape_debug()
            .to_string()
    };
    Some(match out.status.success() {
        true => Ok((program.clone(), text(&out.stdout) == SIGNALS)),
        false => Err(text(&out.stderr)),
    })
}

/// Devices that hold nothing of anybody's.
const DEVICES: [&str; 5] = [
    "/dev/null",
    "/dev/zero",
    "/dev/full",
    "/dev/random",
    "/dev/urandom",
];

/// The words before a command that is to be confined.
pub(crate) fn words(launcher: &Path, root: &Path, view: &View<'_>) -> Vec<OsString> {
    let mut words = vec![launcher.as_os_str().to_owned(), WORD.into()];
    let network = ETC_NETWORK.iter().filter(|_| view.network);
    let system = SYSTEM.iter().chain(&ETC_FILES).chain(network);
    let system = system.chain(&["/proc"]).map(PathBuf::from);
    // A folder that holds the store would show it.
    let shown = view.installed.paths.iter().cloned();
    let shown = shown.filter(|path| !view.hidden.starts_with(path));
    let reads = view.reads.iter().map(PathBuf::from);
    for path in system.chain(shown).chain(reads).chain([root.join(READ)]) {
        words.extend(["--read".into(), path.into_os_string()]);
    }
    let own = [WRITE, WORK, TMP, SHM].map(|name| root.join(name));
    for path in own.into_iter().chain(DEVICES.map(PathBuf::from)) {
        words.extend(["--write".into(), path.into_os_string()]);
    }
    if view.network {
        words.push("--network".into());
    }
    words.push("--".into());
    words
}

/// What a launcher's words give, and the command behind them; `None` if they are not understood.
fn read(words: &mut dyn Iterator<Item = OsString>) -> Option<(Given, Vec<OsString>)> {
    let mut given = Given::default();
    loop {
        match words.next()?.to_str()? {
            "--read" => given.read.push(words.next()?.into()),
            "--write" => given.write.push(words.next()?.into()),
            "--network" => given.network = true,
            "--" => break,
            _ => return None,
        }
    }
    let command: Vec<OsString> = words.collect();
    (!command.is_empty()).then_some((given, command))
}

/// What a `main` asks before it does anything, with its words without the program's name. If they are a launcher's,
/// this process confines itself and becomes the command; it returns only if that failed, with a code. If not, this
/// program is from now on the one that confines other programs where there is no bubblewrap.
pub fn launched(words: impl IntoIterator<Item = OsString>) -> Option<ExitCode> {
    let mut words = words.into_iter();
    if words.next().is_none_or(|word| word != WORD) {
        if let Ok(program) = std::env::current_exe() {
            let _ = PROGRAM.set(program);
        }
        return None;
    }
    let mut words = words.peekable();
    if words.next_if(|word| word == TRY).is_some() {
        return Some(match confine(&Given::default()) {
            Ok(signals) => {
                println!("{}", if signals { SIGNALS } else { "" });
                ExitCode::SUCCESS
            }
            Err(why) => refused(&why),
        });
    }
    let Some((given, command)) = read(&mut words) else {
        return Some(refused("this is no command of a user's"));
    };
    Some(match confine(&given) {
        Ok(_) => refused(&format!(
            "{}: {}",
            command[0].display(),
            become_it(&command)
        )),
        Err(why) => refused(&format!("cannot be confined: {why}")),
    })
}

/// Becomes a command; why not, if it returns.
#[cfg(unix)]
fn become_it(command: &[OsString]) -> std::io::Error {
    use std::os::unix::process::CommandExt;
    Command::new(&command[0]).args(&command[1..]).exec()
}

#[cfg(not(unix))]
fn become_it(_command: &[OsString]) -> std::io::Error {
    std::io::ErrorKind::Unsupported.into()
}

fn refused(why: &str) -> ExitCode {
    eprintln!("{why}");
    ExitCode::from(NOT_STARTED)
}
