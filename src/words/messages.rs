//! Messages in the reader's language, by their codes: from `*.ftl`, and in English, where a page needs no other words than a
//! terminal, as the stages have them. A sentence without a code stays as it is.

use super::language::{Language, Words};
use crate::catalog::kinds_of_messages;
use fluent_bundle::FluentValue;
use stage::{Field, Message, Template};

/// The kind of message of a code.
fn kind(code: &str) -> Option<&'static Template> {
    kinds_of_messages().find(|kind| kind.code == code)
}

/// What comes as a warning, and is none: nothing is wrong, and nothing has to be done.
const NEWS: [&str; 2] = ["warn-mat-known", "warn-shortened"];

/// Whether a warning only names what was found.
pub(crate) fn is_news(message: &Message) -> bool {
    NEWS.contains(&message.code())
}

/// The English sentence of what its fields are now, as stages have it.
pub(crate) fn in_english(message: &Message) -> String {
    let field = |name: &str| message.fields().get(name).cloned();
    let sentence = kind(message.code()).map(|kind| kind.filled(field, Field::to_string));
    let mut text = sentence.unwrap_or_else(|| message.to_string());
    if let Some(about) = message.about() {
        text = format!("{about}: {text}");
    }
    if let Some(remedy) = message.remedy() {
        text += &format!("; {remedy}");
    }
    text
}

/// A message in the reader's language; none where that has no text for it.
pub(crate) fn translated(words: Words, message: &Message) -> Option<String> {
    let mut text = sentence(words, message)?;
    if let Some(about) = message.about() {
        text = format!("{}: {text}", read(words, about));
    }
    if let Some(remedy) = message.remedy() {
        text += &format!("; {}", read(words, remedy));
    }
    Some(text)
}

/// A message as it is read: in the reader's language, else in English.
pub(crate) fn in_words(words: Words, message: &Message) -> String {
    translated(words, message).unwrap_or_else(|| message.to_string())
}

/// Names of girths or photos, or other fields, as they are read.
pub(crate) fn read(words: Words, field: &Field) -> String {
    match field {
        Field::Number { .. } => words.written(&field.to_string()),
        Field::Text(text) => text.clone(),
        Field::List(all) => {
            let all: Vec<String> = all.iter().map(|one| read(words, one)).collect();
            all.join(", ")
        }
        Field::Message(message) => in_words(words, message),
    }
}

/// Its sentence alone.
fn sentence(words: Words, message: &Message) -> Option<String> {
    let code = message.code();
    if code.is_empty() {
        return None;
    }
    let put: Vec<(&str, FluentValue<'_>)> = message
        .fields()
        .iter()
        .map(|(name, field)| (name.as_str(), value(words, field)))
        .collect();
    if words.knows(code) {
        return words.with_all(code, &put);
    }
    match words.language {
        Language::En => {
            let fields = |name: &str| message.fields().get(name).cloned();
            Some(kind(code)?.filled(fields, |field| read(words, field)))
        }
        Language::De => None,
    }
}

/// A field as texts take it: what is counted chooses the plural.
fn value(words: Words, field: &Field) -> FluentValue<'static> {
    match field {
        Field::Number {
            value,
            digits: None,
            unit,
            ..
        } if unit.is_empty() && value.fract() == 0.0 => FluentValue::from(*value),
        field => read(words, field).into(),
    }
}

#[cfg(test)]
#[path = "messages_tests.rs"]
mod tests;
