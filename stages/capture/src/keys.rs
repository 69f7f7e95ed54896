//! Tables of `capture.toml`, read key by key, and what is wrong with one.

use crate::known::believed;
use stage::unknown;
use toml::{Table, Value};

/// What is given of a capture and does not make sense.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{}: {what}", if *.beside { BESIDE } else { FILE })]
pub struct RigError {
    /// What is wrong.
    pub(crate) what: String,
    /// Whether something is not there, which may be elsewhere.
    pub(crate) missing: bool,
    /// Whether it was given beside the file.
    pub(crate) beside: bool,
}

const FILE: &str = "capture.toml";
const BESIDE: &str = "capture.toml and what was given beside it";

impl RigError {
    pub(crate) fn wrong(what: impl ToString) -> Self {
        RigError {
            what: what.to_string(),
            missing: false,
            beside: false,
        }
    }

    pub(crate) fn missing(what: impl ToString) -> Self {
        RigError {
            missing: true,
            ..RigError::wrong(what)
        }
    }
}

/// A table that remembers which of its keys were read.
pub(crate) struct Keys<'a> {
    name: &'a str,
    table: Table,
    known: Vec<&'static str>,
}

impl Keys<'_> {
    /// Of the whole file.
    pub(crate) fn root(table: Table) -> Keys<'static> {
        Keys {
            name: "",
            table,
            known: vec![],
        }
    }

    pub(crate) fn name(&self) -> String {
        self.name.to_owned()
    }

    pub(crate) fn has(&self, key: &str) -> bool {
        self.table.contains_key(key)
    }

    pub(crate) fn take(&mut self, key: &'static str) -> Option<Value> {
        self.known.push(key);
        self.table.remove(key)
    }

    /// A key with the name of its table.
    fn place(&self, key: &str) -> String {
        match self.name {
            "" => key.into(),
            table => format!("{table}.{key}"),
        }
    }

    pub(crate) fn wrong(&self, key: &str, wants: &str, got: &Value) -> RigError {
        let place = self.place(key);
        RigError::wrong(format!("`{place}` wants {wants}, but it is {got}"))
    }

    pub(crate) fn text(&mut self, key: &'static str) -> Result<Option<String>, RigError> {
        match self.take(key) {
            None => Ok(None),
            Some(Value::String(text)) => Ok(Some(text)),
            Some(other) => Err(self.wrong(key, "a text", &other)),
        }
    }

    /// A text, or a list of texts.
    pub(crate) fn texts(&mut self, key: &'static str) -> Result<Vec<String>, RigError> {
        let Some(value) = self.take(key) else {
            return Ok(vec![]);
        };
        let one = |v: &Value| v.as_str().map(str::to_owned);
        let texts: Option<Vec<String>> = match &value {
            Value::Array(list) => list.iter().map(one).collect(),
            other => one(other).map(|text| vec![text]),
        };
        texts.ok_or_else(|| self.wrong(key, "a text or a list of texts", &value))
    }

    /// One of the known numbers, by what is believed of it.
    pub(crate) fn known(&mut self, key: &'static str) -> Result<Option<f64>, RigError> {
        let [least, most] = believed(&self.place(key));
        self.number(key, least, most)
    }

    pub(crate) fn number(
        &mut self,
        key: &'static str,
        lo: f64,
        hi: f64,
    ) -> Result<Option<f64>, RigError> {
        let Some(value) = self.take(key) else {
            return Ok(None);
        };
        let number = value.as_float().or(value.as_integer().map(|i| i as f64));
        match number.filter(|x| (lo..=hi).contains(x)) {
            Some(x) => Ok(Some(x)),
            None => Err(self.wrong(key, &format!("a number from {lo} to {hi}"), &value)),
        }
    }

    pub(crate) fn inner(&mut self, key: &'static str) -> Result<Option<Keys<'static>>, RigError> {
        match self.take(key) {
            None => Ok(None),
            Some(Value::Table(table)) => Ok(Some(Keys {
                name: key,
                table,
                known: vec![],
            })),
            Some(other) => Err(self.wrong(key, "a table", &other)),
        }
    }

    pub(crate) fn rest(&self, unknown_keys: &mut Vec<String>) {
        for key in self.table.keys() {
            unknown_keys.push(unknown("key", key, &self.known));
        }
    }
}
