//! The engine and the contract serve any trade: no file of theirs names the product.

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
