//! Stages' messages in calls: in the reader's language, of the files as their owner calls them.

use super::pages::plain;
use super::progress::Progress;
use super::record::Record;
use crate::words::language::Words;
use serde_json::Value;

/// What was seen of a capture. Photos keep the names of their files, which `files` has.
pub(super) fn look(words: Words, record: &Record, mut look: Value) -> Value {
    let translate = |value: &mut Value| {
        if let Some(text) = value.as_str() {
            *value = plain(words, record, text).into();
        }
    };
    if let Some(wrong) = look.get_mut("wrong") {
        translate(wrong);
    }
    let lists = ["warnings", "findings"].map(|key| look[key].as_array().cloned());
    let [mut warnings, mut findings] = lists.map(Option::unwrap_or_default);
    warnings.iter_mut().for_each(translate);
    for finding in &mut findings {
        for key in ["what", "mend"] {
            translate(&mut finding[key]);
        }
    }
    for (key, list) in [("warnings", warnings), ("findings", findings)] {
        if look[key].is_array() {
            look[key] = list.into();
        }
    }
    if let Some(can) = look.get_mut("can").and_then(Value::as_object_mut) {
        can.values_mut().for_each(translate);
    }
    look
}

/// How far a measuring is.
pub(super) fn progress(words: Words, record: &Record, mut progress: Progress) -> Progress {
    for text in progress.why.iter_mut().chain(&mut progress.warnings) {
        let lines: Vec<String> = text.lines().map(|l| plain(words, record, l)).collect();
        *text = lines.join("\n");
    }
    progress
}
