//! Tables of `capture.toml`, read key by key, and what is wrong with one.

use crate::known::believed;
use stage::{Coded, Message, message, nearest};
use std::fmt;
use toml::{Table, Value};

stage::messages! {
    IN_FILE = "rig-file": "capture.toml: {what}";
    IN_BOTH = "rig-file-and-facts": "capture.toml and what was given beside it: {what}";
    WANTS = "rig-wants": "`{key}` wants {wants}, but it is {got}";
    LACKS = "rig-lacks": "`{table}` has no `{key}`";
    TEXT = "rig-text": "a text";
    TEXTS = "rig-texts": "a text or a list of texts";
    NUMBER = "rig-number": "a number from {least} to {most}";
    TABLE = "rig-table": "a table";
    UNKNOWN = "rig-unknown": "there is no key `{key}`; {near}known: {known}";
    NEAR = "rig-near": "did you mean `{near}`? ";
}

/// What is given of a capture and does not make sense.
#[derive(Debug, Clone, PartialEq)]
pub struct RigError {
    /// What is wrong.
    pub(crate) what: Message,
    /// Whether something is not there, which may be elsewhere.
    pub(crate) missing: bool,
    /// Whether it was given beside the file.
    pub(crate) beside: bool,
}

impl RigError {
    pub(crate) fn wrong(what: impl Into<Message>) -> Self {
        RigError {
            what: what.into(),
            missing: false,
            beside: false,
        }
    }

    pub(crate) fn missing(what: Message) -> Self {
        RigError {
            missing: true,
            ..RigError::wrong(what)
        }
    }
}

impl Coded for RigError {
    fn message(&self) -> Message {
        let what = self.what.clone();
        match self.beside {
            true => message!(IN_BOTH, what = what),
            false => message!(IN_FILE, what = what),
        }
    }
}

impl fmt::Display for RigError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.message().as_str())
    }
}

impl std::error::Error for RigError {}

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

    pub(crate) fn wrong(&self, key: &str, wants: Message, got: &Value) -> RigError {
        let (key, got) = (self.place(key), got.to_string());
        RigError::wrong(message!(WANTS, key = key, wants = wants, got = got))
    }

    /// A key that must be there.
    pub(crate) fn lacks(&self, key: &str) -> RigError {
        RigError::missing(message!(LACKS, table = self.name, key = key))
    }

    pub(crate) fn text(&mut self, key: &'static str) -> Result<Option<String>, RigError> {
        match self.take(key) {
            None => Ok(None),
            Some(Value::String(text)) => Ok(Some(text)),
            Some(other) => Err(self.wrong(key, message!(TEXT), &other)),
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
        texts.ok_or_else(|| self.wrong(key, message!(TEXTS), &value))
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
            None => {
                let wants = message!(NUMBER, least = lo, most = hi);
                Err(self.wrong(key, wants, &value))
            }
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
            Some(other) => Err(self.wrong(key, message!(TABLE), &other)),
        }
    }

    /// Names the keys that nobody read.
    pub(crate) fn rest(&self, unread: &mut Vec<Message>) {
        let known = self.known.join(", ");
        for key in self.table.keys() {
            let near = match nearest(key, &self.known) {
                Some(near) => message!(NEAR, near = near),
                None => Message::default(),
            };
            let known = known.as_str();
            unread.push(message!(UNKNOWN, key = key, near = near, known = known));
        }
    }
}
