//! How far masks and the learned one disagree by part of the body, on true masks and on true masks that lack a limb: for `models/person/alarm.py`.
//!
//! `cargo run --release -p person --features tables --example alarm -- PHOTOS MASKS [PHOTOS MASKS]...` prints a line of JSON a photo and mask: what was taken
//! out of the true mask (nothing, a forearm with its hand, a shank with its foot, the head, a side of the trunk), and by part
//! in the order of `BodyPart::ALL` how wide a piece is lost \[pixels of the network\], and which share is added.

use person::{FindPeople, FindPeopleInput, FindPeopleParams, disagreement};
use shape::{Found, Mask, Photo, PhotoId, Photos};
use stage::{Ctx, Stage};
use std::error::Error;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Lines between joints, by their places in [`Found::JOINTS`], with what is nearest to one: a name where it is taken out.
const LINES: [(&str, usize, usize); 17] = [
    ("head", 7, 8),
    ("head", 0, 7),
    ("head", 0, 8),
    ("", 11, 12),
    ("left side", 11, 23),
    ("right side", 12, 24),
    ("", 23, 24),
    ("", 11, 13),
    ("", 12, 14),
    ("left forearm", 13, 19),
    ("right forearm", 14, 20),
    ("", 23, 25),
    ("", 24, 26),
    ("left shank", 25, 27),
    ("right shank", 26, 28),
    ("left foot", 29, 31),
    ("right foot", 30, 32),
];

/// What is taken out at once.
const TAKEN: [&[&str]; 8] = [
    &[],
    &["head"],
    &["left side"],
    &["right side"],
    &["left forearm"],
    &["right forearm"],
    &["left shank", "left foot"],
    &["right shank", "right foot"],
];

fn main() -> Result<(), Box<dyn Error>> {
    let folders: Vec<PathBuf> = std::env::args().skip(1).map(PathBuf::from).collect();
    for pair in folders.chunks(2) {
        let [photos, masks] = pair else {
            return Err("give pairs of folders: photos and their true masks".into());
        };
        let photos = files(photos)?;
        let turn = photos.iter().map(|path| photo(path));
        let input = FindPeopleInput {
            photos: Arc::new(Photos {
                photos: turn.collect::<Result<_, _>>()?,
                ..Photos::default()
            }),
        };
        let people = FindPeople::run(&FindPeopleParams {}, input, &Ctx::alone())
            .map_err(|stop| format!("{stop:?}"))?;
        for (k, (photo, mask)) in photos.iter().zip(&files(masks)?).enumerate() {
            if let Some(found) = people.subject(PhotoId(k as u32)) {
                reported(found, photo, mask)?;
            }
        }
    }
    Ok(())
}

/// A photo of a turn.
fn photo(path: &Path) -> Result<Photo, Box<dyn Error>> {
    let (width, height) = image::image_dimensions(path)?;
    Ok(Photo::of(
        path.display().to_string(),
        [width, height],
        std::fs::read(path)?,
    ))
}

/// The pictures of a folder, by name; both folders have them in the same order, a plate has another name.
fn files(folder: &Path) -> Result<Vec<PathBuf>, Box<dyn Error>> {
    let all = std::fs::read_dir(folder)?.map(|entry| Ok(entry?.path()));
    let mut all = all.collect::<Result<Vec<_>, std::io::Error>>()?;
    all.retain(|path| path.file_stem().is_some_and(|stem| stem != "plate"));
    all.sort();
    Ok(all)
}

/// Prints the lines of a photo.
fn reported(found: &Found, photo: &Path, mask: &Path) -> Result<(), Box<dyn Error>> {
    let (width, height) = image::image_dimensions(photo)?;
    let truth = image::open(mask)?.into_luma8();
    let truth = image::imageops::resize(&truth, width, height, image::imageops::Triangle);
    let truth = Mask {
        width: width as usize,
        height: height as usize,
        data: truth.into_raw(),
    };
    for taken in TAKEN {
        let all = disagreement(found, &without(found, &truth, taken));
        let rows: Vec<String> = all
            .iter()
            .map(|d| format!("[{:.2},{:.4}]", d.lost_px, d.kept))
            .collect();
        let taken = taken.first().unwrap_or(&"nothing");
        println!(
            "{{\"photo\": {photo:?}, \"taken\": \"{taken}\", \"parts\": [{}]}}",
            rows.join(",")
        );
    }
    Ok(())
}

/// The mask without what is nearest to some lines.
fn without(found: &Found, mask: &Mask, taken: &[&str]) -> Mask {
    let mut mask = mask.clone();
    if taken.is_empty() {
        return mask;
    }
    for i in 0..mask.data.len() {
        let at = [(i % mask.width) as f32, (i / mask.width) as f32];
        if mask.data[i] > 0 {
            let apart = |line: &&(&str, usize, usize)| distance(found, at, line.1, line.2);
            let nearest = LINES
                .iter()
                .min_by(|a, b| apart(a).total_cmp(&apart(b)))
                .map_or("", |line| line.0);
            if taken.contains(&nearest) {
                mask.data[i] = 0;
            }
        }
    }
    mask
}

/// Squared distance of a point from the line between two joints. \[px²\]
fn distance(found: &Found, at: [f32; 2], a: usize, b: usize) -> f32 {
    let (a, b) = (found.joints[a].at_px, found.joints[b].at_px);
    let (along, to) = ([b[0] - a[0], b[1] - a[1]], [at[0] - a[0], at[1] - a[1]]);
    let length = along[0] * along[0] + along[1] * along[1];
    let t = (to[0] * along[0] + to[1] * along[1]) / length.max(f32::MIN_POSITIVE);
    let t = t.clamp(0.0, 1.0);
    let (x, y) = (to[0] - t * along[0], to[1] - t * along[1]);
    x * x + y * y
}
