//! What becomes a field of a message: numbers, names, lists, messages.

use crate::message::Form;
use crate::{Field, Message};

impl Field {
    /// A number with so many decimals and its unit.
    pub fn number(value: f64, digits: u8, unit: &str) -> Field {
        let signed = false;
        let form = Form {
            digits,
            signed,
            unit,
        };
        Field::from(value).formed(form)
    }
}

impl From<Message> for Field {
    fn from(message: Message) -> Field {
        Field::Message(Box::new(message))
    }
}

impl From<&Message> for Field {
    fn from(message: &Message) -> Field {
        message.clone().into()
    }
}

impl From<&str> for Field {
    fn from(text: &str) -> Field {
        Field::Text(text.to_owned())
    }
}

impl From<String> for Field {
    fn from(text: String) -> Field {
        Field::Text(text)
    }
}

impl From<&String> for Field {
    fn from(text: &String) -> Field {
        Field::Text(text.clone())
    }
}

impl From<&&str> for Field {
    fn from(text: &&str) -> Field {
        Field::from(*text)
    }
}

impl From<f64> for Field {
    fn from(value: f64) -> Field {
        if !value.is_finite() {
            return Field::Text(value.to_string());
        }
        Field::Number {
            value,
            digits: None,
            signed: false,
            unit: String::new(),
        }
    }
}

/// Whole numbers are numbers as they are.
macro_rules! whole {
    ($($number:ty),*) => { $(
        impl From<$number> for Field {
            fn from(value: $number) -> Field {
                Field::from(value as f64)
            }
        }
        impl From<&$number> for Field {
            fn from(value: &$number) -> Field {
                Field::from(*value as f64)
            }
        }
    )* };
}
whole!(usize, u64, u32, i32, i64);

impl From<&f64> for Field {
    fn from(value: &f64) -> Field {
        Field::from(*value)
    }
}

impl<T: Into<Field>> From<Vec<T>> for Field {
    fn from(all: Vec<T>) -> Field {
        Field::List(all.into_iter().map(Into::into).collect())
    }
}

impl<T: Clone + Into<Field>> From<&Vec<T>> for Field {
    fn from(all: &Vec<T>) -> Field {
        all.as_slice().into()
    }
}

impl<T: Clone + Into<Field>> From<&[T]> for Field {
    fn from(all: &[T]) -> Field {
        Field::List(all.iter().cloned().map(Into::into).collect())
    }
}
