//! Start values of a turn about one axis, from what neighbouring photos have in common.
//!
//! A fixed camera sees a disk turn. Up to size, the axis in the camera's frame has three unknowns:
//! its direction and how far it passes beside the optical axis. Each pair of photos then has one
//! essential matrix, `E = [t]× R` with `R = Rot(axis, turn)`, `t = (I - R) c`, c on the axis
//! (Fitzgibbon, Cross and Zisserman 1998). All directions of the axis are tried; the best are
//! refined on the robust Sampson error.

use crate::two_view::descent::descend;
use nalgebra::{Matrix3, Rotation3, Unit, Vector2, Vector3};

/// What two photos have in common.
#[derive(Debug, Clone, PartialEq)]
pub struct Pair {
    /// The earlier photo.
    pub from: usize,
    /// The later photo.
    pub to: usize,
    /// Pixels from the photo's middle, in both.
    pub seen: Vec<[Vector2<f64>; 2]>,
}

/// A turn about one axis, in the camera's frame; the axis passes the optical axis at depth one.
#[derive(Debug, Clone, PartialEq)]
pub struct Start {
    /// Focal length. \[px\]
    pub focal_px: f64,
    /// Direction of the axis.
    pub axis: Vector3<f64>,
    /// How far the axis passes beside the optical axis.
    pub beside: f64,
    /// How far the disk has turned about the axis at each photo. \[rad\]
    pub angles: Vec<f64>,
    /// Robust mean of the Sampson errors. \[px\]
    pub error_px: f64,
}

/// What is known of the turn.
#[derive(Debug, Clone, PartialEq)]
pub struct Known {
    /// How many photos.
    pub photos: usize,
    /// Focal lengths to try. \[px\]
    pub focals_px: Vec<f64>,
    /// Whether the focal length is refined.
    pub free_focal: bool,
    /// The size of the turn from photo to photo, its direction unknown. \[rad\]
    pub step: Option<f64>,
}

/// Sampson errors beyond this count as this (derived: three standard deviations, `loss` of pose.calibrate, where they are
/// what is believed at most, `most_px`). \[px\]
const CAP_PX: f64 = 6.0;

/// The point of the axis nearest to the optical axis, at depth one.
pub(crate) fn on_axis(axis: &Vector3<f64>, beside: f64) -> Vector3<f64> {
    let across = Vector3::new(-axis.y, axis.x, 0.0);
    Vector3::z() + across * (beside / across.norm().max(1e-9))
}

/// The essential matrix of a turn.
pub(crate) fn essential(axis: &Vector3<f64>, beside: f64, turn: f64) -> Matrix3<f64> {
    let r = Rotation3::from_axis_angle(&Unit::new_normalize(*axis), turn);
    let c = on_axis(axis, beside);
    (c - r * c).cross_matrix() * r.matrix()
}

/// First-order geometric error of a pair of observations. \[px\]
fn sampson(e: &Matrix3<f64>, focal: f64, seen: &[Vector2<f64>; 2]) -> f64 {
    let a = Vector3::new(seen[0].x / focal, seen[0].y / focal, 1.0);
    let b = Vector3::new(seen[1].x / focal, seen[1].y / focal, 1.0);
    let (ea, eb) = (e * a, e.tr_mul(&b));
    let slope = ea.x * ea.x + ea.y * ea.y + eb.x * eb.x + eb.y * eb.y;
    focal * b.dot(&ea) / slope.sqrt().max(1e-12)
}

/// Sum of the errors of all pairs, each at most [`CAP_PX`]. \[px\]
pub(crate) fn robust(e: &Matrix3<f64>, focal: f64, seen: &[[Vector2<f64>; 2]]) -> f64 {
    seen.iter()
        .map(|s| sampson(e, focal, s).abs().min(CAP_PX))
        .sum()
}

/// Directions over half a sphere, a spiral's points.
fn directions(count: usize) -> impl Iterator<Item = Vector3<f64>> {
    let golden = std::f64::consts::PI * (3.0 - 5f64.sqrt());
    (0..count).map(move |i| {
        // y from -1 to 0: the half that points up in the photo.
        let y = -1.0 + (i as f64 + 0.5) / count as f64;
        let (sin, cos) = libm::sincos(golden * i as f64);
        let r = (1.0 - y * y).sqrt();
        Vector3::new(r * sin, y, r * cos)
    })
}

/// Candidates for the turn, best first; none where photos have nothing in common.
pub fn starts(pairs: &[Pair], known: &Known) -> Vec<Start> {
    let neighbours: Vec<Pair> = pairs
        .iter()
        .filter(|p| p.to == p.from + 1)
        .map(|p| thinned(p, 40))
        .collect();
    if neighbours.is_empty() {
        return vec![];
    }
    let mut tried = Vec::new();
    for focal in &known.focals_px {
        for axis in directions(150) {
            // An axis along the line of sight is no turntable.
            if axis.z.abs() > 0.95 {
                continue;
            }
            for beside in [-0.2, -0.1, 0.0, 0.1, 0.2] {
                for sign in [1.0, -1.0] {
                    tried.push(tried_out(&neighbours, known, *focal, axis, beside, sign));
                }
            }
        }
    }
    tried.sort_by(|a, b| a.error_px.total_cmp(&b.error_px));
    let thin: Vec<Pair> = pairs.iter().map(|p| thinned(p, 60)).collect();
    let mut refined: Vec<Start> = Vec::new();
    for start in apart(tried, 14) {
        refined.push(refine(&thin, known, start));
    }
    refined.sort_by(|a, b| a.error_px.total_cmp(&b.error_px));
    apart(refined, 4)
}

