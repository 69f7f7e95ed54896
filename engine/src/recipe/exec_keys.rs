//! The keys of a node that runs a program: read, and put over each other.

use super::read::Reader;
use super::tree::{Item, Key, Spot};
use super::written::{Exec, Spanned};

impl Reader {
    /// Takes a key of a program; whether it is one.
    pub(super) fn exec(&mut self, exec: &mut Exec, key: &Key<'_>, value: &Spot<'_>) -> bool {
        match &*key.name {
            "command" => exec.command = Some(self.texts(value, "a word of a command")),
            "out" => exec.out = Some(self.text(value, "`out`")),
            "files" => exec.files = Some(self.texts(value, "a file")),
            "identity" => exec.identity = Some(self.texts(value, "a word of a command")),
            "env" => exec.env = Some(self.texts(value, "a name")),
            "reads" => exec.reads = Some(self.texts(value, "a path")),
            "timeout_s" => exec.timeout_s = self.limit(value, "`timeout_s`"),
            "memory_mb" => exec.memory_mb = self.limit(value, "`memory_mb`"),
            "network" => exec.network = self.switch(value, "`network`").or(exec.network),
            "keep" => exec.keep = self.switch(value, "`keep`").or(exec.keep),
            _ => return false,
        }
        exec.key.get_or_insert_with(|| key.spanned());
        true
    }

    fn switch(&mut self, value: &Spot<'_>, what: &str) -> Option<bool> {
        let spanned = match value.item {
            Item::Bool(spanned) => Some(spanned),
            _ => None,
        };
        if spanned.is_none() {
            self.wrong(&value.span, format!("{what} must be true or false"));
        }
        spanned
    }

    /// A number above nothing.
    fn limit(&mut self, value: &Spot<'_>, what: &str) -> Option<Spanned<f64>> {
        let number = match value.item {
            Item::Int(i) => Some(i as f64),
            Item::Float(x) => Some(x),
            _ => None,
        };
        let number = number.filter(|x| *x > 0.0 && *x <= 1e9);
        if number.is_none() {
            let what = format!("{what} must be a number above 0, 1e9 at most");
            self.wrong(&value.span, what);
        }
        let span = value.span.clone();
        number.map(|value| Spanned { value, span })
    }
}

impl Exec {
    /// Puts the keys of another node of the same name over these.
    pub(super) fn change(&mut self, over: Exec) {
        self.key = over.key.or(self.key.take());
        self.command = over.command.or(self.command.take());
        self.out = over.out.or(self.out.take());
        self.files = over.files.or(self.files.take());
        self.identity = over.identity.or(self.identity.take());
        self.env = over.env.or(self.env.take());
        self.reads = over.reads.or(self.reads.take());
        self.timeout_s = over.timeout_s.or(self.timeout_s.take());
        self.memory_mb = over.memory_mb.or(self.memory_mb.take());
        self.network = over.network.or(self.network);
        self.keep = over.keep.or(self.keep);
    }
}
