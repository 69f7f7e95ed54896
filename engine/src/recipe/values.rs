//! Values: from a text, put into each other, merged.

use stage::Value;

/// A TOML value; what is none is a text.
pub fn parse_value(text: &str) -> Value {
    let line = format!("x = {text}");
    let parsed: Option<toml::Table> = line.parse().ok();
    fn convert(value: &toml::Value) -> Option<Value> {
        Some(match value {
            toml::Value::Boolean(b) => Value::Bool(*b),
            toml::Value::Integer(i) => Value::Int(*i),
            toml::Value::Float(x) => Value::Float(*x),
            toml::Value::String(t) => Value::Text(t.clone()),
            toml::Value::Table(t) => {
                let entry = |(k, v): (&String, _)| Some((k.clone(), convert(v)?));
                Value::Table(t.iter().map(entry).collect::<Option<_>>()?)
            }
            toml::Value::Array(l) => Value::List(l.iter().map(convert).collect::<Option<_>>()?),
            _ => return None,
        })
    }
    let value = parsed.as_ref().and_then(|t| t.get("x")).and_then(convert);
    value.unwrap_or_else(|| Value::Text(text.to_owned()))
}

/// Two values as one: of tables, the entries of both, `over` where both speak.
pub(super) fn merged(under: Value, over: Value) -> Value {
    let (Value::Table(mut table), Value::Table(more)) = (under, over.clone()) else {
        return over;
    };
    for (name, value) in more {
        let value = match table.remove(&name) {
            Some(old) => merged(old, value),
            None => value,
        };
        table.insert(name, value);
    }
    Value::Table(table)
}

/// A value at a place within tables: `["a", "b"]` and 1 are `{ a = { b = 1 } }`.
pub(super) fn nested(path: &[&str], value: Value) -> Value {
    let wrap = |value, part: &&str| Value::Table([((*part).to_owned(), value)].into());
    path.iter().rev().fold(value, wrap)
}

/// The value at a place within tables.
pub(super) fn within<'a>(value: &'a Value, path: &[&str]) -> Option<&'a Value> {
    path.iter().try_fold(value, |at, part| match at {
        Value::Table(table) => table.get(*part),
        _ => None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_merged_all_the_way_down() {
        let under = nested(&["a", "at"], Value::Float(0.5));
        let over = nested(&["a", "part"], Value::Text("thigh".into()));
        let both = merged(under.clone(), over);
        let text = "{ \"a\" = { \"at\" = 0.5, \"part\" = \"thigh\" } }";
        assert_eq!(both.to_string(), text);
        let other = merged(both, nested(&["a", "at"], Value::Int(1)));
        assert_eq!(within(&other, &["a", "at"]), Some(&Value::Int(1)));
        assert_eq!(within(&other, &["a", "at", "x"]), None);
        assert_eq!(merged(under, Value::Int(1)), Value::Int(1));
    }
}
