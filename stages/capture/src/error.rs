//! What can be wrong with the user's folder.

/// What is wrong with the user's folder.
#[derive(Debug, thiserror::Error)]
pub enum CaptureError {
    /// Too few.
    #[error(
        "found {found} photos in turning order, but a turn needs at least {least}: put all photos of one turn into one folder, as images/*.jpg or *.jpg"
    )]
    TooFew {
        /// How many there are.
        found: usize,
        /// How many are needed.
        least: u32,
    },
    /// Not as many as capture.toml says.
    #[error(
        "capture.toml says {said} views, but {found} photos are there: add what is missing, or correct `views`"
    )]
    Count {
        /// What capture.toml says.
        said: usize,
        /// How many there are.
        found: usize,
    },
    /// Of another size than the others.
    #[error(
        "{name} is {size}, but {first} is {first_size}: all photos of a turn must come from one camera, uncropped"
    )]
    Size {
        /// The odd one.
        name: String,
        /// Its size.
        size: String,
        /// The first photo.
        first: String,
        /// Its size.
        first_size: String,
    },
    /// Twice the same.
    #[error("{0} and {1} are the same photo: remove one, or put the right one in its place")]
    Twin(String, String),
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
        /// What the decoder says.
        why: String,
    },
    /// A plate that is not there.
    #[error("capture.toml names the plate {0}, but there is no such file")]
    NoPlate(String),
}
