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
const COUNTS: [(&str, usize); 4] = [
    ("src", 2),
    ("src/words/*.ftl", 15),
    ("stages", 15),
    ("tests", 35),
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

/// What is left out of a fit is "held out" in statistics.
fn avoided(text: &str) -> usize {
    let words = words(text);
    let after = |i: usize| words[i + 1..].iter().find(|word| !word.is_empty());
    let of_a_fit = |i: usize| words[i] == "held" && after(i).is_some_and(|word| word == "out");
    let is_avoided = |i: &usize| AVOIDED.contains(&words[*i].as_str()) && !of_a_fit(*i);
    (0..words.len()).filter(is_avoided).count()
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

/// Nor are these where a terminal or a page may show them: they have no clear meaning for readers of English.
const NOT_SHOWN: [&str; 2] = ["tell", "tells"];

/// How often they are in texts of more than one word in code that is no test. What is left is names in files and keys, and
/// sentences in results: these change with the results only.
const SHOWN: [(&str, usize); 1] = [("stages", 6)];

/// Where the text ends that `here` begins with; `before` shows whether a backslash is one.
fn ending(before: &str, here: &str) -> usize {
    let bare = before.trim_end_matches('#');
    let is_name = |c: char| c.is_alphanumeric() || c == '_';
    let raw = bare.strip_suffix('r').filter(|b| !b.ends_with(is_name));
    let end = match raw {
        Some(_) => here[1..].find(&format!("\"{}", &before[bare.len()..])),
        None => {
            let mut escaped = false;
            here[1..].find(|c| {
                let end = c == '"' && !escaped;
                escaped = c == '\\' && !escaped;
                end
            })
        }
    };
    1 + end.expect("a text without an end")
}

/// The texts of a Rust file: literals, without what follows the first `#[cfg(test)]`.
fn texts(code: &str) -> Vec<&str> {
    let code = code.split("#[cfg(test)]").next().unwrap_or_default();
    let (mut found, mut rest) = (Vec::new(), code);
    while let Some(at) = rest.find(['"', '/', '\'']) {
        let here = &rest[at..];
        let skipped = match here.as_bytes() {
            [b'/', b'/', ..] => here.find('\n').unwrap_or(here.len()),
            [b'\'', b'\\', ..] => 2 + here[2..].find('\'').unwrap_or(0) + 1,
            [b'\'', b'"', b'\'', ..] => 3,
            [b'"', ..] => {
                let end = ending(&rest[..at], here);
                found.push(&here[1..end]);
                end + 1
            }
            _ => 1,
        };
        rest = &here[skipped..];
    }
    found
}

fn is_not_shown(word: &str) -> bool {
    AVOIDED.contains(&word) || NOT_SHOWN.contains(&word)
}

/// Texts of more than one word, without names in them (`` `room` ``, `{told}`), that have such a word.
fn shown(code: &str) -> usize {
    let bare = |text: &str| -> String {
        let parts = text.split('`').step_by(2).flat_map(|part| part.split('{'));
        let part = |part: &str| {
            part.split_once('}')
                .map_or(part, |(_, after)| after)
                .to_owned()
        };
        parts.map(part).collect::<Vec<_>>().join(" ")
    };
    let several = texts(code).into_iter().filter(|text| text.contains(' '));
    let is = |word: &&String| is_not_shown(word);
    several
        .map(|text| words(&bare(text)).iter().filter(is).count())
        .sum()
}

#[test]
fn texts_that_are_shown_have_the_words_of_the_trade() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut found: BTreeMap<String, usize> = BTreeMap::new();
    let mut wrong = Vec::new();
    for name in files().iter().filter(|name| name.ends_with(".rs")) {
        let of_tests = ["tests/", "benches/", "docs/"]
            .iter()
            .any(|f| name.starts_with(f));
        let aside = ["/tests/", "/simulation/", "/examples/", "tests.rs"];
        if of_tests || aside.iter().any(|part| name.contains(part)) {
            continue;
        }
        let code = std::fs::read_to_string(root.join(name)).unwrap_or_default();
        let count = shown(&code);
        let folder = name.split('/').next().unwrap_or_default();
        if count > 0 {
            *found.entry(folder.to_owned()).or_default() += count;
            wrong.push(format!("{name}: {count}"));
        }
    }
    let listed = SHOWN.map(|(folder, count)| (folder.to_owned(), count));
    let listed: BTreeMap<String, usize> = listed.into_iter().collect();
    assert_eq!(found, listed, "{wrong:#?}");
}

#[test]
fn english_texts_of_pages_have_the_words_of_the_trade() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/words/en.ftl");
    let text = std::fs::read_to_string(file).unwrap();
    assert!(text.lines().count() > 200);
    for line in text.lines().filter(|line| !line.starts_with('#')) {
        let shown = line.split_once(" =").map_or(line, |(_, shown)| shown);
        let bare: String = shown
            .split('{')
            .map(|p| p.split('}').next_back().unwrap_or_default())
            .collect();
        let found = words(&bare).into_iter().find(|word| is_not_shown(word));
        assert_eq!(found, None, "{line}");
    }
}

#[test]
fn only_texts_that_may_be_shown_are_counted() {
    let code = "// \"it says so\"\nlet a = \"told\"; b('\"', \"the {told} of `room` lies \\\"there\\\"\", '\\\\');\n\
                #[cfg(test)] mod tests { \"it says so\" }";
    assert_eq!(texts(code).len(), 2);
    assert_eq!(shown(code), 1);
}

#[test]
fn words_within_names_are_counted() {
    let text = "fn as_told(TellsSaid: Room) { \"nothing lies; others'\" } // household toldX";
    assert_eq!(avoided(text), 6);
}
