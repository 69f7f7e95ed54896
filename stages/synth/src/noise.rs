//! Patterns in space that need no picture: value noise and chance by place.

/// A number from 0 to below 1 that depends on a place of the lattice and a seed.
#[inline]
pub(crate) fn chance(at: [i32; 3], seed: u32) -> f32 {
    let mut h = (at[0] as u32).wrapping_mul(0x8da6_b343)
        ^ (at[1] as u32).wrapping_mul(0xd816_3841)
        ^ (at[2] as u32).wrapping_mul(0xcb1a_b31f)
        ^ seed.wrapping_mul(0x9e37_79b9);
    h = (h ^ (h >> 15)).wrapping_mul(0x2c1b_3c6d);
    h = (h ^ (h >> 12)).wrapping_mul(0x297a_2d39);
    h ^= h >> 15;
    (h >> 8) as f32 / (1u32 << 24) as f32
}

/// Three numbers of one place.
pub(crate) fn three(at: [i32; 3], seed: u32) -> [f32; 3] {
    [0, 1, 2].map(|k| chance(at, seed.wrapping_mul(3).wrapping_add(k)))
}

/// Smooth noise from -1 to 1 with lattice points one unit apart (Perlin 1985's value noise).
pub(crate) fn smooth(at: [f32; 3], seed: u32) -> f32 {
    // One by one: a map of an array is a call, and millions of places are asked.
    let cell = [
        at[0].floor() as i32,
        at[1].floor() as i32,
        at[2].floor() as i32,
    ];
    let within = |i: usize| {
        let t = at[i] - cell[i] as f32;
        t * t * t * (t * (t * 6.0 - 15.0) + 10.0)
    };
    let (u, v, w) = (within(0), within(1), within(2));
    let corner =
        |dx: i32, dy: i32, dz: i32| chance([cell[0] + dx, cell[1] + dy, cell[2] + dz], seed);
    let mix = |a: f32, b: f32, t: f32| a + t * (b - a);
    let level = |dz: i32| {
        let low = mix(corner(0, 0, dz), corner(1, 0, dz), u);
        mix(low, mix(corner(0, 1, dz), corner(1, 1, dz), u), v)
    };
    2.0 * mix(level(0), level(1), w) - 1.0
}

/// Noise of many sizes, from `coarse` down to `fine`, each half of the one before and of equal
/// strength; what is smaller than two `pixel`s fades out. About -1 to 1. \[all in one unit\]
pub(crate) fn octaves(at: [f32; 3], coarse: f32, fine: f32, pixel: f32, seed: u32) -> f32 {
    let (mut sum, mut power, mut size, mut k) = (0.0, 0.0f32, coarse, 0);
    while size >= fine * 0.99 {
        let kept = ((size / pixel.max(1e-6) - 1.5) / 1.5).clamp(0.0, 1.0);
        if kept > 0.0 {
            let place = |i: usize| at[i] / size + 37.7 * k as f32;
            sum += kept * smooth([place(0), place(1), place(2)], seed.wrapping_add(k));
        }
        power += 1.0;
        size /= 2.0;
        k += 1;
    }
    1.7 * sum / power.max(1.0).sqrt()
}
