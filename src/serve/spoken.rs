//! Stages' messages in calls: in the reader's language, of the files as their owner calls them, with their codes and fields.

use super::pages::plain;
use super::progress::Progress;
use super::record::Record;
use crate::cli::doctor::message;
use crate::words::language::Words;
use serde_json::{Value, json};
use stage::Message;

/// A message in the reader's language, with all that it holds.
fn spoken(words: Words, record: &Record, message: &Message) -> Message {
    let text = plain(words, record, message);
    let mut spoken = json!(message.clone().in_words(text));
    let fields = spoken.get_mut("fields").and_then(Value::as_object_mut);
    for field in fields.into_iter().flat_map(|fields| fields.values_mut()) {
        in_place(words, record, field);
    }
    crate::cli::doctor::message(&spoken)
}

/// A field: names of files as their owner has them, messages in the reader's language.
fn in_place(words: Words, record: &Record, field: &mut Value) {
    match field {
        Value::String(text) => *text = record.named(text),
        Value::Array(all) => all.iter_mut().for_each(|one| in_place(words, record, one)),
        coded if coded["code"].is_string() => {
            *coded = json!(spoken(words, record, &message(coded)));
        }
        _ => {}
    }
}

/// What was seen of a capture. Photos keep the names of their files, which `files` has.
pub(super) fn look(words: Words, record: &Record, mut look: Value) -> Value {
    let translate = |value: &mut Value| *value = json!(spoken(words, record, &message(value)));
    let each = |list: &mut Value| {
        let all = list.as_array_mut().into_iter().flatten();
        all.for_each(translate);
    };
    match look.get_mut("wrong") {
        Some(one) if one.is_string() => translate(one),
        Some(several) => each(several),
        None => {}
    }
    look.get_mut("warnings").into_iter().for_each(each);
    let findings = look.get_mut("findings").and_then(Value::as_array_mut);
    for finding in findings.into_iter().flatten() {
        for key in ["what", "mend"] {
            translate(&mut finding[key]);
        }
    }
    if let Some(can) = look.get_mut("can").and_then(Value::as_object_mut) {
        can.values_mut().for_each(translate);
    }
    look
}

/// How far a measuring is.
pub(super) fn progress(words: Words, record: &Record, mut progress: Progress) -> Progress {
    for message in progress.why.iter_mut().chain(&mut progress.warnings) {
        *message = spoken(words, record, message);
    }
    progress
}
