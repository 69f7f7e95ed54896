//! How a body is placed: its height, which way it faces, where legs join, where the neck is narrow.

use crate::geometry::peak::between_rows;
use crate::geometry::slices::{Ring, Slice, slices};
use nalgebra::Vector3;
use shape::{BodyFeatures, HipAt, Mesh};
use std::ops::{Deref, DerefMut};

/// How far below and above the crotch that shows the buttocks are looked for, as shares of stature: of 6 068 people
/// they are 0.005 below to 0.06 above it in 99 of 100, and no more than 0.017 below and 0.083 above (ANSUR II).
const ABOUT_CROTCH: [f64; 2] = [0.01, 0.16];

/// An upright body, cut into slices, and what they show.
#[derive(Debug, Clone)]
pub struct Body {
    /// What they show.
    pub shown: BodyFeatures,
    /// Its left.
    pub left: Vector3<f64>,
    /// The slices, from the ground up.
    pub slices: Vec<Slice>,
}

impl Deref for Body {
    type Target = BodyFeatures;

    fn deref(&self) -> &BodyFeatures {
        &self.shown
    }
}

impl DerefMut for Body {
    fn deref_mut(&mut self) -> &mut BodyFeatures {
        &mut self.shown
    }
}

impl Body {
    /// Cuts a surface of which this is known.
    pub fn of(mesh: &Mesh, shown: BodyFeatures) -> Body {
        let high = mesh.bounds().map_or(shown.ground, |(_, high)| high.z);
        Body {
            left: Vector3::z().cross(&shown.front),
            slices: slices(mesh, shown.ground, high, shown.stature / 400.0),
            shown,
        }
    }

    /// The ring of the trunk at a height: the largest. \[mm\]
    pub fn trunk(&self, z: f64) -> Option<&Ring> {
        self.slice(z)?.rings.first()
    }

    /// The slice nearest to a height.
    pub fn slice(&self, z: f64) -> Option<&Slice> {
        self.slices
            .iter()
            .min_by(|a, b| (a.z - z).abs().total_cmp(&(b.z - z).abs()))
    }

    /// Slices between two heights that are shares of the stature.
    pub(crate) fn shares(&self, (low, high): (f64, f64)) -> impl Iterator<Item = &Slice> {
        self.between(
            self.ground + low * self.stature,
            self.ground + high * self.stature,
        )
    }

    /// Where the hip is looked for by the crotch that shows.
    pub(crate) fn about_crotch(&self) -> Option<HipAt> {
        let crotch = self.crotch?;
        let (below, above) = ABOUT_CROTCH.map(|share| share * self.stature).into();
        Some(HipAt::Between(crotch - below, crotch + above))
    }

    /// Slices between two heights.
    pub fn between(&self, low: f64, high: f64) -> impl Iterator<Item = &Slice> {
        self.slices
            .iter()
            .filter(move |s| s.z >= low && s.z <= high)
    }
}

/// Reads a body from its mesh; upright is z.
pub fn body(mesh: &Mesh, ground: f64) -> Option<Body> {
    let stature = mesh.bounds()?.1.z - ground;
    if stature <= 0.0 {
        return None;
    }
    let unread = BodyFeatures {
        unit: mesh.unit,
        refused: None,
        ground,
        grounded: false,
        stature,
        stature_sigma: None,
        front: -Vector3::y(),
        front_is_sure: false,
        crotch: None,
        legs_join: None,
        whole: false,
        carved: false,
        hip: None,
        neck: None,
    };
    let mut body = Body::of(mesh, unread);
    body.legs_join = legs_join(&body);
    body.crotch = body
        .legs_join
        .filter(|z| z - ground >= LEAST_LEGS * stature);
    body.whole = body.crotch.is_some();
    body.neck = neck(&body);
    if let Some((front, sure)) = facing(&body) {
        body.front = front;
        body.front_is_sure = sure;
        body.left = Vector3::z().cross(&front);
    }
    body.hip = body.about_crotch();
    Some(body)
}

