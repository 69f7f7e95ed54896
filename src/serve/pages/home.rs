//! The first page: a place to drop photos on, and all captures so far.

use super::super::app::App;
use super::super::home::Place;
use super::super::lan;
use super::super::record::Record;
use super::super::upload::{MOST_FILES, MOST_PHOTO, MOST_VIDEO};
use super::{page, result, time};
use crate::words::language::Words;
use maud::{Markup, html};
use serde_json::Value;

/// A capture in the table.
pub(crate) struct Line {
    pub(crate) place: Place,
    pub(crate) record: Record,
    pub(crate) state: &'static str,
    pub(crate) girths: Option<Value>,
}

/// The page.
pub(crate) fn home(app: &App, words: Words, lines: &[Line]) -> Markup {
    let main = html! {
        h1 { (words.text("home-title")) }
        p { (words.text("home-about")) }
        (drop(words))
        (table(words, lines))
        @if let Some(url) = &app.lan { (phone(words, url)) }
    };
    page(
        words,
        &words.text("home-title"),
        "/",
        &["drop.js", "table.js"],
        main,
    )
}

/// Where photos are dropped.
fn drop(words: Words) -> Markup {
    let count = |key: &str| words.with(key, &[("done", "{done}".into()), ("of", "{of}".into())]);
    let most = |bytes: u64| {
        words.with(
            "drop-large",
            &[("name", "{name}".into()), ("most", (bytes >> 20).into())],
        )
    };
    html! {
        section aria-labelledby="drop-title" {
            h2 #drop-title { (words.text("drop-title")) }
            form #drop .drop data-sending=(count("drop-sending")) data-looking=(words.text("drop-looking"))
                data-large-photo=(most(MOST_PHOTO)) data-large-video=(most(MOST_VIDEO))
                data-most-photo=(MOST_PHOTO) data-most-video=(MOST_VIDEO) data-most-files=(MOST_FILES)
                data-many=(words.with("wrong-many", &[("most", MOST_FILES.into())]))
                data-lost=(words.text("drop-lost")) data-none=(words.text("drop-none")) {
                p #drop-hint .hint { (words.text("drop-hint")) }
                div .fields {
                    label { span { (words.text("drop-name")) }
                        input type="text" name="name" maxlength="120" autocomplete="off"; }
                    label { span { (words.text("drop-files")) }
                        input type="file" name="files" multiple accept="image/*,video/*,.dng,.tif,.tiff"
                            aria-describedby="drop-hint"; }
                    label { span { (words.text("drop-folder")) }
                        input type="file" name="folder" webkitdirectory multiple aria-describedby="folder-hint"; }
                }
                p #folder-hint .soft { (words.text("drop-folder-hint")) }
                progress #drop-bar max="1" value="0" hidden aria-label=(words.text("drop-title")) {}
                p #drop-word role="status" {}
                noscript { p .alert { (words.text("needs-script")) } }
            }
        }
    }
}

/// Every capture.
fn table(words: Words, lines: &[Line]) -> Markup {
    html! {
        section aria-labelledby="history-title" {
            h2 #history-title { (words.text("history-title")) }
            @if lines.is_empty() { p .soft { (words.text("history-none")) } }
            @else {
                div #captures { (rows(words, lines)) }
                div .bar {
                    form method="post" action="/measure" {
                        button type="submit" { (words.text("measure-all")) }
                    }
                    a .button href="/girths.csv" download="girths.csv" { (words.text("all-csv")) }
                }
            }
        }
    }
}

/// The table alone, which a script fetches while something is measured.
pub(crate) fn rows(words: Words, lines: &[Line]) -> Markup {
    let goes_on = lines
        .iter()
        .any(|l| ["waiting", "running"].contains(&l.state));
    html! {
        div .wide tabindex="0" role="group" aria-labelledby="history-title" {
            table data-goes-on=[goes_on.then_some("")] {
                thead { tr {
                    th scope="col" { (words.text("column-name")) }
                    th scope="col" { (words.text("column-time")) }
                    th scope="col" { (words.text("column-state")) }
                    @for girth in result::MAIN { th scope="col" .n { (result::label(words, girth, girth)) } }
                    th scope="col" { span .hidden { (words.text("column-delete")) } }
                } }
                tbody { @for line in lines { (row(words, line)) } }
            }
        }
    }
}

fn row(words: Words, line: &Line) -> Markup {
    let at = format!("/captures/{}", line.place.id);
    let name = super::detail::name(words, &line.record);
    html! {
        tr {
            th scope="row" { a href=(at) { (name) } }
            td .when { (time(line.record.begun)) }
            td .state { (state(words, line)) }
            @for girth in result::MAIN {
                td .n { (line.girths.as_ref().and_then(|g| result::tape(words, g, girth)).unwrap_or_default()) }
            }
            td { a .danger href=(format!("{at}/delete")) {
                (words.text("delete")) span .hidden { " " (name) }
            } }
        }
    }
}

fn state(words: Words, line: &Line) -> String {
    let photos = words.with("photos-count", &[("count", line.record.files.len().into())]);
    match line.state {
        "none" => photos,
        "done" if line.girths.as_ref().is_some_and(result::is_empty) => words.text("state-nothing"),
        state => words.text(&format!("state-{state}")),
    }
}

/// The address for a phone.
fn phone(words: Words, url: &str) -> Markup {
    html! {
        section aria-labelledby="phone-title" {
            h2 #phone-title { (words.text("phone-title")) }
            p { (words.text("phone-about")) }
            (lan::drawing(url))
            p { code { (url) } }
        }
    }
}
