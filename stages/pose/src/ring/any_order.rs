//! Cameras of photos in any order: from two photos on, one more at a time (Snavely, Seitz and
//! Szeliski 2006), adjusted after each.

use crate::adjust::bundle::{Fit, adjust};
use crate::adjust::scene::{Beliefs, PointObservation, Scene, Settings};
use crate::calibration::params::CalibrateParams;
use crate::calibration::prior::{focals, lens_belief, settings};
use crate::ring::cameras::Solved;
use crate::ring::error::TracksError;
use crate::ring::pairs::{LEAST_FEATURES, chosen};
use crate::ring::trial::{filled, spread_px};
use crate::two_view::resection::{at_origin, resected, two_views};
use crate::two_view::triangulate::{Seen, triangulated};
use nalgebra::Point3;
use shape::triangulate;
use shape::{Camera, Intrinsics, PhotoId, Photos, Pose, Tracks};

/// How many pairs are tried as a beginning (structural: the width of a search).
const BEGINNINGS: usize = 8;

/// A point that is triangulated already, and where one more photo shows it. \[mm, px\]
type KnownPoint = (Point3<f64>, [f64; 2]);

/// Cameras found so far.
struct Grown {
    ids: Vec<PhotoId>,
    scene: Scene,
    /// How much is explained.
    score: f64,
}

/// Grows cameras over all photos that hold on to the rest, from the focal length that explains
/// most.
pub(crate) fn grown(
    photos: &Photos,
    lens: &Intrinsics,
    tracks: &Tracks,
    p: &CalibrateParams,
) -> Result<Solved, TracksError> {
    let few = chosen(tracks, p.most_tracks as usize);
    let all: Vec<PhotoId> = photos.iter().map(|(id, _)| id).collect();
    let mut best: Option<Grown> = None;
    for focal in focals(photos, lens) {
        let lens = Intrinsics {
            focal: [focal; 2],
            ..*lens
        };
        let beliefs = beliefs(&lens, photos, p);
        let found = grow(&lens, &all, &few, &beliefs, p);
        if let Some(found) = found
            && best.as_ref().is_none_or(|b| found.score > b.score)
        {
            best = Some(found);
        }
    }
    let Some(Grown { ids, mut scene, .. }) = best else {
        return Err(TracksError::NoBeginning);
    };
    let many = chosen(tracks, p.most_tracks as usize);
    let beliefs = beliefs(&scene.lens, photos, p);
    let mut sigma_px = p.feature_px;
    let mut last: Option<(Vec<PointObservation>, Fit)> = None;
    for _ in 0..4 {
        let seen = triangulated(&scene.lens, &scene.poses, &ids, &many, 8.0 * sigma_px);
        sigma_px = spread_px(&seen).max(p.feature_px);
        let observations = filled(&mut scene, &seen, sigma_px);
        let fit = adjust(&mut scene, &observations, &beliefs, &settings(p));
        last = Some((observations, fit));
    }
    let (observations, fit) = last.expect("bug: no round was adjusted");
    let share = scene.points.len() as f64 / many.points.len().max(1) as f64;
    // By photo, as everybody expects.
    let mut order: Vec<usize> = (0..ids.len()).collect();
    order.sort_by_key(|i| ids[*i]);
    let mut place = vec![0; ids.len()];
    order
        .iter()
        .enumerate()
        .for_each(|(new, old)| place[*old] = new);
    scene.poses = order.iter().map(|i| scene.poses[*i]).collect();
    let moved = |s: &PointObservation| PointObservation {
        camera: place[s.camera],
        ..*s
    };
    Ok(Solved {
        ids: order.iter().map(|i| ids[*i]).collect(),
        observations: observations.iter().map(moved).collect(),
        fit: Fit {
            sigma_mm: order.iter().map(|i| fit.sigma_mm[*i]).collect(),
            ..fit
        },
        scene,
        share,
        prior: beliefs.lens,
    })
}

/// Points further from where they were seen are left out while cameras are added: as many times what is believed at
/// most as features of a good fit are off. \[px\]
fn fits_px(p: &CalibrateParams) -> f64 {
    p.loss * p.most_px
}

fn beliefs(lens: &Intrinsics, photos: &Photos, p: &CalibrateParams) -> Beliefs {
    Beliefs {
        lens: lens_belief(lens, &photos.rig, p),
        steps: None,
        rim: None,
    }
}

/// Adjusts what is there, twice, points triangulated anew.
fn readjust(grown: &mut Grown, tracks: &Tracks, beliefs: &Beliefs, p: &CalibrateParams) {
    let short = Settings {
        steps: 12,
        ..settings(p)
    };
    for most in [2.0 * fits_px(p), fits_px(p)] {
        let seen = seen(grown, tracks, most);
        let observations = filled(&mut grown.scene, &seen, p.feature_px);
        adjust(&mut grown.scene, &observations, beliefs, &short);
    }
    let seen = seen(grown, tracks, fits_px(p));
    grown.score = seen
        .iter()
        .map(|s| s.observations.len() as f64 / (1.0 + s.rms_px * s.rms_px))
        .sum();
}