/// Legs are at least so long, as a share of stature: less is a body that is cut off. Of 6 068 people the shortest have
/// 0.42, and the middle of the kneecap is at 0.24 to 0.32 (ANSUR II).
const LEAST_LEGS: f64 = 0.25;

/// Two rings of like size, the largest, are legs; they join where they become one.
fn legs_join(body: &Body) -> Option<f64> {
    let legs = |s: &Slice| s.rings.len() >= 2 && s.rings[1].area > 0.4 * s.rings[0].area;
    let low = body.ground + 0.12 * body.stature;
    let high = body.ground + 0.65 * body.stature;
    let both: Vec<f64> = body
        .between(low, high)
        .filter(|s| legs(s))
        .map(|s| s.z)
        .collect();
    // The first gap of more than a hundredth of the stature ends the legs.
    let mut top = *both.first()?;
    if top > body.ground + 0.3 * body.stature {
        return None;
    }
    for z in both {
        if z - top > 0.015 * body.stature {
            break;
        }
        top = z;
    }
    // Legs that go on beyond are not those of a whole body: its trunk is cut off.
    (high - top > 0.015 * body.stature).then_some(top)
}

/// The narrowest ring between head and shoulders: from the crown down, the least after the head's
/// widest and before the tape is three tenths longer again.
fn neck(body: &Body) -> Option<f64> {
    let (mut head, mut narrow) = (0.0f64, (0, f64::MAX));
    let low = body.ground + 0.6 * body.stature;
    let above = body.slices.iter().enumerate().rev();
    for (k, slice) in above.take_while(|(_, s)| s.z > low) {
        let Some(ring) = slice.rings.first() else {
            continue;
        };
        if ring.tape > head && narrow.1 > 0.985 * head {
            (head, narrow) = (ring.tape, (0, f64::MAX));
        } else if ring.tape < narrow.1 {
            narrow = (k, ring.tape);
        } else if narrow.1 < 0.985 * head && ring.tape > 1.3 * narrow.1 {
            let tape = |s: &Slice| s.rings.first().map_or(narrow.1, |r| r.tape);
            let row = |k: usize| (body.slices[k].z, tape(&body.slices[k]));
            return Some(between_rows(
                [narrow.0 - 1, narrow.0, narrow.0 + 1].map(row),
            ));
        }
    }
    None
}

/// Feet, or the head, and thighs must agree within this angle, 60°, for the way a body faces to be sure. By hand:
/// looked at three scans, at 0.7 and 1.4 of it: no tape changes. \[cos\]
const LEAST_AGREEMENT: f64 = 0.5;

/// The way a body faces, and whether that is sure: across the line from thigh to thigh, to the side
/// that whole feet point to, or else the head is carried to. Feet alone tell where legs are one; they are
/// small, and where they are on something of their colour they may be lost.
fn facing(body: &Body) -> Option<(Vector3<f64>, bool)> {
    let (feet, head) = (feet(body), head(body));
    let Some(beside) = thighs(body) else {
        return Some((feet?, true));
    };
    let across = Vector3::z().cross(&beside);
    let Some(side) = feet.filter(|_| two_feet(body)).or(head).or(feet) else {
        return Some((across, false));
    };
    let along = across.dot(&side);
    let front = across * along.signum();
    let head_agrees = head.is_none_or(|h| h.dot(&front) > 0.0);
    Some((front, along.abs() >= LEAST_AGREEMENT && head_agrees))
}

/// Heights of feet, as shares of stature: below the malleolus, at 0.030 to 0.053 (ANSUR II).
const TOES: (f64, f64) = (0.008, 0.025);
/// Heights of ankles, as shares of stature: above the malleolus, at 0.030 to 0.053 (ANSUR II).
const ANKLES: (f64, f64) = (0.06, 0.09);

