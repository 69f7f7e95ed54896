//! How high the girth of a neck is taken: from the outline of head, neck and shoulders.
//!
//! The joints that the level lies between do not show, but the whole outline around them tells more
//! of it than any mark of its own: a straight combination of how far head, neck and shoulders reach
//! forward, back and across at 21 heights. Lengths are shares of the head's height, from the neck's
//! narrowest to the crown, so that an infant's head means the same as a man's. Fitted by ridge
//! regression on 773 made bodies from infants to the old; trunk, neck and arms of 360 of them were drawn
//! in or out until their girths were given ones.

use crate::features::body::Body;
use crate::features::marks::extent;
use crate::features::neck::Throat;
use crate::features::reach::{Row, between};
use crate::geometry::slices::Slice;

/// Heights at which the outline is read.
const HEIGHTS: usize = 21;
/// The lowest of them, counted from the neck's narrowest, and the step to the next; shares of the head.
const LOWEST: f64 = -0.75;
const STEP: f64 = 0.075;
/// No height is lower than this share of stature: what is there tells of the chest.
const CHEST: f64 = 0.7;

/// What reaches forward, reaches back and breadths count for, from the lowest height to the highest.
const FRONT: [f64; HEIGHTS] = [
    0.0455, -0.0210, -0.0148, 0.0166, 0.0225, 0.0468, -0.0275, -0.0063, 0.0281, 0.0201, 0.0484,
    0.0627, -0.1659, -0.0083, 0.1943, -0.2092, -0.0928, -0.0245, 0.1640, 0.1483, 0.2043,
];
const BACK: [f64; HEIGHTS] = [
    0.0625, 0.0179, -0.0052, -0.0084, -0.0021, -0.0031, -0.0328, -0.0681, 0.1116, 0.0545, -0.0414,
    0.0553, 0.0410, -0.0154, -0.0642, -0.1450, -0.0232, -0.0446, -0.0091, 0.0386, 0.0220,
];
const WIDE: [f64; HEIGHTS] = [
    -0.0021, 0.0018, -0.0040, -0.0179, -0.0216, 0.0036, 0.0353, 0.0053, -0.0009, -0.0042, 0.0191,
    -0.0740, -0.0176, -0.0493, -0.0056, 0.1836, -0.0325, 0.0525, -0.1442, -0.2429, -0.3100,
];
/// What the head's share of stature, and [`Throat`]'s ears, shoulders, `back` and `ahead` count for.
const MARKS: [f64; 5] = [0.1550, 0.5980, 0.1997, 0.0247, -0.0745];
const ALWAYS: f64 = 0.09134;

/// Offset along the throat's usual axis of the plane amid the neck's two joints, from slices of shoulders,
/// neck and head in rising order; `ears` is the height of their middle. \[mm\]
pub(crate) fn level(body: &Body, throat: &Throat, ears: f64, slices: &[&Slice]) -> f64 {
    let middle = throat.origin.coords.dot(&body.front);
    // Forward, back, across; from the middle of the section at the neck's narrowest.
    let row = |s: &&Slice| {
        let ring = s.rings.first()?;
        let (back, front) = extent(ring, &body.front)?;
        let (low, high) = extent(ring, &body.left)?;
        Some(Row {
            z: s.z,
            reach: [front - middle, back - middle, high - low],
        })
    };
    let rows: Vec<Row<3>> = slices.iter().filter_map(row).collect();
    let head = throat.head;
    let chest = body.ground + CHEST * body.stature;
    let mut sum = ALWAYS;
    for k in 0..HEIGHTS {
        let z = throat.origin.z + head * (LOWEST + STEP * k as f64);
        let reach = between(&rows, z.max(chest));
        for (share, law) in reach.iter().zip([&FRONT, &BACK, &WIDE]) {
            sum += law[k] * share / head;
        }
    }
    let up = ears - throat.origin.z;
    let marks = [
        head * head / body.stature,
        up,
        throat.shoulders,
        throat.back,
        throat.ahead,
    ];
    let told = marks.iter().zip(&MARKS).map(|(m, law)| m * law);
    head * (sum + told.sum::<f64>() / head)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::slices::Ring;
    use nalgebra::{Point3, Vector3};

    /// Head, neck and shoulders of blocks, `scale` times as large, `ahead` further forward. \[mm\]
    fn told(scale: f64, ahead: f64) -> f64 {
        let block = |z: f64| match z {
            ..1450.0 => (400.0, 220.0),
            ..1540.0 => (130.0, 140.0),
            _ => (160.0, 200.0),
        };
        let slices: Vec<Slice> = (1150..1750)
            .step_by(2)
            .map(|z| {
                let z = f64::from(z);
                let (wide, deep) = block(z);
                let corner = |x: f64, y: f64| {
                    Point3::new(x * wide / 2.0, y * deep / 2.0, z) * scale - Vector3::y() * ahead
                };
                let curve = vec![
                    corner(-1.0, -1.0),
                    corner(1.0, -1.0),
                    corner(1.0, 1.0),
                    corner(-1.0, 1.0),
                ];
                let ring = Ring {
                    curve,
                    area: 1.0,
                    tape: 1.0,
                    centre: Point3::origin(),
                };
                Slice {
                    z: z * scale,
                    rings: vec![ring],
                }
            })
            .collect();
        let body = Body {
            ground: 0.0,
            stature: 1750.0 * scale,
            front: -Vector3::y(),
            front_is_sure: true,
            left: Vector3::x(),
            crotch: None,
            neck: Some(1500.0 * scale),
            slices: Vec::new(),
        };
        let throat = Throat {
            origin: Point3::new(0.0, -ahead, 1500.0 * scale),
            axis: Vector3::z(),
            ears: 110.0 * scale,
            shoulders: -45.0 * scale,
            level: 0.0,
            head: 250.0 * scale,
            back: 10.0 * scale,
            ahead: 30.0 * scale,
        };
        let all: Vec<&Slice> = slices.iter().collect();
        level(&body, &throat, 1610.0 * scale, &all)
    }

    #[test]
    fn the_level_grows_with_the_body_and_does_not_depend_on_where_it_stands() {
        let once = told(1.0, 0.0);
        assert!((-20.0..60.0).contains(&once), "{once}");
        proof::near(told(0.4, 0.0), 0.4 * once, 1e-9);
        proof::near(told(1.0, 300.0), once, 1e-9);
    }
}
