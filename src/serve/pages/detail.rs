//! The page of a capture: what was seen of it, what is known of it, its measuring, its results.

use super::super::delete::Gone;
use super::super::home::Place;
use super::super::progress::Progress;
use super::super::record::Record;
use super::{facts, page, progress, result, seen, sentence};
use crate::words::alike::as_read;
use crate::words::language::Words;
use maud::{Markup, html};
use serde_json::Value;

/// All that the page shows.
pub(crate) struct Content {
    pub(crate) place: Place,
    pub(crate) record: Record,
    pub(crate) look: Option<Value>,
    pub(crate) progress: Progress,
    pub(crate) girths: Option<Value>,
    /// What is wrong with what was typed, by field.
    pub(crate) slips: facts::Slips,
    /// What came of what was asked last, if that was nothing.
    pub(crate) alert: Option<String>,
}

/// What a capture is called.
pub(crate) fn name(words: Words, record: &Record) -> String {
    match record.name.is_empty() {
        true => words.text("unnamed"),
        false => record.name.clone(),
    }
}

/// The page.
pub(crate) fn detail(words: Words, content: &Content) -> Markup {
    let Content {
        place,
        record,
        look,
        progress,
        girths,
        ..
    } = content;
    let (title, at) = (name(words, record), format!("/captures/{}", place.id));
    let stopped = look.as_ref().is_some_and(seen::stops);
    let main = html! {
        p .crumb { a href="/" { (words.text("to-start")) } }
        h1 { (title) }
        p .soft { (super::time(record.begun)) " · "
            (words.with("photos-count", &[("count", record.files.len().into())])) }
        @if let Some(alert) = &content.alert { p .alert role="alert" { (alert) } }
        @if let Some(girths) = girths {
            (result::result(words, place, record, girths))
        }
        (measuring(words, content, stopped))
        (facts::form(words, &at, record, &content.slips, progress.goes_on()))
        (seen::seen(words, &at, record, look.as_ref(), progress.goes_on()))
        p { a .danger href=(format!("{at}/delete")) { (words.text("delete-capture")) } }
    };
    page(words, &title, &at, &["live.js"], main)
}

/// Its measuring: what can be asked for, and how far it is.
fn measuring(words: Words, content: &Content, stopped: bool) -> Markup {
    let Content {
        place,
        record,
        progress,
        girths,
        ..
    } = content;
    let at = format!("/captures/{}", place.id);
    let nothing = girths.as_ref().is_some_and(result::is_empty);
    let goes_on = progress.goes_on();
    let warnings = as_read(progress.warnings.clone());
    let again = match progress.state {
        "none" => "measure",
        "interrupted" | "stopped" => "measure-on",
        _ => "measure-again",
    };
    html! {
        section #measuring aria-labelledby="measuring-title"
            data-events=[goes_on.then(|| format!("/api/captures/{}/events", place.id))] {
            h2 #measuring-title { (words.text("measuring-title")) }
            p #sentence role="status" { (progress::sentence(words, progress, nothing)) }
            @for why in &progress.why { p .alert role="alert" { (sentence(words, record, why)) } }
            @if stopped && !goes_on && progress.state == "none" { p .alert { (words.text("measure-stopped")) } }
            div .bar {
                @if goes_on {
                    form method="post" action=(format!("{at}/stop")) {
                        button type="submit" { (words.text("stop")) }
                    }
                } @else {
                    form method="post" action=(format!("{at}/measure")) {
                        button .main type="submit" { (words.text(again)) }
                    }
                }
            }
            div #steps { (progress::steps(words, progress)) }
            div #pictures .pictures { (progress::pictures(words, &place.id, progress)) }
            @if !warnings.is_empty() {
                details { summary { (words.with("warnings", &[("count", warnings.len().into())])) }
                    ul { @for warning in &warnings { li { (sentence(words, record, warning)) } } } }
            }
        }
    }
}

/// Asks once more before a capture goes for good.
pub(crate) fn delete(words: Words, place: &Place, record: &Record, results: bool) -> Markup {
    let at = format!("/captures/{}", place.id);
    let title = words.with("delete-title", &[("name", name(words, record).into())]);
    let megabytes = words.number(record.bytes() as f64 / 1e6, 1);
    let main = html! {
        h1 { (title) }
        p { (words.text("delete-about")) }
        ul {
            li { (words.with("delete-files", &[("count", record.files.len().into()), ("size", megabytes.into())])) }
            @if results { li { (words.text("delete-results")) } }
            li { (words.text("delete-cache")) }
        }
        form .bar method="post" action=(format!("{at}/delete")) {
            button .danger type="submit" { (words.text("delete-yes")) }
            a .button href=(at) { (words.text("delete-no")) }
        }
    };
    page(words, &title, &format!("{at}/delete"), &[], main)
}

/// What went.
pub(crate) fn gone(words: Words, name: &str, gone: &Gone) -> Markup {
    let title = words.with("gone-title", &[("name", name.into())]);
    let size = |bytes: u64| words.number(bytes as f64 / 1e6, 1);
    let (files, results) = (size(gone.bytes), size(gone.results_bytes));
    let main = html! {
        h1 { (title) }
        div role="status" { ul {
            li { (words.with("delete-files", &[("count", gone.files.into()), ("size", files.into())])) }
            li { (words.with("gone-results", &[("count", gone.results.into()), ("size", results.into())])) }
        } }
        @if !gone.shared.is_empty() { p { (words.text("gone-shared")) } }
        @if !gone.unread.is_empty() {
            div role="alert" { p { (words.text("gone-unread")) } ul { @for file in &gone.unread { li { code { (file) } } } } }
        }
        p { a href="/" { (words.text("to-start")) } }
    };
    page(words, &title, "/", &[], main)
}
