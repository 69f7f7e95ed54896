//! Photos brought to one place and one exposure before still pixels are looked for.
//!
//! A stabiliser shifts each photo by a part of a pixel or more, and automatic exposure changes its
//! light: compared as they are, nothing in them is still.

use crate::align::exposure::exposure;
use crate::raster::raster;
use rayon::prelude::*;
use shape::{Alignment, Gray, Placed, Rgb, Tones, register, registered};

/// The photo laid on the plate, both reduced by a factor. Its exposure stays: the plate is brought to it.
pub(crate) fn on_plate(photo: &Rgb, plate: &Gray, factor: usize) -> Alignment {
    // Where they share too little the photo stays, and the cut tells that nothing is alike.
    let placed = register(&photo.gray(), plate).unwrap_or(Placed::SAME);
    Alignment {
        placed: placed.enlarged(factor as f64),
        tones: None,
    }
}

/// How photos of a turn are aligned with each other.
pub(crate) fn on_each_other(photos: &[Rgb]) -> Vec<Placed> {
    let grays: Vec<Gray> = photos.par_iter().map(Rgb::gray).collect();
    let placed = registered(&grays).0.into_iter();
    // What shares too little stays where it is, and hardly anything will be still.
    placed.map(|p| p.unwrap_or(Placed::SAME)).collect()
}

/// What brings photos to the exposure of the middle one, once they are laid on each other.
pub(crate) fn exposed_alike(photos: &[Rgb], placed: &[Placed]) -> Vec<Option<Tones>> {
    let reference = middle(photos, placed);
    let alike = |photo: &Rgb| exposure(&reference, photo);
    photos.par_iter().map(alike).collect()
}

/// The middle of all photos, channel by channel, once their brightness is the same.
fn middle(photos: &[Rgb], placed: &[Placed]) -> Rgb {
    let (w, h) = photos.first().map_or((0, 0), |p| (p.width, p.height));
    let one = |i: usize| {
        let mut values: Vec<f32> = Vec::with_capacity(photos.len());
        [0, 1, 2].map(|c| {
            values.clear();
            let each = photos.iter().zip(placed);
            values.extend(
                each.map(|(p, at)| (f32::from(p.data[i][c]) - at.bias as f32) / at.gain as f32),
            );
            values.sort_unstable_by(f32::total_cmp);
            values[values.len() / 2].round().clamp(0.0, 255.0) as u8
        })
    };
    raster(w, h, (0..w * h).into_par_iter().map(one).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use shape::toned;

    /// Photos of a patterned wall before which a plain block goes to and fro, each shifted and exposed
    /// otherwise; the wall, and how each is aligned.
    fn turn() -> (Rgb, Vec<Rgb>, Vec<[f64; 2]>) {
        let wave = |x: f64, y: f64, c: f64| {
            110.0
                + 35.0 * libm::sin(x / 5.0 + c) * libm::cos(y / 4.0)
                + 20.0 * libm::sin((x - y) / 11.0 + c)
        };
        let wall = |[dx, dy]: [f64; 2], gains: [f64; 3], left: Option<f64>| {
            let mut image = Rgb::filled(160, 200, [0; 3]);
            for (i, p) in image.data.iter_mut().enumerate() {
                let (x, y) = ((i % 160) as f64 - dx, (i / 160) as f64 - dy);
                let block = left.is_some_and(|l| (l..l + 40.0).contains(&x) && y > 50.0);
                *p = [0, 1, 2].map(|c| {
                    let shown = if block { 180.0 } else { wave(x, y, c as f64) };
                    (gains[c] * shown).round() as u8
                });
            }
            image
        };
        let shifts: Vec<[f64; 2]> = (0..9)
            .map(|k| f64::from(k) * 1.3)
            .map(|t| [0.8 * libm::sin(t), 0.6 * libm::cos(t)])
            .collect();
        let photo = |(k, shift): (usize, &[f64; 2])| {
            let t = k as f64 * 0.9;
            let (light, warm) = (1.0 + 0.06 * libm::sin(t), 0.02 * libm::cos(t));
            let gains = [light * (1.0 + warm), light, light * (1.0 - warm)];
            wall(*shift, gains, Some(50.0 + 15.0 * libm::sin(t)))
        };
        let photos = shifts.iter().enumerate().map(photo).collect();
        (wall([0.0; 2], [1.0; 3], None), photos, shifts)
    }

    #[test]
    fn photos_of_a_phone_show_the_background_alike_once_they_are_aligned() {
        let (_, photos, _) = turn();
        let placed = on_each_other(&photos);
        let there: Vec<Rgb> = photos
            .iter()
            .zip(&placed)
            .map(|(photo, at)| at.brought(photo))
            .collect();
        let levels = exposed_alike(&there, &placed);
        let alike: Vec<Rgb> = there
            .into_iter()
            .zip(&levels)
            .map(|(photo, levels)| match levels {
                Some(levels) => toned(&photo, levels),
                None => photo,
            })
            .collect();
        // How far photos are apart where the block never is, nine in ten.
        let apart = |photos: &[Rgb]| {
            let places = (8..40).flat_map(|y| (8..152).map(move |x| (x, y)));
            let spread = |(x, y): (usize, usize)| {
                let all = photos.iter().map(|p| p.at(x, y)[0]);
                all.clone().max().unwrap() - all.min().unwrap()
            };
            let mut all: Vec<u8> = places.map(spread).collect();
            all.sort_unstable();
            all[all.len() * 9 / 10]
        };
        assert!(apart(&photos) > 15, "{}", apart(&photos));
        assert!(apart(&alike) <= 4, "{}", apart(&alike));
    }

    #[test]
    fn photos_of_one_place_and_exposure_stay_as_they_are() {
        let (wall, ..) = turn();
        let mut dice = proof::Dice(3);
        let mut noisy = || wall.map(|p| p.map(|v| (f64::from(v) + dice.normal()).round() as u8));
        let photos: Vec<Rgb> = (0..6).map(|_| noisy()).collect();
        let placed = on_each_other(&photos);
        assert!(placed.iter().all(Placed::is_identity), "{placed:?}");
        assert!(exposed_alike(&photos, &placed).iter().all(Option::is_none));
        let level = on_plate(&photos[0], &photos[1].gray(), 1);
        assert!(level.placed.is_identity(), "{level:?}");
    }
}
