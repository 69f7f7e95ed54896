//! Names: no file of the engine or the contract, which serve any application, names the product; tests that a page
//! names are there.

use std::path::Path;

/// A format's name, which is in the hash of every result, and marks that older files bear.
const KEPT: [&str; 5] = [
    "TAILORAF",
    "TAILORIX",
    "tailor store 1",
    "tailor shared ",
    "tailor signing key 1",
];

/// Lines that name the product beside what is kept.
fn naming(text: &str) -> usize {
    let names = |line: &&str| {
        let rest = KEPT.iter().fold(line.to_string(), |l, k| l.replace(k, ""));
        rest.to_lowercase().contains("tailor")
    };
    text.lines().filter(names).count()
}

#[test]
fn no_file_of_the_engine_names_the_product() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut open = ["engine", "stages/stage"].map(|f| root.join(f)).to_vec();
    let (mut looked, mut found) = (0, Vec::new());
    while let Some(folder) = open.pop() {
        for entry in std::fs::read_dir(&folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.push(path);
            } else if let Ok(text) = std::fs::read_to_string(&path) {
                looked += 1;
                (0..naming(&text)).for_each(|_| found.push(path.clone()));
            }
        }
    }
    assert!(looked > 100, "{looked}");
    assert!(found.is_empty(), "{found:?}");
    assert_eq!(
        naming("a `tailor` run\nTAILORAF\nmagic \"TAILORAF\", tailored\n"),
        2
    );
}

/// Promises of a page, each with its tests in a paragraph that begins so.
const TESTS: &str = "Tests: ";

#[test]
fn tests_that_the_page_on_security_names_are_there() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let page = std::fs::read_to_string(root.join("docs/lab/security.md")).unwrap();
    let promises = page.lines().filter(|line| line.starts_with(TESTS));
    let words = promises.flat_map(|line| line.split('`').skip(1).step_by(2));
    let is_name = |name: &&str| name.bytes().all(|b| b.is_ascii_lowercase() || b == b'_');
    let mut names: Vec<&str> = words.filter(is_name).collect();
    assert!(names.len() > 20, "{names:?}");
    let mut open = ["src", "engine", "stages", "study", "tests"]
        .map(|f| root.join(f))
        .to_vec();
    while let Some(folder) = open.pop() {
        for entry in std::fs::read_dir(&folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|e| e == "rs") {
                let text = std::fs::read_to_string(&path)
                    .unwrap()
                    .replace("\n    ", "\n");
                names.retain(|name| !text.contains(&format!("#[test]\nfn {name}() {{")));
            }
        }
    }
    assert_eq!(names, Vec::<&str>::new());
}
