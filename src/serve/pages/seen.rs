//! What `tailor doctor` saw of a capture, photo by photo.

use super::super::record::{Kept, Record};
use super::sentence;
use crate::cli::doctor::{GRADES, message};
use crate::words::language::Words;
use crate::words::messages::is_news;
use maud::{Markup, html};
use serde_json::Value;
use stage::Message;

/// What was found odd.
fn findings(look: &Value) -> impl Iterator<Item = &Value> {
    look["findings"].as_array().into_iter().flatten()
}

fn text<'a>(value: &'a Value, key: &str) -> &'a str {
    value[key].as_str().unwrap_or_default()
}

/// Why nothing could be seen.
fn wrong(look: &Value) -> Vec<Message> {
    match &look["wrong"] {
        Value::Null => vec![],
        Value::Array(all) => all.iter().map(message).collect(),
        one => vec![message(one)],
    }
}

/// Whether nothing will come of it.
pub(crate) fn stops(look: &Value) -> bool {
    !wrong(look).is_empty() || findings(look).any(|f| f["grade"] == "stop")
}

/// What was seen, and the photos.
pub(crate) fn seen(
    words: Words,
    at: &str,
    record: &Record,
    look: Option<&Value>,
    busy: bool,
) -> Markup {
    html! {
        section #seen aria-labelledby="seen-title" data-look=[look.is_none().then(|| format!("{at}/look"))] {
            h2 #seen-title { (words.text("seen-title")) }
            @match look {
                Some(look) => (report(words, record, look)),
                None => {
                    p #looking role="status" { (words.text("seen-none")) }
                    form method="post" action=(format!("{at}/look")) {
                        button type="submit" { (words.text("look")) }
                    }
                }
            }
            ul .photos {
                @for (number, kept) in &record.files { (photo(words, at, *number, kept, look, busy)) }
            }
        }
    }
}

fn report(words: Words, record: &Record, look: &Value) -> Markup {
    let can = look["can"].as_object().into_iter().flatten();
    html! {
        @for why in &wrong(look) { p .alert { (sentence(words, record, why)) } }
        @if wrong(look).is_empty() {
            p { (facts(words, look)) }
            @if findings(look).next().is_none() { p .good { (words.text("seen-well")) } }
        }
        ul .findings {
            @for (grade, line) in odd(words, record, look) {
                li class=(grade) { strong { (words.text(&format!("grade-{grade}"))) } " " (line) }
            }
        }
        dl .can {
            @for (what, how) in can {
                dt { (words.text(&format!("can-{what}"))) }
                dd { (sentence(words, record, &message(how))) }
            }
        }
    }
}

/// All that is odd with how bad it is, the worst first: findings, then warnings, which are doubts unless they are news.
fn odd<'a>(words: Words, record: &Record, look: &'a Value) -> Vec<(&'a str, Markup)> {
    let finding = |finding: &'a Value| {
        let line = html! {
            (sentence(words, record, &message(&finding["what"]))) " – " (sentence(words, record, &message(&finding["mend"])))
            @if let Some(names) = names(record, finding) { " " span .soft { (names) } }
        };
        (text(finding, "grade"), line)
    };
    let warnings = look["warnings"].as_array().into_iter().flatten();
    let warned = warnings.map(|warning| {
        let warning = message(warning);
        let grade = if is_news(&warning) { "hint" } else { "doubt" };
        (grade, html! { (sentence(words, record, &warning)) })
    });
    let mut all: Vec<_> = findings(look).map(finding).chain(warned).collect();
    all.sort_by_key(|(grade, _)| GRADES.iter().position(|g| g == grade));
    all
}

/// The photos that a finding is about, as their owner calls them.
fn names(record: &Record, finding: &Value) -> Option<String> {
    let all = finding["photos"]
        .as_array()?
        .iter()
        .filter_map(Value::as_str);
    let all: Vec<&str> = all.map(|file| record.called(file)).collect();
    (!all.is_empty()).then(|| format!("({})", all.join(", ")))
}

