//! What was measured, at a glance: the whole is in the report.

use super::super::home::Place;
use super::super::record::Record;
use super::sentence;
use crate::cli::doctor::message;
use crate::words::language::Words;
use maud::{Markup, html};
use serde_json::Value;
use stage::Message;

/// The girths in tables of captures.
pub(crate) const MAIN: [&str; 2] = ["WC", "HC"];
/// Those that come first on the page of one; the rest follows.
const FIRST: [&str; 8] = ["WC", "HC", "CC", "NC", "AC_L", "AC_R", "TC_L", "TC_R"];
/// What can be taken away.
pub(crate) const FILES: [(&str, &str); 8] = [
    ("girths.csv", "text/csv; charset=utf-8"),
    ("girths.json", "application/json"),
    ("report.html", "text/html; charset=utf-8"),
    ("body.glb", "model/gltf-binary"),
    ("body.ply", "application/octet-stream"),
    ("hull.ply", "application/octet-stream"),
    ("cameras.json", "application/json"),
    ("run.json", "application/json"),
];

/// A girth of `girths.json`.
fn girth<'a>(girths: &'a Value, name: &str) -> Option<&'a Value> {
    girths["girths"]
        .as_array()?
        .iter()
        .find(|g| g["name"] == name)
}

/// All girths, in the order of the page.
fn all(girths: &Value) -> Vec<&Value> {
    let named = |one: &&Value| one["name"].as_str().is_some_and(|n| FIRST.contains(&n));
    let first = FIRST.iter().filter_map(|name| girth(girths, name));
    let rest = girths["girths"].as_array().into_iter().flatten();
    first.chain(rest.filter(|one| !named(one))).collect()
}

/// Whether every girth was refused.
pub(crate) fn is_empty(girths: &Value) -> bool {
    girths["girths"].as_array().is_none_or(Vec::is_empty)
}

/// What a girth is called.
pub(crate) fn label(words: Words, name: &str, otherwise: &str) -> String {
    words.girth(name, otherwise)
}

/// A girth by tape; relative where nothing of known length was there.
pub(crate) fn tape(words: Words, girths: &Value, name: &str) -> Option<String> {
    let girth = girth(girths, name)?;
    match girth["tape_cm"].as_f64() {
        Some(cm) => Some(words.length(cm)),
        None => girth["tape_rel"].as_f64().map(|rel| words.number(rel, 3)),
    }
}

fn interval(words: Words, girth: &Value) -> String {
    let ends = |key: &str| Some([girth[key][0].as_f64()?, girth[key][1].as_f64()?]);
    match (ends("interval_cm"), ends("interval_rel")) {
        (Some([low, high]), _) => {
            // The unit once.
            let low = words.length(low);
            let low = low.split(' ').next().unwrap_or(&low);
            format!("{low} – {}", words.length(high))
        }
        (_, Some([low, high])) => format!("{} – {}", words.number(low, 3), words.number(high, 3)),
        _ => String::new(),
    }
}

/// The place of a number in the growth reference: standard deviations, centile.
fn score(score: &Value) -> Option<(f64, f64)> {
    Some((score["z"].as_f64()?, score["centile"].as_f64()?))
}

/// What could not be measured, and why: a reason once.
fn missing(words: Words, record: &Record, girths: &Value) -> Markup {
    let all = girths["missing"].as_array().into_iter().flatten();
    let mut reasons: Vec<(Message, Vec<String>)> = Vec::new();
    let mut count = 0;
    for one in all {
        let text = |key: &str| one[key].as_str().unwrap_or_default();
        let name = label(words, text("name"), text("name"));
        count += 1;
        let mut coded = one.clone();
        coded["text"] = one["why"].clone();
        let why = match one["code"].is_string() {
            true => message(&coded),
            false => text("why").into(),
        };
        match reasons.iter_mut().find(|(known, _)| *known == why) {
            Some((_, names)) => names.push(name),
            None => reasons.push((why, vec![name])),
        }
    }
    html! {
        @if count > 0 {
            details open[is_empty(girths)] {
                summary { (words.with("result-missing", &[("count", count.into())])) }
                ul { @for (why, names) in &reasons { li { (names.join("; ")) ": " (sentence(words, record, why)) } } }
            }
        }
    }
}

/// Whether known lengths contradict each other.
fn disputed(girths: &Value) -> bool {
    let mut all = girths["missing"].as_array().into_iter().flatten();
    girths["unit"] == "relative" && all.any(|one| one["reason"] == "disputed")
}

/// A row of a number that follows from other numbers. On a phone cells are below one another, so roles are given.
fn derived(name: &str, value: &str, more: &str) -> Markup {
    html! {
        tr role="row" { th scope="row" role="rowheader" { (name) } td .n role="cell" { (value) } td .n .range role="cell" { (more) } }
    }
}

