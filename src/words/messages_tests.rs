//! Every kind of message has its sentence in each language, with the same fields.

use super::*;
use std::collections::BTreeSet;

const EN: Words = Words {
    language: Language::En,
    inches: false,
};
const DE: Words = Words {
    language: Language::De,
    inches: false,
};

/// Fields that pages leave out: files, and what only a param helps with.
const LEFT_OUT: [(&str, &str); 3] = [
    ("fail-few-no-mat", "folder"),
    ("fail-hull-memory", "fits"),
    ("find-empty-plate", "name"),
];

/// What a language's text of a code takes, if there is one.
fn placed(language: Language, code: &str) -> Option<BTreeSet<String>> {
    let begin = format!("\n{code} =");
    let (_, after) = language.texts().split_once(&begin)?;
    let end = after.find("\n\n").unwrap_or(after.len());
    let lines = after[..end].split('\n').enumerate();
    let own = lines.take_while(|(i, line)| *i == 0 || line.starts_with([' ', '}']));
    let own: String = own.map(|(_, line)| line).collect();
    let name = |put: &str| {
        let end = put.find(|c: char| !c.is_alphanumeric() && c != '_');
        put[..end.unwrap_or(put.len())].to_owned()
    };
    Some(own.split('$').skip(1).map(name).collect())
}

#[test]
fn no_code_is_there_twice_and_each_has_german_with_the_same_fields() {
    let mut seen = BTreeSet::new();
    for kind in kinds_of_messages() {
        assert!(seen.insert(kind.code), "{} is there twice", kind.code);
        let fields: BTreeSet<String> = kind.fields().into_iter().map(String::from).collect();
        let left_out = |field: &String| LEFT_OUT.contains(&(kind.code, field.as_str()));
        let wanted: BTreeSet<String> = fields.iter().filter(|f| !left_out(f)).cloned().collect();
        let german = placed(Language::De, kind.code);
        assert_eq!(german.as_ref(), Some(&wanted), "{} in German", kind.code);
        if let Some(english) = placed(Language::En, kind.code) {
            assert_eq!(english, wanted, "{} on English pages", kind.code);
        }
    }
    assert!(seen.len() > 300, "{}", seen.len());
}

#[test]
fn no_text_has_the_code_of_a_message_that_is_not_there() {
    for language in Language::ALL {
        for line in language.texts().lines() {
            let key = line.split(" =").next().unwrap_or_default();
            let begins = [
                "warn-", "find-", "fail-", "cli-", "rig-", "recipe-", "compare-", "score-",
            ];
            let of_messages = begins.iter().any(|begin| key.starts_with(begin));
            assert!(!of_messages || kind(key).is_some(), "{key} is no code");
        }
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
    // A `capture.toml` is a file of who wrote it, by its keys.
    let own = |kind: &&Template| {
        ["cli-", "rig-", "recipe-", "compare-", "score-"]
            .iter()
            .any(|own| kind.code.starts_with(own))
    };
    for words in [EN, DE] {
        for kind in kinds_of_messages().filter(|kind| !own(kind)) {
            let field = |name: &str| (name.to_owned(), "x".into());
            let fields = kind.fields().into_iter().map(field).collect();
            let message = Message::with_fields(kind, fields);
            let text = translated(words, &message).expect(kind.code);
            let found = alien.iter().find(|word| text.contains(**word));
            assert_eq!(found, None, "{}: {text}", kind.code);
        }
    }
}

#[test]
fn names_stay_numbers_are_written_as_there_and_messages_in_messages_are_translated() {
    stage::messages! {
        PARTS = "warn-hull-parts": "{count}, {left_out:.1 %}";
        CUTS = "warn-contradicted": "{share:.1 %}";
        REFUSED = "warn-not-measured": "{girths}: {why}";
        LATE = "warn-order": "{early} {late}";
        UNKNOWN = "warn-unknown": "what nobody knows";
    }
    assert_eq!(MESSAGES.len(), 5);
    let german = |message: &Message| translated(DE, message);
    let parts = stage::message!(PARTS, count = 3usize, left_out = 1.5);
    assert_eq!(
        german(&parts).unwrap(),
        "kleinere Teile weggelassen: 3, zusammen 1,5 % des Volumens; fehlt etwas vom Körper, dann die Umrisse ansehen"
    );
    let cuts = stage::message!(CUTS, share = 2.0).of_what("0007.jpg");
    assert!(
        german(&cuts)
            .unwrap()
            .starts_with("0007.jpg: dem Umriss fehlt")
    );
    let girths = [(Some(shape::GirthId::Hip), "HC"), (None, "mid_thigh_L")];
    let why = shape::Refusal::NoSection.message();
    let refused = stage::message!(REFUSED, girths = shape::girth_names(&girths), why = why);
    assert_eq!(
        german(&refused).unwrap(),
        "Hüfte, mid_thigh_L nicht gemessen: die Oberfläche hat dort keinen geschlossenen Schnitt"
    );
    let late = stage::message!(LATE, early = "a.jpg", late = "b.jpg");
    assert_eq!(
        translated(EN, &late).unwrap(),
        "a.jpg was taken before b.jpg: names should be in turning order"
    );
    let unknown = stage::message!(UNKNOWN);
    assert_eq!((german(&unknown), translated(EN, &unknown)), (None, None));
    assert_eq!(in_words(DE, &unknown), "what nobody knows");
    // A message of another version lacks what the text takes.
    let mut other = serde_json::to_value(&late).unwrap();
    other["fields"] = serde_json::json!({ "early": "a.jpg" });
    let other: Message = serde_json::from_value(other).unwrap();
    assert_eq!(german(&other), None);
}
