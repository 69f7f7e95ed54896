//! Words that say too little for a reader of code or screen: how often they are there may only fall.

use super::files::files;
use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::path::Path;

/// Better: reported, given, estimated; named; is in, is at; fixed, compared with; means; the other photos; background,
/// crate, space.
const AVOIDED: [&str; 12] = [
    "told", "said", "say", "says", "held", "lie", "lies", "stand", "stands", "others", "room",
    "rooms",
];

/// How often they are in names, comments and texts of Rust by the repository's folders, and in the screen's own texts.
const COUNTS: [(&str, usize); 9] = [
    ("benches", 1),
    ("docs", 7),
    ("engine", 1770),
    ("python", 11),
    ("src", 306),
    ("src/words/*.ftl", 16),
    ("stages", 1597),
    ("study", 1),
    ("tests", 844),
];

/// The words of a text in lower case; a name is as many words as it is made of.
fn words(text: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut small = false;
    for letter in text.chars() {
        if !letter.is_ascii_alphabetic() || letter.is_ascii_uppercase() && small {
            words.push(String::new());
        }
        small = letter.is_ascii_lowercase();
        let last = words.last_mut().filter(|_| letter.is_ascii_alphabetic());
        last.into_iter()
            .for_each(|word| word.push(letter.to_ascii_lowercase()));
    }
    words
}

fn avoided(text: &str) -> usize {
    let is_avoided = |word: &&String| AVOIDED.contains(&word.as_str());
    words(text).iter().filter(is_avoided).count()
}

#[test]
fn words_to_avoid_only_become_fewer() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut found: BTreeMap<String, usize> = BTreeMap::new();
    for name in files() {
        let folder = match name.rsplit_once('.') {
            Some((_, "rs")) => name.split('/').next().unwrap_or_default(),
            Some(("src/words/en" | "src/words/de", "ftl")) => "src/words/*.ftl",
            _ => continue,
        };
        let text = std::fs::read_to_string(root.join(&name)).unwrap_or_default();
        *found.entry(folder.to_owned()).or_default() += avoided(&text);
    }
    found.retain(|_, count| *count > 0);
    let listed = COUNTS.map(|(folder, count)| (folder.to_owned(), count));
    let mut wrong = Vec::new();
    for folder in found.keys().chain(listed.iter().map(|(folder, _)| folder)) {
        let now = found.get(folder).copied().unwrap_or(0);
        let known = listed.iter().find(|l| l.0 == *folder).map_or(0, |l| l.1);
        let what = match now.cmp(&known) {
            Ordering::Less => "lower the number in tests/tidy/words.rs",
            Ordering::Greater => "take other words",
            Ordering::Equal => continue,
        };
        wrong.push(format!("{folder}: {now}, {known} are listed: {what}"));
    }
    wrong.sort();
    wrong.dedup();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn words_within_names_are_counted() {
    let text = "fn as_told(TellsSaid: Room) { \"nothing lies; others'\" } // household toldX";
    assert_eq!(avoided(text), 6);
}
