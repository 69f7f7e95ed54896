//! Where the texts of pipelines come from: files, and what the program brings along.

use super::mistake::{Mistake, Mistakes, Text};
use super::written::{Recipe, Spanned};
use programs::Catalog;
use std::path::{Path, PathBuf};
use system::{bounded, plain_file};

/// Where a text comes from.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Place {
    File(PathBuf),
    BuiltIn(&'static str),
}

impl Place {
    pub(super) fn name(&self) -> String {
        match self {
            Place::File(path) => path.display().to_string(),
            Place::BuiltIn(name) => format!("built-in {name}.toml"),
        }
    }
}

/// What a text may be at most: a million nodes of 256 bytes. \[bytes\]
const LARGEST_PIPELINE_BYTES: u64 = 256 << 20;

/// Where texts are looked for.
pub(super) struct Origins {
    pub(super) catalog: &'static Catalog,
}

impl Origins {
    /// The file at a path, else the built-in pipeline that is called like it. Else why not. A pipe is read,
    /// since the user names it.
    pub(super) fn at(&self, path: &Path) -> Result<(Place, String), String> {
        let built_in = path.to_str().and_then(|name| self.built_in(name));
        match built_in.filter(|_| !path.is_file()) {
            Some(found) => Ok(found),
            None => {
                let file = std::fs::File::open(path);
                self.text(path, file.and_then(|f| bounded(f, LARGEST_PIPELINE_BYTES)))
            }
        }
    }

    fn text(&self, path: &Path, read: std::io::Result<Vec<u8>>) -> Result<(Place, String), String> {
        let bytes = read.map_err(|why| self.unreadable(&why))?;
        let text = String::from_utf8(bytes);
        let text = text.map_err(|_| self.unreadable(&std::io::Error::other("it is no UTF-8")))?;
        Ok((Place::File(path.to_owned()), text))
    }

    pub(super) fn built_in(&self, name: &str) -> Option<(Place, String)> {
        let (name, text) = self.catalog.pipeline(name)?;
        Some((Place::BuiltIn(name), text.to_owned()))
    }

    fn unreadable(&self, error: &std::io::Error) -> String {
        let names: Vec<&str> = self
            .catalog
            .pipelines
            .iter()
            .map(|(name, _)| *name)
            .collect();
        match names.is_empty() {
            true => format!("cannot be read: {error}"),
            false => format!(
                "cannot be read: {error}; built-in pipelines are {}",
                names.join(", ")
            ),
        }
    }

    /// What a text extends: a plain file beside it, else a built-in pipeline.
    pub(super) fn extended(
        &self,
        spanned: &Spanned<String>,
        by: &Place,
        texts: &[Text],
    ) -> Result<(Place, String), Mistake> {
        let found = match by {
            Place::File(path) => {
                let beside = path.parent().unwrap_or(Path::new("")).join(&spanned.value);
                let built_in = self.built_in(&spanned.value);
                let read = || self.text(&beside, plain_file(&beside, LARGEST_PIPELINE_BYTES));
                built_in.filter(|_| !beside.is_file()).map_or_else(read, Ok)
            }
            Place::BuiltIn(_) => self
                .built_in(&spanned.value)
                .ok_or_else(|| "is no built-in pipeline".to_owned()),
        };
        let (place, text) = found
            .map_err(|why| Mistake::at(&spanned.span, format!("`{}` {why}", spanned.value)))?;
        if texts.iter().any(|t| t.name == place.name()) {
            let what = format!("`{}` extends this pipeline in turn", spanned.value);
            return Err(Mistake::at(&spanned.span, what));
        }
        Ok((place, text))
    }
}

/// What is wrong where the last text is no TOML. If another one extends it, that one shows the place alone: the file may
/// be none of a pipeline, and nothing of it is quoted.
pub(super) fn no_toml(by: Option<&Recipe>, texts: Vec<Text>, wrong: Vec<Mistake>) -> Mistakes {
    let Some(by) = by.and_then(|by| by.extends.as_ref()) else {
        return Mistakes::of(texts, wrong);
    };
    let (last, first) = (texts.last(), wrong.first());
    let place = last.zip(first).and_then(|(text, first)| {
        let (line, column) = text.line_and_column(first.span.as_ref()?.start);
        Some(format!(": line {line}, column {column}: {}", first.what))
    });
    let what = format!("`{}` is no TOML{}", by.value, place.unwrap_or_default());
    let mistake = Mistake::at(&by.span, what);
    Mistakes::of(texts, vec![mistake])
}
