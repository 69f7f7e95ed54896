//! All mistakes of a pipeline file at once, each with its line, column and a caret.

use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};
use serde_json::{Value, json};
use stage::Message;
use std::fmt;
use std::ops::Range;

/// One mistake.
#[derive(Debug, Clone, PartialEq)]
pub struct Mistake {
    /// What is wrong, and what would fit.
    pub what: Message,
    /// Where in the texts. \[bytes\] `None` for the command line.
    pub span: Option<Range<usize>>,
}

impl Mistake {
    /// A mistake at a place of the file.
    pub fn at(span: &Range<usize>, what: impl Into<Message>) -> Self {
        Mistake {
            what: what.into(),
            span: Some(span.clone()),
        }
    }

    /// Its place behind so many bytes of other texts.
    pub(super) fn moved(&mut self, by: usize) {
        if let Some(span) = &mut self.span {
            *span = span.start + by..span.end + by;
        }
    }

    /// A mistake on the command line.
    pub fn spanned(what: impl Into<Message>) -> Self {
        Mistake {
            what: what.into(),
            span: None,
        }
    }
}

/// The text of a pipeline file, behind those that were read before it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Text {
    /// What it is called.
    pub name: String,
    /// How many bytes of other texts come before it.
    pub start: usize,
    /// The text.
    pub text: String,
}

impl Text {
    /// Behind the last one.
    pub(super) fn behind(last: Option<&Text>, name: &str, text: String) -> Text {
        Text {
            name: name.to_owned(),
            start: last.map_or(0, Text::end),
            text,
        }
    }

    /// Where the next one starts.
    pub(super) fn end(&self) -> usize {
        self.start + self.text.len() + 1
    }

    /// Where each line begins. \[bytes\]
    fn lines(&self) -> Vec<usize> {
        let ends = self.text.match_indices('\n').map(|(end, _)| end + 1);
        std::iter::once(0).chain(ends).collect()
    }

    /// Line and column of a byte, from 1; `lines` as [`Text::lines`] gives them.
    fn place(&self, at: usize, lines: &[usize]) -> (usize, usize) {
        let at = self.letter(at);
        let line = lines.partition_point(|start| *start <= at);
        let before = &self.text[lines[line - 1]..at];
        (line, before.chars().count() + 1)
    }

    /// Line and column of a byte, from 1.
    pub(super) fn line_and_column(&self, at: usize) -> (usize, usize) {
        self.place(at, &self.lines())
    }

    /// The lines of a span alone, with the number of the first, and the span in them: what is shown of many mistakes
    /// takes as long as there are mistakes, and not as long as the text is for each.
    fn around(&self, span: &Range<usize>, lines: &[usize]) -> (&str, usize, Range<usize>) {
        let line = lines.partition_point(|start| *start <= span.start);
        let start = lines[line - 1];
        let after = lines.partition_point(|start| *start < span.end).max(line);
        let end = lines.get(after).copied().unwrap_or(self.text.len());
        (
            &self.text[start..end],
            line,
            span.start - start..span.end - start,
        )
    }

    /// A place as whole letters of this text, at least one if there is one.
    fn whole(&self, span: &Range<usize>) -> Range<usize> {
        let start = self.letter(span.start);
        let end = span.end.saturating_sub(self.start);
        let next = (start + 1).max(end).min(self.text.len());
        let end = (next..).find(|at| self.text.is_char_boundary(*at));
        start..end.unwrap_or(next)
    }

    /// Where in this text the letter of a byte begins.
    fn letter(&self, at: usize) -> usize {
        let at = at.saturating_sub(self.start);
        let back = (0..=at.min(self.text.len())).rev();
        let mut begins = back.filter(|at| self.text.is_char_boundary(*at));
        begins.next().unwrap_or(0)
    }
}

/// The text that a place is in.
pub(super) fn text_of<'a>(texts: &'a [Text], span: &Range<usize>) -> &'a Text {
    &texts[at_text(texts, span)]
}

/// The place of the text that a place is in.
fn at_text(texts: &[Text], span: &Range<usize>) -> usize {
    let found = texts.iter().position(|t| span.start < t.end());
    found.unwrap_or_else(|| texts.len().checked_sub(1).expect("bug: a place in no text"))
}

/// All mistakes, in the order of the files.
#[derive(Debug, Clone, PartialEq)]
pub struct Mistakes {
    texts: Vec<Text>,
    /// The mistakes.
    pub all: Vec<Mistake>,
}

impl std::error::Error for Mistakes {}

impl Mistakes {
    /// Of a file with this text.
    pub fn new(file: &str, text: &str, all: Vec<Mistake>) -> Self {
        Mistakes::of(vec![Text::behind(None, file, text.to_owned())], all)
    }

    /// Of several texts, each behind the one before.
    pub(super) fn of(texts: Vec<Text>, mut all: Vec<Mistake>) -> Self {
        all.sort_by_key(|m| m.span.as_ref().map_or(0, |s| s.start));
        all.dedup();
        Mistakes { texts, all }
    }

    /// A file that cannot be read.
    pub fn unreadable(file: &str, what: String) -> Self {
        Mistakes::new(file, "", vec![Mistake::spanned(format!("{file} {what}"))])
    }

    /// The same, each read by this.
    #[must_use]
    pub fn in_words(mut self, read: impl Fn(&Message) -> String) -> Mistakes {
        for mistake in &mut self.all {
            mistake.what = read(&mistake.what).into();
        }
        self
    }

    /// For other programs.
    pub fn json(&self) -> Value {
        let lines: Vec<Vec<usize>> = self.texts.iter().map(Text::lines).collect();
        let one = |m: &Mistake| {
            let at = m.span.as_ref().map_or(0, |s| at_text(&self.texts, s));
            let text = &self.texts[at];
            let place = m.span.as_ref().map(|s| text.place(s.start, &lines[at]));
            json!({
                "file": text.name, "what": m.what.as_str(),
                "line": place.map(|p| p.0), "column": place.map(|p| p.1),
            })
        };
        json!({ "mistakes": self.all.iter().map(one).collect::<Vec<_>>() })
    }
}

impl fmt::Display for Mistakes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let lines: Vec<Vec<usize>> = self.texts.iter().map(Text::lines).collect();
        for (i, mistake) in self.all.iter().enumerate() {
            if i > 0 {
                writeln!(f)?;
            }
            let Some(span) = &mistake.span else {
                write!(f, "error: {}", mistake.what)?;
                continue;
            };
            let at = at_text(&self.texts, span);
            let text = &self.texts[at];
            let (shown, line, span) = text.around(&text.whole(span), &lines[at]);
            let source = Snippet::source(shown)
                .line_start(line)
                .path(&text.name)
                .annotation(AnnotationKind::Primary.span(span));
            let group = Level::ERROR
                .primary_title(mistake.what.as_str())
                .element(source);
            write!(f, "{}", Renderer::plain().render(&[group]))?;
        }
        Ok(())
    }
}
