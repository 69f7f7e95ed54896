//! Which port of a node reads what.

use super::binder::{Binder, Known};
use super::mistake::Mistake;
use super::written::{From, Node, Spanned};
use crate::graph::Source;
use stage::{PortSpec, unknown};

impl<'a> Binder<'a> {
    /// Which port reads what: by name; in a list also the only open port of that kind.
    pub(super) fn wires(
        &mut self,
        node: &'a Node,
        ports: &[PortSpec],
        stages: &[Option<Known>],
    ) -> Vec<(usize, &'a Spanned<String>)> {
        let known: Vec<&str> = ports.iter().map(|p| p.name).collect();
        let mut wires: Vec<(usize, &'a Spanned<String>)> = Vec::new();
        match &node.from {
            From::Table(table) => {
                for (port, source) in table {
                    match known.iter().position(|p| *p == port.value) {
                        Some(i) => wires.push((i, source)),
                        None => {
                            let what = unknown("port", &port.value, &known);
                            self.mistakes.push(Mistake::at(&port.span, what));
                        }
                    }
                }
            }
            From::List(list) => {
                let named = |s: &Spanned<String>| {
                    known
                        .iter()
                        .position(|p| *p == s.value.trim_start_matches('@'))
                };
                let mut open: Vec<usize> = (0..ports.len()).collect();
                open.retain(|i| !list.iter().any(|s| named(s) == Some(*i)));
                for spanned in list {
                    let kind = self
                        .source(spanned)
                        .and_then(|source| self.kind(source, stages));
                    let fits: Vec<usize> = open
                        .iter()
                        .copied()
                        .filter(|i| Some(ports[*i].kind) == kind)
                        .collect();
                    match (named(spanned), fits.as_slice()) {
                        (Some(i), _) => wires.push((i, spanned)),
                        (None, [one]) => {
                            open.retain(|i| i != one);
                            wires.push((*one, spanned));
                        }
                        (None, _) if kind.is_none() => {}
                        (None, several) => {
                            let kind = kind.unwrap_or_default();
                            let what = if several.is_empty() {
                                format!("no open port of {} takes {kind}", node.stage.value)
                            } else {
                                format!(
                                    "several ports take {kind}: name one, `from = {{ {} = \"{}\" }}`",
                                    ports[several[0]].name, spanned.value
                                )
                            };
                            self.mistakes.push(Mistake::at(&spanned.span, what));
                        }
                    }
                }
            }
        }
        wires
    }

    /// Whether all that a node reads is there, and of a kind that is known.
    pub(super) fn known_sources(&self, node: &Node) -> bool {
        let known = |spanned: &Spanned<String>| match spanned.value.strip_prefix('@') {
            Some(name) => self.inputs.contains_key(name),
            None => match self.places.get(spanned.value.as_str()) {
                Some(Source::Node(i)) => self.is_known(*i),
                _ => false,
            },
        };
        match &node.from {
            From::List(list) => list.iter().all(known),
            From::Table(table) => table.iter().all(|(_, source)| known(source)),
        }
    }

    pub(super) fn source(&mut self, spanned: &Spanned<String>) -> Option<Source> {
        let recipe = self.recipe;
        let input = spanned.value.strip_prefix('@');
        let source = match input {
            Some(name) => self.inputs.get(name).copied(),
            None => self.places.get(spanned.value.as_str()).copied(),
        };
        if source.is_none() {
            let (what, known): (_, Vec<&str>) = match input {
                Some(_) => (
                    "input",
                    recipe
                        .inputs
                        .iter()
                        .map(|i| i.name.value.as_str())
                        .collect(),
                ),
                None => (
                    "node",
                    recipe.nodes.iter().map(|n| n.name.value.as_str()).collect(),
                ),
            };
            let mistake = Mistake::at(
                &spanned.span,
                unknown(what, spanned.value.trim_start_matches('@'), &known),
            );
            if !self.mistakes.contains(&mistake) {
                self.mistakes.push(mistake);
            }
        }
        source
    }

    pub(super) fn kind(&self, source: Source, stages: &[Option<Known>]) -> Option<&'static str> {
        match source {
            Source::Input(_) => Some("files"),
            Source::Node(i) => stages[i].as_ref().map(|s| s.stage.yields()),
        }
    }
}
