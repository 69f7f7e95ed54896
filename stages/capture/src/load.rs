//! The stage that reads the photos of a turn.

use crate::alike::{alike, other_cameras, out_of_order};
use crate::error::CaptureError;
use crate::exif;
use crate::rig::{RigFile, read_rig};
use rayon::prelude::*;
use shape::{Photo, Photos};
use stage::{Ctx, FileEntry, Files, Stage, Stop};
use std::path::Path;
use std::sync::Arc;

stage::params! {
    /// What may be a turn.
    pub struct LoadParams {
        /// Fewest photos that are taken for a turn.
        #[range(3..=1000)]
        fewest: u32 = 3,
        /// Of each so many photos in turning order, the first `keep` are taken: what would fewer
        /// views have done?
        #[range(1..=100)]
        of: u32 = 1,
        /// How many of each `of` are taken.
        #[range(1..=100)]
        keep: u32 = 1,
    }
}

stage::inputs! {
    /// The user's folder.
    pub struct LoadInput {
        /// The photos, `capture.toml` and the plate.
        files: Arc<Files>,
    }
}

/// `capture.load`: files → photos.
pub struct Load;

impl Stage for Load {
    const NAME: &'static str = "capture.load";
    const VERSION: u32 = 6;
    const ABOUT: &'static str =
        "Reads the photos of one turn, their EXIF, capture.toml and the plate.";
    type Params = LoadParams;
    type Input = LoadInput;
    type Output = Photos;
    const METRICS: &'static [&'static str] = &["photos", "width", "height"];

    fn run(p: &LoadParams, input: LoadInput, ctx: &Ctx<'_>) -> Result<Photos, Stop> {
        let files = &input.files;
        let known = match files.entries.iter().find(|e| e.name == "capture.toml") {
            Some(entry) => read_rig(&String::from_utf8_lossy(&files.read(entry)?))?,
            None => RigFile::default(),
        };
        known
            .unknown
            .iter()
            .for_each(|key| ctx.warn(format!("capture.toml: {key}")));
        crate::rig_tags::doubts(&known.rig)
            .iter()
            .for_each(|w| ctx.warn(w));
        let (turn, plate) = sorted(files, &known)?;
        if let Some(said) = known.views.filter(|said| *said != turn.len()) {
            return Err(CaptureError::Count {
                said,
                found: turn.len(),
            }
            .into());
        }
        let (keep, of) = (p.keep.min(p.of) as usize, p.of as usize);
        let turn = thinned(turn, keep, of);
        if turn.len() < p.fewest as usize {
            return Err(CaptureError::TooFew {
                found: turn.len(),
                least: p.fewest,
            }
            .into());
        }
        let steps = ctx.steps("photos", turn.len());
        let read = |entry: &&FileEntry| -> Result<Photo, Stop> {
            let photo = photo(&entry.name, files.read(entry)?)?;
            steps.tick()?;
            Ok(photo)
        };
        let mut photos: Vec<Photo> = turn.par_iter().map(read).collect::<Result<_, _>>()?;
        let plate = plate
            .map(|entry| -> Result<Photo, Stop> { Ok(photo(&entry.name, files.read(entry)?)?) })
            .transpose()?;
        alike(&photos, plate.as_ref())?;
        other_cameras(&photos).iter().for_each(|w| ctx.warn(w));
        let start = photos
            .iter()
            .filter_map(|p| p.time_s)
            .fold(f64::MAX, f64::min);
        photos
            .iter_mut()
            .for_each(|p| p.time_s = p.time_s.map(|t| t - start));
        out_of_order(&photos).iter().for_each(|w| ctx.warn(w));
        let mut rig = known.rig;
        // Steps are equal only where one of each so many is left.
        rig.step = rig
            .step
            .filter(|_| keep == of || keep == 1)
            .map(|step| match keep == of {
                true => step,
                false => step * of as f64,
            });
        rig.focal_35mm = rig.focal_35mm.or(photos[0].focal_35mm);
        ctx.metric("photos", photos.len() as f64, "");
        ctx.metric("width", f64::from(photos[0].width), "px");
        ctx.metric("height", f64::from(photos[0].height), "px");
        Ok(Photos { photos, plate, rig })
    }
}

