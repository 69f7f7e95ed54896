//! The engine in layers: what each of its crates knows, and that none knows a product.

use super::rules::breakers;
use std::path::{Path, PathBuf};

/// The engine's crates, lowest first, and what each knows of those below it.
pub(crate) const ENGINE: [(&str, &[&str]); 7] = [
    ("engine/system", &[]),
    ("engine/buckets", &["system"]),
    ("engine/programs", &["system"]),
    ("engine", &["buckets", "programs", "system"]),
    ("engine/tables", &["engine", "system"]),
    ("engine/cluster", &["engine"]),
    (
        "engine/command",
        &[
            "buckets", "cluster", "engine", "programs", "system", "tables",
        ],
    ),
];

#[test]
fn the_engine_knows_the_contract_and_no_trade() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for (part, below) in ENGINE {
        let manifest = std::fs::read_to_string(root.join(part).join("Cargo.toml")).unwrap();
        let product = manifest.split("[dev-dependencies]").next().unwrap();
        let crates = std::fs::read_dir(root.join("stages")).unwrap();
        let names = crates.map(|e| e.unwrap().file_name().into_string().unwrap());
        let known = names.filter(|r| product.contains(&format!("\n{r}.workspace")));
        assert_eq!(known.collect::<Vec<_>>(), ["stage"], "of {part}");
        let own = ENGINE.map(|(path, _)| path.trim_start_matches("engine/"));
        let mut known: Vec<_> = own
            .into_iter()
            .filter(|r| product.contains(&format!("\n{r}.workspace")))
            .collect();
        known.sort_unstable();
        assert_eq!(known, below, "of {part}");
    }
    // Words of the product as the engine would have to spell them to act on them.
    let words = [
        "\"photos\"",
        "\"girths\"",
        "\"mesh\"",
        "\"masks\"",
        "\"cameras\"",
        "\"pose.mat\"",
    ];
    let spells = |path: &Path, text: &str| {
        let product = text.split("#[cfg(test)]").next().unwrap();
        let code = product
            .lines()
            .filter(|l| !l.trim_start().starts_with("//"));
        path.starts_with("engine")
            && path.iter().any(|folder| folder == "src")
            && code
                .into_iter()
                .any(|l| words.iter().any(|w| l.contains(w)))
    };
    assert_eq!(breakers(spells), Vec::<PathBuf>::new());
}
