//! What a motion comes to: cameras as the body saw them, how sure they are, what is odd, and what is refused.

use crate::azimuth::wrapped;
use crate::error::MotionError;
use crate::joints::{Articulated, Sights, TRUNK, TRUNK_SHARE};
use crate::outlines::Agreement;
use crate::points::Fit;
use nalgebra::{Rotation3, Vector3};
use shape::{Camera, Cameras, Intrinsics, PhotoId, Photos, Pose, Scale, View};
use stage::{Message, message};
use std::f64::consts::TAU;

stage::messages! {
    SEVERAL_TURNS = "warn-turning-twice": "the body turned {count:.0} times: all photos were taken together; one turn is enough";
    TURNED_BACK = "warn-turning-back": "the body turned back by {by:.0 °} on the way: photos were taken as they are";
    FITS_NOWHERE = "warn-turning-odd": "the outline on {names} fits nowhere in the turn and was left out: is somebody else in the picture, or is the mask wrong?";
}

/// What was found.
pub(crate) struct Found {
    /// A motion.
    pub(crate) body: Articulated,
    /// How outlines agree with it.
    pub(crate) agreement: Option<Agreement>,
    /// How features do.
    pub(crate) fit: Option<Fit>,
    /// The photos whose outlines do not.
    pub(crate) odd: Vec<usize>,
}

impl Found {
    /// By joints alone.
    pub(crate) fn by_joints(body: Articulated) -> Found {
        Found {
            body,
            agreement: None,
            fit: None,
            odd: vec![],
        }
    }
}

/// Widest stretch of the turn without a photo: what girths by outlines may leave open, too. By hand: not on record.
/// \[rad\]
pub(crate) const MOST_OPEN_RAD: f64 = TAU / 6.0;
/// Outlines may be so far apart, one standard deviation as a share of the body's height. By hand: looked at two scanned
/// people whose outlines were cut out: 0.42 % where the azimuth came out 2.3° off and girths within 1 %, 0.77 % where
/// it was 9° and a waist 16 % off; 0.1 % by true outlines.
const MOST_LOOSE_SHARE: f64 = 0.005;
/// Turned back by more is reported. By hand: not on record. \[rad\]
const LEAST_TURN_BACK_RAD: f64 = TAU / 12.0;

/// What is reported of a motion.
pub(crate) struct Verdict {
    /// All the way round, either way. \[rad\]
    pub(crate) turned: f64,
    /// The widest stretch without a photo. \[rad\]
    pub(crate) open: f64,
    /// How far the body was off its axis, root mean square. [distance to the axis]
    pub(crate) wander: f64,
    /// What outlines changed of azimuths, root mean square. \[rad\]
    pub(crate) corrected: f64,
    /// How far outlines are apart, as a share of the body's height.
    pub(crate) loose: Option<f64>,
    /// What the user should know.
    pub(crate) warnings: Vec<Message>,
}

/// Looks at a motion; outlines must agree where they are `cut` at full size.
///
/// # Errors
///
/// A part of the turn is missing, or outlines contradict each other.
pub(crate) fn verdict(
    joints: &Articulated,
    found: &Found,
    (ids, photos): (&[PhotoId], &Photos),
    cut: bool,
) -> Result<Verdict, MotionError> {
    let Found { body, odd, .. } = found;
    let steps = &body.motion.steps;
    let name = |i: usize| photos.get(ids[i]).map_or(String::new(), |p| p.name.clone());
    let count = steps.len();
    let kept: Vec<usize> = (0..count).filter(|i| !cut || !odd.contains(i)).collect();
    let azimuths: Vec<f64> = kept.iter().map(|i| steps[*i].azimuth).collect();
    let open = closed(&azimuths, MOST_OPEN_RAD, |i| name(kept[i]))?;
    let loose = found.agreement.map(|a| a.spread / height(body));
    if let Some(loose) = loose.filter(|loose| cut && *loose > MOST_LOOSE_SHARE) {
        return Err(MotionError::Loose {
            percent: 100.0 * loose,
            most: 100.0 * MOST_LOOSE_SHARE,
        });
    }
    let sure: Vec<f64> = (0..count)
        .filter(|i| !odd.contains(i))
        .map(|i| steps[i].azimuth)
        .collect();
    let ways: Vec<f64> = (0..sure.len())
        .map(|i| wrapped(sure[(i + 1) % sure.len()] - sure[i]))
        .collect();
    let turned = ways.iter().sum::<f64>();
    let back: f64 = ways.iter().map(|w| (-w * turned.signum()).max(0.0)).sum();
    let mut warnings = Vec::new();
    if turned.abs() > 1.5 * TAU {
        let count = turned.abs() / TAU;
        warnings.push(message!(SEVERAL_TURNS, count = count));
    }
    if back > LEAST_TURN_BACK_RAD {
        warnings.push(message!(TURNED_BACK, by = back.to_degrees()));
    }
    if cut && !odd.is_empty() {
        let names: Vec<String> = odd.iter().map(|i| name(*i)).collect();
        warnings.push(message!(FITS_NOWHERE, names = names));
    }
    let rms = |of: &dyn Fn(usize) -> f64| {
        ((0..count).map(|i| of(i) * of(i)).sum::<f64>() / count as f64).sqrt()
    };
    let first = &joints.motion.steps;
    Ok(Verdict {
        turned: turned.abs(),
        open,
        wander: rms(&|i| libm::hypot(steps[i].off[0], steps[i].off[1])),
        corrected: rms(&|i| wrapped(steps[i].azimuth - first[i].azimuth)),
        loose,
        warnings,
    })
}

