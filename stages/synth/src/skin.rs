//! What a body looks like: colours that are a formula of the place on it.

use crate::noise::{chance, octaves, three};

/// How a body looks.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Look {
    /// From 0, one colour, over 0.05, skin, to 1, a printed dress.
    pub(crate) contrast: f32,
    /// Size of the finest marks. \[mm\]
    pub(crate) finest: f32,
    /// Size of the coarsest marks. \[mm\]
    pub(crate) coarsest: f32,
    /// Which of all such bodies.
    pub(crate) seed: u32,
}

/// The share of light that a place sends back, red, green, blue, linear, whose `base` is skin or cloth; `pixel` is the size
/// of a pixel there. \[mm\]
pub(crate) fn albedo(look: &Look, base: [f32; 3], at: [f32; 3], pixel: f32) -> [f32; 3] {
    let noise = |seed: u32| octaves(at, look.coarsest, look.finest, pixel, seed);
    let gray = noise(look.seed);
    let tint = noise(look.seed.wrapping_add(101));
    let mut color = [0, 1, 2].map(|c| {
        let turn = [0.5, -0.1, -0.6][c] * tint;
        base[c] * (1.0 + look.contrast * (0.9 * gray + turn))
    });
    // A print: one drop in two cells, its colour by chance.
    let drop = (4.0 * look.finest).max(8.0);
    let near = at.map(|x| (x / drop).floor() as i32);
    let middle = [0, 1, 2]
        .map(|i| (near[i] as f32 + 0.3 + 0.4 * three(near, look.seed.wrapping_add(7))[i]) * drop);
    let far = (0..3)
        .map(|i| (at[i] - middle[i]) * (at[i] - middle[i]))
        .sum::<f32>();
    let radius = drop * 0.3;
    if chance(near, look.seed.wrapping_add(11)) < 0.5 {
        let edge = ((radius - far.sqrt()) / pixel.max(0.1) + 0.5).clamp(0.0, 1.0);
        let ink = three(near, look.seed.wrapping_add(13));
        let strength = edge * look.contrast * look.contrast;
        (0..3).for_each(|c| color[c] += strength * (ink[c] * 0.8 - color[c]));
    }
    color.map(|c| c.clamp(0.01, 0.95))
}
