//! The plain part of TOML in one pass: headers of two bare words, bare keys, texts without
//! escapes, numbers as people write them, lists, tables on one line.
//!
//! [`tree`] gives up at the first thing that it does not know or that is wrong, and never says
//! what: the reader of all of TOML does. What it does read, it reads as that one would.

use super::tree::{Item, Key, Spot, Table};
use std::borrow::Cow;
use std::collections::HashSet;

/// The whole text, or nothing.
pub(super) fn tree(text: &str) -> Option<Table<'_>> {
    let mut reader = Plain { text, at: 0 };
    let mut root: Table<'_> = Vec::new();
    let mut headers = HashSet::new();
    // Where keys go: into the root, or into the table of the last header.
    let mut open: Option<usize> = None;
    loop {
        reader.space();
        match reader.peek() {
            None => return Some(root),
            Some(b'\n') => reader.at += 1,
            Some(b'#') => reader.comment()?,
            Some(b'[') => {
                let start = reader.at;
                reader.at += 1;
                let section = reader.key()?;
                reader.take(b'.')?;
                let name = reader.key()?;
                reader.take(b']')?;
                let span = start..reader.at;
                reader.end_of_line()?;
                if !headers.insert((section.name.clone(), name.name.clone())) {
                    return None;
                }
                let at = match root.iter().position(|(key, _)| key.name == section.name) {
                    Some(at) => at,
                    None => {
                        let item = Item::Table(vec![]);
                        let span = span.clone();
                        root.push((section, Spot { item, span }));
                        root.len() - 1
                    }
                };
                // A value of the root cannot be a section as well.
                let Item::Table(tables) = &mut root[at].1.item else {
                    return None;
                };
                let item = Item::Table(Vec::with_capacity(3));
                tables.push((name, Spot { item, span }));
                open = Some(at);
            }
            Some(_) => {
                let entry = (reader.assigned()?, reader.value()?);
                reader.end_of_line()?;
                let table = match open {
                    None if matches!(entry.1.item, Item::Table(_)) => return None,
                    None => &mut root,
                    Some(at) => match &mut root[at].1.item {
                        Item::Table(tables) => match &mut tables.last_mut()?.1.item {
                            Item::Table(table) => table,
                            _ => return None,
                        },
                        _ => return None,
                    },
                };
                add(table, entry)?;
            }
        }
    }
}

/// Adds an entry whose key is new.
fn add<'t>(table: &mut Table<'t>, entry: (Key<'t>, Spot<'t>)) -> Option<()> {
    if table.iter().any(|(key, _)| key.name == entry.0.name) {
        return None;
    }
    table.push(entry);
    Some(())
}

struct Plain<'t> {
    text: &'t str,
    at: usize,
}

impl<'t> Plain<'t> {
    fn peek(&self) -> Option<u8> {
        self.text.as_bytes().get(self.at).copied()
    }

    fn take(&mut self, byte: u8) -> Option<()> {
        (self.peek() == Some(byte)).then(|| self.at += 1)
    }

    fn space(&mut self) {
        while let Some(b' ' | b'\t') = self.peek() {
            self.at += 1;
        }
    }

    fn lines(&mut self) {
        while let Some(b' ' | b'\t' | b'\n') = self.peek() {
            self.at += 1;
        }
    }

    fn comment(&mut self) -> Option<()> {
        while let Some(byte) = self.peek().filter(|b| *b != b'\n') {
            if byte != b'\t' && byte.is_ascii_control() {
                return None;
            }
            self.at += 1;
        }
        Some(())
    }

    fn end_of_line(&mut self) -> Option<()> {
        self.space();
        match self.peek() {
            None | Some(b'\n') => Some(()),
            Some(b'#') => self.comment(),
            Some(_) => None,
        }
    }

    /// The bytes from here on that fit.
    fn run(&mut self, fits: impl Fn(u8) -> bool) -> &'t str {
        let start = self.at;
        while self.peek().is_some_and(&fits) {
            self.at += 1;
        }
        &self.text[start..self.at]
    }

    fn key(&mut self) -> Option<Key<'t>> {
        let start = self.at;
        let word = self.run(|b| b.is_ascii_alphanumeric() || b == b'_' || b == b'-');
        let (name, span) = (Cow::Borrowed(word), start..self.at);
        (!word.is_empty()).then_some(Key { name, span })
    }

    /// A key and what stands between it and its value.
    fn assigned(&mut self) -> Option<Key<'t>> {
        let key = self.key()?;
        self.space();
        self.take(b'=')?;
        self.space();
        Some(key)
    }

    fn value(&mut self) -> Option<Spot<'t>> {
        let start = self.at;
        let item = match self.peek()? {
            b'"' => self.string()?,
            b'[' => self.list()?,
            b'{' => self.table()?,
            b't' | b'f' => match self.run(|b| b.is_ascii_alphabetic()) {
                "true" => Item::Bool(true),
                "false" => Item::Bool(false),
                _ => return None,
            },
            _ => self.number()?,
        };
        let span = start..self.at;
        Some(Spot { item, span })
    }

    fn string(&mut self) -> Option<Item<'t>> {
        self.take(b'"')?;
        let plain = |b: u8| b != b'"' && b != b'\\' && (b == b'\t' || !b.is_ascii_control());
        let text = self.run(plain);
        self.take(b'"')?;
        Some(Item::Text(Cow::Borrowed(text)))
    }

    /// Whole numbers of up to 18 digits and those with a point; no sign but `-`, no exponent.
    fn number(&mut self) -> Option<Item<'t>> {
        let start = self.at;
        let _ = self.take(b'-');
        let whole = self.run(|b| b.is_ascii_digit());
        if whole.is_empty() || whole.len() > 18 || (whole.len() > 1 && whole.starts_with('0')) {
            return None;
        }
        if self.take(b'.').is_none() {
            return self.text[start..self.at].parse().ok().map(Item::Int);
        }
        let part = self.run(|b| b.is_ascii_digit());
        if part.is_empty() {
            return None;
        }
        self.text[start..self.at].parse().ok().map(Item::Float)
    }

    fn list(&mut self) -> Option<Item<'t>> {
        self.take(b'[')?;
        let mut list = Vec::new();
        loop {
            self.lines();
            if self.take(b']').is_some() {
                return Some(Item::List(list));
            }
            // Deeper lists and tables of lists are rare.
            if let b'[' | b'{' = self.peek()? {
                return None;
            }
            list.push(self.value()?);
            self.lines();
            if self.take(b',').is_none() {
                self.take(b']')?;
                return Some(Item::List(list));
            }
        }
    }

    fn table(&mut self) -> Option<Item<'t>> {
        self.take(b'{')?;
        let mut table = Vec::with_capacity(2);
        loop {
            self.space();
            let key = self.assigned()?;
            // A table in a table is rare.
            if self.peek() == Some(b'{') {
                return None;
            }
            add(&mut table, (key, self.value()?))?;
            self.space();
            if self.take(b',').is_none() {
                self.take(b'}')?;
                return Some(Item::Table(table));
            }
        }
    }
}

#[cfg(test)]
mod tests;
