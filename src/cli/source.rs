//! What a capture is read from: photos, a video, raw photos.

use crate::catalog::{is_photo, is_raw, is_video};
use engine::cli::Fault;
use std::path::{Path, PathBuf};

/// What is read.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Source {
    /// Photos of a folder.
    Photos(PathBuf),
    /// The video of a folder: the only one, or that of a name.
    Video(PathBuf, Option<String>),
    /// Raw photos of a folder.
    Raw(PathBuf),
}

/// What was handed over, as it is: of a name without a folder, in this one.
pub(super) fn handed_over(capture: &Path) -> Result<PathBuf, Fault> {
    let is_file = capture.is_file();
    let name = capture
        .file_name()
        .and_then(|n| n.to_str())
        .unwrap_or_default();
    match is_file && !is_video(name) {
        true => Err(Fault::input(format!(
            "{} is a file: hand over the folder with all photos of the turn, or a video (mp4, mov, mkv, …)",
            capture.display()
        ))),
        false => Ok(capture.to_owned()),
    }
}

impl Source {
    /// A video that was handed over itself.
    pub(super) fn file(capture: &Path) -> Option<Source> {
        if !capture.is_file() {
            return None;
        }
        let name = capture.file_name()?.to_str()?.to_owned();
        let folder = capture.parent().filter(|f| !f.as_os_str().is_empty());
        let folder = folder.unwrap_or(Path::new(".")).to_owned();
        Some(Source::Video(folder, Some(name)))
    }

    /// The folder.
    pub(super) fn folder(&self) -> &Path {
        match self {
            Source::Photos(folder) | Source::Video(folder, _) | Source::Raw(folder) => folder,
        }
    }

    /// The built-in pipeline that makes photos of it, over the one that measures; none where they are there.
    pub(super) fn over(&self) -> Option<&'static str> {
        match self {
            Source::Photos(_) => None,
            Source::Video(..) => Some("video"),
            Source::Raw(_) => Some("raw"),
        }
    }

    /// The inputs of that pipeline.
    pub(super) fn inputs(&self) -> Vec<(String, PathBuf)> {
        let names = std::iter::once("photos").chain(self.over());
        names
            .map(|name| (name.to_owned(), self.folder().to_owned()))
            .collect()
    }

    /// The one file that is read of those that a pattern by ending fits.
    pub(super) fn only(&self) -> Vec<String> {
        match self {
            Source::Video(_, Some(name)) => vec![name.clone()],
            _ => vec![],
        }
    }

    /// What lies beside it in the folder and is not read.
    pub(super) fn left_out(&self, names: &[String]) -> Option<String> {
        let plate = |name: &String| name.to_lowercase().starts_with("plate.");
        let other = |name: &&String| match self {
            Source::Photos(_) => false,
            Source::Video(..) => (is_photo(name) || is_raw(name)) && !plate(name),
            Source::Raw(_) => false,
        };
        let first = names.iter().find(other)?;
        let count = names.iter().filter(other).count();
        Some(format!(
            "the video is read; {count} photos beside it are not ({first}, …)"
        ))
    }
}
