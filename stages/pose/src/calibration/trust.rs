//! Whether cameras are to be trusted: what the user should know before he does.

use crate::adjust::bundle::Fit;
use crate::adjust::lens::LensPrior;
use crate::adjust::scene::{PointObservation, Scene};
use crate::calibration::prior::knows_focal;
use nalgebra::Vector3;
use shape::{Camera, Cameras, PhotoId, Photos, Pose, View, upper_median};
use stage::{Message, message};

stage::messages! {
    FEW_TAGS = "warn-few-tags": "shows fewer than two tags";
    SHARES_LITTLE = "warn-shares-little": "shares too little with the other photos";
    NO_CAMERA = "warn-lost": "{name} (photo {number}) {why} and has no camera";
    FOCAL = "warn-focal": "the focal length came out {off:.1 %} from the one in EXIF or capture.toml: check `focal_35mm` or `focal_px`";
    OFF_CIRCLE = "warn-off-circle": "its camera is {off:.1 %} off the circle of the other cameras: did camera or disk move?";
    UNDETERMINED = "warn-degenerate": "the photos do not determine all of the cameras, so their standard deviations are not to be trusted: lay a mat on the disk, or take more photos";
    NUDGED = "warn-nudged": "its camera looks {off:.1 °} away from where the other cameras look: did the camera move?";
    UNEVEN = "warn-uneven-turn": "the disk turned unevenly, now this way, now that: photos should be in turning order";
    NOT_TURNED = "warn-not-turned": "between {before} and {after} the disk did not turn: remove one of them";
    MISFIT = "warn-misfit": "its features are {off:.1 px} from where they should be, {usual:.1 px} on most photos: did camera or subject move?";
    OTHER_STEP = "warn-other-step": "between {before} and {after} the disk turned by {turn:.0 °}, by {usual:.0 °} between most photos: is a photo missing there, or out of its place?";
}

/// Median distance between observations and projections. \[px\]
pub(crate) fn median_px(scene: &Scene, observations: &[PointObservation]) -> f64 {
    let off = |s: &PointObservation| {
        let camera = Camera {
            lens: scene.lens,
            pose: scene.poses[s.camera],
        };
        let at = camera.project(&scene.points[s.point]);
        at.map_or(f64::MAX, |at| {
            libm::hypot(at.x - s.at_px[0], at.y - s.at_px[1])
        })
    };
    upper_median(observations.iter().map(off)).unwrap_or(0.0)
}

/// A photo's camera as it was found, with how far to trust it.
pub(crate) fn view(
    photos: &Photos,
    id: PhotoId,
    camera: usize,
    scene: &Scene,
    observations: &[PointObservation],
    fit: &Fit,
) -> View {
    let own: Vec<PointObservation> = observations
        .iter()
        .filter(|s| s.camera == camera)
        .copied()
        .collect();
    View {
        name: photos.get(id).map_or(String::new(), |p| p.name.clone()),
        camera: Camera {
            lens: scene.lens,
            pose: scene.poses[camera],
        },
        sigma_mm: fit.sigma_mm[camera].filter(|mm| mm.is_finite()),
        rms_px: (!own.is_empty()).then(|| median_px(scene, &own)),
        points: own.len() as u32,
    }
}

