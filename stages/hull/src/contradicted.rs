//! Which masks leave out body that all other photos show.

use nalgebra::Point3;
use rayon::prelude::*;
use shape::{MIN_DISSENT_PHOTOS, Silhouette, deep_dissent};

/// So many cells are along the longest edge of the box in which the body is: 15 mm of an adult, some 200 000 cells, 0.1 s.
/// It is structural: how finely space is sampled.
const CELLS: f64 = 120.0;
/// A mask is contradicted from this share of it on. \[%\] By hand: looked at good masks of 18 photos (true ones of man,
/// woman, mannequin and blue background; found ones of man, woman and mannequin): no photo has more than 0.0 %; three
/// photos beside each other missing 0.04, two of three photos 0.23, 80° of the turn missing 0.39. One stripe of 1.5 to
/// 5 % of the height over chest, waist or thighs of one mask (mannequin, woman), across or upright: 0.8 to 7.3 %, the
/// other photos 0.0.
pub(crate) const CONTRADICTED_PERCENT: f64 = 0.6;

/// How much of each mask, as it shows there, is left out body: of space that all other photos show as body, deeper in
/// all of them than a margin (a share of the body's height), and this one as background. \[%\] Empty where photos are
/// too few to compare.
///
/// Every view carves a thin wedge that no other does; deeper than the margin is only what a stroke took away.
pub(crate) fn contradicted(
    views: &[Silhouette],
    (lo, hi): (Point3<f64>, Point3<f64>),
    margin_pct: f64,
) -> Vec<f64> {
    if views.len() < MIN_DISSENT_PHOTOS {
        return vec![];
    }
    let margin = (margin_pct / 100.0 * (hi.z - lo.z)) as f32;
    let cell = (hi - lo).max() / CELLS;
    let count = |a: usize| ((hi[a] - lo[a]) / cell).ceil().max(1.0) as usize;
    let middle = nalgebra::center(&lo, &hi);
    let across = |view: &Silhouette| {
        let depth = view.camera.project_with_depth(&middle).map(|(_, d)| d);
        depth.map_or(1.0, |d| (cell * view.camera.lens.focal[0] / d).max(1.0))
    };
    let across: Vec<f64> = views.iter().map(across).collect();
    let layer = |k: usize| {
        let mut found = Vec::new();
        for (i, j) in (0..count(0)).flat_map(|i| (0..count(1)).map(move |j| (i, j))) {
            let steps = [i, j, k].map(|n| (n as f64 + 0.5) * cell);
            let x = lo + nalgebra::Vector3::from(steps);
            let sole = deep_dissent(views, &x, margin);
            let place = sole.and_then(|v| Some((v, views[v].camera.project_with_depth(&x)?.0)));
            found.extend(place.map(|(v, px)| {
                let square = [px.x, px.y].map(|c| (c / across[v]) as u32);
                (v, square)
            }));
        }
        found
    };
    let layers: Vec<_> = (0..count(2)).into_par_iter().map(layer).collect();
    let mut squares: Vec<(usize, [u32; 2])> = layers.concat();
    squares.sort_unstable();
    squares.dedup();
    let share = |(v, view): (usize, &Silhouette)| {
        let left_out = squares.iter().filter(|(of, _)| *of == v).count();
        100.0 * left_out as f64 * across[v].powi(2) / view.body_px().max(1) as f64
    };
    views.iter().enumerate().map(share).collect()
}
