//! How much longer a tape would be with what one photo alone leaves out of the body: a wrong stroke of the brush, a strip
//! that a mask lost.

use crate::geometry::section::{axes, flat, tape};
use nalgebra::Point3;
use rayon::prelude::*;
use shape::{
    Cameras, DISSENT_DEPTH, MIN_DISSENT_PHOTOS, Masks, Plane, Silhouette, deep_dissent,
    sole_dissent,
};
use std::collections::BTreeSet;

/// So many cells are along the depth from which a photo contradicts all the rest (structural: samples).
const CELLS_A_DEPTH: f64 = 6.0;
/// A section is searched around to this many times its size: more that is missing leaves no girth to speak of
/// (structural: a cap on work).
const SEARCHED_SIZES: f64 = 2.0;

/// All outlines of a capture, to ask them about a place.
pub(crate) struct Outlines {
    views: Vec<Silhouette>,
    /// How deep a place must be in all photos but one. \[mm\]
    margin: f64,
}

/// A place in a section's plane, in cells.
type Cell = (i32, i32);

impl Outlines {
    /// The outlines of a body so tall; `None` of too few photos for one to contradict the rest. \[mm\]
    pub(crate) fn of(cameras: &Cameras, masks: &Masks, stature: f64) -> Option<Outlines> {
        let pairs: Vec<_> = cameras.views.join(&masks.views).collect();
        (pairs.len() >= MIN_DISSENT_PHOTOS).then(|| Outlines {
            views: pairs
                .par_iter()
                .map(|(_, view, mask)| Silhouette::of(&mask.pixels(), &view.camera))
                .collect(),
            margin: DISSENT_DEPTH * stature,
        })
    }

    /// How much longer a section's tape would be with the places beside it that one photo alone shows as background,
    /// where they hang together with one that is deep in all other photos. 0 on masks that agree. \[mm\]
    pub(crate) fn left_out_mm(&self, contour: &[Point3<f64>], plane: &Plane) -> f64 {
        let around = flat(contour, plane);
        let step = self.margin / CELLS_A_DEPTH;
        let origin = Point3::from(plane.point_mm);
        let (u, v) = axes(plane);
        let place = |(i, j): Cell| -> Point3<f64> {
            let [a, b] = [i, j].map(|n| f64::from(n) * step);
            origin + u * a + v * b
        };
        let denied: Vec<(Cell, usize, bool)> = window(&around, step)
            .into_par_iter()
            .filter_map(|cell| {
                let x = place(cell);
                let sole = sole_dissent(&self.views, &x)?;
                let deep = deep_dissent(&self.views, &x, self.margin as f32) == Some(sole);
                Some((cell, sole, deep))
            })
            .collect();
        if !denied.iter().any(|(.., deep)| *deep) {
            return 0.0;
        }
        let middle = |cell: &Cell| [cell.0, cell.1].map(|n| f64::from(n) * step);
        let near = |cell: &Cell| {
            let at = middle(cell);
            let far = |p: &[f64; 2]| libm::hypot(p[0] - at[0], p[1] - at[1]);
            around.iter().any(|p| far(p) < 2.0 * step)
        };
        let mut with = around.clone();
        for region in regions(&denied) {
            if region.iter().any(near) {
                with.extend(region.iter().map(middle));
            }
        }
        (tape(&with) - tape(&around)).max(0.0)
    }
}

/// All cells around a curve, [`SEARCHED_SIZES`] as wide as it.
fn window(around: &[[f64; 2]], step: f64) -> Vec<Cell> {
    let ends = |axis: usize| {
        let all = around.iter().map(|p| p[axis]);
        let (lo, hi) = all.fold((f64::MAX, f64::MIN), |(l, h), a| (l.min(a), h.max(a)));
        let more = (SEARCHED_SIZES - 1.0) / 2.0 * (hi - lo);
        let cell = |a: f64| (a / step).round() as i32;
        cell(lo - more)..=cell(hi + more)
    };
    let (across, down) = (ends(0), ends(1));
    across
        .flat_map(|i| down.clone().map(move |j| (i, j)))
        .collect()
}

