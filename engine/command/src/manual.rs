//! Completions for shells and pages for `man`, out of the arguments themselves.

use super::fault::Fault;
use clap::{Args, Command};
use clap_complete::Shell;
use std::path::PathBuf;

/// Arguments of `completions`.
#[derive(Args)]
pub(crate) struct Completions {
    /// The shell
    shell: Shell,
}

/// Arguments of `man`.
#[derive(Args)]
pub(crate) struct Man {
    /// A folder to write one page a verb to; without it the main page goes to standard output
    #[arg(long)]
    out: Option<PathBuf>,
}

/// `completions`: a script that the shell reads.
pub(super) fn completions(asked: &Completions, mut command: Command) {
    let name = command.get_name().to_owned();
    let mut script = Vec::new();
    clap_complete::generate(asked.shell, &mut command, name, &mut script);
    crate::out!("{}", String::from_utf8_lossy(&script));
}

/// `man`: pages in roff.
pub(super) fn man(asked: &Man, command: Command) -> Result<(), Fault> {
    match &asked.out {
        None => {
            let mut page = Vec::new();
            let written = clap_mangen::Man::new(command).render(&mut page);
            written.map_err(Fault::input)?;
            crate::out!("{}", String::from_utf8_lossy(&page));
            Ok(())
        }
        Some(folder) => {
            let written = std::fs::create_dir_all(folder)
                .and_then(|()| clap_mangen::generate_to(command, folder));
            let what = |e| Fault::input(format!("cannot write {}: {e}", folder.display()));
            written.map_err(what)
        }
    }
}
