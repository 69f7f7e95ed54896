//! What surrounds a point: histograms of gradients in its own direction (Lowe 2004, §6), as square
//! roots (Arandjelović and Zisserman 2012).

use crate::features::detect::Extremum;
use crate::features::gradients::{AT_ONCE, Row, faded};
use shape::Gray;
use stage::machine::widest;

/// As in Lowe 2004, §6.1.
const CELLS: usize = 4;
/// As in Lowe 2004, §6.1.
const BINS: usize = 8;
/// Width of a cell in scales, as in Lowe's own program of 2005.
const CELL_SCALES: f32 = 3.0;

/// Cells with a border of one to each side: what is spread beyond the outer ones falls there (structural).
const PADDED: usize = CELLS + 2;

/// The descriptor of a point with a direction. \[rad\]
pub fn describe(image: &Gray, e: &Extremum, angle: f32, fading: &[f32]) -> [u8; 128] {
    let (sin, cos) = libm::sincosf(angle);
    let cell = CELL_SCALES * e.scale;
    let half = CELLS as f32 / 2.0;
    let radius = (cell * std::f32::consts::SQRT_2 * (half + 0.5)).round() as i32;
    let mut padded = [[0f32; BINS]; PADDED * PADDED];
    let (cx, cy) = (e.x.round() as i32, e.y.round() as i32);
    let mut row = Row::default();
    let mut places = [Place::default(); AT_ONCE];
    for y in (cy - radius).max(1)..=(cy + radius).min(image.height as i32 - 2) {
        let dy = (y as f32 - e.y) / cell;
        let reach = (half + 0.5) * cell;
        let [from, to] = chord(sin, cos, dy * cell, reach);
        let least = ((e.x + from) as i32 - 1).max(cx - radius).max(1);
        let most = ((e.x + to) as i32 + 2)
            .min(cx + radius)
            .min(image.width as i32 - 2);
        for start in (least..=most).step_by(AT_ONCE) {
            let count = AT_ONCE.min((most - start + 1) as usize);
            row.look(image, start as usize, y as usize, count);
            widest(
                #[inline(always)]
                || {
                    for i in 0..count {
                        let dx = ((start + i as i32) as f32 - e.x) / cell;
                        let (u, v) = (cos * dx + sin * dy, cos * dy - sin * dx);
                        let from = row.turn[i] - angle / std::f32::consts::TAU;
                        places[i] = Place {
                            u: u + half - 0.5,
                            v: v + half - 0.5,
                            o: (if from < 0.0 { from + 1.0 } else { from }) * BINS as f32,
                            far: (u * u + v * v) / (2.0 * half * half),
                        };
                    }
                },
            );
            for (place, steep) in places[..count].iter().zip(&row.steep) {
                let (u, v, end) = (place.u, place.v, CELLS as f32);
                if u > -1.0 && v > -1.0 && u < end && v < end {
                    spread(&mut padded, place, faded(fading, place.far) * steep);
                }
            }
        }
    }
    let mut bins = [0f32; CELLS * CELLS * BINS];
    for (c, bins) in bins.chunks_exact_mut(BINS).enumerate() {
        bins.copy_from_slice(&padded[(c / CELLS + 1) * PADDED + c % CELLS + 1]);
    }
    let norm = |b: &[f32]| b.iter().map(|x| x * x).sum::<f32>().sqrt().max(1e-12);
    let length = norm(&bins);
    bins.iter_mut().for_each(|b| *b = (*b / length).min(0.2));
    let total = bins.iter().sum::<f32>().max(1e-12);
    let mut out = [0; 128];
    for (o, b) in out.iter_mut().zip(&bins) {
        *o = ((b / total).sqrt() * 512.0).round().min(255.0) as u8;
    }
    out
}

/// Where a row `dy` off a square's middle is in the square turned by an angle; `reach` is half its side.
fn chord(sin: f32, cos: f32, dy: f32, reach: f32) -> [f32; 2] {
    let (mut from, mut to) = (-2.0 * reach, 2.0 * reach);
    // |cos dx + sin dy| < reach, |cos dy - sin dx| < reach.
    for (by, at) in [(cos, sin * dy), (-sin, cos * dy)] {
        if by.abs() > 1e-3 {
            let (a, b) = ((-reach - at) / by, (reach - at) / by);
            from = from.max(a.min(b));
            to = to.min(a.max(b));
        }
    }
    [from, to]
}

/// Where a gradient is among the cells and their bins.
#[derive(Clone, Copy, Default)]
struct Place {
    u: f32,
    v: f32,
    o: f32,
    /// How far from the middle, as it fades.
    far: f32,
}

/// Adds a gradient to the eight bins around it.
fn spread(cells: &mut [[f32; BINS]; PADDED * PADDED], place: &Place, weight: f32) {
    let Place { u, v, o, .. } = *place;
    // Truncation of what is at least -1, moved by one, is the floor.
    let (u1, v1, o0) = ((u + 1.0) as i32, (v + 1.0) as i32, o as i32);
    let (fu, fv, fo) = (u - (u1 as f32 - 1.0), v - (v1 as f32 - 1.0), o - o0 as f32);
    let (o0, o1) = (o0 as usize % BINS, (o0 as usize + 1) % BINS);
    for (dv, wv) in [(0, 1.0 - fv), (1, fv)] {
        let first = (v1 as usize + dv) * PADDED + u1 as usize;
        for (cell, wu) in cells[first..first + 2].iter_mut().zip([1.0 - fu, fu]) {
            let weight = weight * wu * wv;
            cell[o0] += weight * (1.0 - fo);
            cell[o1] += weight * fo;
        }
    }
}