/// The cells that one photo denies, by what hangs together; of those, the ones with a cell deep in all the rest.
fn regions(denied: &[(Cell, usize, bool)]) -> Vec<Vec<Cell>> {
    let mut left: BTreeSet<(Cell, usize)> = denied.iter().map(|(c, v, _)| (*c, *v)).collect();
    let deep = denied.iter().filter(|(.., deep)| *deep);
    let mut all = Vec::new();
    for (seed, view, _) in deep {
        if !left.remove(&(*seed, *view)) {
            continue;
        }
        let (mut region, mut next) = (Vec::new(), vec![*seed]);
        while let Some(cell) = next.pop() {
            region.push(cell);
            for (di, dj) in [(0, 1), (1, 0), (0, -1), (-1, 0)] {
                let beside = (cell.0 + di, cell.1 + dj);
                if left.remove(&(beside, *view)) {
                    next.push(beside);
                }
            }
        }
        all.push(region);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Point3;
    use shape::{Camera, Intrinsics, Mask, PhotoId, Scale, View};
    use std::f64::consts::TAU;

    /// How far the cameras are from a post's axis. \[mm\]
    const AWAY: f64 = 2500.0;
    /// The post's radius. \[mm\]
    const RADIUS: f64 = 150.0;

    /// Photos around a round post; in the masks of `cut`, its left `left_mm` are background.
    fn turn(photos: u32, cut: &[u32], left_mm: f64) -> (Cameras, Masks) {
        let camera = |k: u32| {
            let (s, c) = libm::sincos(f64::from(k) * TAU / f64::from(photos));
            let lens = Intrinsics::simple(240, 320, 900.0);
            let from = Point3::new(AWAY * c, AWAY * s, 500.0);
            Camera::looking(lens, from, Point3::new(0.0, 0.0, 500.0))
        };
        let mask = |k: u32| {
            let post = 900.0 * RADIUS / libm::sqrt(AWAY * AWAY - RADIUS * RADIUS);
            let left = if cut.contains(&k) {
                900.0 * left_mm / AWAY
            } else {
                0.0
            };
            let body = |x: f64| x.abs() < post && x > left - post;
            Mask {
                width: 240,
                height: 320,
                data: (0..240 * 320)
                    .map(|i| {
                        if body(f64::from(i % 240) - 119.5) {
                            255
                        } else {
                            0
                        }
                    })
                    .collect(),
            }
        };
        let view = |k: u32| View::of(format!("{k:04}.jpg"), camera(k));
        let cameras = Cameras::of((0..photos).map(|k| (PhotoId(k), view(k))), Scale::Given);
        let masks = (0..photos).map(|k| (PhotoId(k), mask(k)));
        (cameras, masks.collect())
    }

    /// The post's section, less what one photo along x cuts from its left: y below a line.
    fn bitten(left_mm: f64) -> Vec<Point3<f64>> {
        let line = left_mm - RADIUS;
        (0..360)
            .map(|k| {
                let (s, c) = libm::sincos(f64::from(k) * TAU / 360.0);
                Point3::new(RADIUS * c, (RADIUS * s).max(line), 500.0)
            })
            .collect()
    }

    fn level() -> Plane {
        Plane {
            point_mm: [0.0, 0.0, 500.0],
            normal: [0.0, 0.0, 1.0],
        }
    }

    #[test]
    fn what_one_photo_alone_cuts_away_is_added() {
        let off = |photos, cut: &[u32], left| {
            let (cameras, masks) = turn(photos, cut, left);
            let all = Outlines::of(&cameras, &masks, 1700.0)?;
            Some(all.left_out_mm(&bitten(left), &level()))
        };
        let whole = TAU * RADIUS;
        let lost = whole - tape(&flat(&bitten(80.0), &level()));
        let found = off(18, &[0], 80.0).unwrap();
        assert!(
            lost > 20.0 && (found - lost).abs() < 0.15 * lost,
            "{found} of {lost}"
        );
        assert_eq!(off(18, &[], 0.0), Some(0.0));
        assert_eq!(
            off(18, &[0], 6.0),
            Some(0.0),
            "as thin as what every photo carves"
        );
        assert_eq!(off(10, &[0], 80.0), None, "too few photos");
    }
}
