//! Tables of `capture.toml`, read key by key, and what is wrong with one.

use stage::unknown;
use toml::{Table, Value};

/// A `capture.toml` that does not make sense.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("capture.toml: {0}")]
pub struct RigError(pub(crate) String);

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

    pub(crate) fn take(&mut self, key: &'static str) -> Option<Value> {
        self.known.push(key);
        self.table.remove(key)
    }

    pub(crate) fn wrong(&self, key: &str, wants: &str, got: &Value) -> RigError {
        let place = if self.name.is_empty() {
            key.into()
        } else {
            format!("{}.{key}", self.name)
        };
        RigError(format!("`{place}` wants {wants}, but it is {got}"))
    }

    pub(crate) fn text(&mut self, key: &'static str) -> Result<Option<String>, RigError> {
        match self.take(key) {
            None => Ok(None),
            Some(Value::String(text)) => Ok(Some(text)),
            Some(other) => Err(self.wrong(key, "a text", &other)),
        }
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
