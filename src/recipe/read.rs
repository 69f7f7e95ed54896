//! TOML → [`Recipe`]: knows the grammar, not what names mean.

use super::{From, Input, Mistake, Node, Recipe, Said, Variant, With};
use stage::{Value, unknown};
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

pub(super) type Entry<'a, 'i> = (Said<String>, &'a Spanned<DeValue<'i>>);

/// Reads a pipeline. All mistakes of grammar come at once.
pub fn read(text: &str) -> Result<Recipe, Vec<Mistake>> {
    let (root, errors) = DeTable::parse_recoverable(text);
    let mut reader = Reader {
        mistakes: Vec::new(),
    };
    for error in errors {
        let span = error.span().unwrap_or(0..0);
        reader
            .mistakes
            .push(Mistake::at(&span, error.message().to_owned()));
    }
    let recipe = reader.recipe(root.get_ref());
    if reader.mistakes.is_empty() {
        Ok(recipe)
    } else {
        Err(reader.mistakes)
    }
}

/// What has been read so far turned out wrong here and there.
pub(super) struct Reader {
    mistakes: Vec<Mistake>,
}

/// The entries of a table in the order of the file.
pub(super) fn entries<'a, 'i>(table: &'a DeTable<'i>) -> Vec<Entry<'a, 'i>> {
    let said = |key: &Spanned<std::borrow::Cow<'i, str>>| Said {
        value: key.get_ref().to_string(),
        span: key.span(),
    };
    let mut entries: Vec<_> = table.iter().map(|(k, v)| (said(k), v)).collect();
    entries.sort_by_key(|(key, _)| key.span.start);
    entries
}

impl Reader {
    pub(super) fn wrong(&mut self, span: &Range<usize>, what: impl Into<String>) {
        self.mistakes.push(Mistake::at(span, what));
    }

    pub(super) fn unknown_key(&mut self, key: &Said<String>, known: &[&str]) {
        self.wrong(&key.span, unknown("key", &key.value, known));
    }

    pub(super) fn table<'a, 'i>(
        &mut self,
        value: &'a Spanned<DeValue<'i>>,
        what: &str,
    ) -> Vec<Entry<'a, 'i>> {
        match value.get_ref() {
            DeValue::Table(table) => entries(table),
            _ => {
                self.wrong(&value.span(), format!("{what} must be a table"));
                vec![]
            }
        }
    }

    pub(super) fn text(&mut self, value: &Spanned<DeValue<'_>>, what: &str) -> Said<String> {
        let text = match value.get_ref() {
            DeValue::String(text) => text.to_string(),
            _ => {
                self.wrong(&value.span(), format!("{what} must be a text"));
                String::new()
            }
        };
        Said {
            value: text,
            span: value.span(),
        }
    }

    /// A text, or a list of texts.
    pub(super) fn texts(&mut self, value: &Spanned<DeValue<'_>>, what: &str) -> Vec<Said<String>> {
        match value.get_ref() {
            DeValue::Array(list) => list.iter().map(|v| self.text(v, what)).collect(),
            _ => vec![self.text(value, what)],
        }
    }

    pub(super) fn value(&mut self, value: &Spanned<DeValue<'_>>) -> Said<Value> {
        let read = match value.get_ref() {
            DeValue::Boolean(b) => Some(Value::Bool(*b)),
            DeValue::Integer(i) => {
                let digits = i.as_str();
                i64::from_str_radix(digits, i.radix()).ok().map(Value::Int)
            }
            DeValue::Float(x) => x.as_str().parse().ok().map(Value::Float),
            DeValue::String(t) => Some(Value::Text(t.to_string())),
            DeValue::Array(list) => Some(Value::List(
                list.iter().map(|v| self.value(v).value).collect(),
            )),
            DeValue::Datetime(_) | DeValue::Table(_) => None,
        };
        let span = value.span();
        if read.is_none() {
            self.wrong(
                &span,
                "a param must be a boolean, a number, a text or a list of them",
            );
        }
        Said {
            value: read.unwrap_or(Value::Bool(false)),
            span,
        }
    }

