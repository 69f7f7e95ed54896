//! How a program is started: in the sandbox that there is, in a folder of its own, with a cleared environment.

use crate::error::ForeignError;
use crate::family::MARK;
use crate::installed::{in_path, needed, on_path};
use crate::launcher;
use crate::places::{INSIDE, WORK};
use crate::sandbox::{self, Sandbox};
use crate::task::Task;
use crate::view::View;
use stage::process;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The command that starts it. In the sandbox it ends with the thread that starts it.
pub(crate) fn command(task: &Task<'_>, stdin: Stdio) -> Result<Command, ForeignError> {
    sandbox::suffices().map_err(ForeignError::NoSandbox)?;
    let first = &task.words[0];
    let missing = || ForeignError::Missing(first.clone());
    let there = |p: &PathBuf| sandbox::hosted(task.root, p).exists();
    let program: PathBuf = match first.contains('/') {
        true => Some(PathBuf::from(first)).filter(there),
        false => in_path(first),
    }
    .ok_or_else(missing)?;
    let path = std::env::var_os("PATH").unwrap_or_default();
    let (mut words, path) = walled(task, &program, path);
    words.push(program.into_os_string());
    words.extend(task.words[1..].iter().map(OsString::from));
    let work = task.root.join(WORK);
    let mut command = Command::new(&words[0]);
    command.args(&words[1..]).current_dir(&work).env_clear();
    command.env("PATH", path);
    for name in task.env {
        if let Some(value) = std::env::var_os(name) {
            command.env(name, value);
        }
    }
    let work = sandbox::shown(task.root, &work);
    if !task.env.iter().any(|name| name == "HOME") {
        command.env("HOME", &work);
    }
    command.env("TMPDIR", &work).env("LC_ALL", "C.UTF-8");
    command.env(MARK, task.root);
    process::lead_group(&mut command);
    command
        .stdin(stdin)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    Ok(command)
}

/// The words before a command that keep it in the sandbox, none without one; and the folders in PATH that it sees.
fn walled(task: &Task<'_>, program: &Path, path: OsString) -> (Vec<OsString>, OsString) {
    let sandbox = sandbox::sandbox();
    if let Sandbox::None(_) = sandbox {
        return (vec![], path);
    }
    // The store is two folders above a program's.
    let hidden = task.root.ancestors().nth(2).unwrap_or(task.root);
    let inside = program.starts_with(INSIDE);
    let mut installed = match inside {
        true => needed(&sandbox::hosted(task.root, program), hidden).without(task.root),
        false => needed(program, hidden),
    };
    installed.paths.extend(on_path(&path, hidden));
    let view = View {
        installed: &installed,
        reads: task.reads,
        hidden,
        network: task.network,
    };
    let words = match sandbox {
        Sandbox::Bubblewrap(bubblewrap) => {
            let mut words = sandbox::words(bubblewrap, task.root, &view);
            // How the family is known from outside; the program is to know no folder of the user's.
            let last = words.len() - 1;
            words.splice(last..last, ["--unsetenv".into(), MARK.into()]);
            words
        }
        Sandbox::Kernel { launcher, .. } => launcher::words(launcher, task.root, &view),
        Sandbox::None(_) => vec![],
    };
    (words, view.path(&path))
}
