//! Sections: `[girth.mid_thigh]` fills the param `girth` of every node whose stage has one of that
//! name. What sections there are is told by the stages: the engine knows none.

use super::bind::{Binder, Known};
use super::{Mistake, Node, Said, With};
use crate::graph::Bound;
use stage::{ParamSpec, Value, unknown};
use std::collections::BTreeMap;
use std::ops::Range;

/// `[KIND.NAME]`: one entry of a section.
#[derive(Debug, Clone, PartialEq)]
pub struct Section {
    /// The param that it fills.
    pub kind: Said<String>,
    /// Its own name.
    pub name: Said<String>,
    /// What it says.
    pub keys: With,
}

/// The keys of the grammar itself.
const KEYS: [&str; 6] = ["about", "goal", "input", "node", "variant", "sweep"];

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
fn within<'a>(value: &'a Value, path: &[&str]) -> Option<&'a Value> {
    path.iter().try_fold(value, |at, part| match at {
        Value::Table(table) => table.get(*part),
        _ => None,
    })
}

impl Binder<'_> {
    /// All that a node is told: entries of the sections that its stage takes, and over them what it
    /// says itself.
    pub(super) fn told(&self, node: &Node, known: &Known) -> BTreeMap<String, Value> {
        let said = node.with.iter();
        let mut told: BTreeMap<String, Value> = said
            .map(|(k, v)| (k.value.clone(), v.value.clone()))
            .collect();
        for kind in known.sections.iter() {
            let entries = self.recipe.sections.iter();
            let mut table = BTreeMap::new();
            for entry in entries.filter(|s| s.kind.value == *kind) {
                let keys = entry.keys.iter();
                let keys = keys.map(|(k, v)| (k.value.clone(), v.value.clone()));
                table.insert(entry.name.value.clone(), Value::Table(keys.collect()));
            }
            if !table.is_empty() {
                let table = Value::Table(table);
                let value = match told.remove(*kind) {
                    Some(own) => merged(table, own),
                    None => table,
                };
                told.insert((*kind).to_owned(), value);
            }
        }
        told
    }

    /// A mistake of a stage's params, at the place where it was written.
    pub(super) fn misread(
        &self,
        node: &Node,
        stage: &str,
        specs: &[ParamSpec],
        wrong: stage::Mistake,
    ) -> Mistake {
        let path: Vec<&str> = wrong.name.split('.').collect();
        let pair = node.with.iter().find(|(k, _)| k.value == path[0]);
        let spec = specs.iter().find(|p| p.name == path[0]);
        let Some(spec) = spec else {
            let span = pair.map_or(&node.name.span, |(k, _)| &k.span);
            return Mistake::at(span, format!("{stage}: {}", wrong.what));
        };
        if path.len() == 1 {
            let span = pair.map_or(&node.name.span, |(_, v)| &v.span);
            return Mistake::at(span, format!("`{}` {}", wrong.name, wrong.what));
        }
        let fields = spec.entry.as_deref().unwrap_or_default();
        let unknown = path
            .get(2)
            .filter(|key| !fields.iter().any(|f| f.name == **key));
        let what = match unknown {
            Some(_) => format!("`{}.{}`: {}", path[0], path[1], wrong.what),
            None => format!("`{}` {}", wrong.name, wrong.what),
        };
        // What the node says itself stands over the section.
        let own = pair.filter(|(_, v)| within(&v.value, &path[1..]).is_some());
        let span = match own {
            Some((_, v)) => v.span.clone(),
            None => self
                .place(&path, unknown.is_some())
                .unwrap_or_else(|| pair.map_or(node.name.span.clone(), |(_, v)| v.span.clone())),
        };
        Mistake::at(&span, what)
    }

    /// Where a section says what is at a path: the key if it is unknown, else its value, else the
    /// header.
    fn place(&self, path: &[&str], key_itself: bool) -> Option<Range<usize>> {
        let sections = self.recipe.sections.iter();
        let of = |s: &&Section| s.kind.value == path[0] && s.name.value == path[1];
        let section = sections.rev().find(of)?;
        let key = path.get(2).and_then(|key| {
            let mut keys = section.keys.iter();
            keys.find(|(k, _)| k.value == **key)
        });
        Some(match key {
            Some((k, _)) if key_itself => k.span.clone(),
            Some((_, v)) => v.span.clone(),
            None => section.name.span.clone(),
        })
    }

    /// Says which sections mean nothing, and which nobody takes.
    pub(super) fn idle_sections(
        &mut self,
        stages: &[Option<Known>],
        bound: &[Option<Bound>],
        strict: bool,
    ) {
        let mut taken: Vec<&str> = stages
            .iter()
            .flatten()
            .flat_map(|k| k.sections.iter().copied())
            .collect();
        taken.dedup();
        let everywhere = self.catalog.stages().flat_map(|s| sections_of(&s.params()));
        let mut kinds: Vec<&str> = everywhere.chain(taken.iter().copied()).collect();
        kinds.sort_unstable();
        kinds.dedup();
        let whole = strict && bound.iter().all(Option::is_some);
        for section in &self.recipe.sections {
            let (kind, name) = (section.kind.value.as_str(), &section.name.value);
            if !kinds.contains(&kind) {
                let known: Vec<&str> = KEYS.iter().copied().chain(kinds.iter().copied()).collect();
                let mistake = Mistake::at(&section.kind.span, unknown("key", kind, &known));
                if !self.mistakes.contains(&mistake) {
                    self.mistakes.push(mistake);
                }
            } else if whole && !taken.contains(&kind) {
                let what = format!("no node of this pipeline takes `[{kind}.{name}]`");
                self.mistakes.push(Mistake::at(&section.name.span, what));
            }
        }
    }
}

/// The names of the sections among params.
pub(super) fn sections_of(specs: &[ParamSpec]) -> Vec<&'static str> {
    let sections = specs.iter().filter(|p| p.entry.is_some());
    sections.map(|p| p.name).collect()
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
