//! A node that runs a program, bound: its importer, its ports, its command, its files.

use super::binder::{Binder, Known, importer_of};
use super::mistake::Mistake;
use super::written::{From, Node, Spanned};
use crate::graph::{Bound, Source};
use programs::{Granted, Piece, Program, Script, Template};
use stage::{Checked, PortSpec, Value, unknown};
use std::collections::BTreeSet;
use std::path::{Component, Path};
use std::sync::{Arc, Mutex};
use std::time::Duration;
use system::pattern::stays_inside;
use system::plain_file;

/// What a file of a node's may be at most: as much as a result. \[bytes\]
const LARGEST_SCRIPT_BYTES: u64 = 4 << 30;

/// A file that is beside a pipeline; what a link brings there from elsewhere nobody would see who looks at it.
fn script(beside: &Path, path: &Path) -> std::io::Result<Vec<u8>> {
    let outside = || {
        let above = match beside.as_os_str().is_empty() {
            true => Path::new("."),
            false => beside,
        };
        Ok::<bool, std::io::Error>(!path.canonicalize()?.starts_with(above.canonicalize()?))
    };
    if outside()? {
        let why = "is a link out of the pipeline's folder: copy the file there";
        return Err(std::io::Error::other(why));
    }
    plain_file(path, LARGEST_SCRIPT_BYTES)
}

/// How long a program may take if its node gives no limit. \[s\]
const TIMEOUT_S: f64 = 3600.0;

/// Names of ports and params live as long as the process: there are as many as pipelines name.
fn name(text: &str) -> &'static str {
    static NAMES: Mutex<BTreeSet<&'static str>> = Mutex::new(BTreeSet::new());
    let mut names = NAMES.lock().expect("bug: poisoned");
    match names.get(text) {
        Some(known) => known,
        None => {
            let new: &'static str = Box::leak(text.to_owned().into_boxed_str());
            names.insert(new);
            new
        }
    }
}

impl<'a> Binder<'a> {
    pub(super) fn wrong_at(&mut self, spanned: &Spanned<String>, what: impl Into<stage::Message>) {
        self.mistakes.push(Mistake::at(&spanned.span, what));
    }

    /// The importer as the node's stage.
    pub(super) fn importer(&mut self, node: &'a Node) -> Option<Known> {
        let importers = self.catalog.importers.iter();
        let known: Vec<&str> = importers.map(|i| i.stage.yields()).collect();
        let name = &node.name;
        match (&node.exec.out, importer_of(node, self.catalog)) {
            (_, Some(importer)) => Some(Known {
                stage: importer,
                ports: Arc::default(),
                sections: Arc::default(),
                program: true,
            }),
            (Some(out), None) => {
                let what = unknown("kind that a program can make", &out.value, &known);
                self.wrong_at(out, what);
                None
            }
            (None, None) => {
                let what = format!(
                    "node `{}` does not name what it makes: `out = \"KIND\"`, of {}",
                    name.value,
                    known.join(", ")
                );
                self.wrong_at(name, what);
                None
            }
        }
    }

    /// The node with its program.
    pub(super) fn program(
        &mut self,
        node: &'a Node,
        known: &Known,
        stages: &[Option<Known>],
    ) -> Option<Bound> {
        let before = self.mistakes.len();
        let importer = importer_of(node, self.catalog)?;
        let (ports, from) = self.read_by(node, stages);
        let command = self.words(node, node.exec.command.as_deref());
        if command.is_empty() {
            let what = format!(
                "node `{}` runs nothing: give `command = [\"python3\", \"{{here}}/a.py\", \"{{out}}\"]`",
                node.name.value
            );
            self.wrong_at(&node.name, what);
            return None;
        }
        let identity = self.words(node, node.exec.identity.as_deref());
        let spanned = node.exec.command.as_deref().unwrap_or_default();
        self.placed(node, spanned, &command, &ports);
        self.started(spanned, &command);
        let printed = node.exec.identity.as_deref().unwrap_or_default();
        self.started(printed, &identity);
        self.plain(printed, &identity);
        let own = |word: &Template| word.pieces.iter().all(|p| matches!(p, Piece::Text(_)));
        if node.exec.keep == Some(true) && !own(&command[0]) {
            let what = "a program that is kept is one that is installed: name it without braces";
            self.wrong_at(&spanned[0], what);
        }
        self.unread(node, importer, &command, &ports);
        let files = self.files(node);
        let env = self.variables(node);
        let reads = self.reads(node);
        if self.mistakes.len() > before || from.iter().any(Option::is_none) {
            return None;
        }
        let entry = |(k, v): &(Spanned<String>, Spanned<Value>)| (k.value.clone(), v.value.clone());
        let mut with: Vec<(String, Value)> = node.with.iter().map(entry).collect();
        with.sort_by(|a, b| a.0.cmp(&b.0));
        let values = with.iter().map(|(k, v)| (name(k), v.clone())).collect();
        let seconds = node.exec.timeout_s.as_ref().map_or(TIMEOUT_S, |s| s.value);
        let program = Arc::new(Program {
            catalog: self.catalog,
            importer,
            command,
            ports: ports.iter().map(|p| (p.name, p.kind)).collect(),
            with,
            files,
            identity,
            env,
            reads,
            timeout: Duration::from_secs_f64(seconds),
            memory_mb: node.exec.memory_mb.as_ref().map(|m| m.value.ceil() as u64),
            network: node.exec.network.unwrap_or(false),
            keep: node.exec.keep.unwrap_or(false),
            identities: self.beside.identities.clone(),
            granted: Granted::default(),
        });
        Some(Bound {
            name: node.name.value.clone(),
            stage: known.stage,
            ports: ports.into(),
            params: Checked::of(values, Arc::new(program.clone())),
            from,
            program: Some(program),
        })
    }

