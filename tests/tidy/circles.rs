//! No file imports itself through the files of its crate.
//!
//! An arrow goes from a file to the one that defines what it names: by `use`, or by a path that begins with
//! `crate`, `super`, `self` or a module that the file declares. A name that a module only passes on
//! (`pub use`) belongs to the file that defines it; passing it on is no arrow. Tests within files, comments
//! and texts do not count: a test may look upward.

use super::imports;

use imports::Crate;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Those that come round to themselves, each circle once.
fn circles(arrows: &BTreeMap<String, BTreeSet<String>>) -> BTreeSet<BTreeSet<String>> {
    let reach = |from: &String| {
        let mut seen = BTreeSet::new();
        let mut open: Vec<&String> = arrows[from].iter().collect();
        while let Some(next) = open.pop() {
            if seen.insert(next.clone()) {
                open.extend(&arrows[next]);
            }
        }
        seen
    };
    let reached: BTreeMap<_, _> = arrows.keys().map(|from| (from, reach(from))).collect();
    let round = reached.iter().filter(|(from, to)| to.contains(**from));
    let circle = |(from, to): (&&String, &BTreeSet<String>)| {
        let back = |other: &&String| reached[*other].contains(*from);
        to.iter().filter(back).cloned().collect()
    };
    round.map(circle).collect()
}

/// The arrows of each stages' crate, of the engine and of the product.
fn crates() -> Vec<BTreeMap<String, BTreeSet<String>>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let stages = std::fs::read_dir(root.join("stages")).unwrap();
    let mut crates: Vec<PathBuf> = stages.map(|e| e.unwrap().path()).collect();
    crates.extend(
        ["study", ""]
            .iter()
            .copied()
            .chain(super::engine::ENGINE.map(|(path, _)| path))
            .map(|c| root.join(c)),
    );
    crates.sort();
    let arrows = |c: &PathBuf| Crate::read(&c.join("src")).arrows(root);
    crates.iter().map(arrows).collect()
}

fn listed(circles: &BTreeSet<BTreeSet<String>>) -> String {
    let line = |c: &BTreeSet<String>| c.iter().cloned().collect::<Vec<_>>().join(", ");
    circles.iter().map(line).collect::<Vec<_>>().join("\n")
}

#[test]
fn no_file_comes_round_to_itself() {
    let found: BTreeSet<_> = crates().iter().flat_map(circles).collect();
    let text = listed(&found);
    assert!(
        found.is_empty(),
        "these files need each other; move what they share below them:\n{text}"
    );
}

#[test]
fn no_folder_comes_round_to_itself() {
    // A file beside the folders counts as a folder; `a.rs` beside `a/` belongs to it.
    let folder = |file: &String| -> String {
        let (src, inner) = file.split_at(file.find("src/").unwrap() + "src/".len());
        let first = inner.split('/').next().unwrap();
        format!("{src}{}", first.trim_end_matches(".rs"))
    };
    let mut found = BTreeSet::new();
    for files in crates() {
        let mut folders: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
        for (from, to) in &files {
            let own = folder(from);
            let imported = to.iter().map(folder).filter(|other| *other != own);
            let imported: Vec<String> = imported.collect();
            folders.entry(own).or_default().extend(imported);
        }
        found.extend(circles(&folders));
    }
    let text = listed(&found);
    assert!(
        found.is_empty(),
        "these folders need each other; move what they share below them:\n{text}"
    );
}

#[test]
fn a_circle_is_found_through_what_is_passed_on_and_a_test_makes_none() {
    let at = std::env::temp_dir().join(format!("circles-{}", std::process::id()));
    let write = |name: &str, text: &str| {
        let path = at.join("src").join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    };
    write(
        "lib.rs",
        "mod a;\nmod b;\npub use b::inner::{B as Named, C};\n",
    );
    write("a.rs", "use super::{Named, C};\npub struct A(Named, C);\n");
    write(
        "b/mod.rs",
        "//! No arrow: `use super::a::A;`\npub(crate) mod inner;\n",
    );
    write(
        "b/inner.rs",
        "pub struct B;\n#[cfg(test)]\nmod tests {\n use super::a::A;\n}\n",
    );
    let found = || circles(&Crate::read(&at.join("src")).arrows(&at));
    assert_eq!(found(), BTreeSet::new());
    write(
        "b/inner.rs",
        "const TEXT: &str = \"\\\"\";\npub type B = super::super::a::A;\n",
    );
    let both = ["src/a.rs", "src/b/inner.rs"].map(str::to_owned);
    assert_eq!(found(), BTreeSet::from([BTreeSet::from(both)]));
    std::fs::remove_dir_all(&at).unwrap();
}
