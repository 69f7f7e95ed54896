//! The section across an upper arm of a surface carved from outlines, freed of the trunk, of webs and of the filled fold of the armpit.
//!
//! The outer half of an arm always shows. A clear section farther down, grown and shifted so that
//! its support function agrees with the outer half, tells how far the inner half may reach. An arm that nearly touches the trunk may be
//! clear or one with it: the nearer, the less its own outline counts.

use crate::features::body::Body;
use crate::geometry::section::{clipped, hull, tape};
use crate::geometry::slices::rings;
use crate::sections::across_arm::completed;
use crate::sections::arm_inferred::onward;
use crate::sections::beside_trunk::FreedArm;
use crate::sections::down_arm::{CLEAN_ROUND, DownArm, LEAST_ROUND, gap, round};
use crate::sections::one::{FUSED, SectionMeasurement, Why, plain};
use nalgebra::{Matrix3, Vector3};
use shape::{Landmark, Mesh};
use std::f64::consts::TAU;

/// Directions of support functions (structural: samples).
const WAYS: usize = 180;
/// Doubt of a girth whose inner half is given by another section, as a share of what is given. By hand: looked at three
/// scans, at 0.7 and 1.4 of it: tapes move by at most 0.09 and 0.14 %.
const INFERRED_SIGMA: f64 = 0.04;
/// How far inward of its middle an arm that is open to the trunk still shows itself, as a share of its radius. By hand:
/// looked at three scans, at 0.7 and 1.4 of it: tapes move by at most 0.02 and 0 %.
const INNER_SHARE: f64 = 0.25;
/// Doubt by an outer half that the grown section misses, as a multiple of the miss. By hand: looked at three scans, at
/// 0.7 and 1.4 of it: tapes move by at most 0.48 and 0.35 %, intervals change by at most 6 and 2 %.
const MISFIT_DOUBT: f64 = 2.0;
/// An arm that is clear of the trunk by such a chance is (structural: its other reading changes a tape by a thousandth of what they differ).
const SURE: f64 = 0.999;

fn way(k: usize) -> [f64; 2] {
    let (s, c) = libm::sincos(TAU * k as f64 / WAYS as f64);
    [c, s]
}

/// Farthest of points in a direction.
fn support(points: &[[f64; 2]], n: [f64; 2]) -> f64 {
    let reach = points.iter().map(|p| n[0] * p[0] + n[1] * p[1]);
    reach.fold(f64::MIN, f64::max)
}

/// Completes the outer half of an arm's outline by the inner half of a clear section. Both are about their middles; `outward` points
/// away from the trunk.
pub(crate) fn freed(here: &[[f64; 2]], clear: &[[f64; 2]], outward: [f64; 2]) -> Option<FreedArm> {
    let radius = tape(clear) / TAU;
    // Of a ring that the trunk is part of, only what is near can be the arm; its inner side is the trunk's by then.
    let out = |p: &[f64; 2]| p[0] * outward[0] + p[1] * outward[1];
    let near: Vec<[f64; 2]> = here
        .iter()
        .filter(|p| libm::hypot(p[0], p[1]) < 1.6 * radius)
        .filter(|p| out(p) > -INNER_SHARE * radius)
        .copied()
        .collect();
    if near.len() < 8 {
        return None;
    }
    let inner = |n: [f64; 2]| n[0] * outward[0] + n[1] * outward[1] < 0.0;
    let outer = (0..WAYS).map(way).filter(|n| !inner(*n));
    let outer: Vec<([f64; 2], f64)> = outer.map(|n| (n, support(&near, n))).collect();
    // Shift and growth of the clear section, by least squares over the outer half.
    let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for (n, reach) in &outer {
        let row = Vector3::new(n[0], n[1], support(clear, *n));
        normal += row * row.transpose();
        right += row * *reach;
    }
    let fit = normal.cholesky()?.solve(&right);
    if fit.z <= 0.0 {
        return None;
    }
    let grown = |n: [f64; 2]| fit.x * n[0] + fit.y * n[1] + fit.z * support(clear, n);
    let squares = outer.iter().map(|(n, reach)| (reach - grown(*n)).powi(2));
    let mean = squares.sum::<f64>() / outer.len() as f64;
    let misfit = mean.sqrt() / radius;
    let mut points = near;
    points.extend(
        clear
            .iter()
            .map(|p| [fit.x + fit.z * p[0], fit.y + fit.z * p[1]])
            .filter(|p| inner([p[0] - fit.x, p[1] - fit.y])),
    );
    let mut outline = hull(&points);
    let inferred: Vec<[f64; 2]> = (0..WAYS).map(way).filter(|n| inner(*n)).collect();
    for n in &inferred {
        outline = clipped(&outline, *n, grown(*n));
    }
    let share = inferred.len() as f64 / WAYS as f64;
    // What is hidden may have grown as what shows, not at all, or anything between.
    let growth = share * (1.0 - 1.0 / fit.z) / 3f64.sqrt();
    let doubt = libm::hypot(
        libm::hypot(INFERRED_SIGMA * share, MISFIT_DOUBT * misfit),
        growth,
    );
    (outline.len() >= 8).then(|| FreedArm {
        share,
        sigma_mm: doubt * tape(&outline),
        outline,
    })
}

