//! The least cut of a window of a photo: what each pixel is by itself, and borders that are cheap where
//! brightness changes (Boykov and Jolly 2001; Rother, Kolmogorov, Blake 2004).

use crate::cut::maxflow::{Grid, STEPS};
pub use shape::Known;
use shape::Rgb;

/// Costs are multiplied by this and rounded, so that flows are whole numbers (structural).
pub(crate) const UNIT: f64 = 64.0;
/// Contrast beyond which an edge is not any cheaper (structural: the end of a table, where e^−12 is 0.000 006 of the
/// price).
const MOST_CONTRAST: f64 = 12.0;
/// Share of the price of a border that no edge takes away. By hand: looked at the man with a plate, 533 × 800 pixels, at 0.7 and 1.4
/// of it: mean IoU of masks +0.0000 and −0.0001.
const LEAST_PRICE: f64 = 0.15;

/// A rectangle of an image. \[px\]
pub(crate) struct Window {
    /// Left column.
    pub x: usize,
    /// Top row.
    pub y: usize,
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
}

impl Window {
    /// All of an image.
    pub(crate) fn all(image: &Rgb) -> Self {
        Window {
            x: 0,
            y: 0,
            width: image.width,
            height: image.height,
        }
    }

    /// Its pixels (x, y) in the image, row by row.
    pub(crate) fn places(&self) -> impl Iterator<Item = (usize, usize)> {
        let (x, width) = (self.x, self.width);
        let rows = self.y..self.y + self.height;
        rows.flat_map(move |y| (x..x + width).map(move |x| (x, y)))
    }
}

/// What a cut goes by. Pixels are named by their place in the photo (`i`) or in the window (`here`).
pub(crate) struct Terms<'a> {
    /// What is known of pixel `i`.
    pub(crate) known: &'a dyn Fn(usize) -> Known,
    /// What pixel `i`, `here` costs as background and as body, where it is unknown. \[1/UNIT\]
    pub(crate) colours: &'a dyn Fn(usize, usize) -> (i32, i32),
    /// Whether the edge between two neighbours of the window is the background's own.
    pub(crate) own: &'a dyn Fn(usize, usize) -> bool,
}

/// Cuts a window: true is body; row-major over the window. `gamma` weighs the border's length.
///
/// What is certain is no part of the graph: an arc towards it is an arc towards its side.
pub(crate) fn least_cut(photo: &Rgb, window: &Window, gamma: f64, terms: &Terms<'_>) -> Vec<bool> {
    let (w, h) = (window.width, window.height);
    let at = |x: usize, y: usize| (window.y + y) * photo.width + window.x + x;
    let known: Vec<Known> = (0..w * h)
        .map(|here| (terms.known)(at(here % w, here / w)))
        .collect();
    let mut sides: Vec<bool> = known.iter().map(|k| *k == Known::Body).collect();
    let Some([left, top, right, bottom]) = open(&known, w) else {
        return sides;
    };
    let mut prices = Prices::new(gamma, beta(photo, window));
    let mut grid = Grid::new(right - left, bottom - top);
    // What the two sides of a pixel cost: as itself, then beside what is certain.
    let mut costs = vec![(0, 0); w * h];
    for y in top.max(1) - 1..h.min(bottom + 1) {
        for x in left.max(1) - 1..w.min(right + 1) {
            let here = y * w + x;
            if known[here] == Known::Unknown {
                let (background, body) = (terms.colours)(at(x, y), here);
                costs[here].0 += background;
                costs[here].1 += body;
            }
            for (d, (dx, dy)) in STEPS.iter().enumerate().skip(4) {
                let (nx, ny) = (x as i32 + dx, y as i32 + dy);
                if nx < 0 || nx >= w as i32 || ny >= h as i32 {
                    continue;
                }
                let (nx, ny) = (nx as usize, ny as usize);
                let there = ny * w + nx;
                if known[here] != Known::Unknown && known[there] != Known::Unknown {
                    continue;
                }
                let apart = match (terms.own)(here, there) {
                    true => 0,
                    false => apart(photo.data[at(x, y)], photo.data[at(nx, ny)]),
                };
                let price = prices.of(apart, dx * dy != 0);
                let beside = |to: &mut (i32, i32), other: Known| match other {
                    Known::Body => to.0 += price,
                    _ => to.1 += price,
                };
                match (known[here], known[there]) {
                    (Known::Unknown, Known::Unknown) => {
                        grid.set_arc(x - left, y - top, d, price);
                    }
                    (Known::Unknown, other) => beside(&mut costs[here], other),
                    (other, _) => beside(&mut costs[there], other),
                }
            }
        }
    }
    let places = || (top..bottom).flat_map(|y| (left..right).map(move |x| (x, y)));
    for (x, y) in places() {
        let (background, body) = costs[y * w + x];
        grid.set_terminal(x - left, y - top, background, body);
    }
    grid.cut();
    for (x, y) in places().filter(|(x, y)| known[y * w + x] == Known::Unknown) {
        sides[y * w + x] = grid.on_source_side(x - left, y - top);
    }
    sides
}

/// The rectangle (left, top, right, bottom) of a window that holds all that is unknown.
fn open(known: &[Known], wide: usize) -> Option<[usize; 4]> {
    let mut all: Option<[usize; 4]> = None;
    let unknown = known.iter().enumerate();
    for (i, _) in unknown.filter(|(_, k)| **k == Known::Unknown) {
        let (x, y) = (i % wide, i / wide);
        let [left, top, right, _] = all.unwrap_or([x, y, x, y]);
        all = Some([left.min(x), top, right.max(x + 1), y + 1]);
    }
    all
}

/// What it costs to part two neighbours, by how far their colours are apart.
struct Prices {
    gamma: f64,
    beta: f64,
    /// Of neighbours beside each other and at a corner; 0 where nobody asked yet.
    known: Vec<[i32; 2]>,
}

impl Prices {
    fn new(gamma: f64, beta: f64) -> Self {
        // Beyond this all cost the same.
        let most = (MOST_CONTRAST / beta).ceil().min(f64::from(3 * 255 * 255));
        Prices {
            gamma,
            beta,
            known: vec![[0; 2]; most as usize + 1],
        }
    }

    fn of(&mut self, apart: u32, corner: bool) -> i32 {
        let apart = (apart as usize).min(self.known.len() - 1);
        let known = &mut self.known[apart][usize::from(corner)];
        if *known == 0 {
            let contrast = (self.beta * apart as f64).min(MOST_CONTRAST);
            let length = if corner {
                std::f64::consts::FRAC_1_SQRT_2
            } else {
                1.0
            };
            let weight =
                self.gamma * length * (LEAST_PRICE + (1.0 - LEAST_PRICE) * libm::exp(-contrast));
            *known = (weight * UNIT / 8.0) as i32;
        }
        *known
    }
}

/// As [`least_cut`], by what speaks for the body at each pixel of the window: ln p(body) − ln p(background).
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
fn apart(a: [u8; 3], b: [u8; 3]) -> u32 {
    let differ = (0..3).map(|c| u32::from(a[c].abs_diff(b[c])));
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
            sum += f64::from(apart(pair[0], pair[1]));
            count += 1.0;
        }
    }
    count / (2.0 * sum.max(1.0))
}
