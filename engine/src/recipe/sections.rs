//! Sections: `[girth.mid_thigh]` fills the param `girth` of every node whose stage has one of that
//! name. Which sections there are follows from the stages: the engine knows none.

use super::binder::{Binder, Known, sections_of};
use super::mistake::Mistake;
use super::values::{merged, within};
use super::written::{KEYS, Node, Section};
use crate::graph::Bound;
use stage::{Message, ParamSpec, Value, message, unknown};
use std::collections::BTreeMap;
use std::ops::Range;

stage::messages! {
    ENTRY = "recipe-entry": "`{section}.{entry}`: {what}";
    OF_STAGE = "recipe-of-stage": "{stage}: {what}";
    PARAM = "recipe-param": "`{name}` {what}";
}

/// What is wrong with a param's value.
pub(super) fn of_param(name: &str, what: Message) -> Message {
    message!(PARAM, name = name, what = what)
}

/// What a stage does not take.
pub(super) fn of_stage(stage: &str, what: Message) -> Message {
    message!(OF_STAGE, stage = stage, what = what)
}

impl Binder<'_> {
    /// All that a node is given: entries of the sections that its stage takes, and over them what it
    /// sets itself.
    pub(super) fn entries(&self, node: &Node, known: &Known) -> BTreeMap<String, Value> {
        let spanned = node.with.iter();
        let mut entries: BTreeMap<String, Value> = spanned
            .map(|(k, v)| (k.value.clone(), v.value.clone()))
            .collect();
        for kind in known.sections.iter() {
            let spanned = self.recipe.sections.iter();
            let mut table = BTreeMap::new();
            for entry in spanned.filter(|s| s.kind.value == *kind) {
                let keys = entry.keys.iter();
                let keys = keys.map(|(k, v)| (k.value.clone(), v.value.clone()));
                table.insert(entry.name.value.clone(), Value::Table(keys.collect()));
            }
            if !table.is_empty() {
                let table = Value::Table(table);
                let value = match entries.remove(*kind) {
                    Some(own) => merged(table, own),
                    None => table,
                };
                entries.insert((*kind).to_owned(), value);
            }
        }
        entries
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
            return Mistake::at(span, of_stage(stage, wrong.what));
        };
        if path.len() == 1 {
            let span = pair.map_or(&node.name.span, |(_, v)| &v.span);
            return Mistake::at(span, of_param(&wrong.name, wrong.what));
        }
        let fields = spec.entry.as_deref().unwrap_or_default();
        let unknown = path
            .get(2)
            .filter(|key| !fields.iter().any(|f| f.name == **key));
        let what = match unknown {
            Some(_) => message!(ENTRY, section = path[0], entry = path[1], what = wrong.what),
            None => of_param(&wrong.name, wrong.what),
        };
        // What the node sets itself goes over the section.
        let own = pair.filter(|(_, v)| within(&v.value, &path[1..]).is_some());
        let span = match own {
            Some((_, v)) => v.span.clone(),
            None => self
                .place(&path, unknown.is_some())
                .unwrap_or_else(|| pair.map_or(node.name.span.clone(), |(_, v)| v.span.clone())),
        };
        Mistake::at(&span, what)
    }

    /// Where a section sets what is at a path: the key if it is unknown, else its value, else the
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

    /// Reports sections that mean nothing, and those that nobody takes.
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
