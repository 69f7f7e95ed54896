//! What `cache forget` reports: what went, what stays, and what it could not be sure of.

use super::fault::Fault;
use super::program::GlobalArgs;
use super::size::mib;
use super::text::count;
use engine::delivery::Withdrawn;
use engine::store::Forgotten;
use serde_json::json;
use std::path::PathBuf;

/// The line about results that remain.
pub(super) fn remains(out: &str) -> String {
    format!("results of it remain in {out}: remove the folder, or run this again with --out {out}")
}

/// Tells what went.
///
/// # Errors
///
/// Something that may have come of the folder could not be read, whether it stays or went.
pub(super) fn reported(
    f: &Forgotten,
    stay: &[String],
    gone: &[(PathBuf, Withdrawn)],
    global: &GlobalArgs,
) -> Result<(), Fault> {
    if global.json {
        let removed = |(out, w): &(PathBuf, Withdrawn)| json!({ "out": out.display().to_string(), "files": w.removed, "left": w.left });
        let removed: Vec<_> = gone.iter().map(removed).collect();
        crate::outln!(
            "{}",
            json!({
                "results": f.results, "bytes": f.bytes, "runs": f.runs, "pins": f.pins, "shared": f.shared,
                "outs": stay, "removed": removed, "broken": f.broken, "untraced": f.untraced,
                "unnamed": f.unnamed, "unread": f.unread,
            })
        );
        return match f.unread.is_empty() && f.broken == 0 {
            true => Ok(()),
            false => Err(Fault::stage("")),
        };
    }
    lines(f).iter().for_each(|line| crate::outln!("{line}"));
    for (out, withdrawn) in gone {
        let out = out.display();
        crate::outln!("removed from {out}: files {}", withdrawn.removed);
        if !withdrawn.left.is_empty() {
            let left = withdrawn.left.join(", ");
            crate::outln!("left in {out} (not written by a run, or changed since): {left}");
        }
    }
    stay.iter()
        .for_each(|out| crate::outln!("{}", remains(out)));
    let wrong = unread(f);
    match wrong.is_empty() {
        true => Ok(()),
        false => Err(Fault::stage(wrong.join("\n"))),
    }
}

/// What could not be read: what went without anybody knowing whose it was, and what stays.
fn unread(f: &Forgotten) -> Vec<String> {
    let mut lines = Vec::new();
    if f.broken > 0 {
        lines.push(format!(
            "{} could not be read, as of a broken disk: removed with all that may have come of them, of other captures, too; that is made again when needed",
            count(f.broken, "record")
        ));
    }
    if !f.unread.is_empty() {
        lines.push(format!(
            "not all of it may be gone, since these could not be read: {}; a newer program wrote them, or they are not yours: run this again with the program that wrote them, or remove them",
            f.unread.join(", ")
        ));
    }
    lines
}

/// What went of the store, and why some of it did.
fn lines(f: &Forgotten) -> Vec<String> {
    let mut lines = Vec::new();
    let (results, runs, freed) = (f.results, f.runs, mib(f.bytes));
    if f.known {
        lines.push(format!(
            "forgotten: results {results} ({freed:.1} MiB), records of runs {runs}, all unfinished parts"
        ));
    }
    if f.untraced > 0 {
        lines.push(format!(
            "{} more went, since nothing readable names what they came of; made again when needed",
            count(f.untraced, "result")
        ));
    }
    if f.unnamed > 0 {
        lines.push(format!(
            "{} without a record removed, as killed runs leave them",
            count(f.unnamed, "blob")
        ));
    }
    if !f.pins.is_empty() {
        lines.push(format!("pins that went with them: {}", f.pins.join(", ")));
    }
    let shared = f.shared.iter();
    lines.extend(
        shared.map(|folder| {
            format!("{folder} shared some of it; that is made again when it is needed")
        }),
    );
    lines
}
