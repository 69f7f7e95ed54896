//! TOML → [`Recipe`]: knows the grammar, not what names mean.

use super::mistake::Mistake;
use super::toml_text::tree;
use super::tree::{Item, Key, Spot, Table, moved};
use super::written::{Exec, From, Input, KEYS, NODE, Node, Recipe, Section, Spanned, With};
use stage::{Value, unknown};
use std::ops::Range;

/// Reads a pipeline, and not what it extends.
///
/// # Errors
///
/// All mistakes of grammar at once.
pub fn read(text: &str) -> Result<Recipe, Vec<Mistake>> {
    let (recipe, mut mistakes) = read_at(text, 0)?;
    if recipe.extends.is_none() {
        mistakes.extend(without_stage(&recipe));
    }
    match mistakes.is_empty() {
        true => Ok(recipe),
        false => Err(mistakes),
    }
}

/// Nodes that have no stage, and get none from a pipeline that is extended.
pub(super) fn without_stage(recipe: &Recipe) -> impl Iterator<Item = Mistake> {
    let bare = recipe.nodes.iter().filter(|n| n.stage.value.is_empty());
    bare.map(|Node { name, .. }| {
        Mistake::at(&name.span, format!("node `{}` has no `stage`", name.value))
    })
}

/// What can be read of a pipeline whose text comes after `start` bytes of other texts, and what is
/// wrong with the rest; nothing of what is no TOML.
pub(super) fn read_at(text: &str, start: usize) -> Result<(Recipe, Vec<Mistake>), Vec<Mistake>> {
    let (mut root, mut mistakes) = tree(text);
    let whole = mistakes.is_empty();
    if start > 0 {
        moved(&mut root, start);
        mistakes.iter_mut().for_each(|m| m.moved(start));
    }
    let mut reader = Reader { mistakes };
    let recipe = reader.recipe(&root);
    match whole {
        true => Ok((recipe, reader.mistakes)),
        false => Err(reader.mistakes),
    }
}

/// What has been read so far turned out wrong here and there.
pub(super) struct Reader {
    mistakes: Vec<Mistake>,
}

impl Key<'_> {
    /// As it is kept.
    pub(super) fn spanned(&self) -> Spanned<String> {
        Spanned {
            value: self.name.clone().into_owned(),
            span: self.span.clone(),
        }
    }
}

impl Reader {
    pub(super) fn wrong(&mut self, span: &Range<usize>, what: impl Into<stage::Message>) {
        self.mistakes.push(Mistake::at(span, what));
    }

    pub(super) fn unknown_key(&mut self, key: &Key<'_>, known: &[&str]) {
        self.wrong(&key.span, unknown("key", &key.name, known));
    }

    /// Names become those of files, and are parts of commands.
    fn name(&mut self, key: &Key<'_>) {
        let plain = |b: u8| b.is_ascii_alphanumeric() || b == b'_' || b == b'-';
        if key.name.is_empty() || !key.name.bytes().all(plain) {
            let what = format!(
                "`{}` is no name: use letters, digits, `_` and `-`",
                key.name
            );
            self.wrong(&key.span, what);
        }
    }

    pub(super) fn table<'a, 't>(&mut self, value: &'a Spot<'t>, what: &str) -> &'a Table<'t> {
        match &value.item {
            Item::Table(table) => table,
            _ => {
                self.wrong(&value.span, format!("{what} must be a table"));
                const { &Vec::new() }
            }
        }
    }

    pub(super) fn text(&mut self, value: &Spot<'_>, what: &str) -> Spanned<String> {
        let text = match &value.item {
            Item::Text(text) => text.clone().into_owned(),
            _ => {
                self.wrong(&value.span, format!("{what} must be a text"));
                String::new()
            }
        };
        Spanned {
            value: text,
            span: value.span.clone(),
        }
    }

    /// A text, or a list of texts.
    pub(super) fn texts(&mut self, value: &Spot<'_>, what: &str) -> Vec<Spanned<String>> {
        match &value.item {
            Item::List(list) => list.iter().map(|v| self.text(v, what)).collect(),
            _ => vec![self.text(value, what)],
        }
    }

