//! Numbers of the stages by where they come from: those that were set by hand may only become fewer.
//!
//! A number is structural, derived, cited, or fitted with data and program; a choice of a user is a param. What is left was
//! set by hand: its comment has what was looked at, or that this is not on record.

use super::rules::sources;
use std::collections::BTreeMap;

/// Constants and defaults of params that were set by hand, by crate: of how many it is on record what was looked at, and of
/// how many it is not.
type ByHand = (&'static str, [usize; 2]);

const CONSTANTS_BY_HAND: [ByHand; 12] = [
    ("capture", [6, 26]),
    ("follow", [0, 10]),
    ("hull", [2, 1]),
    ("io", [0, 4]),
    ("measure", [66, 1]),
    ("person", [3, 0]),
    ("pose", [57, 0]),
    ("refine", [1, 1]),
    ("report", [0, 3]),
    ("shape", [6, 4]),
    ("silhouette", [72, 0]),
    ("turning", [5, 4]),
];

const DEFAULTS_BY_HAND: [ByHand; 7] = [
    ("capture", [0, 1]),
    ("hull", [1, 0]),
    ("measure", [0, 1]),
    ("pose", [33, 0]),
    ("refine", [8, 22]),
    ("silhouette", [1, 6]),
    ("turning", [0, 2]),
];

/// Constants that are called structural without a word of why.
const BARELY_STRUCTURAL: usize = 53;

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

/// What the comment of a number begins with that was set by hand.
const LOOKED_AT: &str = "By hand: looked at ";
const NOT_ON_RECORD: &str = "By hand: not on record";

/// What names a form of code or bytes, and bounds nothing.
const FORMS: [&str; 2] = ["VERSION", "FORMAT"];

/// Where a constant's number comes from, by its comment.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Origin {
    Named,
    LookedAt,
    NotOnRecord,
    /// The comment has nothing of it, or "by hand" in other words than these.
    Missing,
}

/// What a comment names as a number's source: one of the above, or a year of a paper.
fn named(comment: &str) -> bool {
    let year = |word: &str| {
        let digits = word.trim_matches(|c: char| !c.is_ascii_digit());
        digits.len() == 4 && (digits.starts_with("19") || digits.starts_with("20"))
    };
    SOURCES.iter().any(|s| comment.contains(s)) || comment.split_whitespace().any(year)
}

/// Who set a number by hand has no source for it, whatever else the comment names.
fn origin(comment: &str) -> Origin {
    let by_hand = comment.to_lowercase().contains("by hand");
    let looked_at = comment.split_once(LOOKED_AT).map(|(_, what)| what);
    match (by_hand, looked_at) {
        (false, _) if named(comment) => Origin::Named,
        (true, Some(what)) if what.split_whitespace().count() > 2 => Origin::LookedAt,
        (true, None) if comment.contains(NOT_ON_RECORD) => Origin::NotOnRecord,
        _ => Origin::Missing,
    }
}

/// The constants of a file, tests left out, that hold a number of theirs: name and comment.
fn constants(text: &str) -> Vec<(&str, String)> {
    let text = text.split("#[cfg(test)]").next().unwrap_or_default();
    let (mut comment, mut found) = (String::new(), Vec::new());
    for (line, rest) in text.lines().zip(text.lines().skip(1).chain([""])) {
        let trimmed = line.trim_start();
        if trimmed.starts_with("//") || trimmed.starts_with("#[") {
            comment += trimmed.trim_start_matches('/');
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
            if is_number && !FORMS.contains(&name) {
                found.push((name, std::mem::take(&mut comment)));
            }
        }
        comment.clear();
    }
    found
}

/// Of all stages: crate, name with its file, and comment.
fn all_constants() -> Vec<(String, String, String)> {
    let mut all = Vec::new();
    for (path, text) in sources() {
        let parts: Vec<_> = path.iter().filter_map(|p| p.to_str()).collect();
        if let ["stages", of, "src", .., file] = parts[..]
            && !file.ends_with("tests.rs")
        {
            let one = |(name, comment)| {
                (
                    of.to_owned(),
                    format!("{}: {name}", path.display()),
                    comment,
                )
            };
            all.extend(constants(&text).into_iter().map(one));
        }
    }
    all
}

