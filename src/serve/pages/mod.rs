//! Pages, written by the server: HTML that works without a script as far as it can. What is put in is escaped
//! by `maud`.

pub(super) mod brush;
pub(super) mod detail;
pub(super) mod facts;
pub(super) mod home;
pub(super) mod progress;
pub(super) mod result;
pub(super) mod seen;

use super::record::Record;
use crate::words::language::{Language, Words};
use crate::words::messages::translated;
use maud::{DOCTYPE, Markup, html};
use stage::Message;

/// A page: its title, its address (to come back to after a change of language), its scripts, its content.
pub(super) fn page(
    words: Words,
    title: &str,
    back: &str,
    scripts: &[&str],
    main: Markup,
) -> Markup {
    html! {
        (DOCTYPE)
        html lang=(words.language.code()) {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (title) " · tailor" }
                link rel="stylesheet" href="/assets/page.css";
                link rel="icon" href="/assets/icon.svg";
                @for script in scripts { script type="module" src=(format!("/assets/{script}")) {} }
            }
            body {
                a .skip href="#main" { (words.text("skip")) }
                header {
                    a .brand href="/" { "tailor" }
                    (settings(words, back))
                }
                main #main tabindex="-1" { (main) }
                footer { p { (words.text("privacy")) } }
            }
        }
    }
}

/// Language and unit.
fn settings(words: Words, back: &str) -> Markup {
    let unit = |inches: bool| Words { inches, ..words }.unit();
    html! {
        form .settings method="post" action="/settings" aria-label=(words.text("settings")) {
            input type="hidden" name="back" value=(back);
            @for language in Language::ALL {
                button type="submit" name="set" value=(language.code()) lang=(language.code())
                    aria-pressed=(language == words.language) { (language.name()) }
            }
            span .gap {}
            @for inches in [false, true] {
                button type="submit" name="set" value=(unit(inches))
                    aria-pressed=(inches == words.inches) { (unit(inches)) }
            }
        }
    }
}

/// What is wrong, and the way back.
pub(super) fn wrong(words: Words, text: &str) -> Markup {
    let main = html! {
        h1 { (words.text("wrong-title")) }
        p .alert role="alert" { (text) }
        p { a href="/" { (words.text("to-start")) } }
    };
    page(words, &words.text("wrong-title"), "/", &[], main)
}

/// Flags that stages name in their messages, the longest first, and the fields that take their place here.
const FLAGS: [(&str, &str); 8] = [
    ("--disk-diameter", "fact-disk-diameter-cm"),
    ("--mat-tag", "fact-mat-tag-mm"),
    ("--stature", "fact-stature-cm"),
    ("--weight", "fact-weight-kg"),
    ("--focal", "fact-focal-mm"),
    ("--steps", "fact-steps"),
    ("--plate", "fact-plate"),
    ("--walk", "fact-walk"),
];

/// A stage's message, in the reader's language where it is known, of the files as their owner calls them.
pub(super) fn sentence(words: Words, record: &Record, message: &Message) -> Markup {
    match translated(words, message) {
        Some(text) => html! { (record.named(&text)) },
        None => html! { span lang="en" { (record.named(&with_fields(words, message))) } },
    }
}

/// The same as text.
pub(super) fn plain(words: Words, record: &Record, message: &Message) -> String {
    let text = translated(words, message).unwrap_or_else(|| with_fields(words, message));
    record.named(&text)
}

/// A stage's message as a page shows it: fields in place of flags.
fn with_fields(words: Words, text: &str) -> String {
    let field = |text: String, (flag, key): &(&str, &str)| match text.contains(flag) {
        true => text.replace(flag, &format!("“{}”", words.text(key))),
        false => text,
    };
    FLAGS.iter().fold(text.to_owned(), field)
}

/// A day and a time, which a script shows in the reader's zone.
pub(super) fn time(seconds: u64) -> Markup {
    let (days, rest) = (seconds / 86_400, seconds % 86_400);
    let [y, m, d] = civil(days);
    let clock = format!("{:02}:{:02}", rest / 3600, rest / 60 % 60);
    html! {
        time datetime=(format!("{y:04}-{m:02}-{d:02}T{clock}Z")) { (format!("{y:04}-{m:02}-{d:02} {clock} UTC")) }
    }
}

/// Year, month, day of a day since 1970-01-01 (H. Hinnant, "chrono-compatible low-level date algorithms").
fn civil(days: u64) -> [u64; 3] {
    let z = days + 719_468;
    let (era, of_era) = (z / 146_097, z % 146_097);
    let year = (of_era - of_era / 1460 + of_era / 36_524 - of_era / 146_096) / 365;
    let of_year = of_era - (365 * year + year / 4 - year / 100);
    let shifted = (5 * of_year + 2) / 153;
    let day = of_year - (153 * shifted + 2) / 5 + 1;
    let month = if shifted < 10 {
        shifted + 3
    } else {
        shifted - 9
    };
    [year + era * 400 + u64::from(month <= 2), month, day]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_have_their_dates() {
        for (days, date) in [
            (0, [1970, 1, 1]),
            (11_016, [2000, 2, 29]),
            (11_017, [2000, 3, 1]),
            (20_779, [2026, 11, 22]),
        ] {
            assert_eq!(civil(days), date);
        }
    }

    #[test]
    fn flags_are_fields_here() {
        let words = Words {
            language: Language::En,
            inches: false,
        };
        let text = with_fields(words, "give --stature, or --mat-tag 60, or --mat");
        assert_eq!(text, "give “Stature”, or “Tag of the mat” 60, or --mat");
    }

    #[test]
    fn what_users_write_is_text() {
        let words = Words {
            language: Language::En,
            inches: false,
        };
        let evil = "<script>alert(1)</script>\" onload=\"x";
        let page = wrong(words, evil).into_string()
            + &page(words, evil, evil, &[], html! {}).into_string();
        assert!(
            !page.contains("<script>alert") && !page.contains("\" onload=\""),
            "{page}"
        );
    }
}
