//! The model that ships is what its tables give: a refit writes the same bytes.

use measure::{FitInput, FitLevels};
use stage::{Ctx, FileEntry, Files, Stage, hash};
use std::path::{Path, PathBuf};
use std::sync::Arc;

fn models() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models")
}

fn tables(names: &[&str]) -> Files {
    let root = models().join("tables");
    let entry = |name: &&str| {
        let bytes = std::fs::read(root.join(name)).unwrap();
        FileEntry {
            name: (*name).into(),
            content: hash(&bytes),
            size: bytes.len() as u64,
        }
    };
    let entries = names.iter().map(entry).collect();
    Files { root, entries }
}

fn fitted(names: &[&str]) -> Result<Vec<u8>, String> {
    let input = FitInput {
        tables: Arc::new(tables(names)),
    };
    match FitLevels::run(&(), input, &Ctx::alone()) {
        Ok(document) => Ok(document.bytes),
        Err(stage::Stop::Failed(e)) => Err(e.to_string()),
        Err(stage::Stop::Cancelled) => Err("cancelled".into()),
    }
}

#[test]
fn a_refit_writes_the_model_that_ships() {
    let refit = fitted(&[
        "ansur2.csv",
        "made-bodies.csv",
        "strangers.csv",
        "neck.csv",
        "arms.csv",
    ])
    .unwrap();
    let shipped = std::fs::read(models().join("levels-1.toml")).unwrap();
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("levels-1.toml");
    std::fs::write(&path, &refit).unwrap();
    assert!(
        refit == shipped,
        "models/levels-1.toml is not what its tables give; the refit is in {}",
        path.display()
    );
}

#[test]
fn a_fit_without_one_of_its_tables_names_it() {
    let stated = fitted(&["ansur2.csv"]).unwrap_err();
    assert_eq!(stated, "there is no made-bodies.csv among the files");
}

#[test]
fn intervals_of_levels_hold_on_bodies_that_no_fit_has_seen() {
    let text = std::fs::read_to_string(models().join("levels-1.toml")).unwrap();
    let model: toml::Table = text.parse().unwrap();
    let entries = model["held_out"].as_array().unwrap();
    // Only bodies driven to people have ribs and hip bones.
    let families = |level: &str| match level {
        "waist" | "hip_bone" => vec!["survey"],
        _ => vec!["range", "reach", "survey"],
    };
    for level in ["waist", "navel", "hip_bone", "chest", "larynx"] {
        let own = entries
            .iter()
            .filter(|e| e["level"].as_str() == Some(level));
        let own: Vec<_> = own
            .filter(|e| families(level).contains(&e["family"].as_str().unwrap()))
            .collect();
        // Each family counts alike, as in the fit, and strangers by themselves, whose scatter is none of the fit's here.
        let inside = |e: &toml::Value| e["coverage_of_90"].as_float().unwrap();
        let share = own.iter().map(|e| inside(e)).sum::<f64>() / own.len() as f64;
        assert_eq!(own.len(), families(level).len());
        let strangers = entries.iter().find(|e| {
            e["level"].as_str() == Some(level) && e["family"].as_str() == Some("strangers")
        });
        let least = strangers.map_or(share, |e| inside(e).min(share));
        assert!((0.85..=0.95).contains(&least), "{level}: {share}, {least}");
    }
}
