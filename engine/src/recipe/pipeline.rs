//! A pipeline as it was read: its file, and those that it extends.

use super::bind::{Beside, bind};
use super::checked::Checked;
use super::extend::{extended, trimmed};
use super::mistake::{Mistake, Mistakes, Text, text_of};
use super::origins::{Origins, Place, no_toml};
use super::read::{read_at, without_stage};
use super::shared;
use super::variant::{of_sets, vary};
use super::written::{Overrides, Recipe, Spanned};
use crate::graph::{Graph, Origin};
use programs::Catalog;
use programs::Identities;
use std::borrow::Cow;
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

/// A pipeline with all that it extends, before variants and `--set`s. It is read once: what
/// somebody changes in its files afterwards does not reach it.
pub struct Pipeline {
    recipe: Recipe,
    /// What is wrong in what could be read.
    mistakes: Vec<Mistake>,
    /// Its own text, then those that it extends.
    texts: Vec<Text>,
    catalog: &'static Catalog,
    /// What programs are, read once for all graphs.
    identities: Arc<Identities>,
    /// What is wrong whatever is chosen, looked for once for all graphs.
    checked: OnceLock<Checked>,
}

impl Pipeline {
    /// The pipeline of a file; if there is no such file, the built-in one of that name.
    ///
    /// # Errors
    ///
    /// There is neither, or a text is no TOML. All other mistakes wait for [`Pipeline::graph`].
    pub fn read(path: &Path, catalog: &'static Catalog) -> Result<Pipeline, Mistakes> {
        match (Origins { catalog }).at(path) {
            Ok((place, text)) => Pipeline::gathered(place, text, catalog),
            Err(why) => {
                let name = path.display().to_string();
                Err(Mistakes::unreadable(&name, why))
            }
        }
    }

    /// The built-in pipeline of a name, whatever files there are.
    ///
    /// # Errors
    ///
    /// There is none, or its text is no TOML.
    pub fn built_in(name: &str, catalog: &'static Catalog) -> Result<Pipeline, Mistakes> {
        match (Origins { catalog }).built_in(name) {
            Some((place, text)) => Pipeline::gathered(place, text, catalog),
            None => {
                let why = "is no built-in pipeline".to_owned();
                Err(Mistakes::unreadable(name, why))
            }
        }
    }

    /// The pipeline of a text. `name` is what mistakes call it; files that it extends are looked
    /// for beside it.
    ///
    /// # Errors
    ///
    /// As [`Pipeline::read`].
    pub fn of_text(
        name: &str,
        text: &str,
        catalog: &'static Catalog,
    ) -> Result<Pipeline, Mistakes> {
        let place = Place::File(PathBuf::from(name));
        Pipeline::gathered(place, text.to_owned(), catalog)
    }

    /// The pipeline of texts that [`Pipeline::texts`] gave: what it extends is not looked for anywhere.
    ///
    /// # Errors
    ///
    /// There is no text, or one is no TOML.
    pub fn of_texts(
        texts: Vec<(String, String)>,
        catalog: &'static Catalog,
    ) -> Result<Pipeline, Mistakes> {
        let mut texts = texts.into_iter();
        let Some((name, text)) = texts.next() else {
            return Err(Mistakes::unreadable("a pipeline", "has no text".to_owned()));
        };
        let place = Place::File(PathBuf::from(name));
        Pipeline::gathered_from(place, text, catalog, Some(texts))
    }

    /// Its own text, then those that it extends: name (of a file the whole path) and text.
    pub fn texts(&self) -> Vec<(String, String)> {
        let whole = |name: &str| match Path::new(name).canonicalize() {
            Ok(path) => path.display().to_string(),
            Err(_) => name.to_owned(),
        };
        let one = |text: &Text| (whole(&text.name), text.text.clone());
        self.texts.iter().map(one).collect()
    }

    /// A built-in pipeline as if it extended another built-in one, `under`, instead of its own.
    ///
    /// # Errors
    ///
    /// There is none of a name, or a text is no TOML.
    pub fn built_in_over(
        name: &str,
        under: &str,
        catalog: &'static Catalog,
    ) -> Result<Pipeline, Mistakes> {
        let Some((place, text)) = (Origins { catalog }).built_in(name) else {
            return Pipeline::built_in(name, catalog);
        };
        let line = |line: &str| match line.starts_with("extends = ") {
            true => format!("extends = \"{under}.toml\"\n"),
            false => format!("{line}\n"),
        };
        Pipeline::gathered(place, text.lines().map(line).collect(), catalog)
    }

    fn gathered(
        first: Place,
        text: String,
        catalog: &'static Catalog,
    ) -> Result<Pipeline, Mistakes> {
        Pipeline::gathered_from(first, text, catalog, None)
    }

