//! All mistakes of a pipeline file at once, each with its line, column and a caret.

use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};
use serde_json::{Value, json};
use std::fmt;
use std::ops::Range;

/// One mistake.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mistake {
    /// What is wrong, and what would fit.
    pub what: String,
    /// Where in the file. \[bytes\] `None` for the command line.
    pub span: Option<Range<usize>>,
}

impl Mistake {
    /// A mistake at a place of the file.
    pub fn at(span: &Range<usize>, what: impl Into<String>) -> Self {
        Mistake {
            what: what.into(),
            span: Some(span.clone()),
        }
    }

    /// A mistake on the command line.
    pub fn said(what: impl Into<String>) -> Self {
        Mistake {
            what: what.into(),
            span: None,
        }
    }
}

/// All mistakes, in the order of the file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mistakes {
    file: String,
    text: String,
    /// The mistakes.
    pub all: Vec<Mistake>,
}

impl std::error::Error for Mistakes {}

impl Mistakes {
    /// Of a file with this text.
    pub fn new(file: &str, text: &str, mut all: Vec<Mistake>) -> Self {
        all.sort_by_key(|m| m.span.as_ref().map_or(0, |s| s.start));
        all.dedup();
        Mistakes {
            file: file.into(),
            text: text.into(),
            all,
        }
    }

    /// A file that cannot be read.
    pub fn unreadable(file: &str, what: String) -> Self {
        Mistakes::new(file, "", vec![Mistake::said(format!("{file} {what}"))])
    }

    /// Line and column of a byte, from 1.
    fn place(&self, at: usize) -> (usize, usize) {
        let before = &self.text[..self.letter(at)];
        let line = before.matches('\n').count() + 1;
        let start = before.rfind('\n').map_or(0, |i| i + 1);
        (line, before[start..].chars().count() + 1)
    }

    /// A place as whole letters, at least one if there is one.
    fn whole(&self, span: &Range<usize>) -> Range<usize> {
        let start = self.letter(span.start);
        let next = (start + 1).max(span.end).min(self.text.len());
        let end = (next..).find(|at| self.text.is_char_boundary(*at));
        start..end.unwrap_or(next)
    }

    /// Where the letter of a byte begins.
    fn letter(&self, at: usize) -> usize {
        let back = (0..=at.min(self.text.len())).rev();
        let mut begins = back.filter(|at| self.text.is_char_boundary(*at));
        begins.next().unwrap_or(0)
    }

    /// For other programs.
    pub fn json(&self) -> Value {
        let one = |m: &Mistake| {
            let place = m.span.as_ref().map(|s| self.place(s.start));
            json!({
                "file": self.file, "what": m.what,
                "line": place.map(|p| p.0), "column": place.map(|p| p.1),
            })
        };
        json!({ "mistakes": self.all.iter().map(one).collect::<Vec<_>>() })
    }
}

impl fmt::Display for Mistakes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, mistake) in self.all.iter().enumerate() {
            if i > 0 {
                writeln!(f)?;
            }
            let Some(span) = &mistake.span else {
                write!(f, "error: {}", mistake.what)?;
                continue;
            };
            let source = Snippet::source(&self.text)
                .path(&self.file)
                .annotation(AnnotationKind::Primary.span(self.whole(span)));
            let group = Level::ERROR
                .primary_title(mistake.what.as_str())
                .element(source);
            write!(f, "{}", Renderer::plain().render(&[group]))?;
        }
        Ok(())
    }
}
