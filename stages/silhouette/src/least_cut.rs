//! The least cut of a window of a photo: what each pixel is by itself, and borders that are cheap where
//! brightness changes (Boykov and Jolly 2001; Rother, Kolmogorov, Blake 2004).

use crate::maxflow::{Grid, STEPS};
use shape::Rgb;

/// Costs are multiplied by this and rounded, so that flows are whole numbers.
pub(crate) const UNIT: f64 = 64.0;
/// No pixel may be put on the other side.
const NEVER: i32 = 1 << 24;
/// Share of the price of a border that no edge takes away.
const LEAST: f64 = 0.15;

/// What is known of each pixel before the cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Known {
    /// It may be either.
    Unknown,
    /// It cannot be body.
    Background,
    /// It cannot be background.
    Body,
}

/// A rectangle of an image. \[px\]
pub struct Window {
    /// Left column.
    pub x: usize,
    /// Top row.
    pub y: usize,
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
}

/// What a cut goes by. Pixels are told by their place in the photo (`i`) or in the window (`here`).
pub(crate) struct Terms<'a> {
    /// What is known of pixel `i`.
    pub(crate) known: &'a dyn Fn(usize) -> Known,
    /// What pixel `i`, `here` costs as background and as body, where it is unknown. \[1/UNIT\]
    pub(crate) colours: &'a dyn Fn(usize, usize) -> (i32, i32),
    /// Whether the edge between two neighbours of the window is the background's own.
    pub(crate) own: &'a dyn Fn(usize, usize) -> bool,
}

/// Cuts a window: true is body; row-major over the window. `gamma` weighs the border's length.
pub(crate) fn least_cut(photo: &Rgb, window: &Window, gamma: f64, terms: &Terms<'_>) -> Vec<bool> {
    let (w, h) = (window.width, window.height);
    let at = |x: usize, y: usize| (window.y + y) * photo.width + window.x + x;
    let beta = beta(photo, window);
    let mut grid = Grid::new(w, h);
    for here in 0..w * h {
        let (x, y) = (here % w, here / w);
        let i = at(x, y);
        let (background, body) = match (terms.known)(i) {
            Known::Background => (0, NEVER),
            Known::Body => (NEVER, 0),
            Known::Unknown => (terms.colours)(i, here),
        };
        grid.set_terminal(x, y, background, body);
        for (d, (dx, dy)) in STEPS.iter().enumerate().skip(4) {
            let (nx, ny) = (x as i32 + dx, y as i32 + dy);
            if nx < 0 || nx >= w as i32 || ny >= h as i32 {
                continue;
            }
            let (nx, ny) = (nx as usize, ny as usize);
            let contrast = match (terms.own)(here, ny * w + nx) {
                true => 0.0,
                false => (beta * apart(photo.data[i], photo.data[at(nx, ny)])).min(12.0),
            };
            let length = if dx * dy == 0 {
                1.0
            } else {
                std::f64::consts::FRAC_1_SQRT_2
            };
            let weight = gamma * length * (LEAST + (1.0 - LEAST) * libm::exp(-contrast));
            grid.set_arc(x, y, d, (weight * UNIT / 8.0) as i32);
        }
    }
    grid.cut();
    (0..w * h)
        .map(|i| grid.on_source_side(i % w, i / w))
        .collect()
}

/// As [`least_cut`], by what speaks for the body at each pixel of the window: ln p(body) − ln p(room).
pub(crate) fn cut_by_odds(
    photo: &Rgb,
    window: &Window,
    gamma: f64,
    odds: &[f32],
    known: &dyn Fn(usize) -> Known,
) -> Vec<bool> {
    let colours = |_: usize, here: usize| {
        let cost = (f64::from(odds[here]) * UNIT) as i32;
        (cost.max(0), (-cost).max(0))
    };
    let own = |_: usize, _: usize| false;
    let terms = Terms {
        known,
        colours: &colours,
        own: &own,
    };
    least_cut(photo, window, gamma, &terms)
}

/// Squared difference of two colours, channels summed.
fn apart(a: [u8; 3], b: [u8; 3]) -> f64 {
    let differ = (0..3).map(|c| f64::from(a[c]) - f64::from(b[c]));
    differ.map(|d| d * d).sum()
}

/// 1 / (2 mean squared difference of neighbours): Rother, eq. 5.
fn beta(photo: &Rgb, window: &Window) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for y in (window.y..window.y + window.height).step_by(2) {
        for pair in photo.row(y)[window.x..window.x + window.width]
            .windows(2)
            .step_by(2)
        {
            sum += apart(pair[0], pair[1]);
            count += 1.0;
        }
    }
    count / (2.0 * sum.max(1.0))
}
