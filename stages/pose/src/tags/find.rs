//! The stage that finds the marker tags on the photos.

use crate::mat::recognise::{another, ringed};
use crate::tags::corners::refined;
use rayon::prelude::*;
use shape::{ByPhoto, LOOKED_AT_MPX, Photo, PhotoId, Photos, Tag, Tags};
use stage::{Ctx, Message, Stage, Stop, message};
use std::sync::Arc;

stage::messages! {
    UNUSED = "warn-tags-unused": "marker tags (family 36h11, numbers {first} to {last}) are seen on {seen} of {photos} photos that were searched, but none are given, so they are not used; {layout}";
    AS_MAT = "warn-tags-mat": "they are as on a mat of `tailor mat` ({count} tags on a ring of {ring:.2} times a tag's size): give the edge length of a printed tag's black square as you measure it, such as --mat-tag 60, or hand over the mat's own file with --mat";
    NO_MAT = "warn-tags-strange": "they are not as on a mat of `tailor mat`: describe them in `[mat]` of capture.toml, or cover them";
}

stage::params! {
    /// How tags are searched.
    pub struct TagsParams {
        /// Factor by which the photo is reduced before quads are searched; corners are refined at
        /// full size.
        #[range(1.0..=8.0)]
        #[source(structural)]
        decimate: f64 = 1.0,
        /// Wrong bits of a tag that are corrected.
        #[range(0..=3)]
        #[source(by_hand = "four captures: halved, rotations −0.01° for one; doubled, no more than chance (docs/lab/numbers.md)")]
        correct_bits: u32 = 1,
        /// Most photos that are searched, spread over the turn; 0 for all.
        #[range(0..=5000)]
        #[source(structural)]
        most: u32 = 0,
    }
}

stage::inputs! {
    /// Photos.
    pub struct TagsInput {
        /// The photos to search.
        photos: Arc<Photos>,
    }
}

/// A detector that cannot be set up.
#[derive(Debug, thiserror::Error)]
#[error("the tag detector cannot be set up: {0}")]
pub struct NoDetector(String);

/// Of a pixel: its colours, its brightness, what the detector makes of it (structural: what the buffers hold). \[bytes\]
const TAGS_PIXEL: u64 = 48;

/// `pose.tags`: photos → tags. Where none are given, a glance at three photos decides whether to look.
pub struct FindTags;

impl Stage for FindTags {
    const NAME: &'static str = "pose.tags";
    const VERSION: u32 = 4;
    const ABOUT: &'static str =
        "Finds AprilTags (family 36h11, Olson 2011) and their corners to a part of a pixel.";
    type Params = TagsParams;
    type Input = TagsInput;
    type Output = Tags;
    const METRICS: &'static [&'static str] = &["tags a photo"];

    /// A photo a thread: its colours, its brightness, and what the detector makes of it.
    fn memory(_: &TagsParams, input: &TagsInput) -> u64 {
        input.photos.most_pixels() * TAGS_PIXEL * rayon::current_num_threads() as u64
    }

    fn run(p: &TagsParams, input: TagsInput, ctx: &Ctx<'_>) -> Result<Tags, Stop> {
        let all: Vec<(PhotoId, &Photo)> = input.photos.iter().collect();
        let given = input.photos.rig.tagged();
        if !given && !glanced(&all, p, ctx)? {
            return Ok(Tags::default());
        }
        let all = spread(all, p.most as usize);
        let steps = ctx.steps("photos", all.len());
        let find = |(id, photo): &(PhotoId, &Photo)| -> Result<(PhotoId, Vec<Tag>), Stop> {
            let found: Tags = ctx.part("tags", &[photo.content()], || {
                let tags = find(photo, p)?;
                Ok(Tags {
                    views: [(PhotoId(0), tags)].into_iter().collect(),
                })
            })?;
            steps.tick()?;
            Ok((
                *id,
                found.views.get(PhotoId(0)).cloned().unwrap_or_default(),
            ))
        };
        let views: Vec<_> = all.par_iter().map(find).collect::<Result<_, _>>()?;
        let views: ByPhoto<Vec<Tag>> = views.into_iter().collect();
        let count: usize = views.values().map(Vec::len).sum();
        ctx.metric("tags a photo", count as f64 / views.len().max(1) as f64, "");
        let tags = Tags { views };
        if !given {
            unused_tags(&tags).iter().for_each(|w| ctx.warn(w));
        }
        let mat = input.photos.rig.mat.as_ref();
        mat.and_then(|mat| another(&tags, mat))
            .iter()
            .for_each(|w| ctx.warn(w));
        Ok(tags)
    }
}

