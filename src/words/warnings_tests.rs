//! Every sentence that a stage warns with is known, and has a German text.

use super::super::findings::translated;
use super::super::language::{Language, Words};
use super::*;
use std::path::{Path, PathBuf};

const DE: Words = Words {
    language: Language::De,
    inches: false,
};

/// What a call of one of these begins with is a warning.
const CALLS: [&str; 5] = [
    "ctx.warn(",
    "warn(",
    "warnings.push(",
    "told.push(",
    "words.push(",
];

/// The Rust files of the stage crates.
fn files() -> Vec<PathBuf> {
    let mut open = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("stages")];
    let mut files = vec![];
    while let Some(folder) = open.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|e| e == "rs")
                && path.components().any(|c| c.as_os_str() == "src")
            {
                files.push(path);
            }
        }
    }
    files
}

/// The literal that a call begins with, `*` for what is put in; none where it is no literal.
pub(in crate::words) fn literal(after: &str) -> Option<String> {
    let after = after.trim_start();
    let after = after.strip_prefix('&').unwrap_or(after);
    let inner = after.strip_prefix("format!(").unwrap_or(after).trim_start();
    let mut text = String::new();
    let mut letters = inner.strip_prefix('"')?.chars().peekable();
    while let Some(letter) = letters.next() {
        match letter {
            '"' => return Some(text),
            '\\' if letters.peek() == Some(&'\n') => {
                while letters.peek().is_some_and(|l| l.is_whitespace()) {
                    letters.next();
                }
            }
            '\\' => text.push(letters.next()?),
            '{' => {
                text.push('*');
                letters.by_ref().find(|l| *l == '}');
            }
            other => text.push(other),
        }
    }
    None
}

/// Every sentence that is warned with where it is made.
fn sentences() -> Vec<String> {
    let mut all = vec![];
    for file in files() {
        let text = std::fs::read_to_string(&file).unwrap();
        let code = text.split("#[cfg(test)]").next().unwrap_or_default();
        for call in CALLS {
            let places = code
                .match_indices(call)
                .map(|(at, _)| &code[at + call.len()..]);
            all.extend(places.filter_map(literal));
        }
    }
    // What only joins a name and a sentence has no words.
    all.retain(|s| !s.ends_with(": *"));
    all.retain(|s| s.contains(' ') && s.chars().filter(|c| c.is_alphabetic()).count() > 9);
    all
}

#[test]
fn every_warning_of_the_crates_has_its_texts() {
    let all = sentences();
    assert!(all.len() > 40, "{all:?}");
    let known = |s: &str| WARNINGS.iter().any(|(pattern, _)| *pattern == s);
    for sentence in &all {
        let bare = sentence.split_once("*: ").map_or("", |(_, rest)| rest);
        let fits = known(sentence) || known(bare);
        assert!(fits, "warnings.rs does not know: {sentence}");
    }
}

#[test]
fn texts_of_stages_on_pages_name_no_flag_and_no_file_of_the_command_line() {
    let alien = [
        "--",
        "capture.toml",
        "tailor measure",
        "tailor mat",
        "tailor show",
        "`",
        "[mat]",
        "_mm",
    ];
    for language in Language::ALL {
        let of_stages = |line: &&str| {
            ["warn-", "find-", "fail-"]
                .iter()
                .any(|k| line.starts_with(k))
        };
        for line in language.texts().lines().filter(of_stages) {
            let found = alien.iter().find(|word| line.contains(**word));
            assert_eq!(found, None, "{}: {line}", language.code());
        }
    }
}

#[test]
fn every_reason_and_note_is_in_german() {
    use shape::{Note, Refusal};
    let share = 0.123;
    let notes = [
        Note::Open { share }.sentence(),
        Note::SplineLeft { share }.sentence(),
        Note::Folds { share }.sentence(),
    ];
    let why = Refusal::ALL.map(|r| format!("AC_L: {r}"));
    for sentence in why.iter().chain(&notes) {
        let german = translated(DE, sentence);
        assert!(german.is_some_and(|t| t != *sentence), "{sentence}");
    }
}

#[test]
fn names_stay_and_numbers_are_written_as_there() {
    let german = |text: &str| translated(DE, text).unwrap();
    assert_eq!(
        german("NC: the surface has no closed section there"),
        "NC: die Oberfläche hat dort keinen geschlossenen Schnitt"
    );
    let smaller = "smaller parts left out: 3, 1.5 % of the volume in all; if a part of the body is missing, look at the masks";
    assert_eq!(
        german(smaller),
        "kleinere Teile weggelassen: 3, zusammen 1,5 % des Volumens; fehlt etwas vom Körper, dann die Umrisse ansehen"
    );
    assert!(
        german("nothing was measured: the surface has no closed section there")
            .ends_with("geschlossenen Schnitt")
    );
    let feet = "the surface ends 12.5 mm above the ground without feet: they are lost, and heights are told from the ground";
    assert!(german(feet).contains("endet 12,5 mm über"));
    assert_eq!(translated(DE, "NC: what nobody says"), None);
    let refused = "hip, narrowest waist, upper arms, mid_thigh_L not measured: the surface has no closed section there";
    assert_eq!(
        german(refused),
        "Hüfte, Taille, schmalste Stelle, Oberarme, mid_thigh_L nicht gemessen: die Oberfläche hat dort keinen geschlossenen Schnitt"
    );
    let tall = "this body (81 cm tall) lies outside the range that the waist and chest model knows: where waist and chest lie is a rough \
                estimate, and their intervals are wide accordingly; check the stature, and that the whole body is visible and upright";
    assert!(german(tall).starts_with("dieser Körper (81 cm groß) liegt"));
    assert!(german(&tall.replace(" (81 cm tall)", "")).starts_with("dieser Körper liegt"));
    let withheld = "the mat and the stature contradict each other, so what depends on them is not given: correct one of them, or leave one out";
    assert!(german(withheld).starts_with("Matte mit Marken und Körpergröße widersprechen"));
}