fn seen(grown: &Grown, tracks: &Tracks, most: f64) -> Vec<Seen> {
    let scene = &grown.scene;
    triangulated(&scene.lens, &scene.poses, &grown.ids, tracks, most)
}

/// From the best beginning over all that hold on.
fn grow(
    lens: &Intrinsics,
    all: &[PhotoId],
    tracks: &Tracks,
    beliefs: &Beliefs,
    p: &CalibrateParams,
) -> Option<Grown> {
    let mut grown = begun(lens, all, tracks, beliefs, p)?;
    loop {
        let mut next: Vec<(PhotoId, Vec<KnownPoint>)> = all
            .iter()
            .filter(|id| !grown.ids.contains(id))
            .map(|id| (*id, known_points(&grown, *id, tracks, fits_px(p))))
            .filter(|(_, known)| known.len() >= LEAST_FEATURES)
            .collect();
        next.sort_by_key(|(id, known)| (std::cmp::Reverse(known.len()), *id));
        let added = next.into_iter().find_map(|(id, known)| {
            let near = grown.scene.poses.as_slice();
            let pose = resected(&grown.scene.lens, near, &known, fits_px(p))?;
            Some((id, pose))
        });
        let Some((id, pose)) = added else {
            return Some(grown);
        };
        grown.ids.push(id);
        grown.scene.poses.push(pose);
        readjust(&mut grown, tracks, beliefs, p);
    }
}

/// Points by the cameras so far, and where one more photo shows them.
fn known_points(grown: &Grown, id: PhotoId, tracks: &Tracks, fits_px: f64) -> Vec<KnownPoint> {
    let camera = |pose: &Pose| Camera {
        lens: grown.scene.lens,
        pose: *pose,
    };
    let cameras: Vec<Camera> = grown.scene.poses.iter().map(camera).collect();
    let one = |track: &Vec<shape::Observation>| {
        let here = track.iter().find(|s| s.photo == id)?;
        let observations: Vec<(usize, [f64; 2])> = track
            .iter()
            .filter_map(|s| {
                let at = grown.ids.iter().position(|id| *id == s.photo)?;
                Some((at, s.at_px.map(f64::from)))
            })
            .collect();
        let (point, rms) = triangulate(&cameras, &observations)?;
        (rms < fits_px).then_some((point, here.at_px.map(f64::from)))
    };
    tracks.points.iter().filter_map(one).collect()
}

/// Two photos with much in common, seen from well apart.
fn begun(
    lens: &Intrinsics,
    all: &[PhotoId],
    tracks: &Tracks,
    beliefs: &Beliefs,
    p: &CalibrateParams,
) -> Option<Grown> {
    let mut pairs: Vec<(usize, PhotoId, PhotoId)> = Vec::new();
    for (k, a) in all.iter().enumerate() {
        for b in &all[k + 1..] {
            let both = common(tracks, *a, *b).len();
            if both >= 3 * LEAST_FEATURES {
                pairs.push((both, *a, *b));
            }
        }
    }
    pairs.sort_by_key(|(both, a, b)| (std::cmp::Reverse(*both), *a, *b));
    let mut best: Option<Grown> = None;
    for (_, a, b) in pairs.into_iter().take(BEGINNINGS) {
        let both = common(tracks, a, b);
        let Some(pose) = two_views(lens, &both) else {
            continue;
        };
        let mut grown = Grown {
            ids: vec![a, b],
            scene: Scene {
                lens: *lens,
                poses: vec![at_origin(), pose],
                ring: None,
                points: vec![],
                known: 0,
                rim: None,
            },
            score: 0.0,
        };
        // Two photos know little of a lens.
        let mut tight = beliefs.clone();
        tight.lens.sigma = tight.lens.sigma.map(|s| s * 1e-3);
        readjust(&mut grown, tracks, &tight, p);
        if best.as_ref().is_none_or(|best| grown.score > best.score) {
            best = Some(grown);
        }
    }
    best
}

/// Where two photos show the same points.
fn common(tracks: &Tracks, a: PhotoId, b: PhotoId) -> Vec<[[f64; 2]; 2]> {
    let one = |track: &Vec<shape::Observation>| {
        let on = |id: PhotoId| track.iter().find(|s| s.photo == id);
        Some([on(a)?.at_px.map(f64::from), on(b)?.at_px.map(f64::from)])
    };
    tracks.points.iter().filter_map(one).collect()
}
