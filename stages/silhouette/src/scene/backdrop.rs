//! The background out of the photos themselves: it is still while the body turns.
//!
//! Pixels that never change are background, unless what changes encloses them.

use crate::raster::raster;
use rayon::prelude::*;
use shape::{Image, Rgb};

/// Pixels around a mask that do not tell of the background. By hand: looked at scene 132 without a plate, at 1 and 3:
/// mean IoU +0.0019 and −0.0023; as the width of a soft border, scene 131 with a plate, −0.0018 and −0.0013. \[px\]
pub(crate) const SHY: usize = 2;

/// What the photos of a turn show behind the subject.
#[derive(Debug, Clone, PartialEq)]
pub struct Backdrop {
    /// The scene without the subject; of no meaning where nobody saw it.
    pub image: Rgb,
    /// Whether it was seen.
    pub seen: Image<bool>,
}

impl Backdrop {
    /// A photo of the scene without the subject.
    pub fn whole(image: Rgb) -> Self {
        let seen = Image::filled(image.width, image.height, true);
        Backdrop { image, seen }
    }

    /// Of what is not there, such as a disk that nobody named.
    pub(crate) fn nowhere() -> Self {
        Backdrop {
            image: Rgb::filled(1, 1, [0; 3]),
            seen: Image::filled(1, 1, false),
        }
    }
}

/// Colours nearer to each other than this are one. By hand: looked at scene 132 without a plate, at 3 and 6: mean IoU
/// +0.0001 and −0.0000. \[levels\]
pub(crate) const SAME_LEVELS: u8 = 4;

/// Whether two colours are not one.
pub(crate) fn differ(a: [u8; 3], b: [u8; 3]) -> bool {
    (0..3).any(|c| a[c].abs_diff(b[c]) > SAME_LEVELS)
}

/// Whether a pixel's colours are alike but for one: near one of them.
fn alike_but_one(colors: &[[u8; 3]]) -> bool {
    let mut all = colors.iter();
    all.any(|a| colors.iter().filter(|b| differ(*a, **b)).nth(1).is_none())
}

/// The middle of what some photos show at each place of a square, channel by channel, where three do: for surfaces that
/// turn and so are not lit alike.
pub(crate) fn middle(shown: &[Vec<Option<[u8; 3]>>], side: usize) -> Backdrop {
    let one = |i: usize| {
        let colors: Vec<[u8; 3]> = shown.iter().filter_map(|photo| photo[i]).collect();
        let channel = |c: usize| {
            let mut values: Vec<u8> = colors.iter().map(|color| color[c]).collect();
            values.sort_unstable();
            values[values.len() / 2]
        };
        (colors.len() >= 3).then(|| [0, 1, 2].map(channel))
    };
    let all: Vec<Option<[u8; 3]>> = (0..side * side).map(one).collect();
    let image = all.iter().map(|color| color.unwrap_or([0; 3])).collect();
    Backdrop {
        image: raster(side, side, image),
        seen: raster(side, side, all.iter().map(Option::is_some).collect()),
    }
}

/// Pixels that all photos but one show alike; those that the moving ones enclose apart: what never
/// changes amid the turn may be a plain body that covers it all the time.
///
/// Returns for each pixel whether it is still background.
pub fn still(photos: &[&Rgb]) -> Vec<bool> {
    around(&fixed(photos))
}

/// Pixels that all photos but one show alike.
fn fixed(photos: &[&Rgb]) -> Image<bool> {
    let (w, h) = photos.first().map_or((0, 0), |p| (p.width, p.height));
    let one = |i: usize| {
        let colors: Vec<[u8; 3]> = photos.iter().map(|p| p.data[i]).collect();
        alike_but_one(&colors)
    };
    raster(w, h, (0..w * h).into_par_iter().map(one).collect())
}

/// Which fixed pixels are reached from the photo's border over fixed ones: the rest is amid what changes.
fn around(fixed: &Image<bool>) -> Vec<bool> {
    let (w, h) = (fixed.width, fixed.height);
    // Gaps of three pixels in the ring of change around the body are closed.
    let open = thinned(fixed, 2);
    let mut reached = Image::filled(w, h, false);
    let border = (0..w).flat_map(|x| [(x, 0), (x, h.saturating_sub(1))]);
    let sides = (0..h).flat_map(|y| [(0, y), (w.saturating_sub(1), y)]);
    let mut front: Vec<(usize, usize)> = border.chain(sides).collect();
    while let Some((x, y)) = front.pop() {
        if !open.at(x, y) || std::mem::replace(reached.at_mut(x, y), true) {
            continue;
        }
        for (dx, dy) in [(-1i32, 0i32), (1, 0), (0, -1), (0, 1)] {
            let (nx, ny) = (x as i32 + dx, y as i32 + dy);
            if nx >= 0 && ny >= 0 && nx < w as i32 && ny < h as i32 {
                front.push((nx as usize, ny as usize));
            }
        }
    }
    // What was thinned away beside what was reached belongs to it.
    let near = thinned(&reached.map(|r| !r), 3);
    let both = fixed.data.iter().zip(&near.data);
    both.map(|(fixed, apart)| *fixed && !apart).collect()
}

/// Pixels whose whole neighbourhood is true: a square of `reach` pixels to each side.
pub(crate) fn thinned(image: &Image<bool>, reach: usize) -> Image<bool> {
    let along = |from: &Image<bool>, across: bool| {
        let (w, h) = (from.width, from.height);
        let one = |i: usize| {
            let (x, y) = (i % w, i / w);
            if across {
                (x.saturating_sub(reach)..(x + reach + 1).min(w)).all(|x| from.at(x, y))
            } else {
                (y.saturating_sub(reach)..(y + reach + 1).min(h)).all(|y| from.at(x, y))
            }
        };
        raster(w, h, (0..w * h).map(one).collect())
    };
    along(&along(image, true), false)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A wall of random colours before which a plain block swings to and fro around the middle.
    fn turn(dice: &mut proof::Dice) -> Vec<Rgb> {
        let mut wall = Rgb::filled(60, 40, [0; 3]);
        for p in &mut wall.data {
            *p = [0, 1, 2].map(|_| dice.within(20.0, 200.0) as u8);
        }
        let mut photos = Vec::new();
        for k in 0..12usize {
            let left = 20 + [0, 2, 4, 6, 8, 10, 10, 8, 6, 4, 2, 0][k];
            let body =
                |i: usize| (left..left + 14).contains(&(i % 60)) && i / 60 >= 8 && i / 60 < 32;
            let mut photo = wall.clone();
            for (i, p) in photo.data.iter_mut().enumerate() {
                let noise = dice.within(-1.5, 1.5);
                let shown = if body(i) { [230, 190, 170] } else { *p };
                *p = shown.map(|c| (f64::from(c) + noise).round() as u8);
            }
            photos.push(photo);
        }
        photos
    }

    #[test]
    fn what_never_changes_amid_the_turn_is_body_and_outside_of_it_background() {
        let photos = turn(&mut proof::Dice(1));
        let photos: Vec<&Rgb> = photos.iter().collect();
        let (fixed, still) = (fixed(&photos), still(&photos));
        let at = |x: usize, y: usize| (fixed.at(x, y), still[y * 60 + x]);
        assert_eq!(at(5, 5), (true, true));
        assert_eq!(at(31, 20), (true, false));
        assert_eq!(at(23, 20), (false, false));
    }
}
