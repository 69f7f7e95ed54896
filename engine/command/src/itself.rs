//! Where this program is, for another process to start it.

use super::fault::Fault;
use super::program::GlobalArgs;
use std::path::{Path, PathBuf};

/// A command that is beside this process's own program, or else on the path. In the Python package also beside
/// Python as it was called and the script that it runs: the system names an environment's Python by the one that
/// its link leads to.
pub(super) fn beside(name: &str) -> Option<PathBuf> {
    let own = std::env::current_exe().ok();
    let called = match own.as_deref().is_some_and(is_python) {
        true => std::env::args_os().take(2).map(PathBuf::from).collect(),
        false => vec![],
    };
    let own = own.into_iter().chain(called);
    let own = own.filter_map(|p| {
        p.parent()
            .filter(|p| p.is_absolute())
            .map(Path::to_path_buf)
    });
    let path = std::env::var_os("PATH").unwrap_or_default();
    let folders = own.chain(std::env::split_paths(&path));
    let mut places = folders.map(|folder| folder.join(name));
    let found = places.find(|place| place.is_file())?;
    std::path::absolute(found).ok()
}

/// This program: in the Python package the process is Python, and the command is beside it.
pub(super) fn program(global: &GlobalArgs) -> Result<PathBuf, Fault> {
    let own = std::env::current_exe().map_err(Fault::input)?;
    let name = global.program().name;
    match is_python(&own) {
        false => Ok(own),
        true => beside(name).ok_or_else(|| {
            Fault::input(format!(
                "the command `{name}` is neither beside {} nor on the path",
                own.display()
            ))
        }),
    }
}

/// Whether a program is Python.
fn is_python(program: &Path) -> bool {
    let stem = program.file_stem();
    stem.is_some_and(|stem| stem.to_string_lossy().starts_with("python"))
}
