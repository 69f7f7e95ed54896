//! Cameras from a marker mat: poses from its plane, then one adjustment of all.
//!
//! All photos see one plane turned about its own normal: up to the turn that is one homography, and
//! a homography gives two numbers of a lens (Zhang 2000, §2.4), not three. Focal length, the centre's
//! row and the camera's tilt trade off; what is believed of the centre decides (8 px of 2400 are
//! 0.1 % of focal length and 0.15 % of distance), and `scale_sigma` is how much is left open. Tags
//! on the disk's rim give the third.

use crate::adjust::belief::Beliefs;
use crate::adjust::bundle::adjust;
use crate::adjust::rim::RimBelief;
use crate::adjust::scene::{PointObservation, Scene, median_px};
use crate::calibration::found::Found;
use crate::calibration::params::CalibrateParams;
use crate::calibration::prior::{lens_belief, settings};
use crate::calibration::trust::{nudged, uneven, views, warnings};
use crate::mat::bloom::adjust_tags;
use crate::mat::corners::mat_corners;
use crate::mat::planar::planar_pose;
use crate::mat::rim::{GLUE_MM, with_rim};
use crate::two_view::triangulate::{self, Seen};
use nalgebra::Point3;
use shape::{Camera, Cameras, Intrinsics, Mat, PhotoId, Photos, Pose, Scale, Tag, Tags, Tracks};

stage::failures! {
    /// Why a mat gives no cameras.
    pub enum MatError {
        /// Too few photos show it.
        Unseen {
            /// How many do.
            seen: usize,
            /// How many photos there are.
            of: usize,
        } = "fail-mat-unseen": "only {seen} of {of} photos show two tags of the mat: check `[mat]` in capture.toml (family, ids, count), the light on the disk, and that it is in view",
        /// Its tags are elsewhere than in the mat's layout.
        Misfit {
            /// Root mean square. \[px\]
            rms: f64,
        } = "fail-mat-misfit": "the mat in the photos is not as it is given: its tags are seen {rms:.1 px} from where they should be; hand over the mat's own file with --mat, or check tag size, ring radius and numbers",
    }
}

/// A photo, its camera as its tags alone give it, and those tags.
type Placed<'a> = (PhotoId, Pose, &'a Vec<Tag>);

/// Calibrates from tags, and from features that move with the disk.
pub(crate) fn calibrate(
    photos: &Photos,
    lens: &Intrinsics,
    mat: &Mat,
    tags: &Tags,
    tracks: Option<&Tracks>,
    p: &CalibrateParams,
) -> Result<Found, MatError> {
    let placed = placed(lens, mat, tags, photos.photos.len())?;
    let (mut scene, mut observations) = laid_out(lens, mat, &placed, p);
    let beliefs = beliefs(lens, photos, p);
    let settings = settings(p);
    let mut fit = adjust_tags(
        &mut scene,
        &mut observations,
        &beliefs,
        &settings,
        p.bloom_px,
    );
    if fit.rms_px > 3.0 * p.tag_px.max(0.3) || median_px(&scene, &observations) > 2.0 {
        return Err(MatError::Misfit {
            rms: median_px(&scene, &observations),
        });
    }
    let (mut rim_tags, mut rim_warning) = (0, None);
    if let Some(rim) = &photos.rig.rim {
        let own: Vec<&Vec<Tag>> = placed.iter().map(|(_, _, tags)| *tags).collect();
        match with_rim(&scene, &observations, rim, &own, &beliefs, &settings, p) {
            Ok(better) => {
                rim_tags = better.tags;
                (scene, observations, fit) = (better.scene, better.observations, better.fit);
            }
            Err(why) => rim_warning = Some(why.message()),
        }
    }
    let (mut used_tracks, mut points) = (0, vec![]);
    if let Some(tracks) = tracks {
        (used_tracks, points) = add_features(&mut scene, &mut observations, mat, tracks, p);
        fit = adjust(&mut scene, &observations, &beliefs, &settings);
    }
    let mut warnings = warnings(photos, &scene, &fit, &beliefs.lenses[0]);
    warnings.extend(nudged(photos, &scene));
    warnings.extend(uneven(photos, &scene));
    warnings.extend(rim_warning);
    let disk = photos.rig.disk_diameter_mm.map(|d| d / 2.0);
    let cameras = Cameras {
        views: views(photos, &scene, &observations, &fit),
        scale: Scale::Mat,
        scale_sigma: Some(fit.size_sigma),
        disk_radius_mm: disk,
        ground_mm: 0.0,
        points,
    };
    Ok(Found {
        cameras,
        fit,
        warnings,
        used_tracks,
        rim_tags,
    })
}

