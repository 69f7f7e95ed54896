//! Who reads what a study prints: sentences and numbers in English, or as an application has them in another language.

use stage::{Message, Template};

/// How messages and numbers are read.
pub trait Reader {
    /// A message in words.
    fn message(&self, message: &Message) -> String {
        message.to_string()
    }

    /// A number that is written with a decimal point.
    fn number(&self, number: String) -> String {
        number
    }
}

/// Reads English.
pub struct English;

impl Reader for English {}

/// Words without fields.
pub(crate) fn words<const N: usize>(reader: &dyn Reader, all: [Template; N]) -> [String; N] {
    all.map(|one| reader.message(&Message::new(&one, [])))
}

/// A number with so many decimals; `–` where there is none.
pub(crate) fn number(reader: &dyn Reader, x: Option<f64>, digits: usize) -> String {
    x.map_or("–".into(), |x| reader.number(format!("{x:.digits$}")))
}

/// The same with its sign.
pub(crate) fn signed(reader: &dyn Reader, x: Option<f64>, digits: usize) -> String {
    x.map_or("–".into(), |x| reader.number(format!("{x:+.digits$}")))
}
