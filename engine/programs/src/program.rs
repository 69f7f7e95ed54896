//! A node's program: what its key holds, and what the user allows.

use crate::error::ForeignError;
use crate::identity::Identities;
use crate::installed::is_system;
use crate::reads;
use crate::template::{Piece, Template};
use crate::{Catalog, Importer};
use stage::{Hash, Value};
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};
use std::time::Duration;
use system::plain_file;

/// A file that belongs to a program: it is laid out in `{here}`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Script {
    /// Its name beside the pipeline.
    pub name: String,
    /// Where it is; no part of any key.
    pub path: PathBuf,
    /// The hash of its bytes.
    pub content: Hash,
}

/// A program that was allowed.
#[derive(Debug, Clone)]
pub(crate) struct Grant {
    /// The folder in which its own folder is made.
    pub(crate) folder: PathBuf,
    /// What its identity prints, or why that is not known; none where it has none.
    pub(crate) identity: Option<Result<String, String>>,
    /// The content of what it reads beside, in the order of `reads`, or why that is not known.
    pub(crate) reads: Vec<Result<String, String>>,
    /// What shows that some of it was changed.
    pub(crate) stamps: Vec<Option<Hash>>,
}

impl Grant {
    /// Whether what it reads beside is what it was when the run began.
    pub(crate) fn same_reads(&self, paths: &[String]) -> Result<(), ForeignError> {
        for (path, before) in paths.iter().zip(&self.stamps) {
            let now =
                reads::stamps(path).map_err(|why| ForeignError::Reads(format!("{path}: {why}")))?;
            if *before != Some(now) {
                let why = format!("{path} changed while the run was using it; run again");
                return Err(ForeignError::Reads(why));
            }
        }
        Ok(())
    }
}

/// Whether a program may run: not, until it is settled.
#[derive(Default)]
pub struct Granted(pub(crate) OnceLock<Grant>);

/// A node's program.
pub struct Program {
    /// The kinds that flow.
    pub catalog: &'static Catalog,
    /// How its result is read.
    pub importer: &'static Importer,
    /// The command.
    pub command: Vec<Template>,
    /// Name and kind of what is read, in the order of the node's ports.
    pub ports: Vec<(&'static str, &'static str)>,
    /// Its params.
    pub with: Vec<(String, Value)>,
    /// Files of its own.
    pub files: Vec<Script>,
    /// A command that prints what it is.
    pub identity: Vec<Template>,
    /// Variables of the environment that it gets.
    pub env: Vec<String>,
    /// Files and folders that it reads beside what it is given: whole paths.
    pub reads: Vec<String>,
    /// How long it may take.
    pub timeout: Duration,
    /// What it may hold with its children. \[MB\]
    pub memory_mb: Option<u64>,
    /// Whether it may reach the network.
    pub network: bool,
    /// Whether it stays for further jobs; see `kept.rs`.
    pub keep: bool,
    /// Identities that this pipeline has read.
    pub identities: Arc<Identities>,
    /// Whether it may run.
    pub granted: Granted,
}

/// An identity that is not known, in a line of a key.
const UNKNOWN: &str = "unknown until allowed (--allow-exec)";

impl Program {
    /// What its key holds beside the node's params and the content of what it reads.
    pub fn lines(&self) -> Vec<(String, String)> {
        let words = |words: &[Template]| {
            let words = words.iter().map(|w| Value::Text(w.written.clone()));
            Value::List(words.collect()).to_string()
        };
        let mut lines = vec![("command".to_owned(), words(&self.command))];
        for (port, kind) in &self.ports {
            let version = self.catalog.importer(kind).map_or(0, |i| i.layout);
            lines.push((format!("laid out {port}"), format!("{kind} v{version}")));
        }
        let reader = self.importer.stage;
        let read = format!("{} v{}", reader.name(), reader.version());
        lines.push(("read by".to_owned(), read));
        for file in &self.files {
            let content = file.content.to_hex().to_string();
            lines.push((format!("file {}", file.name), content));
        }
        if !self.env.is_empty() {
            lines.push(("environment".to_owned(), self.env.join(" ")));
        }
        for (i, path) in self.reads.iter().enumerate() {
            let content = match self.granted.0.get().and_then(|grant| grant.reads.get(i)) {
                Some(Ok(content)) => content.clone(),
                Some(Err(why)) => format!("unknown: {why}"),
                None => UNKNOWN.to_owned(),
            };
            lines.push((format!("reads {path}"), content));
        }
        if self.network {
            lines.push(("network".to_owned(), "may be reached".to_owned()));
        }
        if !self.identity.is_empty() {
            let printed = match self.granted.0.get().and_then(|g| g.identity.as_ref()) {
                Some(Ok(printed)) => format!("{printed:?}"),
                Some(Err(why)) => format!("unknown: {why}"),
                None => UNKNOWN.to_owned(),
            };
            lines.push(("identity".to_owned(), printed));
        }
        lines
    }

