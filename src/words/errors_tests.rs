//! Every failure of a stage that a page can meet has its texts in both languages.

use super::super::findings::translated;
use super::super::language::{Language, Words};
use super::super::warnings::tests::literal;
use super::*;
use std::path::Path;

/// Where the failures of the page's pipelines are made.
const FILES: [&str; 15] = [
    "capture/src/error.rs",
    "capture/src/video/error.rs",
    "capture/src/program.rs",
    "pose/src/ring/error.rs",
    "pose/src/walk/error.rs",
    "pose/src/frame/stage.rs",
    "pose/src/calibrate.rs",
    "pose/src/mat/solve.rs",
    "silhouette/src/params.rs",
    "turning/src/error.rs",
    "silhouette/src/walk/params.rs",
    "hull/src/carve.rs",
    "refine/src/pictures/prepare.rs",
    "measure/src/landmarks.rs",
    "shape/src/photos.rs",
];

/// Failures that no page can meet: it has no `capture.toml`, and its photos and cameras belong together.
const ELSEWHERE: [&str; 4] = [
    "capture.toml says * views, but",
    "`images` says *, but",
    "`plate` in capture.toml, or --plate, names",
    "photo * is * pixels, but its camera",
];

/// What a photo without a picture is; each has a sentence of its own.
const BLANK: &str = "* is *: take it again, or remove it";

fn translated_error(language: Language, text: &str) -> Option<String> {
    let inches = false;
    translated(Words { language, inches }, text)
}

/// The sentences of a file's failures.
fn sentences(file: &str) -> Vec<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("stages");
    let text = std::fs::read_to_string(root.join(file)).unwrap();
    let all: Vec<String> = text.split("#[error(").skip(1).filter_map(literal).collect();
    assert!(
        !all.is_empty(),
        "{file} has no failures: where are they now?"
    );
    all
}

#[test]
fn every_failure_that_a_page_can_meet_has_its_texts() {
    let all: Vec<String> = FILES.iter().flat_map(|file| sentences(file)).collect();
    assert!(all.len() > 50, "{all:?}");
    for begin in ELSEWHERE {
        let there = all.iter().any(|s| s.starts_with(begin));
        assert!(there, "{begin} is no failure any more");
    }
    let met = |s: &&String| !ELSEWHERE.iter().any(|begin| s.starts_with(begin));
    let is_sentence = |s: &&String| s.contains(char::is_alphabetic) && *s != BLANK;
    for sentence in all.iter().filter(met).filter(is_sentence) {
        let known = ERRORS.iter().any(|(pattern, _)| pattern == sentence);
        assert!(known, "errors.rs does not know: {sentence}");
    }
}

#[test]
fn every_failure_is_in_german_with_what_is_put_in() {
    for (pattern, key) in ERRORS {
        let sentence = pattern.replace('*', "7.5");
        let [en, de] =
            Language::ALL.map(|language| translated_error(language, &sentence).expect(pattern));
        assert!(en != de || key == "fail-hopeless", "{pattern}");
        assert!(!de.contains("--"), "a page has no flags: {de}");
    }
    for what in ["of one colour", "overexposed nearly everywhere"] {
        let sentence = BLANK.replacen('*', "0003.jpg", 1).replace('*', what);
        assert!(
            translated_error(Language::De, &sentence).is_some(),
            "{sentence}"
        );
    }
    let hopeless = "0001.jpg, 0002.jpg: photos are more like others far away in order than like their neighbours: they are not in \
                    turning order; look whether these photos are in their place (if you are sure of the photos: --set photos.stop=false)";
    let de = translated_error(Language::De, hopeless).unwrap();
    assert!(
        de.starts_with("0001.jpg, 0002.jpg: ")
            && !de.contains("photos.stop")
            && de.contains("folgen nicht der Drehung"),
        "{de}"
    );
}

#[test]
fn the_sentence_of_few_photos_is_the_stages_own() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let code = std::fs::read_to_string(root.join("src/cli/folder.rs")).unwrap();
    let (_, after) = code.split_once("fn too_few(").unwrap();
    let after = &after[after.find("format!(").unwrap()..];
    let sentence = literal(after).unwrap();
    assert!(
        ERRORS.iter().any(|(pattern, _)| *pattern == sentence),
        "{sentence}"
    );
}