    pub(super) fn value(&mut self, value: &Spot<'_>) -> Spanned<Value> {
        let read = match &value.item {
            Item::Bool(b) => Some(Value::Bool(*b)),
            Item::Int(i) => Some(Value::Int(*i)),
            Item::Float(x) => Some(Value::Float(*x)),
            Item::Text(t) => Some(Value::Text(t.clone().into_owned())),
            Item::List(list) => Some(Value::List(
                list.iter().map(|v| self.value(v).value).collect(),
            )),
            Item::Table(table) => {
                let entry = |(k, v): &(Key<'_>, _)| (k.spanned().value, self.value(v).value);
                Some(Value::Table(table.iter().map(entry).collect()))
            }
            Item::Other => None,
        };
        let span = value.span.clone();
        if read.is_none() {
            self.wrong(
                &span,
                "a param must be a boolean, a number, a text, or a list or table of them",
            );
        }
        Spanned {
            value: read.unwrap_or(Value::Bool(false)),
            span,
        }
    }

    fn recipe(&mut self, root: &Table<'_>) -> Recipe {
        let mut recipe = Recipe::default();
        for (key, value) in root {
            match &*key.name {
                "about" => recipe.about = self.text(value, "`about`").value,
                "goal" => recipe.goal = self.texts(value, "a goal"),
                "extends" => recipe.extends = Some(self.text(value, "`extends`")),
                "without" => recipe.without = self.texts(value, "a node"),
                "params" => recipe.params = self.with_of(value, "`params`"),
                "input" => {
                    for (name, value) in self.table(value, "`input`") {
                        self.name(name);
                        let input = self.input(name.spanned(), value);
                        recipe.inputs.push(input);
                    }
                }
                "node" => {
                    for (name, value) in self.table(value, "`node`") {
                        self.name(name);
                        let node = self.node(name.spanned(), value);
                        recipe.nodes.push(node);
                    }
                }
                "variant" => {
                    for (name, value) in self.table(value, "`variant`") {
                        self.name(name);
                        let variant = self.variant(name.spanned(), value);
                        recipe.variants.push(variant);
                    }
                }
                "sweep" => {
                    for (name, value) in self.table(value, "`sweep`") {
                        self.name(name);
                        let sweep = self.sweep(name.spanned(), value);
                        recipe.sweeps.push(sweep);
                    }
                }
                "search" => {
                    for (name, value) in self.table(value, "`search`") {
                        self.name(name);
                        let search = self.search(name.spanned(), value);
                        recipe.searches.extend(search);
                    }
                }
                // A stage may take it as a section; whether one does, binding finds.
                _ if matches!(value.item, Item::Table(_)) => {
                    for (name, value) in self.table(value, "a section") {
                        self.name(name);
                        let section = Section {
                            kind: key.spanned(),
                            name: name.spanned(),
                            keys: self.with_of(value, "an entry of a section"),
                        };
                        recipe.sections.push(section);
                    }
                }
                _ => self.unknown_key(key, &KEYS),
            }
        }
        recipe
    }

    fn input(&mut self, name: Spanned<String>, value: &Spot<'_>) -> Input {
        let mut input = Input {
            name,
            about: String::new(),
            files: vec![],
        };
        for (key, value) in self.table(value, "an input") {
            match &*key.name {
                "about" => input.about = self.text(value, "`about`").value,
                "files" => {
                    for Spanned { value, span } in self.texts(value, "a pattern") {
                        if !system::pattern::stays_inside(&value) {
                            let what = "a pattern stays in the input's folder: no `..`, and no `/` in front";
                            self.wrong(&span, what);
                        }
                        input.files.push(value);
                    }
                }
                _ => self.unknown_key(key, &["about", "files"]),
            }
        }
        if input.files.is_empty() {
            let what = format!(
                "input `{}` names no files: write `files = \"*.jpg\"`",
                input.name.value
            );
            self.wrong(&input.name.span.clone(), what);
        }
        input
    }

    fn node(&mut self, name: Spanned<String>, value: &Spot<'_>) -> Node {
        let mut stage = None;
        let (mut from, mut with) = (From::List(vec![]), With::new());
        let mut exec = Exec::default();
        for (key, value) in self.table(value, "a node") {
            match &*key.name {
                "stage" => stage = Some(self.text(value, "`stage`")),
                "from" => from = self.from(value),
                "with" => with = self.with(value),
                _ if self.exec(&mut exec, key, value) => {}
                _ => self.unknown_key(key, &NODE),
            }
        }
        let stage = stage.unwrap_or_else(|| Spanned {
            value: String::new(),
            span: name.span.clone(),
        });
        Node {
            name,
            stage,
            from,
            with,
            exec,
        }
    }

    pub(super) fn from(&mut self, value: &Spot<'_>) -> From {
        match &value.item {
            Item::Table(table) => {
                let wire = |(k, v): &(Key<'_>, _)| (k.spanned(), self.text(v, "a source"));
                From::Table(table.iter().map(wire).collect())
            }
            _ => From::List(self.texts(value, "a source")),
        }
    }

    pub(super) fn with(&mut self, value: &Spot<'_>) -> With {
        self.with_of(value, "`with`")
    }

    fn with_of(&mut self, value: &Spot<'_>, what: &str) -> With {
        let entries = self.table(value, what).iter();
        entries.map(|(k, v)| (k.spanned(), self.value(v))).collect()
    }
}