/// So many of all, evenly spread; all for 0.
fn spread<T: Copy>(all: Vec<T>, most: usize) -> Vec<T> {
    match (1..all.len()).contains(&most) {
        true => (0..most).map(|k| all[k * all.len() / most]).collect(),
        false => all,
    }
}

/// So many photos are glanced at where no tags are given (structural: a cap on work).
const GLANCED_PHOTOS: usize = 3;
/// What is found at a glance need not be found exactly: photos are reduced by this (structural: a cap on work).
const GLANCE_REDUCED: f64 = 2.0;

/// Whether tags show on some photos, spread over the turn: three of one photo are no chance.
fn glanced(all: &[(PhotoId, &Photo)], p: &TagsParams, ctx: &Ctx<'_>) -> Result<bool, Stop> {
    let quick = TagsParams {
        decimate: p.decimate.max(GLANCE_REDUCED),
        correct_bits: 0,
        most: 0,
    };
    let some = spread(all.to_vec(), GLANCED_PHOTOS)
        .into_iter()
        .map(|(_, photo)| photo);
    let count = |photo: &Photo| -> Result<usize, Stop> {
        ctx.check()?;
        Ok(find(photo, &quick)?.len())
    };
    let some: Vec<&Photo> = some.collect();
    let counts: Vec<usize> = some
        .par_iter()
        .map(|photo| count(photo))
        .collect::<Result<_, _>>()?;
    Ok(counts.iter().any(|tags| *tags >= 3))
}

/// The warning on tags that were not given.
fn unused_tags(tags: &Tags) -> Option<Message> {
    let seen = tags.views.values().filter(|v| !v.is_empty()).count();
    let ids = || tags.views.values().flatten().map(|t| t.id);
    let (first, last) = (ids().min()?, ids().max()?);
    let layout = match ringed(tags) {
        Some(ring) => message!(AS_MAT, count = ring.count, ring = ring.ring),
        None => message!(NO_MAT),
    };
    Some(message!(
        UNUSED,
        first = first,
        last = last,
        seen = seen,
        photos = tags.views.len(),
        layout = layout
    ))
}

/// The whole factor by which a photo has more pixels along a side than it is looked at with: tags are looked for there,
/// and read and placed at full size.
fn decimation(photo: &Photo) -> f64 {
    let mpx = f64::from(photo.width) * f64::from(photo.height) / 1e6;
    (mpx / LOOKED_AT_MPX).sqrt().floor().max(1.0)
}

/// The tags of one photo, sorted by number; a number that is seen twice is nobody's.
fn find(photo: &Photo, p: &TagsParams) -> Result<Vec<Tag>, Stop> {
    let gray = photo.decode()?.gray();
    let no = |e: String| NoDetector(e);
    let mut image = apriltag::Image::zeros_with_alignment(gray.width, gray.height, 96)
        .map_err(|e| no(e.to_string()))?;
    let stride = image.stride();
    for (y, row) in gray.data.chunks(gray.width).enumerate() {
        for (x, v) in row.iter().enumerate() {
            image.as_slice_mut()[y * stride + x] = v.round() as u8;
        }
    }
    let family = apriltag::Family::tag_36h11();
    let mut detector = apriltag::DetectorBuilder::new()
        .add_family_bits(family, p.correct_bits as usize)
        .build()
        .map_err(|e| no(e.to_string()))?;
    detector.set_thread_number(1);
    detector.set_decimation(p.decimate.max(decimation(photo)) as f32);
    // The library's own refinement takes sines from the system: its last digits differ between systems.
    detector.set_refine_edges(false);
    let mut tags: Vec<Tag> = detector
        .detect(&image)
        .iter()
        .map(|found| {
            // The library's corners run from the top right against the clock, and its pixels have their centres
            // at halves.
            let [tr, tl, bl, br] = found.corners().map(|[x, y]| [x - 0.5, y - 0.5]);
            Tag {
                id: found.id() as u32,
                corners: refined(&gray, refined(&gray, [tl, tr, br, bl])),
            }
        })
        .collect();
    tags.sort_by_key(|t| t.id);
    let twice: Vec<u32> = tags
        .windows(2)
        .filter(|w| w[0].id == w[1].id)
        .map(|w| w[0].id)
        .collect();
    tags.retain(|t| !twice.contains(&t.id));
    Ok(tags)
}
