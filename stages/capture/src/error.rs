//! What can be wrong with the user's folder.

/// What is wrong with the user's folder.
#[derive(Debug, thiserror::Error)]
pub enum CaptureError {
    /// Too few.
    #[error(
        "photos in turning order: {found}, but a turn needs at least {least}: put all photos of one turn into one folder, as images/*.jpg or *.jpg"
    )]
    TooFew {
        /// How many there are.
        found: usize,
        /// How many are needed.
        least: u32,
    },
    /// Too few that are not copies of another.
    #[error(
        "only {found} of {files} photos differ, but a turn needs at least {least}; copies of another photo: {copies}; put the photos of one turn into the folder, each once"
    )]
    Copies {
        /// How many differ.
        found: usize,
        /// How many files there are.
        files: usize,
        /// How many are needed.
        least: u32,
        /// Which are copies, and of which.
        copies: String,
    },
    /// Not as many as capture.toml names.
    #[error(
        "capture.toml says {promised} views, but {found} photos are there{}: add what is missing, or correct `views`",
        match copies.as_str() {
            "" => String::new(),
            copies => format!(" (copies of another photo do not count: {copies})"),
        }
    )]
    Count {
        /// The count of capture.toml.
        promised: usize,
        /// How many there are.
        found: usize,
        /// Which files are copies, and of which.
        copies: String,
    },
    /// Of several sizes.
    #[error(
        "photos are of several sizes, but one camera must take all of a turn, uncropped: {most} are {size}, {odd}; move what does not belong to the turn \
         into another folder, or say which photos are the turn: `images = \"IMG_*.jpg\"` in capture.toml, or --images; a walk around somebody may have several: --walk"
    )]
    Size {
        /// How many are of the usual size.
        most: usize,
        /// That size.
        size: String,
        /// Those that are not, with theirs.
        odd: String,
    },
    /// `images` names what is not there.
    #[error(
        "`images` says {pattern}, but {}: correct it, or leave it out{}",
        match found.as_slice() {
            [] => "no photo was handed over".to_owned(),
            some => format!("none of {count} files fits ({}{})", some.join(", "), if *count > some.len() { ", …" } else { "" }),
        },
        if pattern.contains('/') { "; folders below others are read by `tailor measure` alone" } else { "" }
    )]
    NoImages {
        /// A name or a pattern.
        pattern: String,
        /// The first files that are there.
        found: Vec<String>,
        /// How many there are.
        count: usize,
    },
    /// One colour.
    #[error("{name} is {what}: take it again, or remove it")]
    Blank {
        /// The photo.
        name: String,
        /// How.
        what: &'static str,
    },
    /// No picture.
    #[error(
        "{name} is no picture that can be read ({why}); export it again as JPEG, PNG or TIFF, or remove it"
    )]
    NoPicture {
        /// The file.
        name: String,
        /// The decoder's message.
        why: String,
    },
    /// Photos of which nothing will come.
    #[error("{0} (if you are sure of the photos: --set photos.stop=false)")]
    Hopeless(String),
    /// A plate that is not there.
    #[error(
        "`plate` in capture.toml, or --plate, names {name}, but there is no such file{}: correct it, or leave it out (a photo called plate.jpg is found without it)",
        match near.as_slice() {
            [] => String::new(),
            some => format!("; there is {}", some.join(", ")),
        }
    )]
    NoPlate {
        /// What is named.
        name: String,
        /// Files that may be meant.
        near: Vec<String>,
    },
}
