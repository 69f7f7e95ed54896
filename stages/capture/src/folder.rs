//! What is in the user's folder besides photos that can be read, and the command that makes photos of it.

use stage::{Field, Message, Template};

stage::messages! {
    HEIC = "files-heic": "{count} HEIC {count|photo|photos} ({files}{more})";
    VIDEO = "files-video": "{count} {count|video|videos} ({files}{more})";
    RAW = "files-raw": "{count} raw {count|photo|photos} ({files}{more})";
    OTHER = "files-other": "{count} {count|picture of another format|pictures of other formats} ({files}{more})";
}

/// Endings of photos that are read.
pub const READ: &[&str] = match cfg!(feature = "heic") {
    true => &["jpg", "jpeg", "png", "tif", "tiff", "heic", "heif", "hif"],
    false => &["jpg", "jpeg", "png", "tif", "tiff"],
};

/// Endings of videos, which `capture.video` reads.
pub const VIDEOS: [&str; 9] = [
    "mp4", "mov", "m4v", "mkv", "webm", "avi", "3gp", "mts", "m2ts",
];

/// Endings of raw photos, which `capture.raw` reads.
pub const RAWS: [&str; 10] = [
    "dng", "cr2", "cr3", "nef", "arw", "raf", "orf", "rw2", "pef", "srw",
];

/// A kind of file that cannot be read as it is.
struct Kind {
    called: Template,
    endings: &'static [&'static str],
    way: fn(&str, &str) -> String,
}

const KINDS: [Kind; 4] = [
    Kind {
        called: HEIC,
        endings: &["heic", "heif", "hif", "avif"],
        way: |_, ending| {
            format!("for f in *.{ending}; do heif-convert -q 95 \"$f\" \"${{f%.*}}.jpg\"; done")
        },
    },
    Kind {
        called: VIDEO,
        endings: &VIDEOS,
        way: |first, _| format!("tailor measure \"{first}\""),
    },
    Kind {
        called: RAW,
        endings: &RAWS,
        way: |_, ending| format!("dcraw_emu -w -W -o 1 -g 2.4 12.92 -T *.{ending}"),
    },
    Kind {
        called: OTHER,
        endings: &["webp", "bmp", "gif", "jp2", "jxl", "ppm", "tga"],
        way: |_, ending| format!("mogrify -format jpg -quality 95 *.{ending}"),
    },
];

/// Files of one kind that cannot be read as they are.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Foreign {
    /// What they are.
    called: Template,
    /// Their names.
    pub names: Vec<String>,
    /// The command of a shell, run in their folder, that makes photos of them.
    pub way: String,
}

impl Foreign {
    /// `3 HEIC photos (a.heic, b.heic, …)`.
    pub fn words(&self) -> Message {
        let count = self.names.len();
        let more = if count > 2 { ", …" } else { "" };
        let fields = [
            ("count", count.into()),
            ("files", Field::from(&self.names[..count.min(2)])),
            ("more", more.into()),
        ];
        Message::new(&self.called, fields)
    }
}

fn ending(name: &str) -> Option<&str> {
    let base = name.rsplit('/').next().unwrap_or(name);
    base.rsplit_once('.').map(|(_, ending)| ending)
}

/// Whether a file is a photo that is read, by its name. Hidden files are none: macOS writes `._0001.jpg`
/// beside photos.
pub fn is_photo(name: &str) -> bool {
    is_one_of(name, READ)
}

/// Whether a file is a video, by its name.
pub fn is_video(name: &str) -> bool {
    is_one_of(name, &VIDEOS)
}

/// Whether a file is a raw photo, by its name.
pub fn is_raw(name: &str) -> bool {
    is_one_of(name, &RAWS)
}

fn is_one_of(name: &str, endings: &[&str]) -> bool {
    let base = name.rsplit('/').next().unwrap_or(name);
    let fits = |ending: &str| endings.iter().any(|e| ending.eq_ignore_ascii_case(e));
    !base.starts_with('.') && ending(name).is_some_and(fits)
}

/// The files that cannot be read as they are, by kind; none of them hidden.
pub fn foreign(names: &[String]) -> Vec<Foreign> {
    let shown = |name: &&String| !name.rsplit('/').next().unwrap_or(name).starts_with('.');
    let of = |kind: &Kind| {
        let fits = |name: &&String| {
            let is = |ending: &str| kind.endings.iter().any(|e| ending.eq_ignore_ascii_case(e));
            ending(name).is_some_and(is) && !is_photo(name)
        };
        let names: Vec<String> = names.iter().filter(shown).filter(fits).cloned().collect();
        let first = names.first()?.clone();
        let base = first.rsplit('/').next().unwrap_or(&first);
        let way = (kind.way)(base, ending(base).unwrap_or_default());
        let called = kind.called;
        Some(Foreign { called, names, way })
    };
    KINDS.iter().filter_map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cannot_be_read_is_named_with_the_command_that_converts_it() {
        let names = [
            "a.jpg",
            "IMG_1.HEIC",
            "IMG_2.HEIC",
            "IMG_3.HEIC",
            "walk.MOV",
            "._x.HEIC",
            "b.DNG",
            "Thumbs.db",
            "notes.txt",
        ];
        let names = names.map(str::to_owned);
        let found = foreign(&names);
        let words: Vec<String> = found.iter().map(|f| f.words().into()).collect();
        let unread = ["1 video (walk.MOV)", "1 raw photo (b.DNG)"];
        let [video, raw] = found.last_chunk().unwrap();
        assert_eq!(video.way, "tailor measure \"walk.MOV\"");
        assert!(raw.way.starts_with("dcraw_emu -w") && raw.way.ends_with("*.DNG"));
        let photos = names.iter().filter(|n| is_photo(n)).count();
        if cfg!(feature = "heic") {
            assert_eq!(
                (words.as_slice(), photos),
                (unread.map(String::from).as_slice(), 4)
            );
        } else {
            assert_eq!(words[0], "3 HEIC photos (IMG_1.HEIC, IMG_2.HEIC, …)");
            assert_eq!(
                (&words[1..], photos),
                (unread.map(String::from).as_slice(), 1)
            );
            assert!(found[0].way.contains("*.HEIC") && found[0].way.contains("heif-convert"));
        }
    }
}
