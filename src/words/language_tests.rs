//! Both languages have the same texts, and numbers as they are written in each.

use super::*;
use crate::catalog::kinds_of_messages;
use std::collections::{BTreeMap, BTreeSet};

/// Each text's key with what is put into it.
fn keys(language: Language) -> BTreeMap<String, BTreeSet<String>> {
    let mut keys: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    let mut key = String::new();
    for line in language.texts().lines().filter(|l| !l.starts_with('#')) {
        if let Some((name, _)) = line
            .split_once(" =")
            .filter(|_| line.starts_with(|c: char| c.is_alphabetic()))
        {
            key = name.to_owned();
            assert!(!keys.contains_key(&key), "{key} is there twice");
            keys.insert(key.clone(), BTreeSet::new());
        }
        for put in line.split('$').skip(1) {
            let end = put
                .find(|c: char| !c.is_alphanumeric() && c != '_')
                .unwrap_or(put.len());
            keys.get_mut(&key).unwrap().insert(put[..end].to_owned());
        }
    }
    keys
}

/// Whether a text is that of a message.
fn is_message(key: &str) -> bool {
    kinds_of_messages().any(|kind| kind.code == key)
}

#[test]
fn both_languages_have_the_same_texts_with_the_same_places() {
    // Messages have English sentences where they are made.
    let own = |language: Language| {
        let mut keys = keys(language);
        keys.retain(|key, _| !is_message(key));
        keys
    };
    let en = own(Language::En);
    assert!(en.len() > 60, "{}", en.len());
    assert_eq!(en, own(Language::De));
    for language in Language::ALL {
        let words = Words {
            language,
            inches: false,
        };
        for (key, put) in keys(language) {
            let put: Vec<_> = put
                .iter()
                .map(|p| (p.as_str(), FluentValue::from(3)))
                .collect();
            assert!(!words.with(&key, &put).is_empty(), "{key}");
        }
    }
}

#[test]
fn every_text_that_is_asked_for_is_there_and_none_is_unused() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let (mut open, mut code) = (vec![root], String::new());
    while let Some(folder) = open.pop() {
        for path in std::fs::read_dir(folder)
            .unwrap()
            .map(|e| e.unwrap().path())
        {
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|e| e == "rs" || e == "js") {
                code += &std::fs::read_to_string(path).unwrap();
            }
        }
    }
    for key in keys(Language::En).keys() {
        // Some are put together: `state-` and a word, …
        let begin = format!("{}-{{", key.split('-').next().unwrap());
        let asked = code.contains(&format!("\"{key}\"")) || code.contains(&format!("\"{begin}"));
        assert!(asked || is_message(key), "no code uses {key}");
    }
    for call in [".text(\"", ".with(\""] {
        for rest in code.split(call).skip(1) {
            let key = rest.split('"').next().unwrap();
            let words = Words {
                language: Language::En,
                inches: false,
            };
            assert!(
                words.knows(key) || key.contains('{') || key.is_empty(),
                "{key}"
            );
        }
    }
}

#[test]
fn numbers_are_read_and_written_as_in_each_language() {
    let [en, de] = Language::ALL.map(|language| Words {
        language,
        inches: false,
    });
    assert_eq!(
        (en.length(84.25), de.length(84.26)),
        ("84.2 cm".into(), "84,3 cm".into())
    );
    let inches = Words { inches: true, ..en };
    assert_eq!(inches.length(84.5), "33.27 in");
    for text in ["171,5", " 171.5 "] {
        assert_eq!(de.typed_length(text), Ok(Some(171.5)));
    }
    assert_eq!(inches.typed_length("70"), Ok(Some(177.8)));
    assert_eq!(inches.field_length(177.8), "70");
    assert_eq!(de.typed(""), Ok(None));
    assert!(de.typed("1,7 m").is_err() && de.typed("inf").is_err());
    assert_eq!(
        Language::asked("fr-CH, de-AT;q=0.9, en;q=0.8"),
        Some(Language::De)
    );
    assert_eq!(Language::asked("fr"), None);
}