    fn recipe(&mut self, root: &DeTable<'_>) -> Recipe {
        let mut recipe = Recipe::default();
        for (key, value) in entries(root) {
            match key.value.as_str() {
                "about" => recipe.about = self.text(value, "`about`").value,
                "goal" => recipe.goal = self.texts(value, "a goal"),
                "input" => {
                    for (name, value) in self.table(value, "`input`") {
                        let input = self.input(name, value);
                        recipe.inputs.push(input);
                    }
                }
                "node" => {
                    for (name, value) in self.table(value, "`node`") {
                        let node = self.node(name, value);
                        recipe.nodes.push(node);
                    }
                }
                "variant" => {
                    for (name, value) in self.table(value, "`variant`") {
                        let variant = self.variant(name, value);
                        recipe.variants.push(variant);
                    }
                }
                "sweep" => {
                    for (name, value) in self.table(value, "`sweep`") {
                        let sweep = self.sweep(name, value);
                        recipe.sweeps.push(sweep);
                    }
                }
                _ => self.unknown_key(
                    &key,
                    &["about", "goal", "input", "node", "variant", "sweep"],
                ),
            }
        }
        recipe
    }

    fn input(&mut self, name: Said<String>, value: &Spanned<DeValue<'_>>) -> Input {
        let mut input = Input {
            name,
            about: String::new(),
            files: vec![],
        };
        for (key, value) in self.table(value, "an input") {
            match key.value.as_str() {
                "about" => input.about = self.text(value, "`about`").value,
                "files" => {
                    input.files = self
                        .texts(value, "a pattern")
                        .into_iter()
                        .map(|s| s.value)
                        .collect();
                }
                _ => self.unknown_key(&key, &["about", "files"]),
            }
        }
        if input.files.is_empty() {
            let what = format!(
                "input `{}` names no files: say `files = \"*.jpg\"`",
                input.name.value
            );
            self.wrong(&input.name.span.clone(), what);
        }
        input
    }

    fn node(&mut self, name: Said<String>, value: &Spanned<DeValue<'_>>) -> Node {
        let mut stage = None;
        let (mut from, mut with) = (From::List(vec![]), With::new());
        for (key, value) in self.table(value, "a node") {
            match key.value.as_str() {
                "stage" => stage = Some(self.text(value, "`stage`")),
                "from" => from = self.from(value),
                "with" => with = self.with(value),
                _ => self.unknown_key(&key, &["stage", "from", "with"]),
            }
        }
        let stage = stage.unwrap_or_else(|| {
            self.wrong(&name.span, format!("node `{}` has no `stage`", name.value));
            Said {
                value: String::new(),
                span: name.span.clone(),
            }
        });
        Node {
            name,
            stage,
            from,
            with,
        }
    }

    fn from(&mut self, value: &Spanned<DeValue<'_>>) -> From {
        match value.get_ref() {
            DeValue::Table(table) => From::Table(
                entries(table)
                    .into_iter()
                    .map(|(k, v)| (k, self.text(v, "a source")))
                    .collect(),
            ),
            _ => From::List(self.texts(value, "a source")),
        }
    }

    fn with(&mut self, value: &Spanned<DeValue<'_>>) -> With {
        let entries = self.table(value, "`with`");
        entries
            .into_iter()
            .map(|(key, value)| (key, self.value(value)))
            .collect()
    }

    fn variant(&mut self, name: Said<String>, value: &Spanned<DeValue<'_>>) -> Variant {
        let mut v = Variant {
            name,
            about: String::new(),
            with: vec![],
            stage: vec![],
            from: vec![],
            without: vec![],
        };
        for (key, value) in self.table(value, "a variant") {
            match key.value.as_str() {
                "about" => v.about = self.text(value, "`about`").value,
                "without" => v.without = self.texts(value, "a node"),
                "with" => {
                    let nodes = self.table(value, "`with` of a variant");
                    v.with = nodes
                        .into_iter()
                        .map(|(node, w)| (node, self.with(w)))
                        .collect();
                }
                "stage" => {
                    let nodes = self.table(value, "`stage` of a variant");
                    v.stage = nodes
                        .into_iter()
                        .map(|(n, s)| (n, self.text(s, "a stage")))
                        .collect();
                }
                "from" => {
                    let nodes = self.table(value, "`from` of a variant");
                    v.from = nodes
                        .into_iter()
                        .map(|(node, f)| (node, self.from(f)))
                        .collect();
                }
                _ => self.unknown_key(&key, &["about", "with", "without", "stage", "from"]),
            }
        }
        v
    }
}
