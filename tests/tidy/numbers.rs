//! Numbers of the stages that are constants without a source: how many there are may only fall.
//!
//! A number is structural, derived, cited, or fitted with data and program; a choice of a user is a param. What is left was
//! set by hand.

use super::rules::sources;
use std::collections::BTreeMap;

/// Constants with a number in it whose comment names no source, by crate.
const UNSOURCED: [(&str, usize); 12] = [
    ("capture", 36),
    ("follow", 10),
    ("hull", 2),
    ("io", 4),
    ("measure", 81),
    ("person", 2),
    ("pose", 73),
    ("refine", 2),
    ("report", 3),
    ("shape", 8),
    ("silhouette", 96),
    ("turning", 10),
];

/// What a comment names where a number comes from a paper, a standard, a program's fit or another number.
const SOURCES: [&str; 9] = [
    "fitted",
    "models/",
    "ISO ",
    "RFC ",
    "Exif",
    "ANSUR",
    "MediaPipe",
    "derived",
    "structural",
];

/// What names a form of code or bytes, and bounds nothing.
const FORMS: [&str; 2] = ["VERSION", "FORMAT"];

/// Whether a comment names a source: one of the above, or a year of a paper.
fn sourced(comment: &str) -> bool {
    let year = |word: &str| {
        let digits = word.trim_matches(|c: char| !c.is_ascii_digit());
        digits.len() == 4 && (digits.starts_with("19") || digits.starts_with("20"))
    };
    SOURCES.iter().any(|s| comment.contains(s)) || comment.split_whitespace().any(year)
}

/// The constants of a file, tests left out, that hold a number of theirs and name no source.
fn unsourced(text: &str) -> Vec<&str> {
    let text = text.split("#[cfg(test)]").next().unwrap_or_default();
    let (mut comment, mut found) = (String::new(), Vec::new());
    for (line, rest) in text.lines().zip(text.lines().skip(1).chain([""])) {
        let trimmed = line.trim_start();
        if trimmed.starts_with("//") || trimmed.starts_with("#[") {
            comment += trimmed;
            continue;
        }
        let declared = trimmed
            .trim_start_matches("pub(crate) ")
            .trim_start_matches("pub(super) ")
            .trim_start_matches("pub ")
            .strip_prefix("const ");
        let named = declared.and_then(|d| d.split_once(':'));
        if let Some((name, (kind, value))) = named.and_then(|(n, d)| Some((n, d.split_once(" =")?)))
        {
            let numeric = [
                "f64", "f32", "usize", "u8", "u16", "u32", "u64", "i32", "i64",
            ];
            let value = if value.ends_with(';') {
                value.to_owned()
            } else {
                format!("{value}{rest}")
            };
            let is_number = numeric.iter().any(|n| kind.contains(n))
                && value.contains(|c: char| c.is_ascii_digit());
            if is_number && !FORMS.contains(&name) && !sourced(&comment) {
                found.push(name);
            }
        }
        comment.clear();
    }
    found
}

#[test]
fn numbers_without_a_source_only_become_fewer() {
    let mut found: BTreeMap<String, usize> = BTreeMap::new();
    for (path, text) in sources() {
        let parts: Vec<_> = path.iter().filter_map(|p| p.to_str()).collect();
        if let ["stages", name, "src", .., file] = parts[..]
            && !file.ends_with("tests.rs")
        {
            *found.entry(name.to_owned()).or_default() += unsourced(&text).len();
        }
    }
    found.retain(|_, count| *count > 0);
    let listed = UNSOURCED.map(|(name, count)| (name.to_owned(), count));
    assert_eq!(
        found.into_iter().collect::<Vec<_>>(),
        listed,
        "a number needs a source, or is a param; where there are fewer, lower the list in tests/tidy/numbers.rs"
    );
}

#[test]
fn a_source_is_a_year_a_fit_or_a_standard() {
    let text = "/// Of a paper (Lowe 2004).\nconst A: f64 = 0.8;\n/// By hand.\npub const B_MM: [f64; 2] =\n    [1.0, 2.0];\n\
        const VERSION: u32 = 3;\nconst NAME: &str = \"9\";\n/// Fitted by models/x.py.\nconst C: usize = 7;\nconst D: u8 = 1;\n\
        #[cfg(test)]\nconst E: f64 = 1.0;\n";
    assert_eq!(unsourced(text), ["B_MM", "D"]);
}

/// Params whose default was set by hand, by the crate of their stages (`tailor stages --provenance` lists them).
const DEFAULTS_BY_HAND: [(&str, usize); 7] = [
    ("capture", 1),
    ("hull", 1),
    ("measure", 1),
    ("pose", 43),
    ("refine", 38),
    ("silhouette", 19),
    ("turning", 2),
];

#[test]
fn defaults_set_by_hand_only_become_fewer() {
    let mut found: BTreeMap<&str, usize> = BTreeMap::new();
    for stage in tailor::catalog::CATALOG.stages() {
        let by_hand = stage.params().into_iter().filter(|p| p.is_number());
        let by_hand = by_hand.filter(|p| p.source.is_by_hand()).count();
        let group = stage.name().split('.').next().unwrap_or_default();
        *found.entry(group).or_default() += by_hand;
    }
    found.retain(|_, count| *count > 0);
    assert_eq!(
        found.into_iter().collect::<Vec<_>>(),
        DEFAULTS_BY_HAND,
        "a default needs a source (`#[source(…)]`); where fewer are set by hand, lower the list in tests/tidy/numbers.rs"
    );
}
