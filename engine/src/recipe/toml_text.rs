//! A pipeline's TOML as a tree: every key and value with its place in the file.

use super::mistake::Mistake;
use super::tree::{Item, Key, Spot, Table};
use std::borrow::Cow;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Reads all of a text; what is no TOML is reported, and left out of the tree.
pub(super) fn tree(text: &str) -> (Table<'_>, Vec<Mistake>) {
    let (root, errors) = DeTable::parse_recoverable(text);
    let root = table(root.into_inner());
    let mistake = |error: toml::de::Error| {
        let span = error.span().unwrap_or(0..0);
        let mut what = error.message().to_owned();
        if what.contains("duplicate key")
            && let Some(first) = first(&root, text, &span)
        {
            let line = 1 + text[..first].matches('\n').count();
            what += &format!("; the first is in line {line}");
        }
        Mistake::at(&span, what)
    };
    let mistakes = errors.into_iter().map(mistake).collect();
    (root, mistakes)
}

/// Where a key or a header is that is written once more at `again`. \[bytes\]
fn first(root: &Table<'_>, text: &str, again: &Range<usize>) -> Option<usize> {
    let name = text.get(again.clone())?.trim_matches(['"', '\'']);
    let start = text[..again.start].rfind('\n').map_or(0, |i| i + 1);
    let line = text[start..].lines().next().unwrap_or("").trim();
    if line.starts_with('[') {
        let mut at = 0;
        return text[..start].split_inclusive('\n').find_map(|before| {
            at += before.len();
            (before.trim() == line).then_some(at - before.len())
        });
    }
    // The nearest one before is in the same table.
    fn nearest(table: &Table<'_>, name: &str, before: usize, best: &mut Option<usize>) {
        for (key, value) in table {
            if key.name == name && key.span.start < before {
                *best = (*best).max(Some(key.span.start));
            }
            if let Item::Table(inner) = &value.item {
                nearest(inner, name, before, best);
            }
        }
    }
    let mut best = None;
    nearest(root, name, again.start, &mut best);
    best
}

fn table(table: DeTable<'_>) -> Table<'_> {
    let entry = |(key, value): (Spanned<Cow<'_, str>>, _)| {
        let span = key.span();
        let name = Cow::Owned(key.into_inner().into_owned());
        (Key { name, span }, spot(value))
    };
    let mut entries: Table<'_> = table.into_iter().map(entry).collect();
    entries.sort_by_key(|(key, _)| key.span.start);
    entries
}

fn spot(value: Spanned<DeValue<'_>>) -> Spot<'_> {
    let span = value.span();
    let item = match value.into_inner() {
        DeValue::Boolean(b) => Item::Bool(b),
        DeValue::Integer(i) => {
            let whole = i64::from_str_radix(i.as_str(), i.radix());
            whole.map_or(Item::Other, Item::Int)
        }
        DeValue::Float(x) => x.as_str().parse().map_or(Item::Other, Item::Float),
        DeValue::String(text) => Item::Text(text),
        DeValue::Array(list) => Item::List(list.into_iter().map(spot).collect()),
        DeValue::Table(entries) => Item::Table(table(entries)),
        DeValue::Datetime(_) => Item::Other,
    };
    Spot { item, span }
}
