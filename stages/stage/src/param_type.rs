//! The types that a param may have, and how one is read.

use crate::{Field, Message, Mistake, ParamSpec, Template, Value, message};
use std::collections::BTreeMap;

crate::messages! {
    BOOLEAN = "recipe-a-boolean": "a boolean";
    CHOICE = "recipe-choice": "{value} is none of {words}";
    LIST = "recipe-a-list": "a list";
    MISSING = "recipe-missing": "must be given: {name} is {wanted}";
    NUMBER = "recipe-a-number": "a number";
    ONE_OF = "recipe-a-one-of": "one of {words}";
    RANGE = "recipe-range": "{value} is out of range: it must be in {least}..={most}";
    SECTION = "recipe-a-section": "a section of named tables";
    TABLE = "recipe-a-table": "a table";
    TEXT = "recipe-a-text": "a text";
    UNLIKE = "recipe-type": "wants {wanted}, but {value} is {got}";
    WHOLE = "recipe-a-whole": "a whole number";
    WITHIN = "recipe-a-within": "{kind} in {least}..={most}";
}

/// Words for types, as [`ParamType::NAME`] and [`Value::type_name`] have them.
const TYPES: [Template; 7] = [BOOLEAN, LIST, NUMBER, SECTION, TABLE, TEXT, WHOLE];

/// The word for a type, with its code where it has one.
fn type_field(name: &str) -> Field {
    let known = TYPES.iter().find(|known| known.english == name);
    known.map_or(name.into(), |known| Message::new(known, []).into())
}

/// A value is of another type than is wanted.
pub(crate) fn unlike(wanted: &str, value: &Value) -> Message {
    let got = type_field(value.type_name());
    message!(
        UNLIKE,
        wanted = type_field(wanted),
        value = value.to_string(),
        got = got
    )
}

/// A type that a param may have.
pub trait ParamType: Sized + Clone {
    /// What a person would call it.
    const NAME: &'static str;
    /// The words it may be, where it is a choice.
    const CHOICES: &'static [&'static str] = &[];
    /// What each entry holds, where it is a section of named entries.
    fn entry() -> Option<Vec<ParamSpec>> {
        None
    }
    /// From what was written, with all that is wrong within it.
    fn read_within(name: &str, value: &Value, mistakes: &mut Vec<Mistake>) -> Option<Self> {
        let read = Self::read(value);
        if read.is_none() {
            let what = match Self::CHOICES {
                [] => unlike(Self::NAME, value),
                words => message!(CHOICE, value = value.to_string(), words = words.join(", ")),
            };
            let name = name.to_owned();
            mistakes.push(Mistake { name, what });
        }
        read
    }
    /// From what was written. [`None`] when it does not fit.
    fn read(value: &Value) -> Option<Self>;
    /// To be written.
    fn value(&self) -> Value;
    /// The number that a range speaks of.
    fn number(&self) -> Option<f64> {
        None
    }
}

impl ParamType for f64 {
    const NAME: &'static str = "a number";
    fn read(value: &Value) -> Option<Self> {
        match value {
            Value::Float(x) if x.is_finite() => Some(*x),
            Value::Int(i) => Some(*i as f64),
            _ => None,
        }
    }
    fn value(&self) -> Value {
        Value::Float(*self)
    }
    fn number(&self) -> Option<f64> {
        Some(*self)
    }
}

macro_rules! whole {
    ($($t:ty),*) => {$(
        impl ParamType for $t {
            const NAME: &'static str = "a whole number";
            fn read(value: &Value) -> Option<Self> {
                match value {
                    Value::Int(i) => <$t>::try_from(*i).ok(),
                    _ => None,
                }
            }
            fn value(&self) -> Value {
                Value::Int(*self as i64)
            }
            fn number(&self) -> Option<f64> {
                Some(*self as f64)
            }
        }
    )*};
}
whole!(i64, u32, usize);

impl ParamType for bool {
    const NAME: &'static str = "a boolean";
    fn read(value: &Value) -> Option<Self> {
        match value {
            Value::Bool(b) => Some(*b),
            _ => None,
        }
    }
    fn value(&self) -> Value {
        Value::Bool(*self)
    }
}

impl ParamType for String {
    const NAME: &'static str = "a text";
    fn read(value: &Value) -> Option<Self> {
        match value {
            Value::Text(t) => Some(t.clone()),
            _ => None,
        }
    }
    fn value(&self) -> Value {
        Value::Text(self.clone())
    }
}

impl<T: ParamType> ParamType for Vec<T> {
    const NAME: &'static str = "a list";
    fn read(value: &Value) -> Option<Self> {
        match value {
            Value::List(l) => l.iter().map(T::read).collect(),
            _ => None,
        }
    }
    fn value(&self) -> Value {
        Value::List(self.iter().map(T::value).collect())
    }
}

/// Reads one param: for [`params!`](crate::params!).
#[doc(hidden)]
pub fn read_one<T: ParamType>(
    name: &'static str,
    range: Option<(f64, f64)>,
    required: bool,
    given: &BTreeMap<String, Value>,
    default: T,
    mistakes: &mut Vec<Mistake>,
) -> T {
    let Some(value) = given.get(name) else {
        if required {
            mistakes.push(Mistake {
                name: name.into(),
                what: message!(MISSING, name = name, wanted = wanted::<T>(range)),
            });
        }
        return default;
    };
    let Some(read) = T::read_within(name, value, mistakes) else {
        return default;
    };
    if let (Some((lo, hi)), Some(x)) = (range, read.number())
        && !(lo..=hi).contains(&x)
    {
        mistakes.push(Mistake {
            name: name.into(),
            what: message!(RANGE, value = value.to_string(), least = lo, most = hi),
        });
        return default;
    }
    read
}

/// What would fit, in words.
fn wanted<T: ParamType>(range: Option<(f64, f64)>) -> Field {
    match (T::CHOICES, range) {
        ([], None) => type_field(T::NAME),
        ([], Some((lo, hi))) => {
            message!(WITHIN, kind = type_field(T::NAME), least = lo, most = hi).into()
        }
        (words, _) => message!(ONE_OF, words = words.join(", ")).into(),
    }
}
