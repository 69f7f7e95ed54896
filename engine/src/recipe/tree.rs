//! A tree of keys and values, each with its place.

use std::borrow::Cow;
use std::ops::Range;

/// A value.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Item<'t> {
    Bool(bool),
    Int(i64),
    Float(f64),
    Text(Cow<'t, str>),
    List(Vec<Spot<'t>>),
    Table(Table<'t>),
    /// A date, or a number that is none of ours.
    Other,
}

/// A value and its place.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Spot<'t> {
    pub(super) item: Item<'t>,
    pub(super) span: Range<usize>,
}

/// A key and its place.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Key<'t> {
    pub(super) name: Cow<'t, str>,
    pub(super) span: Range<usize>,
}

/// Keys with their values in the order of the file.
pub(super) type Table<'t> = Vec<(Key<'t>, Spot<'t>)>;

/// Moves all places of a table: its text comes after other texts.
pub(super) fn moved(table: &mut Table<'_>, by: usize) {
    let shift = |span: &mut Range<usize>| *span = span.start + by..span.end + by;
    for (key, value) in table {
        shift(&mut key.span);
        moved_value(value, by);
    }
}

fn moved_value(value: &mut Spot<'_>, by: usize) {
    value.span = value.span.start + by..value.span.end + by;
    match &mut value.item {
        Item::List(list) => list.iter_mut().for_each(|v| moved_value(v, by)),
        Item::Table(table) => moved(table, by),
        _ => {}
    }
}
