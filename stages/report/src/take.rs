//! The stage that takes a document that somebody else made.

use shape::Document;
use stage::{Ctx, Files, FilesError, Stage, Stop};
use std::sync::Arc;

stage::inputs! {
    /// Somebody's document.
    pub struct TakeInput {
        /// One file; its ending names its format.
        files: Arc<Files>,
    }
}

/// Why there is no document.
#[derive(Debug, thiserror::Error)]
pub enum TakeError {
    /// None or several.
    #[error("one file is wanted, but {0} are there")]
    Count(usize),
    /// An ending that is not known.
    #[error(
        "{0} is no document: call it .html, .json, .csv, .toml, .svg, .txt, .png, .jpg or .pdf"
    )]
    Ending(String),
    /// Nothing in it.
    #[error("{0} is empty")]
    Empty(String),
    /// A text that is none.
    #[error("{0} is not UTF-8 from byte {1} on")]
    Text(String, usize),
    /// A file that cannot be read.
    #[error(transparent)]
    Files(#[from] FilesError),
}

/// `report.take`: files → document.
pub struct Take;

impl Stage for Take {
    const NAME: &'static str = "report.take";
    const VERSION: u32 = 1;
    const ABOUT: &'static str = "Takes a document from a file: a table, a picture, a page.";
    type Params = ();
    type Input = TakeInput;
    type Output = Document;

    fn run(_: &(), input: TakeInput, _: &Ctx<'_>) -> Result<Document, Stop> {
        let [entry] = &input.files.entries[..] else {
            return Err(TakeError::Count(input.files.entries.len()).into());
        };
        let name = || entry.name.clone();
        let media = media(&entry.name).ok_or_else(|| TakeError::Ending(name()))?;
        let bytes = input.files.read(entry).map_err(TakeError::from)?;
        if bytes.is_empty() {
            return Err(TakeError::Empty(name()).into());
        }
        let is_text = media.starts_with("text/") || media.ends_with("json");
        if let (true, Err(wrong)) = (is_text, std::str::from_utf8(&bytes)) {
            return Err(TakeError::Text(name(), wrong.valid_up_to()).into());
        }
        let media = media.into();
        Ok(Document { media, bytes })
    }
}

/// The media type of a name's ending.
fn media(name: &str) -> Option<&'static str> {
    let (_, ending) = name.rsplit_once('.')?;
    Some(match ending.to_ascii_lowercase().as_str() {
        "html" => "text/html",
        "json" => "application/json",
        "csv" => "text/csv",
        "toml" => "application/toml",
        "svg" => "image/svg+xml",
        "txt" => "text/plain",
        "png" => "image/png",
        "jpg" | "jpeg" => "image/jpeg",
        "pdf" => "application/pdf",
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn take(files: &[(&str, &[u8])]) -> Result<Document, String> {
        let place = tempfile::tempdir().unwrap();
        let entry = |(name, bytes): &(&str, &[u8])| {
            std::fs::write(place.path().join(name), bytes).unwrap();
            stage::FileEntry {
                name: (*name).into(),
                content: stage::hash(bytes),
                size: bytes.len() as u64,
            }
        };
        let entries = files.iter().map(entry).collect();
        let root = place.path().to_owned();
        let files = Arc::new(Files { root, entries });
        match Take::run(&(), TakeInput { files }, &Ctx::alone()) {
            Ok(document) => Ok(document),
            Err(Stop::Failed(why)) => Err(why.to_string()),
            Err(Stop::Cancelled) => unreachable!("nobody stops it"),
        }
    }

    #[test]
    fn a_file_is_a_document_by_its_ending() {
        let table = take(&[("a.b.CSV", b"x,y\n1,2\n")]).unwrap();
        assert_eq!((table.media.as_str(), table.bytes.len()), ("text/csv", 8));
        assert_eq!(take(&[("a.png", &[0xff, 0])]).unwrap().media, "image/png");
    }

    #[test]
    fn what_is_none_is_refused() {
        let refused = |files: &[(&str, &[u8])]| take(files).unwrap_err();
        assert!(refused(&[]).contains("but 0 are there"));
        assert!(refused(&[("a.txt", b"a"), ("b.txt", b"b")]).contains("but 2"));
        assert!(refused(&[("a.exe", b"a")]).contains("call it .html"));
        assert!(refused(&[("a.txt", b"")]).contains("is empty"));
        assert!(refused(&[("a.json", &[b'"', 0xff])]).contains("not UTF-8 from byte 1"));
    }
}
