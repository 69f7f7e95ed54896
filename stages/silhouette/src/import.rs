//! The stage that takes masks that somebody else made.

use shape::{Mask, Masks, PhotoId, Photos, gray_from_file};
use stage::{Ctx, FileEntry, Files, FilesError, Stage, Stop, message};
use std::sync::Arc;

stage::messages! {
    NO_MASK = "warn-no-mask": "{name} has no mask and is left out: put its mask beside the other masks, under the name of the photo";
}

stage::choice! {
    /// Which shade is the body.
    pub enum Body {
        /// The one that the masks' borders do not show.
        Auto = "auto",
        /// White.
        White = "white",
        /// Black.
        Black = "black",
    }
}

stage::params! {
    /// How to read masks.
    pub struct ImportParams {
        /// Which shade is the body.
        body: Body = Body::Auto,
    }
}

stage::inputs! {
    /// Somebody's masks.
    pub struct ImportInput {
        /// Images named as the photos are: `0003.png` or `0003_mask.png` for `0003.jpg`.
        files: Arc<Files>,
        /// The photos they belong to.
        photos: Arc<Photos>,
    }
}

stage::failures! {
    /// Why there are no masks.
    pub enum ImportError {
        /// No file is named as a photo is.
        Strangers(count: usize, photo: String, stem: String) = "fail-masks-named": "none of the {count} files is named as a photo is: call the mask of {photo} {stem}.png or {stem}_mask.png",
        /// Two masks of one photo.
        Twice(one: String, other: String, photo: String) = "fail-masks-twice": "{one} and {other} are both named as masks of {photo}: keep one of them",
        /// No image.
        Image(name: String, why: String) = "fail-masks-image": "{name} cannot be read as an image: {why}; export it again as PNG",
        /// Another size.
        Size {
            /// The file.
            name: String,
            /// Its size.
            got: String,
            /// The photo.
            photo: String,
            /// The photo's size.
            want: String,
        } = "fail-masks-size": "{name} has {got} pixels, but the photo {photo} has {want}: export it at the photo's size",
        /// All black.
        Black(name: String) = "fail-masks-black": "{name} is all black: it does not show where the body is; draw it again or remove it",
        /// All white.
        White(name: String) = "fail-masks-white": "{name} is all white: it does not show where the body is; draw it again or remove it",
        /// The other way around.
        Inverted(name: String) = "cli-masks-inverted": "{name} looks inverted: its border is the shade that is body on the other masks; invert it, or set `body` if the subject fills the photos",
    }
    wraps {
        /// A file that cannot be read.
        Files(FilesError),
    }
}

/// `silhouette.import`: files, photos → masks.
pub struct Import;

impl Stage for Import {
    const NAME: &'static str = "silhouette.import";
    const VERSION: u32 = 1;
    const ABOUT: &'static str =
        "Takes masks from a folder of images, body white or black, one for each photo.";
    type Params = ImportParams;
    type Input = ImportInput;
    type Output = Masks;

    fn run(p: &ImportParams, input: ImportInput, ctx: &Ctx<'_>) -> Result<Masks, Stop> {
        let mut read = Vec::new();
        for (id, photo) in input.photos.iter() {
            ctx.check()?;
            let Some(entry) = of_photo(&input.files, &photo.name)? else {
                ctx.warn(message!(NO_MASK, name = &photo.name));
                continue;
            };
            let mask = gray_from_file(&input.files.read(entry).map_err(ImportError::from)?)
                .map_err(|why| ImportError::Image(entry.name.clone(), why))?;
            if (mask.width, mask.height) != (photo.width as usize, photo.height as usize) {
                return Err(ImportError::Size {
                    name: entry.name.clone(),
                    got: format!("{}×{}", mask.width, mask.height),
                    photo: photo.name.clone(),
                    want: format!("{}×{}", photo.width, photo.height),
                }
                .into());
            }
            read.push((id, entry.name.clone(), mask));
        }
        if read.is_empty() {
            let name = input.photos.photos.first().map_or("", |p| p.name.as_str());
            let strangers = ImportError::Strangers(
                input.files.entries.len(),
                name.to_owned(),
                stem(name).to_owned(),
            );
            return Err(strangers.into());
        }
        let masks = upright(read, p.body)?;
        Ok(masks.into_iter().collect())
    }
}

/// A file's name without folders and ending.
fn stem(name: &str) -> &str {
    let name = name.rsplit('/').next().unwrap_or(name);
    name.rsplit_once('.').map_or(name, |(stem, _)| stem)
}

/// The file that is named as a photo's mask.
fn of_photo<'a>(files: &'a Files, photo: &str) -> Result<Option<&'a FileEntry>, ImportError> {
    let want = stem(photo);
    let belongs = |entry: &&FileEntry| {
        let name = stem(&entry.name);
        // `0003.jpg.png`, as some programs call it, has the photo's whole name as its stem.
        [want, photo].contains(&name) || name.strip_suffix("_mask") == Some(want)
    };
    let mut found = files.entries.iter().filter(belongs);
    let (first, second) = (found.next(), found.next());
    if let (Some(a), Some(b)) = (first, second) {
        let names = (a.name.clone(), b.name.clone(), photo.to_owned());
        return Err(ImportError::Twice(names.0, names.1, names.2));
    }
    Ok(first)
}

/// Share of the photo's outermost pixels that are white.
fn white_border(mask: &Mask) -> f64 {
    let (w, h) = (mask.width, mask.height);
    let rows = (0..w).flat_map(|x| [(x, 0), (x, h - 1)]);
    let sides = (0..h).flat_map(|y| [(0, y), (w - 1, y)]);
    let white = rows.chain(sides).filter(|(x, y)| mask.at(*x, *y) > 127);
    white.count() as f64 / (2 * (w + h)) as f64
}

/// Masks with the body white.
fn upright(
    masks: Vec<(PhotoId, String, Mask)>,
    body: Body,
) -> Result<Vec<(PhotoId, Mask)>, ImportError> {
    for (_, name, mask) in &masks {
        let share = mask.area() as f64 / mask.data.len().max(1) as f64;
        match share {
            s if s < 1e-4 => return Err(ImportError::Black(name.clone())),
            s if s > 1.0 - 1e-4 => return Err(ImportError::White(name.clone())),
            _ => {}
        }
    }
    let white: Vec<bool> = masks.iter().map(|m| white_border(&m.2) > 0.5).collect();
    let invert = match body {
        Body::White => false,
        Body::Black => true,
        Body::Auto => {
            let invert = white.iter().filter(|w| **w).count() * 2 > masks.len();
            if let Some(odd) = white.iter().position(|w| *w != invert) {
                return Err(ImportError::Inverted(masks[odd].1.clone()));
            }
            invert
        }
    };
    let turned = |mask: Mask| if invert { mask.map(|c| 255 - c) } else { mask };
    Ok(masks
        .into_iter()
        .map(|(id, _, mask)| (id, turned(mask)))
        .collect())
}