    /// The node's ports, called as the node calls them and sorted, and what they read.
    fn read_by(
        &mut self,
        node: &'a Node,
        stages: &[Option<Known>],
    ) -> (Vec<PortSpec>, Vec<Option<Source>>) {
        let mut pairs: Vec<(&Spanned<String>, &str, &Spanned<String>)> = match &node.from {
            From::Table(table) => {
                let pairs = table.iter();
                pairs
                    .map(|(port, source)| (port, port.value.as_str(), source))
                    .collect()
            }
            From::List(list) => {
                let own = |s: &'a Spanned<String>| (s, s.value.trim_start_matches('@'), s);
                list.iter().map(own).collect()
            }
        };
        pairs.sort_by_key(|(_, port, _)| *port);
        let (mut ports, mut from) = (Vec::<PortSpec>::new(), Vec::new());
        for (spanned, port, source) in pairs {
            let plain = |b: u8| b.is_ascii_alphanumeric() || b == b'_' || b == b'-';
            if port.is_empty() || !port.bytes().all(plain) {
                let what = format!("`{port}` is no name: use letters, digits, `_` and `-`");
                self.wrong_at(spanned, what);
            }
            if ports.iter().any(|p| p.name == port) {
                self.wrong_at(spanned, format!("`{port}` is read twice"));
                continue;
            }
            let at = self.source(source);
            let kind = at.and_then(|at| self.kind(at, stages));
            ports.push(PortSpec {
                name: name(port),
                kind: kind.unwrap_or("nothing"),
                optional: false,
                doc: String::new(),
            });
            from.push(at.filter(|_| kind.is_some()));
        }
        (ports, from)
    }

    fn words(&mut self, _: &Node, spanned: Option<&[Spanned<String>]>) -> Vec<Template> {
        let mut words = Vec::new();
        for word in spanned.unwrap_or_default() {
            match Template::read(&word.value) {
                Ok(template) => words.push(template),
                Err(why) => self.wrong_at(word, why.to_string()),
            }
        }
        words
    }

    /// The node's own files, by their content.
    fn files(&mut self, node: &Node) -> Vec<Script> {
        let mut files = Vec::<Script>::new();
        for spanned in node.exec.files.iter().flatten() {
            let odd =
                spanned.value.contains(['*', '{']) || spanned.value.contains(char::is_control);
            if !stays_inside(&spanned.value) || spanned.value.is_empty() || odd {
                let what = "a file is named by its path from the pipeline: no `..`, no `/` in front, no pattern";
                self.wrong_at(spanned, what);
                continue;
            }
            let path = (self.beside.folder)(spanned).join(&spanned.value);
            match script(&(self.beside.folder)(spanned), &path) {
                Ok(bytes) => files.push(Script {
                    name: spanned.value.clone(),
                    path,
                    content: stage::hash(&bytes),
                }),
                Err(why) => self.wrong_at(spanned, format!("{}: {why}", path.display())),
            }
        }
        files.sort_by(|a, b| a.name.cmp(&b.name));
        files.dedup_by(|a, b| a.name == b.name);
        files
    }

    /// Files and folders by their whole paths.
    fn reads(&mut self, node: &Node) -> Vec<String> {
        let mut paths = Vec::new();
        for spanned in node.exec.reads.iter().flatten() {
            let path = Path::new(&spanned.value);
            let up = path.components().any(|part| part == Component::ParentDir);
            let odd = spanned.value.contains(char::is_control);
            match path.is_absolute() && !up && !odd && path.parent().is_some() {
                true => paths.push(spanned.value.clone()),
                false => self.wrong_at(
                    spanned,
                    "what is read besides is named by its whole path, without `..`",
                ),
            }
        }
        paths.sort_unstable();
        paths.dedup();
        paths
    }

    fn variables(&mut self, node: &Node) -> Vec<String> {
        let mut names = Vec::new();
        for spanned in node.exec.env.iter().flatten() {
            let plain = |b: u8| b.is_ascii_alphanumeric() || b == b'_';
            match !spanned.value.is_empty() && spanned.value.bytes().all(plain) {
                true => names.push(spanned.value.clone()),
                false => self.wrong_at(spanned, "a variable is called by letters, digits and `_`; its value comes from the environment"),
            }
        }
        names.sort_unstable();
        names.dedup();
        names
    }
}
