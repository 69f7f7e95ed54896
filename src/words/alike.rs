//! Warnings that differ only in their photo and numbers, as one.

use super::messages::in_english;
use stage::{Field, Message, message};
use std::collections::BTreeSet;

stage::messages! {
    RANGE = "some-numbers": "{least}–{most}";
}

/// A list with the messages of the same code and remedy joined where the first of them came: photos are named together, of
/// numbers the least and the most are given. The same is reported once; what differs in anything else stays apart.
pub(crate) fn joined<T>(all: Vec<(T, Message)>) -> Vec<(T, Message)> {
    let mut groups: Vec<(T, Vec<Message>)> = Vec::new();
    for (tag, message) in all {
        match groups.iter_mut().find(|(_, of)| alike(&of[0], &message)) {
            Some((_, of)) => of.push(message),
            None => groups.push((tag, vec![message])),
        }
    }
    let one = |(tag, of): (T, Vec<Message>)| (tag, as_one(of));
    groups.into_iter().map(one).collect()
}

/// The same of messages alone.
pub(crate) fn as_read(all: Vec<Message>) -> Vec<Message> {
    let all = joined(all.into_iter().map(|message| ((), message)).collect());
    all.into_iter().map(|(_, message)| message).collect()
}

/// Whether two messages differ in nothing but numbers and the photo that they are about.
fn alike(a: &Message, b: &Message) -> bool {
    let joins = |(name, field): (&String, &Field)| match (field, b.fields().get(name)) {
        (Field::Number { unit, .. }, Some(Field::Number { unit: other, .. })) => unit == other,
        (Field::Text(_), Some(Field::Text(_))) if Some(field) == a.about() => true,
        (field, other) => Some(field) == other,
    };
    let of_a_kind = !a.code().is_empty() && a.code() == b.code();
    a == b || of_a_kind && a.fields().len() == b.fields().len() && a.fields().iter().all(joins)
}

fn as_one(of: Vec<Message>) -> Message {
    let [first, .., _] = &of[..] else {
        return of.into_iter().next().expect("bug: a group of none");
    };
    let mut whole = first.clone();
    for (name, field) in first.fields() {
        let all: Vec<&Field> = of.iter().map(|m| &m.fields()[name]).collect();
        let field = match field {
            Field::Number { .. } => range(&all),
            Field::Text(_) if Some(field) == first.about() => names(&all),
            _ => continue,
        };
        whole = whole.with_field(name, field);
    }
    let text = in_english(&whole);
    whole.in_words(text)
}

/// The names of photos, each once, as messages of several photos have them.
fn names(all: &[&Field]) -> Field {
    let mut names: Vec<String> = all.iter().map(|name| name.to_string()).collect();
    let mut seen = BTreeSet::new();
    names.retain(|name| seen.insert(name.clone()));
    shape::some_photos(&names).expect("bug: a group of none")
}

/// The least and the most, with the unit once: `0.6–7.9°`.
fn range(all: &[&Field]) -> Field {
    let value = |field: &Field| match field {
        Field::Number { value, .. } => *value,
        _ => unreachable!("bug: alike are numbers with numbers"),
    };
    let by_value = |a: &&&Field, b: &&&Field| value(a).total_cmp(&value(b));
    let least = all.iter().min_by(by_value).expect("bug: a group of none");
    let most = all.iter().max_by(by_value).expect("bug: a group of none");
    if least == most {
        return (*least).clone();
    }
    let bare = match (*least).clone() {
        Field::Number {
            value,
            digits,
            signed,
            ..
        } => Field::Number {
            value,
            digits,
            signed,
            unit: String::new(),
        },
        other => other,
    };
    message!(RANGE, least = bare, most = (*most).clone()).into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::words::language::{Language, Words};
    use crate::words::messages::in_words;
    use stage::message;

    stage::messages! {
        AWAY = "warn-nudged": "its camera looks {off:.1 °} away";
        SEEN = "warn-seen-by-two": "only {share:.0 %} of the surface is seen by two photos or more";
    }

    fn texts(all: Vec<Message>) -> Vec<String> {
        as_read(all).into_iter().map(String::from).collect()
    }

    #[test]
    fn a_warning_of_each_photo_is_one_that_names_them_all() {
        let away = |photo: &str, off: f64| message!(AWAY, off = off).of_what(photo);
        let all = vec![
            away("0004.jpg", 7.94),
            message!(SEEN, share = 13.0),
            away("0005.jpg", 0.61),
            message!(SEEN, share = 18.2),
            away("0006.jpg", 2.0).with_remedy("look"),
        ];
        let read = texts(all);
        assert_eq!(read.len(), 3, "{read:?}");
        assert!(read[0].starts_with("0004.jpg, 0005.jpg: its camera looks 0.6–7.9° away"));
        assert!(
            read[1].starts_with("only 13–18 % of the surface"),
            "{read:?}"
        );
        assert!(read[2].starts_with("0006.jpg: its camera looks 2.0° away"));
    }

    #[test]
    fn words_that_differ_stay_apart_and_no_message_changes_alone() {
        let all: Vec<Message> = vec!["no length".into(), "no length".into(), "no mat".into()];
        assert_eq!(texts(all), ["no length", "no mat"]);
        let one = message!(SEEN, share = 13.0);
        assert_eq!(texts(vec![one.clone()]), [one.to_string()]);
    }

    #[test]
    fn many_photos_are_counted_in_german_too() {
        let away = |n: usize| message!(AWAY, off = n as f64).of_what(format!("{n:04}.jpg"));
        let all = as_read((0..7).map(away).collect());
        let german = Words {
            language: Language::De,
            inches: false,
        };
        let text = in_words(german, &all[0]);
        assert!(
            text.contains("0000.jpg, 0001.jpg, 0002.jpg, … (7 Fotos)"),
            "{text}"
        );
        assert!(text.contains("0,0–6,0°"), "{text}");
    }
}