/// What the user should know before trusting the cameras.
pub(crate) fn warnings(
    photos: &Photos,
    ids: &[PhotoId],
    scene: &Scene,
    fit: &Fit,
    prior: &LensPrior,
) -> Vec<Message> {
    let mut warnings = Vec::new();
    for (id, photo) in photos.iter().filter(|(id, _)| !ids.contains(id)) {
        let n = id.0;
        let why = match photos.rig.mat.is_some() {
            true => message!(FEW_TAGS),
            false => message!(SHARES_LITTLE),
        };
        warnings.push(message!(
            NO_CAMERA,
            name = &photo.name,
            number = n,
            why = why
        ));
    }
    let off = (scene.lens.focal[0] / prior.mean[0] - 1.0).abs();
    let sure = prior.sigma[0] / prior.mean[0];
    if knows_focal(&photos.rig) && off > (3.0 * sure).max(0.03) {
        warnings.push(message!(FOCAL, off = off * 100.0));
    }
    // A fixed camera and a turning disk: centres are on a circle around the axis.
    let ring: Vec<(f64, f64)> = scene
        .poses
        .iter()
        .map(|p| p.centre())
        .map(|c| (libm::hypot(c.x, c.y), c.z))
        .collect();
    let count = ring.len() as f64;
    let (radius, height) = (
        ring.iter().map(|r| r.0).sum::<f64>() / count,
        ring.iter().map(|r| r.1).sum::<f64>() / count,
    );
    for (id, (r, z)) in ids.iter().zip(&ring) {
        let out = libm::hypot(r - radius, z - height) / radius;
        if out > 0.02 {
            let name = photos.get(*id).map_or("", |p| p.name.as_str());
            warnings.push(message!(OFF_CIRCLE, off = out * 100.0).of_what(name));
        }
    }
    if fit.sigma_mm.iter().flatten().any(|s| !s.is_finite()) {
        warnings.push(message!(UNDETERMINED));
    }
    warnings
}

/// Photos on which the camera looks elsewhere than on the rest.
pub(crate) fn nudged(photos: &Photos, ids: &[PhotoId], poses: &[Pose]) -> Vec<Message> {
    let warning = |(i, degrees): (usize, f64)| {
        let name = photos.get(ids[i]).map_or("", |p| p.name.as_str());
        message!(NUDGED, off = degrees).of_what(name)
    };
    turned(poses).into_iter().map(warning).collect()
}

/// Share of the distance, or angle \[rad\], by which the disk may seem to move before a fixed camera. By hand: not on
/// record.
const MOVED_SHARE: f64 = 0.01;

/// Cameras before which the disk's centre is elsewhere than before most, and by what angle. \[°\]
/// A fixed camera sees it in one place all the time, be the disk turned as it may.
fn turned(poses: &[Pose]) -> Vec<(usize, f64)> {
    let middle =
        |axis: usize| upper_median(poses.iter().map(|p| p.translation[axis])).unwrap_or(0.0);
    let usual = Vector3::new(middle(0), middle(1), middle(2));
    let off = |p: &Pose| p.translation.angle(&usual);
    let places = poses.iter().map(off).enumerate();
    places
        .filter(|(_, off)| *off > MOVED_SHARE)
        .map(|(i, off)| (i, off.to_degrees()))
        .collect()
}

/// A disk that turned by less than this did not turn. By hand: not on record. \[°\]
const STILL_DEG: f64 = 0.5;

/// Between which photos the disk, seen by its mat, did not turn or turned otherwise than between
/// most: photos saved twice, missing, or out of their place.
pub(crate) fn uneven(photos: &Photos, ids: &[PhotoId], poses: &[Pose]) -> Vec<Message> {
    let turns: Vec<f64> = poses
        .windows(2)
        .map(|w| {
            let between = w[0].rotation.inverse() * w[1].rotation;
            libm::atan2(between[(1, 0)], between[(0, 0)]).to_degrees()
        })
        .collect();
    let usual = upper_median(&turns).unwrap_or(0.0);
    // Who turns by hand turns unevenly, but not back.
    let even = photos.rig.step.is_some();
    let odd = |turn: f64| {
        let off = (turn - usual).abs() > 0.5 * usual.abs() + STILL_DEG;
        off && (even || turn * usual < 0.0)
    };
    if 3 * turns.iter().filter(|t| odd(**t)).count() > turns.len() {
        return vec![message!(UNEVEN)];
    }
    let name = |i: usize| photos.get(ids[i]).map_or("", |p| p.name.as_str());
    let warning = |(i, turn): (usize, &f64)| {
        let (a, b) = (name(i), name(i + 1));
        let followed = ids[i].0 + 1 == ids[i + 1].0;
        match turn.abs() < STILL_DEG {
            true => Some(message!(NOT_TURNED, before = a, after = b)),
            false if odd(*turn) && followed => Some(message!(
                OTHER_STEP,
                before = a,
                after = b,
                turn = turn,
                usual = usual
            )),
            false => None,
        }
    };
    turns.iter().enumerate().filter_map(warning).collect()
}

