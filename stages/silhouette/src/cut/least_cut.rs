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

    /// Its pixels by their places in an image, row by row.
    pub(crate) fn pixels(&self, image: &Rgb) -> impl Iterator<Item = usize> {
        let wide = image.width;
        self.places().map(move |(x, y)| y * wide + x)
    }

    /// Its pixels (x, y) in the image, row by row.
    pub(crate) fn places(&self) -> impl Iterator<Item = (usize, usize)> {
        let (x, width) = (self.x, self.width);
        let rows = self.y..self.y + self.height;
        rows.flat_map(move |y| (x..x + width).map(move |x| (x, y)))
    }
}

/// A window ready to be cut as often as what its pixels cost changes. Row by row as all of a window is.
pub(crate) struct LeastCut {
    width: usize,
    known: Vec<Known>,
    /// The rectangle (left, top, right, bottom) of all that is unknown.
    open: [usize; 4],
    grid: Grid,
    /// What the sides of each pixel cost in the grid by itself.
    given: Vec<(i32, i32)>,
}

impl LeastCut {
    /// By what is `known` of each pixel, and which edges are the background's `own`; `gamma` weighs the border's length.
    ///
    /// What is certain is no part of the graph: an arc towards it is an arc towards its side.
    pub(crate) fn new(
        photo: &Rgb,
        window: &Window,
        gamma: f64,
        known: Vec<Known>,
        own: &[bool],
    ) -> Self {
        let (w, h) = (window.width, window.height);
        let open @ [left, top, right, bottom] = open(&known, w);
        let mut grid = Grid::new(right - left, bottom - top);
        let mut prices = Prices::new(gamma, beta(photo, window));
        let row = |y: usize| &photo.row(window.y + y)[window.x..][..w];
        for y in top.max(1) - 1..h.min(bottom + 1) {
            for (d, (dx, dy)) in STEPS.iter().enumerate().skip(4) {
                let beyond = |x: usize| (x as i32 + dx) as usize;
                let ny = y + *dy as usize;
                let columns = left.max(1) - 1..w.min(right + 1);
                for x in columns.filter(|x| ny < h && beyond(*x) < w) {
                    let (here, there) = (y * w + x, ny * w + beyond(x));
                    let sides = (known[here], known[there]);
                    if sides.0 != Known::Unknown && sides.1 != Known::Unknown {
                        continue;
                    }
                    let apart = match own[here] || own[there] {
                        true => 0,
                        false => apart(row(y)[x], row(ny)[beyond(x)]),
                    };
                    let price = prices.of(apart, dx * dy != 0);
                    let mut beside = |x: usize, y: usize, other: Known| match other {
                        Known::Body => grid.add_terminal(x - left, y - top, price, 0),
                        _ => grid.add_terminal(x - left, y - top, 0, price),
                    };
                    match sides {
                        (Known::Unknown, Known::Unknown) => {
                            grid.set_arc(x - left, y - top, d, price);
                        }
                        (Known::Unknown, other) => beside(x, y, other),
                        (other, _) => beside(beyond(x), ny, other),
                    }
                }
            }
        }
        LeastCut {
            width: w,
            given: vec![(0, 0); known.len()],
            known,
            open,
            grid,
        }
    }

    /// The window cut by what each pixel costs as background and as body, where it is unknown: true is body. \[1/UNIT\]
    pub(crate) fn sides(&mut self, costs: Vec<(i32, i32)>) -> Vec<bool> {
        let ([left, top, right, bottom], w) = (self.open, self.width);
        let places = || (top..bottom).flat_map(|y| (left..right).map(move |x| (x, y)));
        let open = |known: &[Known], (x, y): &(usize, usize)| known[y * w + x] == Known::Unknown;
        for (x, y) in places().filter(|at| open(&self.known, at)) {
            let (new, old) = (costs[y * w + x], self.given[y * w + x]);
            let more = [new.0 - old.0, new.1 - old.1];
            self.grid.add_terminal(x - left, y - top, more[0], more[1]);
        }
        self.given = costs;
        self.grid.cut();
        let mut sides: Vec<bool> = self.known.iter().map(|k| *k == Known::Body).collect();
        for (x, y) in places().filter(|at| open(&self.known, at)) {
            sides[y * w + x] = self.grid.on_source_side(x - left, y - top);
        }
        sides
    }
}

/// The rectangle (left, top, right, bottom) of a window that holds all that is unknown.
fn open(known: &[Known], wide: usize) -> [usize; 4] {
    let mut all = [usize::MAX, usize::MAX, 0, 0];
    for (y, row) in known.chunks(wide.max(1)).enumerate() {
        let unknown = |k: &Known| *k == Known::Unknown;
        let (first, last) = (row.iter().position(unknown), row.iter().rposition(unknown));
        if let (Some(first), Some(last)) = (first, last) {
            let [left, top, right, _] = all;
            all = [left.min(first), top.min(y), right.max(last + 1), y + 1];
        }
    }
    match all[3] {
        0 => [0; 4],
        _ => all,
    }
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

/// A window cut by what speaks for the body at each of its pixels: ln p(body) − ln p(background).
pub(crate) fn cut_by_odds(
    photo: &Rgb,
    window: &Window,
    gamma: f64,
    odds: &[f32],
    known: &dyn Fn(usize) -> Known,
) -> Vec<bool> {
    let colours = |odds: &f32| {
        let cost = (f64::from(*odds) * UNIT) as i32;
        (cost.max(0), (-cost).max(0))
    };
    let known = window.pixels(photo).map(known).collect();
    let mut cut = LeastCut::new(photo, window, gamma, known, &vec![false; odds.len()]);
    cut.sides(odds.iter().map(colours).collect())
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
