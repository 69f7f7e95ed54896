//! A word of a command: text with places for what is known only when it runs.

use std::fmt;

/// A part of a word.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Piece {
    /// As it is.
    Text(String),
    /// The folder with copies of the node's `files`.
    Here,
    /// What is read at a port, as files; in the format after a colon.
    From(String, Option<String>),
    /// Where the result is to be written.
    Out,
    /// A param.
    With(String),
}

/// A word.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Template {
    /// Its parts in order.
    pub pieces: Vec<Piece>,
    /// As it was written.
    pub written: String,
}

/// A word that cannot be.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum TemplateError {
    /// A brace without its other one.
    #[error("a brace is open in `{0}`: write {{{{ and }}}} for braces of the program's own")]
    Open(String),
    /// A placeholder that there is not.
    #[error(
        "`{{{0}}}` is no placeholder: there are {{here}}, {{out}}, {{from.PORT}}, {{from.PORT:FORMAT}} \
         and {{with.NAME}}; write {{{{ and }}}} for braces of the program's own"
    )]
    Unknown(String),
}

impl Template {
    /// Reads a word.
    ///
    /// # Errors
    ///
    /// A brace is open, or a placeholder is unknown.
    pub fn read(word: &str) -> Result<Template, TemplateError> {
        let (mut pieces, mut text) = (Vec::new(), String::new());
        let mut rest = word;
        while let Some(at) = rest.find(['{', '}']) {
            text += &rest[..at];
            let (brace, after) = rest[at..].split_at(1);
            if let Some(after) = after.strip_prefix(brace) {
                text += brace;
                rest = after;
                continue;
            }
            let inner = after.split_once('}').filter(|_| brace == "{");
            let (inner, after) = inner.ok_or_else(|| TemplateError::Open(word.into()))?;
            if !text.is_empty() {
                pieces.push(Piece::Text(std::mem::take(&mut text)));
            }
            pieces.push(placeholder(inner)?);
            rest = after;
        }
        text += rest;
        if !text.is_empty() || pieces.is_empty() {
            pieces.push(Piece::Text(text));
        }
        let written = word.to_owned();
        Ok(Template { pieces, written })
    }

    /// The word with its places filled in.
    pub fn filled(&self, of: &dyn Fn(&Piece) -> String) -> String {
        let one = |piece: &Piece| match piece {
            Piece::Text(text) => text.clone(),
            other => of(other),
        };
        self.pieces.iter().map(one).collect()
    }
}

fn placeholder(inner: &str) -> Result<Piece, TemplateError> {
    let unknown = || TemplateError::Unknown(inner.into());
    match inner.split_once('.') {
        None if inner == "here" => Ok(Piece::Here),
        None if inner == "out" => Ok(Piece::Out),
        Some(("with", name)) if !name.is_empty() => Ok(Piece::With(name.into())),
        Some(("from", port)) if !port.is_empty() => Ok(match port.split_once(':') {
            Some((port, format)) => Piece::From(port.into(), Some(format.into())),
            None => Piece::From(port.into(), None),
        }),
        _ => Err(unknown()),
    }
}

/// As it was written; what a terminal would act on, or that has spaces, in quotes.
impl fmt::Display for Template {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let plain = |c: char| c.is_alphanumeric() || "-_./{}:=,+@%".contains(c);
        match !self.written.is_empty() && self.written.chars().all(plain) {
            true => write!(f, "{}", self.written),
            false => write!(f, "{:?}", self.written),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(text: &str) -> Piece {
        Piece::Text(text.into())
    }

    #[test]
    fn words_are_taken_apart() {
        let pieces = |word: &str| Template::read(word).map(|t| t.pieces);
        assert_eq!(pieces("-v"), Ok(vec![text("-v")]));
        assert_eq!(pieces(""), Ok(vec![text("")]));
        let file = vec![Piece::Here, text("/a.py")];
        assert_eq!(pieces("{here}/a.py"), Ok(file));
        let port = Piece::From("x".into(), Some("colmap".into()));
        let word = vec![text("--in="), port, text(":"), Piece::With("n".into())];
        assert_eq!(pieces("--in={from.x:colmap}:{with.n}"), Ok(word));
        assert_eq!(
            pieces("{{out}} {out}"),
            Ok(vec![text("{out} "), Piece::Out])
        );
    }

    #[test]
    fn what_is_no_template_is_refused() {
        for word in ["{", "a}", "{out", "{out} }"] {
            let reported = Template::read(word).unwrap_err();
            assert_eq!(reported, TemplateError::Open(word.into()));
        }
        for word in ["", "from", "from.", "with.", "outs", "a.b"] {
            let reported = Template::read(&format!("x{{{word}}}")).unwrap_err();
            assert_eq!(reported, TemplateError::Unknown(word.into()));
        }
    }

    #[test]
    fn what_would_steer_a_terminal_is_shown_in_quotes() {
        let shown = |word: &str| Template::read(word).unwrap().to_string();
        assert_eq!(shown("{here}/a.py"), "{here}/a.py");
        assert_eq!(shown("a b\u{1b}[2J"), "\"a b\\u{1b}[2J\"");
        assert_eq!(shown(""), "\"\"");
    }
}