/// The first of those that are much alike, at most `most`.
fn apart(sorted: Vec<Start>, most: usize) -> Vec<Start> {
    let mut kept: Vec<Start> = Vec::new();
    for start in sorted {
        let alike = |k: &Start| {
            k.axis.dot(&start.axis) > 0.995
                && (k.beside - start.beside).abs() < 0.05
                && libm::log(k.focal_px / start.focal_px).abs() < 0.1
                && k.angles.last().map(|a| a.signum()) == start.angles.last().map(|a| a.signum())
        };
        if kept.len() < most && !kept.iter().any(alike) {
            kept.push(start);
        }
    }
    kept
}

fn thinned(pair: &Pair, most: usize) -> Pair {
    let every = pair.seen.len().div_ceil(most).max(1);
    Pair {
        seen: pair.seen.iter().step_by(every).copied().collect(),
        ..*pair
    }
}

/// A guess: with a known step its error, else each pair's best turn.
fn tried_out(
    pairs: &[Pair],
    known: &Known,
    focal_px: f64,
    axis: Vector3<f64>,
    beside: f64,
    sign: f64,
) -> Start {
    let mut steps = vec![None; known.photos.saturating_sub(1)];
    let (mut error, mut count) = (0.0, 0usize);
    for pair in pairs {
        let at = |turn: f64| robust(&essential(&axis, beside, turn), focal_px, &pair.seen);
        let (turn, cost) = match known.step {
            Some(step) => (sign * step, at(sign * step)),
            None => (1..=15)
                .map(|k| sign * f64::from(k) * 0.05)
                .map(|turn| (turn, at(turn)))
                .min_by(|a, b| a.1.total_cmp(&b.1))
                .expect("bug: no turn was tried"),
        };
        steps[pair.from] = Some(turn);
        error += cost;
        count += pair.seen.len();
    }
    let usual = shape::upper_median(steps.iter().flatten()).unwrap_or_default();
    let mut angles = vec![0.0; known.photos];
    for (i, step) in steps.iter().enumerate() {
        angles[i + 1] = angles[i] + step.unwrap_or(usual);
    }
    Start {
        focal_px,
        axis,
        beside,
        angles,
        error_px: error / count.max(1) as f64,
    }
}

/// Refines a start on all pairs.
fn refine(pairs: &[Pair], known: &Known, start: Start) -> Start {
    let (u, v) = {
        let helper = if start.axis.x.abs() < 0.7 {
            Vector3::x()
        } else {
            Vector3::z()
        };
        let u = start.axis.cross(&helper).normalize();
        (u, start.axis.cross(&u))
    };
    // Unknowns: axis (2), beside, log focal length, then one step or all angles.
    let build = |x: &[f64]| {
        let axis = (start.axis + u * x[0] + v * x[1]).normalize();
        let angles = match known.step {
            Some(_) => start.angles.iter().map(|a| a * (1.0 + x[4])).collect(),
            None => start
                .angles
                .iter()
                .enumerate()
                .map(|(i, a)| a + if i == 0 { 0.0 } else { x[3 + i] })
                .collect(),
        };
        Start {
            focal_px: start.focal_px * libm::exp(x[3]),
            axis,
            beside: start.beside + x[2],
            angles,
            error_px: 0.0,
        }
    };
    let count = 4 + if known.step.is_some() {
        1
    } else {
        known.photos - 1
    };
    let fixed = |k: usize| match k {
        3 => !known.free_focal,
        4 => known.step.is_some(),
        _ => false,
    };
    let free: Vec<usize> = (0..count).filter(|k| !fixed(*k)).collect();
    let whole = |x: &[f64]| {
        let mut all = vec![0.0; count];
        free.iter().zip(x).for_each(|(k, x)| all[*k] = *x);
        all
    };
    let residuals = |x: &[f64]| -> Vec<f64> {
        let s = build(&whole(x));
        let mut all = Vec::new();
        for pair in pairs {
            let e = essential(&s.axis, s.beside, s.angles[pair.to] - s.angles[pair.from]);
            all.extend(pair.seen.iter().map(|p| sampson(&e, s.focal_px, p)));
        }
        all
    };
    let x = descend(&vec![0.0; free.len()], residuals, 1.5, 25);
    let mut best = build(&whole(&x));
    let all = residuals(&x);
    best.error_px = all.iter().map(|r| r.abs().min(CAP_PX)).sum::<f64>() / all.len().max(1) as f64;
    best
}