/// Whether two feet show: at all their heights two rings, the smaller at least half the larger.
fn two_feet(body: &Body) -> bool {
    let two = |s: &Slice| s.rings.len() >= 2 && s.rings[1].area >= 0.5 * s.rings[0].area;
    body.shares(TOES).all(two)
}

/// How far hips are above the crotch, as a share of stature: the mean of trochanterion less crotch of 6 068 people (ANSUR II).
const HIPS: f64 = 0.034;

/// The horizontal direction from hip to hip, unit; which of both is first is open. Thighs run there: in a stride, or with
/// a knee bent, one is before the other farther down.
fn thighs(body: &Body) -> Option<Vector3<f64>> {
    let high = body.legs_join? - body.ground;
    let pairs = body.between(body.ground + 0.6 * high, body.ground + 0.95 * high);
    let mut all: Vec<(f64, Vector3<f64>)> = Vec::new();
    let mut sum = Vector3::<f64>::zeros();
    for pair in pairs.filter(|s| s.rings.len() >= 2) {
        let apart = pair.rings[0].centre - pair.rings[1].centre;
        let apart = if apart.dot(&sum) < 0.0 { -apart } else { apart };
        sum += apart;
        all.push((pair.z, apart));
    }
    let n = all.len() as f64;
    let mean = all.iter().map(|p| p.0).sum::<f64>() / n;
    let (mut slope, mut square) = (Vector3::zeros(), 0.0);
    for (z, apart) in &all {
        slope += apart * (z - mean);
        square += (z - mean).powi(2);
    }
    let hips = body.ground + high + HIPS * body.stature;
    let mut beside = sum / n + slope * ((hips - mean) / square);
    beside.z = 0.0;
    beside.try_normalize(1e-6)
}

/// Feet point forward of the ankles.
fn feet(body: &Body) -> Option<Vector3<f64>> {
    let mean = |shares| {
        let (mut sum, mut total) = (Vector3::zeros(), 0.0);
        for s in body.shares(shares) {
            for r in s.rings.iter().take(2) {
                sum += r.centre.coords * r.area;
                total += r.area;
            }
        }
        (total > 0.0).then(|| sum / total)
    };
    ahead(mean(ANKLES)?, mean(TOES)?, 0.004 * body.stature)
}

/// How far the middle of the head is before that of the shoulders at least, as a share of stature. By hand: looked at
/// on 710 made bodies, where it is 0.008 and more, 0.022 in the middle.
const HEAD_AHEAD: f64 = 0.006;

/// A head is carried forward of the shoulders. `None` without a neck.
fn head(body: &Body) -> Option<Vector3<f64>> {
    let shoulders = body.trunk(body.neck? - 0.06 * body.stature)?;
    let head = body.trunk(body.ground + 0.96 * body.stature)?;
    let (from, to) = (shoulders.centre.coords, head.centre.coords);
    ahead(from, to, HEAD_AHEAD * body.stature)
}

/// The horizontal direction from one place to another, unit. `None` where they are nearer than `least`.
fn ahead(from: Vector3<f64>, to: Vector3<f64>, least: f64) -> Option<Vector3<f64>> {
    let mut way = to - from;
    way.z = 0.0;
    (way.norm() > least).then(|| way.normalize())
}

#[cfg(test)]
impl Body {
    /// For tests: a whole body of 1750 mm that looks along -y, of these slices, nothing else of which was found.
    pub(crate) fn of_slices(slices: Vec<Slice>) -> Body {
        Body {
            shown: BodyFeatures {
                unit: shape::Unit::Metric,
                refused: None,
                ground: 0.0,
                grounded: true,
                stature: 1750.0,
                stature_sigma: None,
                front: -Vector3::y(),
                front_is_sure: true,
                crotch: None,
                legs_join: None,
                whole: true,
                carved: false,
                hip: None,
                neck: None,
            },
            left: Vector3::x(),
            slices,
        }
    }
}
