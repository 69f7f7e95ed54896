//! A least cut of a window of a photo by what colours tell and where brightness changes.

use crate::maxflow::{Grid, STEPS};
use crate::segment::{Known, Window, beta};
use shape::Rgb;

/// Costs are multiplied by this and rounded, so that flows are whole numbers.
const UNIT: f64 = 64.0;
/// No pixel may be put on the other side.
const NEVER: i32 = 1 << 24;
/// Share of the price of a border that no edge takes away.
const LEAST: f64 = 0.15;

/// Cuts a window: true is the subject. `favour` (ln p(body) − ln p(room)) and the result are row-major
/// over the window, `known` goes by the photo's pixels.
pub(crate) fn cut(
    photo: &Rgb,
    window: &Window,
    favour: &[f32],
    gamma: f64,
    known: &dyn Fn(usize) -> Known,
) -> Vec<bool> {
    let (w, h) = (window.width, window.height);
    let at = |x: usize, y: usize| (window.y + y) * photo.width + window.x + x;
    let beta = beta(photo, window);
    let mut grid = Grid::new(w, h);
    for (here, favour) in favour.iter().enumerate() {
        let (x, y) = (here % w, here / w);
        let i = at(x, y);
        match known(i) {
            Known::Background => grid.set_terminal(x, y, 0, NEVER),
            Known::Body => grid.set_terminal(x, y, NEVER, 0),
            Known::Unknown => {
                let cost = (f64::from(*favour) * UNIT) as i32;
                grid.set_terminal(x, y, cost.max(0), (-cost).max(0));
            }
        }
        for (d, (dx, dy)) in STEPS.iter().enumerate().skip(4) {
            let (nx, ny) = (x as i32 + dx, y as i32 + dy);
            if nx < 0 || nx >= w as i32 || ny >= h as i32 {
                continue;
            }
            let (a, b) = (photo.data[i], photo.data[at(nx as usize, ny as usize)]);
            let differ = (0..3).map(|c| (f64::from(a[c]) - f64::from(b[c])).powi(2));
            let edge = (-(beta * differ.sum::<f64>()).min(12.0)).exp();
            let length = if dx * dy == 0 {
                1.0
            } else {
                std::f64::consts::FRAC_1_SQRT_2
            };
            let weight = gamma * length * (LEAST + (1.0 - LEAST) * edge);
            grid.set_arc(x, y, d, (weight * UNIT / 8.0) as i32);
        }
    }
    grid.cut();
    (0..w * h)
        .map(|i| grid.on_source_side(i % w, i / w))
        .collect()
}
