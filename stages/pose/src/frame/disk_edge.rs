//! The edge of a turning disk: its rim is round, so that it projects to one fixed ellipse.

use crate::frame::disk_exact::{NEAR, angle, exact, is_far};
use nalgebra::{Point3, Vector2, Vector3};
use shape::{Camera, Gray};

/// A disk's upper edge about the z axis, in the camera's unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DiskEdge {
    /// Height of the edge.
    pub height: f64,
    /// Its radius.
    pub radius: f64,
    /// Mean step of brightness across it, 0..=255.
    pub contrast: f64,
    /// The same over the median of all circles that were tried.
    pub standout: f64,
    /// Whether the step is of one sign nearly all around.
    pub round: bool,
}

/// Steps of half a level are none, whatever the rest are: files hold whole levels (derived: what rounding hides).
/// \[levels\]
const LEAST_STEP_LEVELS: f64 = 0.5;
/// Points around the edge (structural: samples).
const AROUND: usize = 96;

/// How far to both sides of an edge to look that may be between circles tried. By hand: looked at two captures, halved
/// and doubled: no more than chance (docs/lab/numbers.md). \[px\]
const WIDE: f64 = 4.0;
/// Circles tried along heights and along radii (structural: samples of a search).
const STEPS: usize = 70;
/// So many of the strongest circles are looked at; where one edge is no disk's, many are along it.
/// It is structural: the width of a search.
const PEAKS: usize = 100;
/// A quarter of a disk's steps may be less than this share of their mean: other edges of the background, a skirting
/// board's, follow a circle for a part of it. By hand: looked at six captures: halved, nothing changes; doubled, ground
/// −3.1 mm for one (docs/lab/numbers.md).
const LEAST_QUARTER_SHARE: f64 = 0.25;

/// Finds the round edge with the strongest step of one sign, within heights and radii. Of edges
/// nearly as strong and as wide (a disk has a lower one too) the upper is taken. Where that is no
/// step all around, edges are looked for that are between the circles tried. Of a circle's height and radius `may`
/// whether it can be a disk.
pub fn disk_edge(
    gray: &Gray,
    camera: &Camera,
    heights: [f64; 2],
    radii: [f64; 2],
    may: May<'_>,
) -> Option<DiskEdge> {
    let camera = camera.resized(gray.width as u32, gray.height as u32);
    let cells = [heights, radii].map(|[lo, hi]| (hi - lo) / STEPS as f64);
    let tried = circles(gray, &camera, [heights, radii], may, NEAR);
    let strongest = tried.iter().copied().max_by(|a, b| a.2.total_cmp(&b.2))?;
    let first = climbed(gray, &camera, upper(&tried, strongest)?, (cells, may), NEAR);
    let found = match is_all_around(gray, &camera, first) {
        true => first,
        false => between(gray, &camera, heights, radii, may).unwrap_or(first),
    };
    // To a part of a pixel where that can be a disk's, too.
    let within = |(z, r): &(f64, f64)| (heights[0]..=heights[1]).contains(z) && may(*z, *r);
    let laid = exact(gray, &camera, (found.0, found.1)).filter(within);
    let (height, radius) = laid.unwrap_or((found.0, found.1));
    let tried = tried.iter().filter(|t| may(t.0, t.1));
    let usual = shape::upper_median(tried.map(|t| t.2))?;
    Some(DiskEdge {
        round: is_all_around(gray, &camera, found),
        height,
        radius,
        contrast: found.2,
        standout: found.2 / usual.max(LEAST_STEP_LEVELS),
    })
}

/// Whether a circle of a height and a radius can be a disk's.
pub type May<'a> = &'a dyn Fn(f64, f64) -> bool;

/// A circle: height, radius, and its mean step.
type Circle = (f64, f64, f64);

/// All circles of a grid, row by row of one height.
fn circles(
    gray: &Gray,
    camera: &Camera,
    [heights, radii]: [[f64; 2]; 2],
    may: May<'_>,
    beside: f64,
) -> Vec<Circle> {
    let at = |[lo, hi]: [f64; 2], i: usize| lo + (hi - lo) * i as f64 / STEPS as f64;
    let mut tried = Vec::with_capacity((STEPS + 1) * (STEPS + 1));
    for i in 0..=STEPS {
        for j in 0..=STEPS {
            let (z, r) = (at(heights, i), at(radii, j));
            let step = may(z, r).then(|| step(gray, camera, (z, r), beside));
            tried.push((z, r, step.flatten().unwrap_or(0.0)));
        }
    }
    tried
}

/// The upper of the circles alike to one.
fn upper(tried: &[Circle], strongest: Circle) -> Option<Circle> {
    let alike = |t: &&Circle| t.2 >= 0.75 * strongest.2 && (t.1 / strongest.1 - 1.0).abs() < 0.15;
    let upper = tried.iter().filter(alike);
    let upper = upper.max_by(|a, b| a.0.total_cmp(&b.0).then(a.2.total_cmp(&b.2)));
    upper.copied()
}