/// Photos whose features fit far worse than those of most.
pub(crate) fn misfits(cameras: &Cameras) -> Vec<Message> {
    let known: Vec<(&str, f64)> = cameras
        .views
        .values()
        .filter_map(|v| Some((v.name.as_str(), v.rms_px?)))
        .collect();
    let usual = upper_median(known.iter().map(|(_, px)| *px)).unwrap_or(0.0);
    let worse = |(_, px): &&(&str, f64)| *px > 4.0 * usual && *px > 2.0;
    let warning =
        |(name, px): &(&str, f64)| message!(MISFIT, off = *px, usual = usual).of_what(*name);
    known.iter().filter(worse).map(warning).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Rotation3;

    #[test]
    fn a_camera_that_was_nudged_is_named_by_its_photo() {
        let pose = |i: u32| Pose {
            rotation: Rotation3::from_euler_angles(1.8, 0.0, 0.3 * f64::from(i)),
            translation: Vector3::new(3.0, 340.0, 1770.0 + f64::from(i % 3)),
        };
        let mut poses: Vec<Pose> = (0..9).map(pose).collect();
        assert_eq!(turned(&poses), vec![]);
        // A turn of the camera about its own centre: the ring does not show it.
        let nudge = Rotation3::from_euler_angles(0.0, 0.026, 0.0);
        poses[4].rotation = nudge * poses[4].rotation;
        poses[4].translation = nudge * poses[4].translation;
        let found = turned(&poses);
        assert!(found.len() == 1 && found[0].0 == 4, "{found:?}");
        proof::near(found[0].1, 0.026f64.to_degrees(), 0.1);
    }

    #[test]
    fn photos_that_are_missing_or_twice_are_named_by_the_mat() {
        let found = |places: &[f64]| {
            let pose = |place: &f64| Pose {
                rotation: Rotation3::from_euler_angles(1.8, 0.0, 0.0)
                    * Rotation3::from_euler_angles(0.0, 0.0, place * -20f64.to_radians()),
                translation: Vector3::new(3.0, 340.0, 1770.0),
            };
            let poses: Vec<Pose> = places.iter().map(pose).collect();
            let ids: Vec<PhotoId> = (0..poses.len() as u32).map(PhotoId).collect();
            let mut photos = Photos::default();
            photos.rig.step = Some(20f64.to_radians());
            uneven(&photos, &ids, &poses)
        };
        let even: Vec<f64> = (0..18).map(f64::from).collect();
        assert_eq!(found(&even), Vec::<Message>::new());
        let (mut twice, mut missing, mut shuffled) = (even.clone(), even.clone(), even);
        twice.insert(4, 4.001);
        let warnings = found(&twice);
        assert!(
            warnings.len() == 1 && warnings[0].contains("did not turn"),
            "{warnings:?}"
        );
        missing.remove(7);
        let warnings = found(&missing);
        assert!(
            warnings.len() == 1 && warnings[0].contains("turned by -40°"),
            "{warnings:?}"
        );
        (0..18).for_each(|i| shuffled[i] = f64::from((7 * i as u32) % 18));
        shuffled.swap(2, 9);
        shuffled.swap(4, 15);
        shuffled.swap(6, 12);
        let warnings = found(&shuffled);
        assert!(
            warnings.len() == 1 && warnings[0].contains("turning order"),
            "{warnings:?}"
        );
    }
}
