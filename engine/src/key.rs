//! What a result depends on: one walk, two writers.
//!
//! The lines that are hashed into the key are the lines that `why` shows, so the reason that a
//! user is shown is the reason there was.

use crate::graph::Bound;
use stage::Hash;
use std::fmt::Write as _;

/// Takes down what a result depends on.
pub trait Ledger {
    /// One dependency: what it is, and its value.
    fn line(&mut self, what: &str, value: &str);
}

/// Writes down what the node does, without its inputs: stage, format of the output, versions of the
/// foreign programs that it runs, params.
pub fn describe_recipe(node: &Bound, ledger: &mut impl Ledger) {
    let (mut what, mut value) = (String::from("with "), String::with_capacity(64));
    let stage = node.stage;
    let _ = write!(value, "{} v{}", stage.name(), stage.version());
    ledger.line("stage", &value);
    value.clear();
    let _ = write!(value, "{} format {}", stage.yields(), stage.format());
    ledger.line("makes", &value);
    if let Some(program) = &node.program {
        let lines = program.lines();
        lines
            .iter()
            .for_each(|(what, value)| ledger.line(what, value));
    }
    for (program, version) in stage.programs() {
        ledger.line(&format!("program {program}"), &version);
    }
    for (name, given) in &node.params.values {
        what.truncate("with ".len());
        what += name;
        value.clear();
        let _ = write!(value, "{given}");
        ledger.line(&what, &value);
    }
}

/// Writes down all that the node's result depends on. `inputs` has one entry a port.
pub fn describe(node: &Bound, inputs: &[Option<Hash>], ledger: &mut impl Ledger) {
    describe_recipe(node, ledger);
    let mut what = String::from("from ");
    for (port, content) in node.ports.iter().zip(inputs) {
        what.truncate("from ".len());
        what += port.name;
        match content {
            Some(hash) => ledger.line(&what, hash.to_hex().as_str()),
            None => ledger.line(&what, "nothing"),
        }
    }
}

/// The key: lengths before texts, so that no line can pass for another.
#[derive(Default)]
pub struct Digest(blake3::Hasher);

impl Ledger for Digest {
    fn line(&mut self, what: &str, value: &str) {
        for text in [what, value] {
            self.0.update(&(text.len() as u64).to_le_bytes());
            self.0.update(text.as_bytes());
        }
    }
}

impl Digest {
    /// The hash of all lines.
    pub fn finish(&self) -> Hash {
        self.0.finalize()
    }
}

/// The same lines as text, kept beside the result.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Provenance(pub Vec<(String, String)>);

impl Ledger for Provenance {
    fn line(&mut self, what: &str, value: &str) {
        self.0.push((what.into(), value.into()));
    }
}

impl Provenance {
    /// The key of what has this provenance.
    pub fn key(&self) -> Hash {
        of(&self.0)
    }
}

/// The key of what has these lines.
pub fn of(lines: &[(String, String)]) -> Hash {
    let mut digest = Digest::default();
    lines
        .iter()
        .for_each(|(what, value)| digest.line(what, value));
    digest.finish()
}

/// The key of a node's result.
pub fn key(node: &Bound, inputs: &[Option<Hash>]) -> Hash {
    let mut digest = Digest::default();
    describe(node, inputs, &mut digest);
    digest.finish()
}

/// The provenance of a node's result.
pub fn provenance(node: &Bound, inputs: &[Option<Hash>]) -> Provenance {
    let mut provenance = Provenance::default();
    describe(node, inputs, &mut provenance);
    provenance
}