/// The photos whose tags show where their cameras are, of so many.
fn placed<'a>(
    lens: &Intrinsics,
    mat: &Mat,
    tags: &'a Tags,
    of: usize,
) -> Result<Vec<Placed<'a>>, MatError> {
    let placed: Vec<Placed<'_>> = tags
        .views
        .iter()
        .filter_map(|(id, tags)| Some((id, pose(lens, mat, tags)?, tags)))
        .collect();
    let seen = placed.len();
    match seen {
        ..3 => Err(MatError::Unseen { seen, of }),
        _ => Ok(placed),
    }
}

/// What is believed of the lens, and of the rim's tags where there are any.
fn beliefs(lens: &Intrinsics, photos: &Photos, p: &CalibrateParams) -> Beliefs {
    Beliefs {
        lenses: vec![lens_belief(lens, &photos.rig, p)],
        rim: photos.rig.rim.map(|_| RimBelief {
            round_mm: p.rim_round_mm,
            stretch: p.rim_stretch,
            glue_mm: GLUE_MM,
        }),
        ..Beliefs::default()
    }
}

/// What is adjusted and what was seen of it: the corners of the mat's tags, all of them known.
fn laid_out(
    lens: &Intrinsics,
    mat: &Mat,
    placed: &[Placed<'_>],
    p: &CalibrateParams,
) -> (Scene, Vec<PointObservation>) {
    let mut points = vec![];
    let mut observations = Vec::new();
    for (camera, (_, _, tags)) in placed.iter().enumerate() {
        for tag in tags.iter() {
            let Some(corners) = mat_corners(mat, tag.id) else {
                continue;
            };
            for (corner, at_px) in corners.iter().zip(tag.corners) {
                observations.push(PointObservation {
                    camera,
                    point: points.len(),
                    at_px,
                    sigma_px: p.tag_px,
                });
                points.push(*corner);
            }
        }
    }
    let shots = placed.iter().map(|(id, pose, _)| (*id, *pose));
    let scene = Scene {
        known: points.len(),
        points,
        ..Scene::of_one_lens(*lens, shots)
    };
    (scene, observations)
}

/// Adds features that move with the disk: all of them where the subject stood still, else those on
/// the disk. How many, and where all features are. \[mm\]
fn add_features(
    scene: &mut Scene,
    observations: &mut Vec<PointObservation>,
    mat: &Mat,
    tracks: &Tracks,
    p: &CalibrateParams,
) -> (usize, Vec<[f32; 3]>) {
    let seen = triangulate::triangulated(scene, tracks, 4.0);
    let points = seen
        .iter()
        .map(|s| s.spot.at.coords.map(|x| x as f32).into());
    let rigid = triangulate::median_residual(&seen) < 1.2 * p.feature_px;
    let radius = mat.ring_mm + mat.tag_mm / 2.0;
    let on_disk = |s: &&Seen| {
        let at = s.spot.at;
        at.z.abs() < 4.0 && libm::hypot(at.x, at.y) < radius
    };
    let keep: Vec<&Seen> = seen.iter().filter(|s| rigid || on_disk(s)).collect();
    observations.extend(scene.added(keep.iter().map(|s| &s.spot), p.feature_px));
    (keep.len(), points.collect())
}

/// The pose of one camera from its tags, bad ones left out.
fn pose(lens: &Intrinsics, mat: &Mat, tags: &[Tag]) -> Option<Pose> {
    let mut pairs: Vec<([f64; 2], [f64; 2])> = Vec::new();
    for tag in tags {
        let Some(corners) = mat_corners(mat, tag.id) else {
            continue;
        };
        pairs.extend(
            corners
                .iter()
                .zip(tag.corners)
                .map(|(c, px)| ([c.x, c.y], px)),
        );
    }
    for _ in 0..3 {
        if pairs.len() < 8 {
            return None;
        }
        let found = planar_pose(lens, &pairs)?;
        let camera = Camera {
            lens: *lens,
            pose: found,
        };
        let off = |(p, px): &([f64; 2], [f64; 2])| {
            let at = camera.project(&Point3::new(p[0], p[1], 0.0));
            at.map_or(f64::MAX, |at| libm::hypot(at.x - px[0], at.y - px[1]))
        };
        let most = (shape::upper_median(pairs.iter().map(off)).unwrap_or_default() * 5.0).max(1.5);
        let before = pairs.len();
        pairs.retain(|pair| off(pair) <= most);
        if pairs.len() == before {
            return Some(found);
        }
    }
    planar_pose(lens, &pairs)
}