fn constants_whose(comment_is: impl Fn(&str) -> bool) -> Vec<String> {
    let all = all_constants().into_iter();
    let chosen = all.filter(|(_, _, comment)| comment_is(comment));
    chosen.map(|(_, name, _)| name).collect()
}

#[test]
fn constants_set_by_hand_only_become_fewer() {
    let mut found: BTreeMap<String, [usize; 2]> = BTreeMap::new();
    for (of, _, comment) in all_constants() {
        match origin(&comment) {
            Origin::LookedAt => found.entry(of).or_default()[0] += 1,
            Origin::NotOnRecord => found.entry(of).or_default()[1] += 1,
            Origin::Named | Origin::Missing => {}
        }
    }
    let listed = CONSTANTS_BY_HAND.map(|(name, counts)| (name.to_owned(), counts));
    assert_eq!(
        found.into_iter().collect::<Vec<_>>(),
        listed,
        "a number needs a source, or is a param; where there are fewer, lower the list in tests/tidy/numbers.rs"
    );
}

#[test]
fn every_constant_names_where_its_number_comes_from() {
    let missing = |comment: &str| origin(comment) == Origin::Missing;
    let found = constants_whose(missing);
    assert!(
        found.is_empty(),
        "a source, \"{LOOKED_AT}…\" or \"{NOT_ON_RECORD}\" is missing: {found:#?}"
    );
}

#[test]
fn what_is_not_on_record_names_no_source() {
    let hides = |comment: &str| {
        origin(comment) == Origin::NotOnRecord && SOURCES.iter().any(|s| comment.contains(s))
    };
    let found = constants_whose(hides);
    assert!(found.is_empty(), "a source, or none: {found:#?}");
}

#[test]
fn constants_called_structural_without_why_only_become_fewer() {
    let bare = |comment: &str| {
        let more = SOURCES.iter().filter(|s| **s != "structural");
        let why = ["structural:", "structural (", "structural, "];
        comment.contains("structural") && !why.iter().chain(more).any(|s| comment.contains(s))
    };
    let found = constants_whose(bare);
    assert_eq!(found.len(), BARELY_STRUCTURAL, "{found:#?}");
}

#[test]
fn a_number_set_by_hand_has_no_source_beside_it() {
    let text = "/// Of a paper (Lowe 2004).\nconst A: f64 = 0.8;\n/// By hand.\npub const B_MM: [f64; 2] =\n    [1.0, 2.0];\n\
        const VERSION: u32 = 3;\nconst NAME: &str = \"9\";\n/// Fitted by models/x.py.\nconst C: usize = 7;\nconst D: u8 = 1;\n\
        /// Wide. By hand: looked\n/// at two scans (ANSUR).\nconst E: f64 = 2.0;\n/// By hand: not on record.\nconst F: f64 = 3.0;\n\
        /// Set by hand, structural.\nconst G: f64 = 4.0;\n/// By hand: looked at it.\nconst H: f64 = 5.0;\n\
        #[cfg(test)]\nconst I: f64 = 1.0;\n";
    let found = constants(text)
        .into_iter()
        .map(|(name, comment)| (name, origin(&comment)));
    let wanted = [
        ("A", Origin::Named),
        ("B_MM", Origin::Missing),
        ("C", Origin::Named),
        ("D", Origin::Missing),
        ("E", Origin::LookedAt),
        ("F", Origin::NotOnRecord),
        ("G", Origin::Missing),
        ("H", Origin::Missing),
    ];
    assert_eq!(found.collect::<Vec<_>>(), wanted);
}

#[test]
fn defaults_set_by_hand_only_become_fewer() {
    let mut found: BTreeMap<&str, [usize; 2]> = BTreeMap::new();
    for stage in tailor::catalog::CATALOG.stages() {
        let by_hand = stage.params().into_iter().filter(|p| p.is_number());
        let group = stage.name().split('.').next().unwrap_or_default();
        for param in by_hand.filter(|p| p.source.is_by_hand()) {
            let unrecorded = param.source == stage::NumberSource::Unrecorded;
            found.entry(group).or_default()[usize::from(unrecorded)] += 1;
        }
    }
    assert_eq!(
        found.into_iter().collect::<Vec<_>>(),
        DEFAULTS_BY_HAND,
        "a default needs a source (`#[source(…)]`); where fewer are set by hand, lower the list in tests/tidy/numbers.rs"
    );
}