/// The first `keep` of each `of`.
fn thinned<T>(all: Vec<T>, keep: usize, of: usize) -> Vec<T> {
    let kept = all.into_iter().enumerate().filter(|(i, _)| i % of < keep);
    kept.map(|(_, item)| item).collect()
}

type Sorted<'a> = (Vec<&'a FileEntry>, Option<&'a FileEntry>);

/// Which files are the turn, and which is the plate. `images/` goes before the folder itself.
fn sorted<'a>(files: &'a Files, known: &RigFile) -> Result<Sorted<'a>, CaptureError> {
    let stem = |e: &FileEntry| {
        Path::new(&e.name)
            .file_stem()
            .map_or(String::new(), |s| s.to_string_lossy().to_lowercase())
    };
    let pictures: Vec<_> = files
        .entries
        .iter()
        .filter(|e| e.name != "capture.toml")
        .collect();
    let plate = match &known.plate {
        Some(name) => {
            let found = pictures.iter().find(|e| e.name == *name).copied();
            Some(found.ok_or_else(|| CaptureError::NoPlate(name.clone()))?)
        }
        None => pictures.iter().find(|e| stem(e) == "plate").copied(),
    };
    let inner = pictures
        .iter()
        .any(|e| e.name.starts_with("images/") && stem(e) != "plate");
    let of_turn = |e: &&FileEntry| {
        Some(e.name.as_str()) != plate.map(|p| p.name.as_str())
            && stem(e) != "plate"
            && e.name.starts_with("images/") == inner
    };
    Ok((pictures.into_iter().filter(of_turn).collect(), plate))
}

/// One photo: decoded once to see that it is whole and shows something.
fn photo(path: &str, bytes: Vec<u8>) -> Result<Photo, CaptureError> {
    let name = path.rsplit('/').next().unwrap_or(path).to_owned();
    let no_picture = |why: String| CaptureError::NoPicture {
        name: path.to_owned(),
        why,
    };
    if bytes.is_empty() {
        return Err(no_picture("it is empty".into()));
    }
    if crate::whole::is_cut_off(&bytes) {
        return Err(no_picture("it ends too early: copied whole?".into()));
    }
    let exif = exif::read(&bytes);
    let (width, height) = image::ImageReader::new(std::io::Cursor::new(&bytes))
        .with_guessed_format()
        .map_err(|e| no_picture(e.to_string()))?
        .into_dimensions()
        .map_err(|e| no_picture(e.to_string()))?;
    let lying = exif.orientation >= 5;
    let (width, height) = if lying {
        (height, width)
    } else {
        (width, height)
    };
    let photo = Photo {
        name,
        width,
        height,
        orientation: exif.orientation,
        focal_35mm: exif.focal_35mm,
        device: exif.device,
        time_s: exif.time_s,
        file: bytes.into(),
    };
    let pixels = photo.decode().map_err(|e| no_picture(e.why))?;
    let (mut lo, mut hi, mut white) = ([255u8; 3], [0u8; 3], 0usize);
    for p in &pixels.data {
        (0..3).for_each(|c| (lo[c], hi[c]) = (lo[c].min(p[c]), hi[c].max(p[c])));
        white += usize::from(p.iter().all(|c| *c >= 254));
    }
    let flat = (0..3).all(|c| hi[c] - lo[c] < 8);
    let what = match (flat, white * 10 > pixels.data.len() * 9) {
        (true, _) => Some("of one colour"),
        (_, true) => Some("overexposed nearly everywhere"),
        _ => None,
    };
    match what {
        Some(what) => Err(CaptureError::Blank {
            name: path.to_owned(),
            what,
        }),
        None => Ok(photo),
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn two_of_three_views_are_left() {
        assert_eq!(super::thinned((0..7).collect(), 2, 3), [0, 1, 3, 4, 6]);
    }
}
