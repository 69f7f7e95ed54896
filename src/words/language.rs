//! Texts of pages in the reader's language: every text is in `words/*.ftl` (Fluent).

use fluent_bundle::concurrent::FluentBundle;
use fluent_bundle::{FluentArgs, FluentResource, FluentValue};
use std::sync::OnceLock;

/// A language that pages are written in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Language {
    /// English.
    En,
    /// German.
    De,
}

impl Language {
    /// All of them.
    pub(crate) const ALL: [Language; 2] = [Language::En, Language::De];

    /// Its code.
    pub(crate) fn code(self) -> &'static str {
        match self {
            Language::En => "en",
            Language::De => "de",
        }
    }

    /// What it calls itself.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Language::En => "English",
            Language::De => "Deutsch",
        }
    }

    /// Of a code, `de` or `de-AT`.
    pub(crate) fn of(code: &str) -> Option<Language> {
        let code = code.trim().split(['-', '_', '.', ';']).next()?.trim();
        Self::ALL
            .into_iter()
            .find(|l| l.code().eq_ignore_ascii_case(code))
    }

    /// The first that there is of those that a browser asks for (`Accept-Language`).
    pub(crate) fn asked(header: &str) -> Option<Language> {
        header.split(',').find_map(Language::of)
    }

    /// What the environment asks for, as other programs of the command line read it.
    pub(crate) fn of_environment() -> Language {
        let set = |name: &str| std::env::var(name).ok().filter(|value| !value.is_empty());
        let names = ["LC_ALL", "LC_MESSAGES", "LANG"];
        let first = names.into_iter().find_map(set);
        let asked = first.and_then(|value| Language::of(&value));
        asked.unwrap_or(Language::En)
    }

    /// Its texts as a file.
    pub(crate) fn texts(self) -> &'static str {
        match self {
            Language::En => include_str!("en.ftl"),
            Language::De => include_str!("de.ftl"),
        }
    }

    fn bundle(self) -> &'static FluentBundle<FluentResource> {
        static BUNDLES: [OnceLock<FluentBundle<FluentResource>>; 2] =
            [const { OnceLock::new() }; 2];
        BUNDLES[self as usize].get_or_init(|| {
            let locale = self.code().parse().expect("bug: a language's code");
            let texts = FluentResource::try_new(self.texts().to_owned());
            let texts = texts.unwrap_or_else(|(_, why)| panic!("bug: {}: {why:?}", self.code()));
            let mut bundle = FluentBundle::new_concurrent(vec![locale]);
            // Marks around what is put in are for scripts of two directions; ours have one.
            bundle.set_use_isolating(false);
            let added = bundle.add_resource(texts);
            added.unwrap_or_else(|why| panic!("bug: {}: {why:?}", self.code()));
            bundle
        })
    }
}

/// What a reader wants to read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Words {
    /// In which language.
    pub(crate) language: Language,
    /// Whether lengths are in inches.
    pub(crate) inches: bool,
}

/// \[cm\]
const INCH: f64 = 2.54;

impl Words {
    /// A text.
    pub(crate) fn text(self, key: &str) -> String {
        self.with(key, &[])
    }

    /// A text with what is put in: texts, and whole numbers, which choose the plural.
    pub(crate) fn with(self, key: &str, put: &[(&str, FluentValue<'_>)]) -> String {
        let text = self.with_all(key, put);
        text.unwrap_or_else(|| panic!("bug: no text of the key {key}, or not all that it takes"))
    }

    /// A text with what is put in, as far as all of that is given.
    pub(crate) fn with_all(self, key: &str, put: &[(&str, FluentValue<'_>)]) -> Option<String> {
        let bundle = self.language.bundle();
        let pattern = bundle.get_message(key)?.value()?;
        let mut args = FluentArgs::new();
        for (name, value) in put {
            args.set((*name).to_owned(), value.clone());
        }
        let mut wrong = vec![];
        let text = bundle.format_pattern(pattern, Some(&args), &mut wrong);
        wrong.is_empty().then(|| text.into_owned())
    }

    /// Whether there is such a text.
    pub(crate) fn knows(self, key: &str) -> bool {
        self.language.bundle().has_message(key)
    }

    /// What a girth is called by its name in files; `otherwise` where nobody called it.
    pub(crate) fn girth(self, name: &str, otherwise: &str) -> String {
        let key = format!("girth-{}", name.replace('_', "-"));
        match self.knows(&key) {
            true => self.text(&key),
            false => otherwise.to_owned(),
        }
    }

    /// The unit of lengths, as a form names it.
    pub(crate) fn unit(self) -> &'static str {
        if self.inches { "in" } else { "cm" }
    }

    /// A number with so many decimals, as it is written in the language.
    pub(crate) fn number(self, value: f64, decimals: usize) -> String {
        self.written(&format!("{value:.decimals$}"))
    }

    /// A number with a decimal point, as it is written in the language.
    pub(crate) fn written(self, number: &str) -> String {
        match self.language {
            Language::En => number.to_owned(),
            Language::De => number.replace('.', ","),
        }
    }

    /// A length in what the reader wants; to a millimetre, or a twentieth of an inch.
    pub(crate) fn length(self, cm: f64) -> String {
        match self.inches {
            false => format!("{} cm", self.number(cm, 1)),
            true => format!("{} in", self.number(cm / INCH, 2)),
        }
    }

    /// A duration.
    pub(crate) fn duration(self, seconds: f64) -> String {
        let whole = seconds.max(0.0).round() as u64;
        match (whole / 60, whole % 60) {
            (0, s) => format!("{s} s"),
            (m, s) => format!("{m} min {s} s"),
        }
    }

    /// A number as somebody typed it, with a point or a comma; none if nothing was typed.
    ///
    /// # Errors
    ///
    /// What was typed is no number.
    pub(crate) fn typed(self, text: &str) -> Result<Option<f64>, String> {
        let text = text.trim();
        let number = text
            .replace(',', ".")
            .parse::<f64>()
            .ok()
            .filter(|n| n.is_finite());
        match text.is_empty() {
            true => Ok(None),
            false => number.map(Some).ok_or_else(|| text.to_owned()),
        }
    }

    /// A length as somebody typed it, in what he reads. \[cm\]
    ///
    /// # Errors
    ///
    /// What was typed is no number.
    pub(crate) fn typed_length(self, text: &str) -> Result<Option<f64>, String> {
        let number = self.typed(text)?;
        let cm = |number: f64| {
            if self.inches {
                round(number * INCH)
            } else {
                number
            }
        };
        Ok(number.map(cm))
    }

    /// A length for a field that somebody types into.
    pub(crate) fn field_length(self, cm: f64) -> String {
        self.field(if self.inches { round(cm / INCH) } else { cm })
    }

    /// A number for a field that somebody types into.
    pub(crate) fn field(self, value: f64) -> String {
        self.written(&value.to_string())
    }
}

/// What a factor leaves behind the fourth decimal is nobody's.
fn round(value: f64) -> f64 {
    (value * 1e4).round() / 1e4
}

#[cfg(test)]
#[path = "language_tests.rs"]
mod tests;
