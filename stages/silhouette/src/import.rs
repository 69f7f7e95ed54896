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

/// Why there are no masks.
#[derive(Debug, thiserror::Error)]
pub enum ImportError {
    /// No file is named as a photo is.
    #[error(
        "none of the {0} files is named as a photo is: call the mask of {1} {2}.png or {2}_mask.png"
    )]
    Strangers(usize, String, String),
    /// Two masks of one photo.
    #[error("{0} and {1} are both named as masks of {2}: keep one of them")]
    Twice(String, String, String),
    /// No image.
    #[error("{0} cannot be read as an image: {1}; export it again as PNG")]
    Image(String, String),
    /// Another size.
    #[error(
        "{name} has {got} pixels, but the photo {photo} has {want}: export it at the photo's size"
    )]
    Size {
        /// The file.
        name: String,
        /// Its size.
        got: String,
        /// The photo.
        photo: String,
        /// The photo's size.
        want: String,
    },
    /// All one shade.
    #[error("{0} is {1}: it does not show where the body is; draw it again or remove it")]
    Blank(String, &'static str),
    /// The other way around.
    #[error(
        "{0} looks inverted: its border is the shade that is body on the other masks; invert it, or set `body` if the subject fills the photos"
    )]
    Inverted(String),
    /// A file that cannot be read.
    #[error(transparent)]
    Files(#[from] FilesError),
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
            let mask = gray_from_file(&input.files.read(entry)?)
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
        Ok(Masks {
            views: masks.into_iter().collect(),
        })
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
        let what = match share {
            s if s < 1e-4 => "all black",
            s if s > 1.0 - 1e-4 => "all white",
            _ => continue,
        };
        return Err(ImportError::Blank(name.clone(), what));
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
