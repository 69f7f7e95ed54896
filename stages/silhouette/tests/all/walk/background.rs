//! The patterned background of a made scene: colours that follow from places as if thrown.

use crate::walk::scene::Made;
use nalgebra::Point3;

/// The colour of walls, floor and ceiling.
pub(crate) fn background(made: &Made, x: &Point3<f64>, axis: usize) -> [f64; 3] {
    if made.plain {
        let light = 0.7 + 0.3 * noise(x, 700.0, 3);
        return made.colors[1].map(|c| c * light);
    }
    let grain = noise(x, 35.0, 4) + noise(x, 110.0, 5) - 1.0;
    if axis == 2 {
        let plank = [(x.x / 180.0).floor(), (x.y / 900.0).floor(), 0.0];
        let shade = 0.3 * (thrown(plank.map(|v| v as i64), 6) - 0.5);
        // The figure's shadow about its feet.
        let shadow = 0.35 * libm::exp(-libm::hypot(x.x - made.aside, x.y) / 230.0);
        let base = if x.z > 1.0 {
            [200.0, 198.0, 190.0]
        } else {
            made.floor
        };
        return base.map(|c| c * (1.0 + 0.5 * grain + shade - shadow));
    }
    let book = [
        (x.z / 330.0).floor() as i64,
        ((x.x + x.y) / 60.0).floor() as i64,
        axis as i64,
    ];
    let tint = [0, 1, 2].map(|c| thrown(book, 7 + c));
    let base = if axis == 0 {
        [150.0, 140.0, 120.0]
    } else {
        [120.0, 132.0, 128.0]
    };
    [0, 1, 2]
        .map(|c: usize| base[c] * (0.55 + 0.55 * thrown(book, 10) + 0.25 * tint[c] + 0.4 * grain))
}

/// A number from 0 to 1 that follows from a place as if thrown.
fn thrown(at: [i64; 3], seed: i64) -> f64 {
    let mut h = (at[0].wrapping_mul(374_761_393) ^ at[1].wrapping_mul(668_265_263))
        .wrapping_add(at[2].wrapping_mul(1_274_126_177))
        .wrapping_add(seed.wrapping_mul(974_634_777)) as u32;
    h = (h ^ (h >> 13)).wrapping_mul(1_274_126_177);
    f64::from((h ^ (h >> 16)) & 0xffff) / 65535.0
}

/// Smooth noise of a grain, 0 to 1. \[mm\]
pub(crate) fn noise(x: &Point3<f64>, grain: f64, seed: i64) -> f64 {
    let q = x / grain;
    let cell = q.map(f64::floor);
    let f = (q - cell).map(|v| v * v * (3.0 - 2.0 * v));
    let mut sum = 0.0;
    for corner in 0..8usize {
        let bit = |a: usize| corner >> a & 1 == 1;
        let weight: f64 = (0..3)
            .map(|a| if bit(a) { f[a] } else { 1.0 - f[a] })
            .product();
        let at = [0, 1, 2].map(|a| cell[a] as i64 + i64::from(bit(a)));
        sum += weight * thrown(at, seed);
    }
    sum
}