/// The results.
pub(crate) fn result(words: Words, place: &Place, record: &Record, girths: &Value) -> Markup {
    let at = format!("/captures/{}", place.id);
    let ratios = girths["ratios"].as_object().into_iter().flatten();
    let there = FILES
        .iter()
        .filter(|(file, _)| place.out().join(file).is_file());
    html! {
        section aria-labelledby="result-title" {
            h2 #result-title { (words.text("result-title")) }
            @if is_empty(girths) { p .alert { (words.text("result-none")) } }
            @else if disputed(girths) { p .alert { (words.text("result-disputed")) } }
            @else if girths["unit"] == "relative" { p .alert { (words.text("result-relative")) } }
            div .wide tabindex="0" role="group" aria-labelledby="result-title" {
                table .girths role="table" {
                    thead { tr {
                        th scope="col" { (words.text("column-girth")) }
                        th scope="col" .n { (words.text("column-tape")) }
                        th scope="col" .n { (words.text("column-interval")) }
                    } }
                    tbody {
                        @for one in all(girths) {
                            @let name = one["name"].as_str().unwrap_or_default();
                            tr role="row" {
                                th scope="row" role="rowheader" { (label(words, name, one["label"].as_str().unwrap_or(name))) }
                                td .n role="cell" { (tape(words, girths, name).unwrap_or_default()) }
                                td .n .range role="cell" data-of=(words.text("column-interval")) { (interval(words, one)) }
                            }
                        }
                        @for (name, value) in ratios {
                            @if let Some(value) = value.as_f64().filter(|_| words.knows(&format!("girth-{name}"))) {
                                (derived(&label(words, name, name), &words.number(value, 3), ""))
                            }
                        }
                        @if let Some(bmi) = girths["bmi"].as_f64() {
                            (derived(&words.text("result-bmi"), &format!("{} kg/m²", words.number(bmi, 1)), ""))
                        }
                        @for (key, text) in [("bmi_for_age", "result-bmi-for-age"), ("height_for_age", "result-height-for-age")] {
                            @if let Some((z, centile)) = score(&girths["growth"][key]) {
                                @let centile = words.with("result-centile", &[("centile", words.number(centile, 1).into())]);
                                (derived(&words.text(text), &format!("z {}", words.number(z, 2)), &centile))
                            }
                        }
                    }
                }
            }
            @if girths["growth"].is_object() { p .soft { (words.text("result-growth")) } }
            (missing(words, record, girths))
            div .bar {
                a .button .main href=(format!("{at}/report")) { (words.text("report")) }
                a .button href=(format!("{at}/masks")) { (words.text("brush-open")) }
            }
            details {
                summary { (words.text("downloads")) }
                ul .downloads {
                    @for (file, _) in there {
                        li { a href=(format!("{at}/out/{file}")) download=(file) { (file) } }
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::words::language::Language;
    use serde_json::json;

    #[test]
    fn every_girth_that_was_measured_is_on_the_page_under_its_name() {
        let all: Vec<String> = shape::TABLE
            .iter()
            .filter(|row| !["", "PICKED"].contains(&row.name))
            .flat_map(|row| match row.id.side() {
                Some(_) => vec![format!("{}_L", row.name), format!("{}_R", row.name)],
                None => vec![row.name.to_owned()],
            })
            .collect();
        let one = |name: &String| json!({ "name": name, "label": "?", "tape_cm": 50.0 });
        let girths = json!({ "girths": all.iter().map(one).collect::<Vec<_>>() });
        assert_eq!(super::all(&girths).len(), all.len());
        assert_eq!(super::all(&girths)[0]["name"], "WC");
        for (language, name) in Language::ALL
            .iter()
            .flat_map(|l| all.iter().map(move |n| (l, n)))
        {
            let (language, inches) = (*language, false);
            let shown = label(Words { language, inches }, name, "?");
            // The mean of both arms is a row of its own.
            assert_ne!(shown, "?", "{name} has no text");
        }
    }

    #[test]
    fn a_reason_is_shown_once_and_lengths_that_contradict_each_other_are_reported() {
        let words = Words {
            language: Language::De,
            inches: false,
        };
        let one = |name: &str, reason: &str, why: &Message| json!({ "name": name, "reason": reason, "why": why.as_str(), "code": why.code(), "fields": {} });
        let why = &shape::Refusal::NoLegs.message();
        let mut girths = json!({
            "unit": "relative",
            "missing": [one("HC", "no_legs", why), one("WC", "no_legs", why)],
        });
        let html = missing(words, &Record::default(), &girths).into_string();
        assert_eq!(html.matches("keine zwei Beine").count(), 1, "{html}");
        assert!(html.contains("Hüfte; Taille: "), "{html}");
        assert!(!disputed(&girths));
        girths["missing"] = json!([one("BMI", "disputed", &"".into())]);
        assert!(disputed(&girths));
    }
}