/// Takes the section of an upper arm; the plane's normal points down the arm.
pub(crate) fn across_arm_of_hull(
    mesh: &Mesh,
    body: &Body,
    landmark: &Landmark,
    side: f64,
) -> Result<SectionMeasurement, Why> {
    let plane = &landmark.plane;
    let down = DownArm::of(mesh, body, plane);
    let own = down.small(0).map(|(_, ring)| ring);
    let all = rings(&down.part, plane);
    // The chance that no error as large as the gap, or as the way up to where it ends, joins or parts what is finer than an edge.
    let edge = mesh.mean_edge();
    let apart = own
        .as_ref()
        .map_or(0.0, |ring| gap(ring, &all).min(down.clear_up(edge)));
    let chance = libm::erf(apart / (2f64.sqrt() * edge));
    let clean = own
        .as_ref()
        .filter(|r| round(r) > CLEAN_ROUND && chance > SURE);
    if let Some(ring) = clean {
        return plain(plane, ring.clone());
    }
    let clear = down.clear(own.as_ref(), body, side)?;
    let tapes: Vec<(f64, f64)> = (clear.steps[0]..=down.last)
        .filter_map(|k| down.alone(k))
        .map(|(k, r)| (f64::from(k), r.tape))
        .collect();
    let below = onward(&tapes, f64::from(clear.steps[1]), &clear.reference);
    let open = |ring| freed(&clear.flat(ring, plane), &clear.reference, clear.outward);
    let outer = match &own {
        Some(ring) => open(ring),
        None => all.iter().find_map(open),
    };
    let joined = match (outer, below) {
        (Some(outer), Some(below)) => Some(outer.and(below)),
        (outer, below) => outer.or(below),
    };
    // Its own outline is the arm's if it is apart; of one that is not round, a web on it is even odds.
    let own = own.map(|ring| {
        let bare = ((round(&ring) - LEAST_ROUND) / (CLEAN_ROUND - LEAST_ROUND)).clamp(0.0, 1.0);
        (
            chance * (1.0 + bare) / 2.0,
            FreedArm {
                outline: hull(&clear.flat(&ring, plane)),
                share: 0.0,
                sigma_mm: 0.0,
            },
        )
    });
    let free = match (own, joined) {
        (Some((chance, own)), Some(joined)) => own.or(chance, joined),
        (own, joined) => own.map(|o| o.1).or(joined).ok_or(FUSED)?,
    };
    Ok(completed(free, clear.origin, plane))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn oval(a: f64, b: f64) -> Vec<[f64; 2]> {
        (0..360)
            .map(|k| libm::sincos(TAU * f64::from(k) / 360.0))
            .map(|(s, c)| [a * c, b * s])
            .collect()
    }

    /// An arm open to the trunk, with points of a web.
    fn webbed(web: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let arm = oval(55.0, 48.4).into_iter().filter(|p| p[0] > -20.0);
        let trunk = [[-200.0, 60.0], [-200.0, -60.0]];
        arm.chain(trunk).chain(web.iter().copied()).collect()
    }

    #[test]
    fn a_ring_open_to_the_trunk_gets_its_inner_half_from_the_clear_section() {
        let clear = oval(50.0, 44.0);
        let free = freed(&webbed(&[]), &clear, [1.0, 0.0]).unwrap();
        proof::near(tape(&free.outline) / tape(&oval(55.0, 48.4)), 1.0, 0.01);
    }

    #[test]
    fn an_outer_half_that_runs_out_into_a_web_or_is_much_larger_than_the_clear_section_is_less_sure()
     {
        let clear = oval(50.0, 44.0);
        let doubt = |web: &[[f64; 2]], clear: &[[f64; 2]]| {
            let free = freed(&webbed(web), clear, [1.0, 0.0]).unwrap();
            free.sigma_mm / tape(&free.outline)
        };
        let slight = doubt(&[[20.0, 55.0]], &clear);
        let strong = doubt(&[[20.0, 70.0], [0.0, 78.0]], &clear);
        assert!(doubt(&[], &clear) < slight && slight < strong && strong > 0.1);
        assert!(doubt(&[], &oval(35.0, 31.0)) > doubt(&[], &clear) + 0.05);
    }
}
