//! What a capture is read from: photos, a video, raw photos; or a scan, which is none.

use crate::catalog::{is_photo, is_plate, is_raw, is_scan, is_video};
use command::Fault;
use stage::{Message, message};
use std::path::{Path, PathBuf};

stage::messages! {
    NO_FOLDER = "fail-no-folder": "{file} is a file: hand over the folder with all photos of the turn, a video (mp4, mov, mkv, …), or a scan (ply, obj, stl, off, glb, 3mf)";
    NO_VIDEO = "cli-folder-no-video": "{folder} holds no video (mp4, mov, mkv, …)";
    ONLY_VIDEO = "warn-only-video": "the video is read, not what is beside it: {count} {count|photo|photos} ({first}, …)";
}

/// What is read.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Source {
    /// Photos of a folder.
    Photos(PathBuf),
    /// The video of a folder: the only one, or that of a name.
    Video(PathBuf, Option<String>),
    /// Raw photos of a folder.
    Raw(PathBuf),
    /// A surface from elsewhere: a file of a folder.
    Scan(PathBuf, String),
}

impl Source {
    /// A file that was handed over itself, if it is one.
    pub(super) fn file(capture: &Path) -> Result<Option<Source>, Fault> {
        if !capture.is_file() {
            return Ok(None);
        }
        let name = capture.file_name().and_then(|n| n.to_str());
        let Some(name) = name.filter(|n| is_video(n) || is_scan(n)) else {
            let file = capture.display().to_string();
            return Err(Fault::coded(&message!(NO_FOLDER, file = file)));
        };
        let folder = capture.parent().filter(|f| !f.as_os_str().is_empty());
        let folder = folder.unwrap_or(Path::new(".")).to_owned();
        let name = name.to_owned();
        Ok(Some(match is_scan(&name) {
            true => Source::Scan(folder, name),
            false => Source::Video(folder, Some(name)),
        }))
    }

    /// What a folder with these files is read from: photos if there are any, unless its `video` is wanted.
    pub(super) fn of(folder: &Path, names: &[String], video: bool) -> Result<Source, Fault> {
        let there = |is: fn(&str) -> bool| names.iter().any(|n| is(n) && !is_plate(n));
        let folder = folder.to_owned();
        // Videos of folders below are not looked for.
        let video_here = |name: &str| is_video(name) && !name.contains('/');
        match (there(is_photo), there(video_here), there(is_raw)) {
            (_, true, _) if video => Ok(Source::Video(folder, None)),
            _ if video => {
                let folder = folder.display().to_string();
                Err(Fault::coded(&message!(NO_VIDEO, folder = folder)))
            }
            (false, true, _) => Ok(Source::Video(folder, None)),
            (false, false, true) => Ok(Source::Raw(folder)),
            _ => Ok(Source::Photos(folder)),
        }
    }

    /// The folder.
    pub(super) fn folder(&self) -> &Path {
        match self {
            Source::Photos(folder)
            | Source::Video(folder, _)
            | Source::Raw(folder)
            | Source::Scan(folder, _) => folder,
        }
    }

    /// The built-in pipeline that makes photos of it, over the one that measures; none where they are there.
    pub(super) fn over(&self) -> Option<&'static str> {
        match self {
            Source::Photos(_) | Source::Scan(..) => None,
            Source::Video(..) => Some("video"),
            Source::Raw(_) => Some("raw"),
        }
    }

    /// The inputs of that pipeline.
    pub(super) fn inputs(&self) -> Vec<(String, PathBuf)> {
        let first = match self {
            Source::Scan(..) => "surface",
            _ => "photos",
        };
        let names = std::iter::once(first).chain(self.over());
        names
            .map(|name| (name.to_owned(), self.folder().to_owned()))
            .collect()
    }

    /// The one file that is read of those that a pattern by ending fits.
    pub(super) fn only(&self) -> Vec<String> {
        match self {
            Source::Video(_, Some(name)) | Source::Scan(_, name) => vec![name.clone()],
            _ => vec![],
        }
    }

    /// What is beside it in the folder and is not read.
    pub(super) fn left_out(&self, names: &[String]) -> Option<Message> {
        let photo = |name: &str| is_photo(name) || is_raw(name);
        let video = matches!(self, Source::Video(..));
        let other = |name: &&String| video && photo(name) && !is_plate(name);
        let first = names.iter().find(other)?;
        let photos = names.iter().filter(other).count();
        Some(message!(ONLY_VIDEO, count = photos, first = first))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn photos_go_before_a_video_and_a_video_before_raw_photos() {
        let of = |names: &[&str], video: bool| {
            let names: Vec<String> = names.iter().map(|n| (*n).to_owned()).collect();
            Source::of(Path::new("x"), &names, video).map(|s| s.over())
        };
        let over =
            |names: &[&str], video| of(names, video).unwrap_or_else(|f| panic!("{}", f.text()));
        assert_eq!(over(&["a.jpg", "turn.mp4"], false), None);
        assert_eq!(over(&["a.jpg", "turn.mp4"], true), Some("video"));
        assert_eq!(
            over(&["plate.jpg", "turn.MOV", "a.dng"], false),
            Some("video")
        );
        assert_eq!(
            over(&["plate.jpg", "a.DNG", "capture.toml"], false),
            Some("raw")
        );
        assert_eq!(over(&["IMG_1.HEIC"], false), None);
        assert!(of(&["a.jpg"], true).is_err_and(|f| f.text().contains("holds no video")));
    }

    #[test]
    fn a_file_is_a_video_or_a_scan_or_refused() {
        let place = tempfile::tempdir().unwrap();
        let at = |name: &str| {
            let path = place.path().join(name);
            std::fs::write(&path, "x").unwrap();
            Source::file(&path)
        };
        let video = Source::Video(place.path().to_owned(), Some("turn.MP4".into()));
        assert!(at("turn.MP4").is_ok_and(|s| s == Some(video)));
        let scan = Source::Scan(place.path().to_owned(), "body.OBJ".into());
        assert!(at("body.OBJ").is_ok_and(|s| s == Some(scan)));
        assert!(at("a.jpg").is_err_and(|f| f.text().contains("is a file")));
        assert!(Source::file(place.path()).is_ok_and(|s| s.is_none()));
    }
}
