//! Backgrounds, clothes, skin, light and disks drawn by a seed: captures that nobody chose.

use crate::dice::Dice;
use crate::noise::octaves;
use nalgebra::Point3;

/// A colour: the share of light that comes back, red, green, blue, linear.
type Color = [f32; 3];

/// Skin from light to dark, about Fitzpatrick's six types. The third is that of the standard scene.
const SKINS: [Color; 6] = [
    [0.72, 0.50, 0.41],
    [0.64, 0.42, 0.31],
    [0.55, 0.33, 0.22],
    [0.38, 0.21, 0.13],
    [0.20, 0.10, 0.06],
    [0.09, 0.05, 0.035],
];

/// How a scene looks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Palette {
    /// Bare wall.
    pub(crate) wall: Color,
    /// How many of the wall's places carry a picture, as a share.
    pub(crate) pictures: f32,
    /// The boards of the floor.
    pub(crate) floor: Color,
    /// The disk's top without a mat.
    pub(crate) disk: Color,
    /// The share of light that the disk's top mirrors.
    pub(crate) gloss: f32,
    /// Skin.
    pub(crate) skin: Color,
    /// What is worn.
    pub(crate) clothes: [Option<Garment>; 2],
    /// The share of light that comes from all sides; `None`: the param's.
    pub(crate) ambient: Option<f64>,
}

/// Cloth around a part of the body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Garment {
    /// From where to where it reaches, as shares of the stature.
    pub(crate) reach: [f32; 2],
    /// How far from the body's middle it reaches at most, as a share of the stature.
    pub(crate) out: f32,
    /// Its colour.
    pub(crate) color: Color,
    /// Which folds it has.
    pub(crate) seed: u32,
}

/// Where a body is: its middle, its ground and its stature. \[mm\]
#[derive(Debug, Clone, Copy)]
pub(crate) struct Placed {
    /// Middle and ground.
    pub(crate) foot: Point3<f64>,
    /// Stature.
    pub(crate) tall: f64,
}

impl Palette {
    /// The default background, skin all over, a disk of wood.
    pub(crate) const STANDARD: Palette = Palette {
        wall: [0.42, 0.42, 0.42 * 0.92],
        pictures: 0.75,
        floor: [0.24, 0.13, 0.08],
        disk: [0.42, 0.27, 0.15],
        gloss: 0.0,
        skin: SKINS[2],
        clothes: [None; 2],
        ambient: None,
    };

    /// The scene that a number names; 0 is the standard one. In one of three, clothes have the colour of the wall (two of
    /// three of those) or of the floor; in one of three the disk mirrors; in one of three no picture hangs.
    pub(crate) fn drawn(scene: u32) -> Palette {
        if scene == 0 {
            return Palette::STANDARD;
        }
        let mut dice = Dice::new(scene, 77);
        let wall = muted(&mut dice, 0.12, 0.75);
        let floor = muted(&mut dice, 0.04, 0.5);
        let pictures = if dice.unit() < 1.0 / 3.0 { 0.0 } else { 0.6 };
        let skin = SKINS[(dice.unit() * 6.0) as usize];
        let like = match dice.unit() * 9.0 {
            x if x < 2.0 => Some(wall),
            x if x < 3.0 => Some(floor),
            _ => None,
        };
        let trousers = dice.unit();
        let lower = Garment {
            // Briefs, shorts, or leggings.
            reach: match trousers {
                x if x < 0.3 => [0.46, 0.56],
                x if x < 0.7 => [0.33, 0.6],
                _ => [0.06, 0.6],
            },
            out: 0.16,
            color: match like {
                Some(c) => nearly(c, &mut dice),
                None => muted(&mut dice, 0.02, 0.8),
            },
            seed: scene.wrapping_mul(31) + 1,
        };
        let shirt = dice.unit() < 0.5;
        let same = dice.unit() < 0.3;
        let upper = Garment {
            reach: [0.58, 0.83],
            out: 0.2,
            color: if same {
                nearly(lower.color, &mut dice)
            } else {
                muted(&mut dice, 0.02, 0.8)
            },
            seed: scene.wrapping_mul(31) + 2,
        };
        let gloss = if dice.unit() < 1.0 / 3.0 {
            0.08 + 0.17 * dice.unit() as f32
        } else {
            0.0
        };
        Palette {
            wall,
            pictures,
            floor,
            disk: muted(&mut dice, 0.05, 0.6),
            gloss,
            skin,
            clothes: [Some(lower), shirt.then_some(upper)],
            ambient: Some(0.35 + 0.4 * dice.unit()),
        }
    }

    /// What covers a place of the body: skin or cloth; `pixel` is the size of a pixel there. \[mm\]
    pub(crate) fn cover(&self, at: [f32; 3], body: &Placed, pixel: f32) -> Color {
        let tall = body.tall as f32;
        let [x, y, z] = [0, 1, 2].map(|i| (at[i] - body.foot[i] as f32) / tall);
        let worn =
            |g: &&Garment| (g.reach[0]..g.reach[1]).contains(&z) && libm::hypotf(x, y) < g.out;
        match self.clothes.iter().flatten().find(worn) {
            None => self.skin,
            Some(g) => {
                let folds = octaves(at, 90.0, 8.0, pixel, g.seed);
                g.color.map(|c| c * (1.0 + 0.1 * folds))
            }
        }
    }
}

/// A colour of a brightness from `low` to `high`, tinted as paint and cloth are.
fn muted(dice: &mut Dice, low: f64, high: f64) -> Color {
    // Even in brightness as it is seen, not as it is measured.
    let [low, high] = [low, high].map(libm::cbrt);
    let bright = (low + (high - low) * dice.unit()).powi(3);
    let strong = 0.25 * dice.unit();
    [(); 3].map(|()| (bright * (1.0 + strong * dice.normal()).clamp(0.3, 2.0)).min(0.9) as f32)
}

/// The same colour as two makers mix it: within 4 %.
fn nearly(color: Color, dice: &mut Dice) -> Color {
    let off = 0.96 + 0.08 * dice.unit() as f32;
    color.map(|c| (c * off).min(0.95))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_third_of_the_scenes_wear_what_the_wall_or_the_floor_has() {
        let close = |a: Color, b: Color| (0..3).all(|i| (a[i] / b[i] - 1.0).abs() < 0.05);
        let alike = |s: &u32| {
            let p = Palette::drawn(*s);
            let lower = p.clothes[0].unwrap().color;
            close(lower, p.wall) || close(lower, p.floor)
        };
        let count = (1..=600).filter(alike).count();
        assert!((160..=240).contains(&count), "{count} of 600");
        assert_eq!(Palette::drawn(7), Palette::drawn(7));
        assert_ne!(Palette::drawn(7), Palette::drawn(8));
    }

    #[test]
    fn clothes_are_where_they_are_worn() {
        let mut p = Palette::drawn(3);
        let body = Placed {
            foot: Point3::new(10.0, 0.0, 0.0),
            tall: 1700.0,
        };
        p.clothes[0] = Some(Garment {
            reach: [0.4, 0.6],
            out: 0.16,
            color: [0.5; 3],
            seed: 1,
        });
        p.clothes[1] = None;
        assert_eq!(p.cover([100.0, 0.0, 1600.0], &body, 1.0), p.skin);
        assert_ne!(p.cover([100.0, 0.0, 850.0], &body, 1.0), p.skin);
        assert_eq!(p.cover([500.0, 0.0, 850.0], &body, 1.0), p.skin, "a hand");
    }
}
