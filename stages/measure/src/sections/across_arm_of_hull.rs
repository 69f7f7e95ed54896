//! The section across an upper arm of a surface carved from outlines, freed of the trunk, of webs and of the filled fold of the armpit.
//!
//! The outer half of an arm always shows. A clear section farther down, grown and shifted so that
//! its support function agrees with the outer half, tells how far the inner half may reach.

use crate::features::body::Body;
use crate::geometry::section::{clipped, hull, tape};
use crate::geometry::slices::rings;
use crate::sections::across_arm::completed;
use crate::sections::arm_inferred::{InferredSection, bounded, onward};
use crate::sections::down_arm::{CLEAN, DownArm, round};
use crate::sections::one::{FUSED, SectionMeasurement, Why, plain};
use nalgebra::{Matrix3, Vector3};
use shape::{Landmark, Mesh};
use std::f64::consts::TAU;

/// How far beyond the grown section an inner half may reach, as a share of the arm's radius.
const LOOSE: f64 = 0.03;
/// Directions of support functions (structural: samples).
const WAYS: usize = 180;
/// Doubt of a girth whose inner half is given by another section, as a share of what is given.
const DOUBT: f64 = 0.04;

fn way(k: usize) -> [f64; 2] {
    let (s, c) = libm::sincos(TAU * k as f64 / WAYS as f64);
    [c, s]
}

/// Farthest of points in a direction.
fn support(points: &[[f64; 2]], n: [f64; 2]) -> f64 {
    let reach = points.iter().map(|p| n[0] * p[0] + n[1] * p[1]);
    reach.fold(f64::MIN, f64::max)
}

/// How far the grown section may miss the outer half of a ring that is open to the trunk, as a share
/// of the arm's radius, root of the mean square. Arms keep within 0.035; a web that a hull of few
/// photos leaves between arm and trunk is off by 0.065 and more.
const MISFIT: f64 = 0.05;
/// How far inward of its middle an arm that is open to the trunk still shows itself, as a share of its
/// radius.
const INNER: f64 = 0.25;
/// The same of an outer half that the grown section misses, as a multiple of the miss.
const MISFIT_DOUBT: f64 = 2.0;

/// An arm's outline freed of what hangs on its inner half.
pub(crate) struct CompletedArm {
    outline: Vec<[f64; 2]>,
    /// Share of directions that the clear section gives.
    inferred: f64,
    /// How far that misses the outer half of a ring that is open to the trunk, as a share of the arm's
    /// radius, root of the mean square.
    misfit: f64,
}

/// Frees an arm's outline by a clear section. Both are about their middles; `outward` points away from
/// the trunk. `None` if the two disagree in size, or in shape where the inner half is not to be seen.
pub(crate) fn freed(
    here: &[[f64; 2]],
    clear: &[[f64; 2]],
    outward: [f64; 2],
) -> Option<CompletedArm> {
    let radius = tape(clear) / TAU;
    // Of a ring that the trunk is part of, only what is near can be the arm.
    let close = |p: &&[f64; 2]| libm::hypot(p[0], p[1]) < 1.6 * radius;
    let open = here.iter().filter(close).count() < here.len();
    // Its inner side is the trunk's by then.
    let out = |p: &[f64; 2]| p[0] * outward[0] + p[1] * outward[1];
    let near: Vec<[f64; 2]> = here
        .iter()
        .filter(close)
        .filter(|p| !open || out(p) > -INNER * radius)
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
    if !(0.8..=1.3).contains(&fit.z) {
        return None;
    }
    let grown = |n: [f64; 2]| fit.x * n[0] + fit.y * n[1] + fit.z * support(clear, n);
    // The inner half of a ring that is open to the trunk is the clear section's, if the outer half is.
    let squares = outer.iter().map(|(n, reach)| (reach - grown(*n)).powi(2));
    let mean = squares.sum::<f64>() / outer.len() as f64;
    let misfit = if open { mean.sqrt() / radius } else { 0.0 };
    if misfit > MISFIT {
        return None;
    }
    let mut points = near;
    if open {
        points.extend(
            clear
                .iter()
                .map(|p| [fit.x + fit.z * p[0], fit.y + fit.z * p[1]])
                .filter(|p| inner([p[0] - fit.x, p[1] - fit.y])),
        );
    }
    let mut outline = hull(&points);
    let mut inferred = 0;
    for k in 0..WAYS {
        let n = way(k);
        let most = grown(n);
        let beyond = support(&outline, n) > most + LOOSE * radius;
        if inner(n) && (open || beyond) {
            outline = clipped(&outline, n, most);
            inferred += 1;
        }
    }
    (outline.len() >= 8).then_some(CompletedArm {
        outline,
        inferred: inferred as f64 / WAYS as f64,
        misfit,
    })
}