    /// What the user allows: command, identity, files, variables of the environment, what it reads, network,
    /// whether it stays, params in the command that are more than a number, and the content
    /// of a program that is named by its place and is none of the system's.
    pub fn permission(&self) -> Hash {
        let mut hasher = blake3::Hasher::new();
        let mut put = |text: &str| {
            hasher.update(&(text.len() as u64).to_le_bytes());
            hasher.update(text.as_bytes());
        };
        put("a program that may run 2");
        for words in [&self.command, &self.identity] {
            put(&words.len().to_string());
            words.iter().for_each(|word| put(&word.written));
        }
        put(&self.files.len().to_string());
        for file in &self.files {
            put(&file.name);
            put(&file.content.to_hex());
        }
        put(&self.env.join("\n"));
        put(&self.reads.join("\n"));
        put(if self.network { "network" } else { "" });
        put(if self.keep { "keep" } else { "" });
        for words in [&self.command, &self.identity] {
            put(&words.first().map_or(String::new(), own));
        }
        for (name, value) in self.texts() {
            put(name);
            put(&value.to_string());
        }
        hasher.finalize()
    }

    /// Params in the command that are no plain number and no switch: they may have any text.
    pub fn texts(&self) -> impl Iterator<Item = (&String, &Value)> {
        let plain = |v: &Value| matches!(v, Value::Bool(_) | Value::Int(_) | Value::Float(_));
        let pairs = self.with.iter().filter(move |(_, v)| !plain(v));
        pairs.map(|(name, value)| (name, value))
    }

    /// A param as it is written into a command: texts without quotes, lists and tables as JSON.
    pub(crate) fn output(&self, name: &str) -> String {
        let value = self.with.iter().find(|(n, _)| n == name);
        match value.map(|(_, value)| value) {
            Some(Value::Text(text)) => text.clone(),
            Some(value @ (Value::List(_) | Value::Table(_))) => json(value).to_string(),
            Some(value) => value.to_string(),
            None => String::new(),
        }
    }

    /// What it is called in messages.
    pub fn name(&self) -> String {
        let first = self.command.first().map_or("", |word| &word.written);
        let script = self
            .command
            .iter()
            .skip(1)
            .find(|w| w.pieces.contains(&Piece::Here));
        let script = script.and_then(|w| w.written.strip_prefix("{here}/"));
        script.unwrap_or(first).to_owned()
    }
}

/// What a program may be at most whose content is in a permission: as much as a result. \[bytes\]
const LARGEST_PROGRAM_BYTES: u64 = 4 << 30;

/// The content of a program that is named by its place, if it is none of the system's.
fn own(word: &Template) -> String {
    let path = Path::new(&word.written);
    let bytes = match path.is_absolute() && !is_system(path) {
        true => plain_file(path, LARGEST_PROGRAM_BYTES).ok(),
        false => None,
    };
    bytes.map_or(String::new(), |bytes| {
        stage::hash(&bytes).to_hex().to_string()
    })
}

fn json(value: &Value) -> serde_json::Value {
    match value {
        Value::Bool(b) => (*b).into(),
        Value::Int(i) => (*i).into(),
        Value::Float(x) => (*x).into(),
        Value::Text(t) => t.clone().into(),
        Value::List(l) => l.iter().map(json).collect(),
        Value::Table(t) => t.iter().map(|(k, v)| (k.clone(), json(v))).collect(),
    }
}
