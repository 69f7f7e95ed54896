//! Whether a stage gives other bytes than before while its VERSION is what it was.
//!
//! `tests/fingerprints/list.txt` has a line a node: stage, version, node, key, content. Where the
//! key is the same, the content must be. Where it is another, an input, a param or a version was
//! changed on purpose: `TAILOR_FINGERPRINTS=write cargo test --release --test fingerprints` notes
//! what comes out now, and refuses to where a key has another content.

use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Stage and version, node, key, content.
type Line = (String, String, String, String);

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fingerprints")
}

/// Runs a pipeline of the folder; what its nodes came to.
fn run(place: &Path, pipeline: &str, more: &[&str]) -> Vec<Line> {
    let mut command = Command::new(env!("CARGO_BIN_EXE_tailor"));
    command
        .current_dir(place)
        .arg("run")
        .arg(folder().join(pipeline));
    command.args(more).args(["--json", "--cache", "cache"]);
    let out = command.output().unwrap();
    let (printed, wrong) = (
        out.stdout,
        String::from_utf8_lossy(&out.stderr).into_owned(),
    );
    let run: Value = serde_json::from_slice(&printed).unwrap_or_else(|e| panic!("{e}: {wrong}"));
    assert!(out.status.success(), "{run}");
    let text = |n: &Value, key: &str| n[key].as_str().unwrap().to_owned();
    let line = |n: &Value| {
        let stage = format!("{} v{}", text(n, "stage"), n["version"]);
        (stage, text(n, "node"), text(n, "key"), text(n, "content"))
    };
    run["nodes"].as_array().unwrap().iter().map(line).collect()
}

fn listed() -> Vec<Line> {
    let text = std::fs::read_to_string(folder().join("list.txt")).unwrap_or_default();
    let line = |line: &str| match line.split(' ').collect::<Vec<_>>()[..] {
        [stage, version, node, key, content] => {
            let stage = format!("{stage} {version}");
            (stage, node.into(), key.into(), content.into())
        }
        _ => panic!("no line of the list: {line}"),
    };
    text.lines().map(line).collect()
}

#[test]
fn no_stage_gives_other_bytes_under_the_same_version() {
    let place = tempfile::tempdir().unwrap();
    let goal = "photos masks moved_masks cameras body girths_formula tracks calibrated ring_swayed walked walk_masks framed framed_by_disk alarmed grabcut masks_by_plate \
        masks_by_turn masks_by_turn_of_phone masks_by_box carved \
        compensated optimized evolved textured girths page mat score phone turned turned_score lit_masks jittered drawn";
    let mut more: Vec<&str> = goal.split_whitespace().collect();
    more.extend(["--out", "out"]);
    let mut now = run(place.path(), "stages.toml", &more);
    let tables = Path::new(env!("CARGO_MANIFEST_DIR")).join("models/tables");
    let tables = format!("tables={}", tables.display());
    let found = folder().join("found").display().to_string();
    let found = ["tags", "tracks", "planes", "tapes"].map(|kind| format!("{kind}={found}"));
    let mut inputs = vec![
        "photos=out/photos",
        "cameras=out",
        "masks=out/masks",
        "surface=out",
        "table=out",
        &tables,
    ];
    inputs.extend(found.iter().map(String::as_str));
    let inputs: Vec<&str> = inputs.iter().flat_map(|i| ["--input", *i]).collect();
    now.extend(run(place.path(), "imports.toml", &inputs));
    let covered: BTreeSet<&str> = now.iter().filter_map(|l| l.0.split(' ').next()).collect();
    for stage in tailor::catalog::stages() {
        // What a foreign program makes of a file is its own; its version is in the key.
        let foreign = !stage.programs().is_empty();
        assert!(
            covered.contains(stage.name()) || foreign,
            "{} has no fingerprint",
            stage.name()
        );
    }
    let of = |node: &str| now.iter().find(|l| l.1 == node).map(|l| &l.3);
    assert_eq!(
        of("grabcut"),
        of("masks_by_plate"),
        "one stage, and its steps"
    );
    let before = listed();
    let known: BTreeMap<&str, &str> = before.iter().map(|l| (&*l.2, &*l.3)).collect();
    let mut wrong = Vec::new();
    for (stage, node, key, content) in &now {
        if known.get(&**key).is_some_and(|before| before != content) {
            wrong.push(format!(
                "{node}: {stage} gives other bytes: raise its VERSION"
            ));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    if std::env::var("TAILOR_FINGERPRINTS").is_ok_and(|v| v == "write") {
        let line = |(stage, node, key, content): &Line| format!("{stage} {node} {key} {content}\n");
        let text: String = now.iter().map(line).collect();
        std::fs::write(folder().join("list.txt"), text).unwrap();
        return;
    }
    for (stage, node, key, _) in &now {
        assert!(
            known.contains_key(&**key),
            "{node}: {stage} is new, or its input or params are; note it with \
             TAILOR_FINGERPRINTS=write cargo test --release --test fingerprints"
        );
    }
}