/// How wide the widest stretch is, if that is little enough. \[rad\]
///
/// # Errors
///
/// A part of the turn is missing; photos beside it are named.
pub(crate) fn closed(
    azimuths: &[f64],
    most: f64,
    name: impl Fn(usize) -> String,
) -> Result<f64, MotionError> {
    let (before, after, open) = widest(azimuths);
    match open > most {
        true => Err(MotionError::Open {
            before: name(before),
            after: name(after),
            degrees: open.to_degrees(),
            most: MOST_OPEN_RAD.to_degrees(),
        }),
        false => Ok(open),
    }
}

/// The widest stretch of a turn without a photo: the photos before and after it, and how wide it is. \[rad\]
fn widest(azimuths: &[f64]) -> (usize, usize, f64) {
    let place = |a: f64| a - TAU * (a / TAU).floor();
    let mut order: Vec<usize> = (0..azimuths.len()).collect();
    order.sort_by(|a, b| place(azimuths[*a]).total_cmp(&place(azimuths[*b])));
    let count = order.len();
    let gap = |k: usize| {
        let (a, b) = (order[k], order[(k + 1) % count]);
        let way = place(azimuths[b]) - place(azimuths[a]);
        let way = if k + 1 == count { way + TAU } else { way };
        (a, b, way)
    };
    let gaps = (0..count).map(gap);
    gaps.max_by(|a, b| a.2.total_cmp(&b.2))
        .unwrap_or((0, 0, TAU))
}

/// The body's height by its trunk. \[distance to the axis\]
fn height(body: &Articulated) -> f64 {
    let z = |j: usize| body.places[TRUNK[j]].z;
    let trunk = (z(0) + z(1) - z(2) - z(3)) / 2.0;
    (trunk / TRUNK_SHARE).abs().max(1e-6)
}

/// The cameras as the body saw them: its axis amid shoulders and hips, it faces −y, and the floor is at 0. Millimetres by the
/// stature as far as joints tell it, [`NOBODY_MM`] where nobody does: whoever has outlines scales them anew.
pub(crate) fn cameras(
    found: &Found,
    sights: &Sights,
    (ids, photos): (&[PhotoId], &Photos),
    lens: Intrinsics,
) -> Cameras {
    let body = &found.body;
    let trunk = TRUNK.map(|j| body.places[j]);
    let middle = trunk.iter().sum::<Vector3<f64>>() / 4.0;
    let left = trunk[0] - trunk[1] + trunk[2] - trunk[3];
    let facing = Rotation3::from_axis_angle(&Vector3::z_axis(), libm::atan2(left.y, left.x));
    let floor = floor(body, sights);
    let axis = Vector3::new(middle.x, middle.y, floor);
    let unit = photos.rig.stature_mm.unwrap_or(NOBODY_MM) / height(body);
    let view = |(k, camera): (usize, Camera)| {
        // x_in_camera = R (facing x + axis) + t
        let pose = Pose {
            rotation: camera.pose.rotation * facing,
            translation: (camera.pose.rotation * axis + camera.pose.translation) * unit,
        };
        let view = View {
            name: photos.get(ids[k]).map_or(String::new(), |p| p.name.clone()),
            camera: Camera { lens, pose },
            sigma_mm: None,
            rms_px: found.agreement.map(|a| a.spread * lens.focal[0]),
            points: sights.iter().filter(|of| of[k].is_some()).count() as u32,
        };
        (ids[k], view)
    };
    let all = body.motion.cameras(lens).enumerate();
    Cameras {
        views: all.map(view).collect(),
        scale: Scale::Nothing,
        scale_sigma: None,
        disk_radius_mm: None,
        ground_mm: 0.0,
        points: vec![],
    }
}

/// The stature of somebody who gives none (structural: only rules of some centimetres go by it): 1 628 and 1 756 are
/// the means of women and men (ANSUR II). \[mm\]
const NOBODY_MM: f64 = 1700.0;
/// Places of heels and toes in [`shape::Found::JOINTS`], structural.
const FEET: std::ops::RangeInclusive<usize> = 29..=32;
/// Shoulders of a standing body as a share of its height (ANSUR II: acromial height 0.82 of stature).
const SHOULDERS: f64 = 0.82;
/// How far below the network's heels and toes soles may be, as a share of the height: 17 mm of an adult. By hand:
/// looked at made bodies, where it is half of that.
const SOLES_SHARE: f64 = 0.01;

/// The height of the floor: a little below heels and toes; by the shoulders where no feet are in the picture.
/// \[distance to the axis\]
fn floor(body: &Articulated, sights: &Sights) -> f64 {
    let tall = height(body);
    let seen = FEET.filter(|j| 2 * sights[*j].iter().flatten().count() > body.motion.steps.len());
    let lowest = seen.map(|j| body.places[j].z).reduce(f64::min);
    let shoulders = (body.places[TRUNK[0]].z + body.places[TRUNK[1]].z) / 2.0;
    lowest.map_or(shoulders - SHOULDERS * tall, |z| z - SOLES_SHARE * tall)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_widest_step_is_found_across_the_turns_end_and_whatever_the_order() {
        let degrees = |all: &[f64]| {
            let (a, b, wide) = widest(&all.iter().map(|d| d.to_radians()).collect::<Vec<_>>());
            (a, b, wide.to_degrees().round())
        };
        assert_eq!(degrees(&[350.0, 10.0, 100.0, 280.0]), (2, 3, 180.0));
        assert_eq!(degrees(&[80.0, 0.0, -60.0, 160.0]), (3, 2, 140.0));
        assert_eq!(degrees(&[720.0, 810.0, 900.0, 990.0]).2, 90.0);
    }
}
