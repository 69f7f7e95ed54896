//! The book in `docs/` is true: its links lead somewhere, its commands are understood, those on what
//! ships run, its screens are what the program prints, and its tables are those of the data. `TAILOR_BOOK=write` writes the tables.

mod bad;
mod commands;
mod faults;
mod figures;
mod growth;
mod lab;
mod links;
mod near;
mod phone;
mod plain;
mod printed;
mod scans;
mod screens;
mod stances;
mod strangers;
mod tables;
mod turning;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::LazyLock;

/// A file of the repository.
fn place(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

fn read(name: &str) -> String {
    std::fs::read_to_string(place(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// The pages that people read: the front page, all chapters and the laboratory.
fn pages() -> Vec<String> {
    let docs = std::fs::read_dir(place("docs")).unwrap();
    let names = docs.map(|e| e.unwrap().file_name().into_string().unwrap());
    let mut pages: Vec<String> = names
        .filter(|n| n.ends_with(".md"))
        .map(|n| format!("docs/{n}"))
        .collect();
    pages.sort();
    pages.extend(lab::pages());
    pages.extend(["README.md", "ARCHITECTURE.md"].map(String::from));
    pages
}

/// A folder with what ships, in which the commands of pages are run: one for all, so that what two of them ask for is made once.
/// What another run of tests left there is removed first.
pub(crate) static FOLDER: LazyLock<PathBuf> = LazyLock::new(|| {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("book");
    match std::fs::remove_dir_all(&folder) {
        Err(e) if e.kind() != std::io::ErrorKind::NotFound => panic!("{e}: {folder:?}"),
        _ => (),
    }
    std::fs::create_dir_all(&folder).unwrap();
    for shipped in ["samples", "pipelines", "models"] {
        std::os::unix::fs::symlink(place(shipped), folder.join(shipped)).unwrap();
    }
    folder
});

/// What a command line of a page comes to there.
fn run(line: &str) -> Output {
    Command::new(env!("CARGO_BIN_EXE_tailor"))
        .args(line.split_whitespace().skip(1))
        .current_dir(&*FOLDER)
        .env_remove("TAILOR_CACHE")
        .output()
        .unwrap()
}