fn facts(words: Words, look: &Value) -> String {
    let number = |key: &str| look[key].as_u64().unwrap_or(0);
    let focal = look["focal_35mm"].as_f64();
    let mut facts = vec![
        words.with("photos-count", &[("count", number("photos").into())]),
        format!("{} × {} px", number("width"), number("height")),
        text(look, "camera").to_owned(),
        focal.map_or(words.text("focal-unknown"), |mm| {
            format!("{} mm", words.number(mm, 0))
        }),
        words.text(if look["plate"].is_string() {
            "plate-there"
        } else {
            "plate-none"
        }),
        words.text(if text(look, "motion") == "turn" {
            "camera-stood"
        } else {
            "camera-moved"
        }),
    ];
    facts.retain(|f| !f.is_empty());
    facts.join(" · ")
}

fn photo(
    words: Words,
    at: &str,
    number: u32,
    kept: &Kept,
    look: Option<&Value>,
    busy: bool,
) -> Markup {
    let views = look.and_then(|l| l["views"].as_array());
    let view = views.and_then(|v| v.iter().find(|v| v["name"] == kept.file.as_str()));
    let odd = look.into_iter().flat_map(findings).any(|f| {
        f["photos"]
            .as_array()
            .is_some_and(|all| all.iter().any(|p| *p == kept.file.as_str()))
    });
    let place = words.with(
        "photo-place",
        &[
            ("number", number.into()),
            ("name", kept.name.as_str().into()),
        ],
    );
    html! {
        li class=(if odd { "odd" } else { "" }) {
            @match kept.size {
                Some([w, h]) => {
                    img src=(format!("/api{at}/files/{number}/small/320")) alt=(place) loading="lazy"
                        width=(320 * w / w.max(h).max(1)) height=(320 * h / w.max(h).max(1));
                }
                None => p .file { (place) },
            }
            p .name { (number) ": " (kept.name) @if odd { " " strong .bad { (words.text("photo-odd")) } } }
            @if let Some(view) = view { (numbers(words, view, middle_step(views))) }
            @if !busy {
                form method="post" action=(format!("{at}/files/{number}/remove")) {
                    button .small type="submit" aria-label=(words.with("photo-remove-this", &[("name", kept.name.as_str().into())])) {
                        (words.text("photo-remove"))
                    }
                }
            }
        }
    }
}

/// The middle one of all steps, in what the stage counts them in.
fn middle_step(views: Option<&Vec<Value>>) -> Option<f64> {
    let steps = views?.iter().filter_map(|v| v["to_next"].as_f64());
    let mut steps: Vec<f64> = steps.collect();
    steps.sort_by(f64::total_cmp);
    steps.get(steps.len() / 2).copied().filter(|s| *s > 0.0)
}

fn numbers(words: Words, view: &Value, middle: Option<f64>) -> Markup {
    let number = |key: &str| view[key].as_f64();
    html! {
        dl {
            @if let Some(seconds) = number("taken_s") {
                dt { (words.text("photo-taken")) } dd { "+" (words.duration(seconds)) }
            }
            @if let Some(sharp) = number("sharpness") {
                dt { (words.text("photo-sharp")) } dd { (words.number(100.0 * sharp, 0)) " %" }
            }
            @if let Some(ev) = number("exposure_ev") {
                dt { (words.text("photo-light")) } dd { (signed(words, ev)) " EV" }
            }
            @if let Some(burnt) = number("overexposed_pct").filter(|b| *b >= 0.1) {
                dt { (words.text("photo-burnt")) } dd { (words.number(burnt, 1)) " %" }
            }
            @if let Some((step, middle)) = number("to_next").zip(middle) {
                dt { (words.text("photo-step")) } dd { (words.number(step / middle, 2)) " ×" }
            }
            @if let Some(tags) = view["tags"].as_u64() {
                dt { (words.text("photo-tags")) } dd { (tags) }
            }
        }
    }
}

/// A number that shows whether it is more or less than nothing.
fn signed(words: Words, value: f64) -> String {
    let text = words.number(value.abs(), 2);
    let sign = match (
        text.contains(|c: char| ('1'..='9').contains(&c)),
        value > 0.0,
    ) {
        (false, _) => "±",
        (_, true) => "+",
        (_, false) => "−",
    };
    format!("{sign}{text}")
}