/// The strongest circle near one, of those that may be a disk's.
fn climbed(
    gray: &Gray,
    camera: &Camera,
    (mut z, mut r, mut contrast): Circle,
    (mut reach, may): ([f64; 2], May<'_>),
    beside: f64,
) -> Circle {
    for _ in 0..12 {
        let mut best = (z, r, contrast);
        for (dz, dr) in (-2..=2).flat_map(|a| (-2..=2).map(move |b| (a, b))) {
            let (z, r) = (
                z + f64::from(dz) * reach[0] * 0.5,
                r + f64::from(dr) * reach[1] * 0.5,
            );
            let step = may(z, r).then(|| step(gray, camera, (z, r), beside));
            if let Some(c) = step.flatten().filter(|c| *c > best.2) {
                best = (z, r, c);
            }
        }
        if best.2 <= contrast {
            reach = reach.map(|r| r * 0.6);
        }
        (z, r, contrast) = best;
    }
    (z, r, contrast)
}

/// Whether a circle has a step of one sign nearly all around its near side, and of one nearly all around the rest.
fn is_all_around(gray: &Gray, camera: &Camera, (z, r, contrast): Circle) -> bool {
    let Some(steps) = steps_around(gray, camera, (z, r), NEAR) else {
        return false;
    };
    let ways = sums(&steps).map(f64::signum);
    let mut steps: Vec<f64> = steps
        .iter()
        .map(|(far, s)| s * ways[usize::from(*far)])
        .collect();
    steps.sort_by(f64::total_cmp);
    steps[steps.len() / 4] > LEAST_QUARTER_SHARE * contrast
}

/// The strongest edge all around that is on or between the circles tried.
fn between(
    gray: &Gray,
    camera: &Camera,
    heights: [f64; 2],
    radii: [f64; 2],
    may: May<'_>,
) -> Option<Circle> {
    let cells = [heights, radii].map(|[lo, hi]| (hi - lo) / STEPS as f64);
    let tried = circles(gray, camera, [heights, radii], may, WIDE);
    let cell = |i: usize, j: usize| tried[i * (STEPS + 1) + j];
    let near = |k: usize| k.saturating_sub(1)..=(k + 1).min(STEPS);
    let peak = |(i, j): (usize, usize)| {
        let mut around = near(i).flat_map(|a| near(j).map(move |b| (a, b)));
        (!around.any(|(a, b)| cell(a, b).2 > cell(i, j).2)).then(|| cell(i, j))
    };
    let all = (0..=STEPS).flat_map(|i| (1..STEPS).map(move |j| (i, j)));
    let mut peaks: Vec<Circle> = all.filter_map(peak).collect();
    peaks.sort_by(|a, b| b.2.total_cmp(&a.2));
    peaks.truncate(PEAKS);
    let sharp = |strongest: &Circle| {
        let (z, r, _) = climbed(gray, camera, upper(&tried, *strongest)?, (cells, may), WIDE);
        let here = (z, r, step(gray, camera, (z, r), NEAR)?);
        let found = climbed(gray, camera, here, (cells.map(|c| 0.3 * c), may), NEAR);
        is_all_around(gray, camera, found).then_some(found)
    };
    peaks.iter().find_map(sharp)
}

/// Mean step of brightness outwards along the edge, its size: beyond the near side is the disk's own side, beyond the far
/// one the floor, which may be darker and brighter than the disk.
fn step(gray: &Gray, camera: &Camera, circle: (f64, f64), beside: f64) -> Option<f64> {
    let all = steps_around(gray, camera, circle, beside)?;
    let size: f64 = sums(&all).iter().map(|sum| sum.abs()).sum();
    Some(size / all.len() as f64)
}

/// A step of brightness outwards, and whether it is on the far side.
type Step = (bool, f64);

/// The sums of the steps of the near side and of the far one.
fn sums(steps: &[Step]) -> [f64; 2] {
    [false, true].map(|far| steps.iter().filter(|s| s.0 == far).map(|s| s.1).sum())
}

/// Steps of brightness outwards along the edge. `None` where most of it is not on the picture.
fn steps_around(
    gray: &Gray,
    camera: &Camera,
    (height, radius): (f64, f64),
    beside: f64,
) -> Option<Vec<Step>> {
    let mut steps = Vec::with_capacity(AROUND);
    for k in 0..AROUND {
        let angle = angle(camera, k as f64 / (AROUND - 1) as f64);
        let (sin, cos) = libm::sincos(angle);
        let at = camera.project(&Point3::new(radius * cos, radius * sin, height))?;
        let ahead = camera.project(&Point3::from(
            Vector3::new(radius * cos, radius * sin, height)
                + Vector3::new(-sin, cos, 0.0) * (radius * 0.01),
        ))?;
        let along = Vector2::new(ahead.x - at.x, ahead.y - at.y).try_normalize(1e-9)?;
        let across = Vector2::new(along.y, -along.x);
        let value = |s: f64| light(gray, at.x + across.x * s, at.y + across.y * s);
        if let (Some(out), Some(inside)) = (value(beside), value(-beside)) {
            steps.push((is_far(camera, radius, angle), out - inside));
        }
    }
    (steps.len() > AROUND * 2 / 3).then_some(steps)
}

/// Brightness between pixels.
fn light(gray: &Gray, x: f64, y: f64) -> Option<f64> {
    if x < 0.0 || y < 0.0 || x >= gray.width as f64 - 1.0 || y >= gray.height as f64 - 1.0 {
        return None;
    }
    let (x0, y0) = (x as usize, y as usize);
    let (fx, fy) = (x - x0 as f64, y - y0 as f64);
    let at = |dx: usize, dy: usize| f64::from(gray.at(x0 + dx, y0 + dy));
    let top = at(0, 0) + fx * (at(1, 0) - at(0, 0));
    let bottom = at(0, 1) + fx * (at(1, 1) - at(0, 1));
    Some(top + fy * (bottom - top))
}

#[cfg(test)]
mod tests;
