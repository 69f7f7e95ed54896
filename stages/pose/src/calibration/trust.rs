//! Whether cameras are to be trusted: what the user should know before he does.

use crate::adjust::bundle::Fit;
use crate::adjust::lens::LensPrior;
use crate::adjust::scene::{PointObservation, Scene, Shot, offs};
use crate::calibration::prior::knows_focal;
use nalgebra::Vector3;
use shape::{ByPhoto, Cameras, Photos, View, upper_median};
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

/// Each photo's camera as it was found, with how far to trust it.
pub(crate) fn views(
    photos: &Photos,
    scene: &Scene,
    observations: &[PointObservation],
    fit: &Fit,
) -> ByPhoto<View> {
    let mut own: Vec<Vec<f64>> = vec![Vec::new(); scene.shots.len()];
    let all = offs(scene, observations).into_iter().zip(observations);
    all.for_each(|(off, o)| own[o.camera].push(off));
    let view = |((s, shot), own): ((usize, &Shot), Vec<f64>)| {
        let photo = photos.get(shot.photo);
        let view = View {
            name: photo.map_or(String::new(), |p| p.name.clone()),
            camera: scene.camera(s),
            sigma_mm: fit.sigma_mm[s].filter(|mm| mm.is_finite()),
            points: own.len() as u32,
            rms_px: upper_median(own),
        };
        (shot.photo, view)
    };
    let shots = scene.shots.iter().enumerate();
    shots.zip(own).map(view).collect()
}

/// What the user should know before trusting the cameras.
pub(crate) fn warnings(
    photos: &Photos,
    scene: &Scene,
    fit: &Fit,
    prior: &LensPrior,
) -> Vec<Message> {
    let mut warnings = Vec::new();
    let has_camera = |id| scene.shots.iter().any(|s| s.photo == id);
    for (id, photo) in photos.iter().filter(|(id, _)| !has_camera(*id)) {
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
    let off = (scene.lenses[0].focal[0] / prior.mean[0] - 1.0).abs();
    let sure = prior.sigma[0] / prior.mean[0];
    if knows_focal(&photos.rig) && off > (3.0 * sure).max(0.03) {
        warnings.push(message!(FOCAL, off = off * 100.0));
    }
    // A fixed camera and a turning disk: centres are on a circle around the axis.
    let ring: Vec<(f64, f64)> = scene
        .shots
        .iter()
        .map(|s| s.pose.centre())
        .map(|c| (libm::hypot(c.x, c.y), c.z))
        .collect();
    let count = ring.len() as f64;
    let (radius, height) = (
        ring.iter().map(|r| r.0).sum::<f64>() / count,
        ring.iter().map(|r| r.1).sum::<f64>() / count,
    );
    for (shot, (r, z)) in scene.shots.iter().zip(&ring) {
        let out = libm::hypot(r - radius, z - height) / radius;
        if out > 0.02 {
            let name = name(photos, shot);
            warnings.push(message!(OFF_CIRCLE, off = out * 100.0).of_what(name));
        }
    }
    if fit.sigma_mm.iter().flatten().any(|s| !s.is_finite()) {
        warnings.push(message!(UNDETERMINED));
    }
    warnings
}

/// The name of a shot's photo.
fn name<'a>(photos: &'a Photos, shot: &Shot) -> &'a str {
    photos.get(shot.photo).map_or("", |p| p.name.as_str())
}

/// Photos on which the camera looks elsewhere than on the rest.
pub(crate) fn nudged(photos: &Photos, scene: &Scene) -> Vec<Message> {
    let warning = |(i, degrees): (usize, f64)| {
        message!(NUDGED, off = degrees).of_what(name(photos, &scene.shots[i]))
    };
    turned(&scene.shots).into_iter().map(warning).collect()
}

/// Share of the distance, or angle \[rad\], by which the disk may seem to move before a fixed camera. By hand: looked
/// at five captures, halved and doubled: nothing changes, for none has a camera that was nudged (docs/lab/numbers.md).
const MOVED_SHARE: f64 = 0.01;

/// Cameras before which the disk's centre is elsewhere than before most, and by what angle. \[°\]
/// A fixed camera sees it in one place all the time, be the disk turned as it may.
fn turned(shots: &[Shot]) -> Vec<(usize, f64)> {
    let shifts = || shots.iter().map(|s| s.pose.translation);
    let middle = |axis: usize| upper_median(shifts().map(|t| t[axis])).unwrap_or(0.0);
    let usual = Vector3::new(middle(0), middle(1), middle(2));
    let places = shifts().map(|t| t.angle(&usual)).enumerate();
    places
        .filter(|(_, off)| *off > MOVED_SHARE)
        .map(|(i, off)| (i, off.to_degrees()))
        .collect()
}

/// A disk that turned by less than this did not turn. By hand: looked at three captures, halved and doubled: nothing
/// changes, for none has a photo twice (docs/lab/numbers.md). \[°\]
const STILL_DEG: f64 = 0.5;

/// Between which photos the disk, seen by its mat, did not turn or turned otherwise than between
/// most: photos saved twice, missing, or out of their place.
pub(crate) fn uneven(photos: &Photos, scene: &Scene) -> Vec<Message> {
    let shots = &scene.shots;
    let turns: Vec<f64> = shots
        .windows(2)
        .map(|w| {
            let between = w[0].pose.rotation.inverse() * w[1].pose.rotation;
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
    let warning = |(i, turn): (usize, &f64)| {
        let (a, b) = (name(photos, &shots[i]), name(photos, &shots[i + 1]));
        let followed = shots[i].photo.0 + 1 == shots[i + 1].photo.0;
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
    use shape::{Intrinsics, PhotoId, Pose};

    fn scene(poses: impl Iterator<Item = Pose>) -> Scene {
        let lens = Intrinsics::simple(600, 800, 900.0);
        Scene::of_one_lens(lens, (0..).map(PhotoId).zip(poses))
    }

    #[test]
    fn a_camera_that_was_nudged_is_named_by_its_photo() {
        let pose = |i: u32| Pose {
            rotation: Rotation3::from_euler_angles(1.8, 0.0, 0.3 * f64::from(i)),
            translation: Vector3::new(3.0, 340.0, 1770.0 + f64::from(i % 3)),
        };
        let mut shots = scene((0..9).map(pose)).shots;
        assert_eq!(turned(&shots), vec![]);
        // A turn of the camera about its own centre: the ring does not show it.
        let nudge = Rotation3::from_euler_angles(0.0, 0.026, 0.0);
        let pose = &mut shots[4].pose;
        pose.rotation = nudge * pose.rotation;
        pose.translation = nudge * pose.translation;
        let found = turned(&shots);
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
            let mut photos = Photos::default();
            photos.rig.step = Some(20f64.to_radians());
            uneven(&photos, &scene(places.iter().map(pose)))
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
