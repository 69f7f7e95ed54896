//! A param's value as a pipeline file may write it, and its one canonical text.

use std::collections::BTreeMap;
use std::fmt;

/// A param's value.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// `true` or `false`.
    Bool(bool),
    /// A whole number.
    Int(i64),
    /// A real number.
    Float(f64),
    /// A text.
    Text(String),
    /// A list of values.
    List(Vec<Value>),
    /// Values by name.
    Table(BTreeMap<String, Value>),
}

impl Value {
    /// What a person would call the type.
    pub fn type_name(&self) -> &'static str {
        match self {
            Value::Bool(_) => "a boolean",
            Value::Int(_) => "a whole number",
            Value::Float(_) => "a number",
            Value::Text(_) => "a text",
            Value::List(_) => "a list",
            Value::Table(_) => "a table",
        }
    }
}

/// The canonical text: equal bits give equal text, other bits other text. Floats are written
/// with the fewest digits that read back to the same bits; every NaN reads `nan`.
impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Value::Bool(b) => write!(f, "{b}"),
            Value::Int(i) => write!(f, "{i}"),
            Value::Float(x) if x.is_nan() => write!(f, "nan"),
            Value::Float(x) => write!(f, "{x:?}"),
            Value::Text(t) => write!(f, "{t:?}"),
            Value::List(l) => {
                write!(f, "[")?;
                for (i, v) in l.iter().enumerate() {
                    if i > 0 {
                        write!(f, ", ")?;
                    }
                    write!(f, "{v}")?;
                }
                write!(f, "]")
            }
            Value::Table(t) => {
                write!(f, "{{")?;
                for (i, (name, v)) in t.iter().enumerate() {
                    let comma = if i > 0 { "," } else { "" };
                    write!(f, "{comma} {name:?} = {v}")?;
                }
                write!(f, "{}}}", if t.is_empty() { "" } else { " " })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Value;

    #[test]
    fn floats_are_distinct_by_their_bits() {
        for (x, text) in [
            (0.0, "0.0"),
            (-0.0, "-0.0"),
            (0.1 + 0.2, "0.30000000000000004"),
        ] {
            assert_eq!(Value::Float(x).to_string(), text);
        }
        assert_eq!(
            Value::Float(f64::NAN).to_string(),
            Value::Float(-f64::NAN).to_string()
        );
    }

    #[test]
    fn a_text_cannot_pass_for_a_list_nor_one_table_for_another() {
        let table = |name: &str, value| Value::Table([(name.to_owned(), value)].into());
        let (plain, tricky) = (
            table("a", Value::Int(1)),
            table("a\" = 1, \"b", Value::Int(1)),
        );
        assert_eq!(plain.to_string(), "{ \"a\" = 1 }");
        assert!(!tricky.to_string().contains("{ \"a\" = 1"));
        let text = Value::List(vec![Value::Text("a\", \"b".into())]);
        let list = Value::List(vec![Value::Text("a".into()), Value::Text("b".into())]);
        assert_ne!(text.to_string(), list.to_string());
    }
}