/// The first of several rings that holds the arm, and what [`freed`] makes of it.
fn first_freed(
    all: &[Vec<[f64; 2]>],
    clear: &[[f64; 2]],
    outward: [f64; 2],
) -> Option<(usize, CompletedArm)> {
    let mut tried = all.iter().enumerate();
    tried.find_map(|(i, ring)| Some((i, freed(ring, clear, outward)?)))
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
    let own = down.alone(0).map(|(_, ring)| ring);
    if let Some(ring) = own.as_ref().filter(|r| round(r) > CLEAN) {
        return plain(mesh, plane, ring.clone());
    }
    let clear = down.clear(own.as_ref(), body, side)?;
    let whole = own.is_some();
    let all = match own {
        Some(ring) => vec![ring],
        None => rings(&down.part, plane),
    };
    let flats: Vec<_> = all.iter().map(|ring| clear.flat(ring, plane)).collect();
    let [first, steps] = clear.steps;
    let tapes = (first..=down.last)
        .filter_map(|k| down.alone(k))
        .map(|(k, r)| (f64::from(k), r.tape));
    let beyond = || {
        onward(
            &tapes.collect::<Vec<_>>(),
            f64::from(steps),
            &clear.reference,
        )
    };
    let inferred = match first_freed(&flats, &clear.reference, clear.outward) {
        Some((at, free)) if free.inferred == 0.0 => return plain(mesh, plane, all[at].clone()),
        Some((_, free)) => {
            let inferred = InferredSection {
                doubt: libm::hypot(DOUBT * free.inferred, MISFIT_DOUBT * free.misfit),
                share: free.inferred,
                outline: free.outline,
            };
            match whole {
                true => inferred,
                false => bounded(inferred, beyond()),
            }
        }
        None => beyond().ok_or(FUSED)?,
    };
    Ok(completed(inferred.freed(), clear.origin, plane))
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

    #[test]
    fn a_fold_that_hangs_on_the_inner_half_is_cut_away() {
        let (mut here, clear) = (oval(55.0, 48.0), oval(50.0, 44.0));
        let own = tape(&here);
        here.extend([[-68.0, 22.0], [-66.0, -5.0]]);
        let here = hull(&here);
        assert!(tape(&here) > 1.03 * own);
        let free = freed(&here, &clear, [1.0, 0.0]).unwrap();
        proof::near(tape(&free.outline) / own, 1.0, 0.012);
        assert!(free.inferred > 0.05 && free.inferred < 0.5);
    }

    #[test]
    fn a_ring_open_to_the_trunk_gets_its_inner_half_from_the_clear_section() {
        let clear = oval(50.0, 44.0);
        let own = tape(&oval(55.0, 48.4));
        let here: Vec<[f64; 2]> = oval(55.0, 48.4)
            .into_iter()
            .filter(|p| p[0] > -20.0)
            .chain([[-200.0, 60.0], [-200.0, -60.0]])
            .collect();
        let free = freed(&here, &clear, [1.0, 0.0]).unwrap();
        proof::near(tape(&free.outline) / own, 1.0, 0.01);
    }

    #[test]
    fn an_outer_half_that_runs_out_into_a_web_is_refused() {
        let clear = oval(50.0, 44.0);
        let webbed = |web: &[[f64; 2]]| -> Vec<[f64; 2]> {
            let arm = oval(55.0, 48.4).into_iter().filter(|p| p[0] > -20.0);
            let trunk = [[-200.0, 60.0], [-200.0, -60.0]];
            arm.chain(trunk).chain(web.iter().copied()).collect()
        };
        let plain = freed(&webbed(&[]), &clear, [1.0, 0.0]).unwrap();
        assert!(plain.misfit < 0.01);
        let slight = freed(&webbed(&[[20.0, 55.0]]), &clear, [1.0, 0.0]).unwrap();
        assert!(slight.misfit > 0.015);
        let web = [[20.0, 70.0], [0.0, 78.0]];
        assert!(freed(&webbed(&web), &clear, [1.0, 0.0]).is_none());
    }

    #[test]
    fn a_plain_arm_is_left_as_it_is() {
        let (here, clear) = (oval(55.0, 48.0), oval(50.0, 44.0));
        let free = freed(&here, &clear, [1.0, 0.0]).unwrap();
        assert_eq!(free.inferred, 0.0);
        proof::near(tape(&free.outline), tape(&here), 1e-9);
    }

    #[test]
    fn of_several_rings_the_arms_own_is_taken_and_not_the_trunk() {
        let clear = oval(50.0, 44.0);
        let aside = |p: [f64; 2]| [p[0] - 400.0, p[1]];
        let trunk: Vec<[f64; 2]> = oval(180.0, 120.0).into_iter().map(aside).collect();
        let all = [trunk, oval(55.0, 48.0)];
        let (at, free) = first_freed(&all, &clear, [1.0, 0.0]).unwrap();
        assert_eq!((at, free.inferred), (1, 0.0));
        proof::near(tape(&free.outline), tape(&all[1]), 1e-9);
    }
}