    /// What it extends is looked for beside it, unless it is `given`.
    fn gathered_from(
        first: Place,
        text: String,
        catalog: &'static Catalog,
        mut given: Option<std::vec::IntoIter<(String, String)>>,
    ) -> Result<Pipeline, Mistakes> {
        let origins = Origins { catalog };
        let mut texts: Vec<Text> = Vec::new();
        let mut layers = Vec::new();
        let mut mistakes = Vec::new();
        let mut next = Some((first, text));
        while let Some((place, text)) = next.take() {
            let text = Text::behind(texts.last(), &place.name(), text);
            let start = text.start;
            let read = read_at(&text.text, start);
            texts.push(text);
            let (recipe, wrong) = match read {
                Ok(read) => read,
                Err(wrong) => return Err(no_toml(layers.last(), texts, wrong)),
            };
            mistakes.extend(wrong);
            if let Some(spanned) = &recipe.extends {
                let found = match &mut given {
                    None => origins.extended(spanned, &place, &texts),
                    Some(given) => given
                        .next()
                        .map(|(name, text)| (Place::File(PathBuf::from(name)), text))
                        .ok_or_else(|| Mistake::at(&spanned.span, "is missing".to_owned())),
                };
                match found {
                    Ok(base) => next = Some(base),
                    Err(mistake) => mistakes.push(mistake),
                }
            }
            layers.push(recipe);
        }
        let mut recipe = layers.pop().unwrap_or_default();
        let extends = !layers.is_empty();
        while let Some(over) = layers.pop() {
            recipe = extended(recipe, over, &mut mistakes);
        }
        mistakes.extend(without_stage(&recipe));
        // Where what it extends was not found, only that is reported.
        if mistakes.is_empty() && extends {
            let end = texts[0].end();
            trimmed(&mut recipe, &|name: &Spanned<String>| name.span.start < end);
        }
        Ok(Pipeline {
            recipe,
            mistakes,
            texts,
            catalog,
            identities: Arc::default(),
            checked: OnceLock::new(),
        })
    }

    /// What is written, with all that it extends.
    pub fn recipe(&self) -> &Recipe {
        &self.recipe
    }

    /// The name of its own file or text.
    pub fn name(&self) -> &str {
        &self.texts[0].name
    }

    /// The folder of the file in which something is written; where it is built in, the current one.
    pub fn folder(&self, spanned: &Spanned<String>) -> PathBuf {
        let file = Path::new(&text_of(&self.texts, &spanned.span).name);
        file.parent().unwrap_or(Path::new(".")).to_owned()
    }

    /// Some mistakes with the texts that they are in.
    pub fn wrong(&self, mistakes: Vec<Mistake>) -> Mistakes {
        Mistakes::of(self.texts.clone(), mistakes)
    }

    /// Bound to the catalog's stages, with variants and `--set`s.
    ///
    /// # Errors
    ///
    /// All mistakes of its files and of the command line at once.
    pub fn graph(&self, overrides: &Overrides) -> Result<Graph, Mistakes> {
        let mut mistakes = self.mistakes.clone();
        // What is missing because of one mistake is not reported as another.
        if self.recipe.extends.is_some() && !mistakes.is_empty() {
            return Err(self.wrong(mistakes));
        }
        let recipe = &self.recipe;
        let checked = self
            .checked
            .get_or_init(|| Checked::of(recipe, self.catalog));
        mistakes.extend_from_slice(&checked.variants);
        let as_it_is = overrides.variant.is_none() && overrides.sets.is_empty();
        let varied = match as_it_is {
            true => Ok(Cow::Borrowed(recipe)),
            false => vary(recipe, overrides).map(Cow::Owned),
        };
        // If the pipeline is wrong in itself, only that is reported.
        let mut varied = match varied {
            Ok(varied) if checked.variants.is_empty() => varied,
            varied => {
                mistakes.extend(varied.err().unwrap_or_default());
                Cow::Borrowed(recipe)
            }
        };
        mistakes.extend_from_slice(&checked.sweeps);
        let strict = overrides.variant.is_none() && mistakes.is_empty();
        let readers: Vec<(String, String)> = shared::references(&varied)
            .map(|(node, name)| (name.to_owned(), node.name.value.clone()))
            .collect();
        if !readers.is_empty() || !recipe.params.is_empty() {
            shared::resolve(varied.to_mut(), strict.then_some(recipe), &mut mistakes);
        }
        let beside = Beside {
            folder: &|spanned| self.folder(spanned),
            identities: self.identities.clone(),
        };
        match bind(&varied, self.catalog, strict, &beside) {
            Ok(mut graph) if mistakes.is_empty() => {
                let there = Path::new(self.name()).canonicalize();
                let there = there.map(|p| p.display().to_string());
                graph.origin = Origin {
                    pipeline: there.unwrap_or_else(|_| self.name().to_owned()),
                    variant: overrides.variant.clone(),
                };
                graph.shared = readers;
                Ok(graph)
            }
            bound => {
                mistakes.extend(bound.err().into_iter().flatten());
                Err(self.wrong(of_sets(mistakes, &overrides.sets)))
            }
        }
    }
}

/// Reads, varies and binds a pipeline: a file, or the name of a built-in one.
///
/// # Errors
///
/// As [`Pipeline::read`] and [`Pipeline::graph`].
pub fn open(
    path: &Path,
    overrides: &Overrides,
    catalog: &'static Catalog,
) -> Result<Graph, Mistakes> {
    Pipeline::read(path, catalog)?.graph(overrides)
}

/// As [`open`], for a text with a name.
///
/// # Errors
///
/// As [`Pipeline::of_text`] and [`Pipeline::graph`].
pub fn open_text(
    name: &str,
    text: &str,
    overrides: &Overrides,
    catalog: &'static Catalog,
) -> Result<Graph, Mistakes> {
    Pipeline::of_text(name, text, catalog)?.graph(overrides)
}
