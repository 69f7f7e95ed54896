//! Outlines, to be corrected with a brush.

use super::super::home::Place;
use super::super::record::{Kept, Record};
use super::{detail, page};
use crate::words::language::Words;
use maud::{Markup, html};

/// The page.
pub(crate) fn brush(words: Words, place: &Place, record: &Record, corrected: bool) -> Markup {
    let at = format!("/captures/{}", place.id);
    let masks = place.out().join("masks");
    let there = |(number, kept): &(&u32, &Kept)| {
        !kept.video && masks.join(format!("{number:04}.png")).is_file()
    };
    let photos: Vec<(&u32, &Kept)> = record.files.iter().filter(there).collect();
    let main = html! {
        p .crumb { a href=(at) { (detail::name(words, record)) } }
        h1 { (words.text("brush-title")) }
        @if photos.is_empty() { p .alert { (words.text("brush-nothing")) } }
        @else {
            p { (words.text("brush-about")) }
            (tools(words, place, &photos))
            div .bar {
                form method="post" action=(format!("{at}/measure")) {
                    button .main type="submit" { (words.text("measure-again")) }
                }
                @if corrected {
                    form method="post" action=(format!("{at}/masks/forget")) {
                        button type="submit" { (words.text("brush-forget")) }
                    }
                }
            }
            @if corrected { p .soft { (words.text("brush-measured")) } }
        }
    };
    let title = words.text("brush-title");
    page(words, &title, &format!("{at}/masks"), &["brush.js"], main)
}

fn tools(words: Words, place: &Place, photos: &[(&u32, &Kept)]) -> Markup {
    let lost = words.with("brush-lost", &[("why", "{why}".into())]);
    html! {
        section #brush aria-label=(words.text("brush-title")) data-api=(format!("/api/captures/{}", place.id))
            data-saved=(words.text("brush-saved")) data-lost=(lost) data-none=(words.text("brush-none"))
            data-unkept=(words.with("brush-unkept", &[("photos", "{photos}".into())])) {
            div .bar {
                label { (words.text("brush-photo")) " "
                    select name="photo" {
                        @for (number, kept) in photos { option value=(number) { (number) ": " (kept.name) } }
                    }
                }
                fieldset .bar { legend .hidden { (words.text("brush-paint")) }
                    @for (at, paint) in ["body", "room", "clear"].into_iter().enumerate() {
                        label .choice { input type="radio" name="paint" value=(paint) checked[at == 0];
                            (words.text(&format!("brush-{paint}"))) }
                    }
                }
                label { (words.text("brush-size")) " " input type="range" name="size" min="2" max="80" value="16"; }
                button type="button" name="undo" { (words.text("brush-undo")) }
                button type="button" name="save" { (words.text("brush-save")) }
            }
            p role="status" {}
            canvas tabindex="0" role="img" aria-label=(words.text("brush-canvas")) {}
        }
    }
}
