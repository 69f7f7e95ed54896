//! What can be wrong with the user's folder.

use stage::{Message, message};
stage::messages! {
    NOT_COUNTED = "photos-not-counted": " (copies of another photo do not count: {copies})";
    NONE_GIVEN = "photos-none-given": "no photo was handed over";
    NONE_FITS = "photos-none-fits": "none of {count} files fits ({files}{more})";
    BELOW = "photos-below": "; folders in folders are read by `tailor measure` alone";
    NEAR = "photos-near": "; there is {files}";
}

stage::failures! {
    /// What is wrong with a capture.
    pub enum CaptureError {
        /// Too few.
        TooFew {
            /// How many there are.
            found: usize,
            /// How many are needed.
            least: u32,
        } = "fail-few-photos": "photos in turning order: {found}, but a turn needs at least {least}: put all photos of one turn into one folder, as images/*.jpg or *.jpg",
        /// Too few that are not copies of another.
        Copies {
            /// How many differ.
            found: usize,
            /// How many files there are.
            files: usize,
            /// How many are needed.
            least: u32,
            /// Which are copies, and of which.
            copies: String,
        } = "fail-copies": "only {found} of {files} photos differ, but a turn needs at least {least}; copies of another photo: {copies}; put the photos of one turn into the folder, each once",
        /// Not as many as capture.toml names.
        Count {
            /// The count of capture.toml.
            promised: usize,
            /// How many there are.
            found: usize,
            /// Which files are copies, and of which.
            copies: Message,
        } = "fail-count": "capture.toml has {promised} views, but {found} photos are there{copies}: add what is missing, or correct `views`",
        /// Of several sizes.
        Size {
            /// How many are of the usual size.
            most: usize,
            /// That size.
            size: String,
            /// Those that are not, with theirs.
            odd: String,
        } = "fail-mixed-sizes": "photos are of several sizes, but one camera must take all of a turn, uncropped: {most} are {size}, {odd}; move what does not belong to the turn into another folder, or list the photos of the turn: `images = \"IMG_*.jpg\"` in capture.toml, or --images; a walk around somebody may have several: --walk",
        /// `images` names what is not there.
        NoImages {
            /// A name or a pattern.
            pattern: String,
            /// What is there.
            found: Message,
            /// What files in folders are read by.
            below: Message,
        } = "fail-no-images": "`images` is {pattern}, but {found}: correct it, or leave it out{below}",
        /// One colour.
        OneColour {
            /// The photo.
            name: String,
        } = "fail-one-colour": "{name} is of one colour: take it again, or remove it",
        /// White.
        Overexposed {
            /// The photo.
            name: String,
        } = "fail-overexposed": "{name} is overexposed nearly everywhere: take it again, or remove it",
        /// No picture.
        NoPicture {
            /// The file.
            name: String,
            /// The decoder's message.
            why: String,
        } = "fail-no-picture": "{name} is no picture that can be read ({why}); export it again as JPEG, PNG or TIFF, or remove it",
        /// Photos of which nothing will come.
        Hopeless(why: Message) = "fail-hopeless": "{why} (if you are sure of the photos: --set photos.stop=false)",
        /// A plate that is not there.
        NoPlate {
            /// What is named.
            name: String,
            /// Files that may be meant.
            near: Message,
        } = "fail-no-such-plate": "`plate` in capture.toml, or --plate, names {name}, but there is no such file{near}: correct it, or leave it out (a photo called plate.jpg is found without it)",
    }
}

impl CaptureError {
    /// Not as many photos as promised; which files are copies, and of which.
    pub(crate) fn count(promised: usize, found: usize, copies: &str) -> CaptureError {
        let copies = match copies {
            "" => Message::default(),
            copies => message!(NOT_COUNTED, copies = copies),
        };
        CaptureError::Count {
            promised,
            found,
            copies,
        }
    }

    /// A pattern that none of so many files fits, the first of which are these.
    pub(crate) fn no_images(pattern: &str, files: Vec<String>, count: usize) -> CaptureError {
        let more = if count > files.len() { ", …" } else { "" };
        let found = match files.as_slice() {
            [] => message!(NONE_GIVEN),
            _ => message!(NONE_FITS, count = count, files = files, more = more),
        };
        let below = match pattern.contains('/') {
            true => message!(BELOW),
            false => Message::default(),
        };
        let pattern = pattern.to_owned();
        CaptureError::NoImages {
            pattern,
            found,
            below,
        }
    }

    /// A plate that is not there; files that may be meant.
    pub(crate) fn no_plate(name: &str, near: Vec<String>) -> CaptureError {
        let near = match near.is_empty() {
            true => Message::default(),
            false => message!(NEAR, files = near),
        };
        let name = name.to_owned();
        CaptureError::NoPlate { name, near }
    }
}
