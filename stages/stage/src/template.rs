//! A message before its fields are known: a code and an English sentence with places for them.

use crate::message::Form;
use crate::{Field, Message};
use std::collections::BTreeMap;

/// A kind of message: declared by [`messages!`](crate::messages!), filled in by [`message!`](crate::message!).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Template {
    /// Its code, which no other has: `warn-same-file`. Sentences in other languages are found by it.
    pub code: &'static str,
    /// The English sentence. `{name}` is a field, `{name:.1 mm}` a number with one decimal and its unit, `{name:+.1 mm}` the
    /// same with its sign, `{name|photo|photos}` the first word where the number is one, else the second.
    pub english: &'static str,
}

/// Names that every message may have beside its own: what it is about, and what would help.
const RESERVED: [&str; 2] = ["about", "remedy"];

/// More fields than these has no message (structural: a bound of what is looked through at compile time).
const MOST_FIELDS: usize = 12;

impl Template {
    /// A template; `{` begins a field.
    pub const fn new(code: &'static str, english: &'static str) -> Template {
        Template { code, english }
    }

    /// Fails to compile where the sentence's fields are not these, each at least once.
    #[doc(hidden)]
    pub const fn takes(&self, names: &[&str]) {
        assert!(names.len() <= MOST_FIELDS, "too many fields");
        let text = self.english.as_bytes();
        let mut used = [false; MOST_FIELDS];
        let mut at = 0;
        while at < text.len() {
            if text[at] == b'{' {
                let from = at + 1;
                while !matches!(text[at], b'}' | b':' | b'|') {
                    at += 1;
                }
                let (mut n, mut known) = (0, false);
                while n < names.len() {
                    if is(text, from, at, names[n]) {
                        (used[n], known) = (true, true);
                    }
                    n += 1;
                }
                assert!(known, "the sentence has a field that is not given");
            }
            at += 1;
        }
        let mut n = 0;
        while n < names.len() {
            assert!(used[n], "a field is given that the sentence does not have");
            let name = names[n].as_bytes();
            assert!(
                !is(name, 0, name.len(), RESERVED[0]) && !is(name, 0, name.len(), RESERVED[1]),
                "`about` and `remedy` are given by their own methods"
            );
            n += 1;
        }
    }

    /// The names of its fields.
    pub fn fields(&self) -> Vec<&'static str> {
        let mut names = Vec::new();
        for piece in pieces(self.english) {
            if let Piece::Field(name, _) | Piece::Either(name, ..) = piece
                && !names.contains(&name)
            {
                names.push(name);
            }
        }
        names
    }
}

impl Template {
    /// The sentence with these fields, each as it is to be read.
    pub fn filled(
        &self,
        fields: impl Fn(&str) -> Option<Field>,
        read: impl Fn(&Field) -> String,
    ) -> String {
        let mut text = String::new();
        for piece in pieces(self.english) {
            match piece {
                Piece::Text(part) => text += part,
                Piece::Field(name, _) => {
                    text += &fields(name).as_ref().map_or(String::new(), &read)
                }
                Piece::Either(name, one, several) => {
                    let is_one = fields(name).is_some_and(|field| field.is_one());
                    text += if is_one { one } else { several };
                }
            }
        }
        text
    }
}

/// Whether a part of a text is this name.
const fn is(text: &[u8], from: usize, to: usize, name: &str) -> bool {
    let name = name.as_bytes();
    if to - from != name.len() {
        return false;
    }
    let mut at = 0;
    while at < name.len() {
        if text[from + at] != name[at] {
            return false;
        }
        at += 1;
    }
    true
}

/// A part of a sentence.
pub(crate) enum Piece<'a> {
    Text(&'a str),
    Field(&'a str, Option<Form<'a>>),
    /// A word for one, and a word for several.
    Either(&'a str, &'a str, &'a str),
}

/// The parts of a sentence.
pub(crate) fn pieces(english: &str) -> Vec<Piece<'_>> {
    let mut all = Vec::new();
    let mut rest = english;
    while let Some((before, after)) = rest.split_once('{') {
        let (inner, tail) = after.split_once('}').expect("bug: a field without an end");
        all.push(Piece::Text(before));
        all.push(piece(inner));
        rest = tail;
    }
    all.push(Piece::Text(rest));
    all
}

fn piece(inner: &str) -> Piece<'_> {
    if let Some((name, words)) = inner.split_once('|') {
        let (one, several) = words.split_once('|').expect("bug: one word of two");
        return Piece::Either(name, one, several);
    }
    let Some((name, form)) = inner.split_once(':') else {
        return Piece::Field(inner, None);
    };
    let (number, unit) = form.split_once(' ').unwrap_or((form, ""));
    let digits = number.trim_start_matches('+').trim_start_matches('.');
    let form = Form {
        digits: digits.parse().expect("bug: decimals of a field"),
        signed: number.starts_with('+'),
        unit,
    };
    Piece::Field(name, Some(form))
}

/// Declares kinds of messages, and `MESSAGES`, the list of them: `NAME = "code": "The sentence with a {field}.";`.
/// A crate lists those of its modules, so that a test can read all codes.
#[macro_export]
macro_rules! messages {
    ($( $(#[doc = $doc:literal])* $name:ident = $code:literal : $english:literal; )*) => {
        $(
            $(#[doc = $doc])*
            pub(crate) const $name: $crate::Template = $crate::Template::new($code, $english);
        )*

        /// The kinds of messages that are declared here.
        pub(crate) const MESSAGES: &[$crate::Template] = &[$($name),*];
    };
}

/// A message of a kind with its fields: `message!(SAME_FILE, copy = name, first = other)`. Names that the sentence does not
/// have, or has and are not given, do not compile.
#[macro_export]
macro_rules! message {
    ($template:expr $(, $name:ident = $value:expr)* $(,)?) => {{
        const { $template.takes(&[$(stringify!($name)),*]) };
        $crate::Message::new(&$template, [$((stringify!($name), $crate::Field::from($value))),*])
    }};
}

impl Message {
    /// A message of a kind; its numbers as the kind writes them. See [`message!`](crate::message!).
    #[doc(hidden)]
    pub fn new<const N: usize>(template: &Template, fields: [(&'static str, Field); N]) -> Message {
        let form = |name: &str| {
            pieces(template.english).into_iter().find_map(|p| match p {
                Piece::Field(own, Some(form)) if own == name => Some(form),
                _ => None,
            })
        };
        let fields = fields.map(|(name, field)| match form(name) {
            Some(form) => (name.to_owned(), field.formed(form)),
            None => (name.to_owned(), field),
        });
        Message::with_fields(template, fields.into_iter().collect())
    }

    /// The same with fields by their names, none of them of another form than it is written in.
    pub fn with_fields(template: &Template, fields: BTreeMap<String, Field>) -> Message {
        let text = template.filled(|name| fields.get(name).cloned(), Field::to_string);
        Message::of(template.code, fields, text)
    }
}
