//! Tags on the disk's rim beside those on the disk: the third number of the lens.
//!
//! Marks of known size that are not on the disk show what a turned plane leaves open. Only the
//! sizes of the tags are taken at their word; see [`crate::adjust::rim`].

use crate::adjust::belief::Beliefs;
use crate::adjust::bundle::{Fit, Settings};
use crate::adjust::rim::{OnRim, met};
use crate::adjust::scene::{PointObservation, Scene, scatter_px};
use crate::calibration::params::CalibrateParams;
use crate::mat::bloom::adjust_tags;
use nalgebra::{Point3, Vector2};
use shape::{Camera, Rim, Tag, upper_median};
use stage::{Message, message};
use std::collections::BTreeMap;

stage::messages! {
    UNSEEN = "warn-rim-few": "capture.toml has tags on the disk's rim, but only {count} observations of them are good for anything: check `[rim]` (ids, count, radius), the light on the rim, and that it is in view";
    MISFIT = "warn-rim-off": "the tags on the disk's rim are {rim:.2 px} from where they should be, those on the disk {mat:.2 px}: they were left out; measure a printed tag and the disk, and check `tag_size_mm` and `radius_mm` of `[rim]`";
}

/// How far along the rim and how deep a tag may sit from where it seems to at first. By hand: looked at one capture,
/// halved and doubled: no more than chance (docs/lab/numbers.md). \[mm\]
pub(crate) const GLUE_MM: f64 = 5.0;
/// A tag that is seen more aslant than this (cosine) is left out. By hand: looked at one capture: halved, rotations
/// +0.02°; doubled, no more than chance (docs/lab/numbers.md).
const LEAST_FACING: f64 = 0.45;
/// And one with a side shorter than this: 1.25 pixels a module. By hand: looked at one capture: halved, nothing
/// changes; doubled, rotations +0.02° (docs/lab/numbers.md). \[px\]
const SHORTEST_PX: f64 = 10.0;
/// Fewest observations of tags that are worth it. By hand: looked at one capture, halved and doubled: nothing changes,
/// for its tags are seen more often (docs/lab/numbers.md).
const LEAST_SIGHTINGS: usize = 8;
/// Corners that scatter more than this are not of the strip that was given. By hand: looked at one capture, halved and
/// doubled: nothing changes, for its strip is the one that was given (docs/lab/numbers.md). \[px\]
const MOST_SCATTER_PX: f64 = 0.4;

/// Cameras that know the rim, too.
pub(crate) struct Better {
    pub(crate) scene: Scene,
    pub(crate) observations: Vec<PointObservation>,
    pub(crate) fit: Fit,
    /// How many tags were used.
    pub(crate) tags: usize,
}

/// Why the rim is of no use.
#[derive(Debug)]
pub(crate) enum RimError {
    Unseen(usize),
    Misfit { rim: f64, mat: f64 },
}

impl RimError {
    /// As people read it.
    pub(crate) fn message(&self) -> Message {
        match self {
            RimError::Unseen(count) => message!(UNSEEN, count = count),
            RimError::Misfit { rim, mat } => message!(MISFIT, rim = rim, mat = mat),
        }
    }
}

/// Adjusts cameras that follow from the mat once more, to mat and rim. `tags`: those of each camera.
pub(crate) fn with_rim(
    scene: &Scene,
    observations: &[PointObservation],
    rim: &Rim,
    tags: &[&Vec<Tag>],
    beliefs: &Beliefs,
    settings: &Settings,
    p: &CalibrateParams,
) -> Result<Better, RimError> {
    let mut middles: BTreeMap<u32, Vec<[f64; 2]>> = BTreeMap::new();
    let mut seen: Vec<(usize, &Tag)> = Vec::new();
    for (camera, tags) in tags.iter().enumerate() {
        let eye = scene.camera(camera);
        let ids = rim.first_id..rim.first_id + rim.count;
        for tag in tags.iter().filter(|t| ids.contains(&t.id)) {
            if let Some(middle) = middle(&eye, tag, rim) {
                middles.entry(tag.id).or_default().push(middle);
                seen.push((camera, tag));
            }
        }
    }
    if seen.len() < LEAST_SIGHTINGS {
        return Err(RimError::Unseen(seen.len()));
    }
    let place: BTreeMap<u32, usize> = middles.keys().copied().zip(0..).collect();
    let first = scene.points.len();
    let on_rim = OnRim::new(rim, first, middles.values().map(|m| medians(m)).collect());
    let (mut scene, mut observations) = (scene.clone(), observations.to_vec());
    scene.points.extend(on_rim.corners());
    scene.known = scene.points.len();
    scene.rim = Some(on_rim);
    let on_disk = observations.len();
    for (camera, tag) in seen {
        for (k, at_px) in tag.corners.into_iter().enumerate() {
            observations.push(PointObservation {
                camera,
                point: first + 4 * place[&tag.id] + k,
                at_px,
                sigma_px: p.tag_px,
            });
        }
    }
    let fit = adjust_tags(&mut scene, &mut observations, beliefs, settings, p.bloom_px);
    let (mat, rim) = (
        scatter_px(&scene, &observations[..on_disk]),
        scatter_px(&scene, &observations[on_disk..]),
    );
    if rim > MOST_SCATTER_PX.max(4.0 * mat) {
        return Err(RimError::Misfit { rim, mat });
    }
    Ok(Better {
        scene,
        observations,
        fit,
        tags: middles.len(),
    })
}

/// Where a tag's middle is on the rim, if it is seen well: angle and height. \[rad, mm\]
fn middle(eye: &Camera, tag: &Tag, rim: &Rim) -> Option<[f64; 2]> {
    let corners = tag.corners.map(Vector2::from);
    let side = |i: usize| (corners[(i + 1) % 4] - corners[i]).norm();
    let px = corners.iter().sum::<Vector2<f64>>() / 4.0;
    let (angle, height) = met(eye, px.into(), rim.radius_mm)?;
    let (sin, cos) = libm::sincos(angle);
    let at = Point3::new(rim.radius_mm * cos, rim.radius_mm * sin, height);
    let to = (eye.centre() - at).normalize();
    let facing = to.x * cos + to.y * sin > LEAST_FACING;
    (facing && (0..4).all(|i| side(i) > SHORTEST_PX)).then_some([angle, height])
}

/// The median of heights, and of angles about the first.
fn medians(all: &[[f64; 2]]) -> [f64; 2] {
    use std::f64::consts::{PI, TAU};
    let first = all[0][0];
    let about = |a: &[f64; 2]| (a[0] - first + PI).rem_euclid(TAU) - PI;
    [
        first + upper_median(all.iter().map(about)).unwrap_or_default(),
        upper_median(all.iter().map(|a| a[1])).unwrap_or_default(),
    ]
}
