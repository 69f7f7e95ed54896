//! Messages: a code with named fields, and the English sentence that they make.

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fmt;

/// Something that people should know: a code with named fields, which other languages and programs read, and the English
/// sentence. A sentence that somebody gave as it is has neither.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Message(pub(crate) Box<Parts>);

/// On the heap, so that what may fail is not large. In artifacts one after the other.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct Parts {
    pub(crate) code: String,
    pub(crate) fields: BTreeMap<String, Field>,
    pub(crate) text: String,
}

/// What a message holds in a place. Derived is its form in artifacts, by place; in JSON it is a part of its message.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Field {
    /// A number.
    Number {
        /// As exact as it is written.
        value: f64,
        /// Decimals; as many as it takes where that is open.
        digits: Option<u8>,
        /// Whether it is written with its sign.
        signed: bool,
        /// Empty for a plain number.
        unit: String,
    },
    /// A name, or words of somebody else's.
    Text(String),
    /// Several, in order.
    List(Vec<Field>),
    /// Something with a code of its own.
    Message(Box<Message>),
}

/// How a number is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Form<'a> {
    pub(crate) digits: u8,
    pub(crate) signed: bool,
    pub(crate) unit: &'a str,
}

/// The field of what a message is about, such as names of photos.
const ABOUT: &str = "about";
/// The field of what would help.
const REMEDY: &str = "remedy";

impl Message {
    /// From its parts.
    pub(crate) fn of(code: &str, fields: BTreeMap<String, Field>, text: String) -> Message {
        let code = code.to_owned();
        Message(Box::new(Parts { code, fields, text }))
    }

    /// Its code; empty for a sentence as somebody gave it.
    pub fn code(&self) -> &str {
        &self.0.code
    }

    /// Its fields by name; with `about` and `remedy` where it has them.
    pub fn fields(&self) -> &BTreeMap<String, Field> {
        &self.0.fields
    }

    /// What it is about, before its sentence.
    pub fn about(&self) -> Option<&Field> {
        self.0.fields.get(ABOUT)
    }

    /// What would help, after its sentence.
    pub fn remedy(&self) -> Option<&Field> {
        self.0.fields.get(REMEDY)
    }

    /// The English sentence.
    pub fn as_str(&self) -> &str {
        &self.0.text
    }

    /// The same in other words, such as another language's.
    #[must_use]
    pub fn in_words(mut self, text: String) -> Message {
        self.0.text = text;
        self
    }

    /// The same with another field of this name, its text as it was.
    #[must_use]
    pub fn with_field(mut self, name: &str, field: Field) -> Message {
        self.0.fields.insert(name.to_owned(), field);
        self
    }

    /// The same with where it comes from before its sentence, for a list: `body: the sentence`. No field has it.
    #[must_use]
    pub fn from_where(mut self, place: &str) -> Message {
        self.0.text = format!("{place}: {}", self.0.text);
        self
    }

    /// The same about something: `NC: the sentence`.
    #[must_use]
    pub fn of_what(mut self, about: impl Into<Field>) -> Message {
        let about = about.into();
        if !self.0.code.is_empty() {
            self.0.text = format!("{about}: {}", self.0.text);
            self.0.fields.insert(ABOUT.into(), about);
            return self;
        }
        Message::from(format!("{about}: {}", self.0.text))
    }

    /// The same with what would help: `the sentence; the remedy`.
    #[must_use]
    pub fn with_remedy(mut self, remedy: impl Into<Field>) -> Message {
        let remedy = remedy.into();
        self.0.text += &format!("; {remedy}");
        if !self.0.code.is_empty() {
            self.0.fields.insert(REMEDY.into(), remedy);
        }
        self
    }

    /// Whether all its texts, those of its fields included, are such.
    pub fn all_texts(&self, are: &dyn Fn(&str) -> bool) -> bool {
        let names = self.0.fields.keys().all(|name| are(name));
        let fields = self.0.fields.values().all(|field| field.all_texts(are));
        are(&self.0.code) && are(&self.0.text) && names && fields
    }
}

impl Field {
    /// A number as it is to be written; what is none stays.
    pub(crate) fn formed(self, form: Form<'_>) -> Field {
        let Field::Number { value, .. } = self else {
            return self;
        };
        let digits = form.digits;
        let written = format!("{value:.0$}", usize::from(digits));
        Field::Number {
            value: written.parse().unwrap_or(value),
            digits: Some(digits),
            signed: form.signed,
            unit: form.unit.to_owned(),
        }
    }

    /// Whether it is the number one.
    pub(crate) fn is_one(&self) -> bool {
        matches!(self, Field::Number { value, .. } if *value == 1.0)
    }

    pub(crate) fn all_texts(&self, are: &dyn Fn(&str) -> bool) -> bool {
        match self {
            Field::Number { unit, .. } => are(unit),
            Field::Text(text) => are(text),
            Field::List(all) => all.iter().all(|field| field.all_texts(are)),
            Field::Message(message) => message.all_texts(are),
        }
    }
}

impl fmt::Display for Message {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0.text)
    }
}

impl fmt::Display for Field {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Field::Number {
                value,
                digits,
                signed,
                unit,
            } => {
                let sign = if *signed && !value.is_sign_negative() {
                    "+"
                } else {
                    ""
                };
                match digits {
                    Some(digits) => write!(f, "{sign}{value:.0$}", usize::from(*digits))?,
                    None => write!(f, "{sign}{value}")?,
                }
                let gap = if unit.is_empty() || unit == "°" {
                    ""
                } else {
                    " "
                };
                write!(f, "{gap}{unit}")
            }
            Field::Text(text) => f.write_str(text),
            Field::List(all) => {
                let all: Vec<String> = all.iter().map(Field::to_string).collect();
                f.write_str(&all.join(", "))
            }
            Field::Message(message) => f.write_str(message),
        }
    }
}

impl std::error::Error for Message {}

impl std::ops::Deref for Message {
    type Target = str;
    fn deref(&self) -> &str {
        &self.0.text
    }
}

impl From<Message> for String {
    fn from(message: Message) -> String {
        message.0.text
    }
}

impl From<&Message> for String {
    fn from(message: &Message) -> String {
        message.0.text.clone()
    }
}

impl PartialEq<&str> for Message {
    fn eq(&self, text: &&str) -> bool {
        self.0.text == *text
    }
}

impl From<&str> for Message {
    fn from(text: &str) -> Message {
        Message::of("", BTreeMap::new(), text.to_owned())
    }
}

impl From<String> for Message {
    fn from(text: String) -> Message {
        Message::of("", BTreeMap::new(), text)
    }
}

impl From<&String> for Message {
    fn from(text: &String) -> Message {
        Message::from(text.as_str())
    }
}

impl From<&Message> for Message {
    fn from(message: &Message) -> Message {
        message.clone()
    }
}
