//! Photos brought to one place and one exposure before anything is said to stand still.
//!
//! A stabiliser shifts each photo by a part of a pixel or more, and automatic exposure changes its
//! light: held against each other as they are, nothing in them stands still.

use crate::exposure::{Levels, exposure_beyond, relit};
use rayon::prelude::*;
use shape::{Camera, Gray, Image, Mask, Placed, Rgb, register, registered};

/// Photos of a turn are of the same exposure where ratios are off one by less than this.
const SAME: f32 = 0.003;

/// How a photo lies in the common place, and what its levels are there.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Level {
    pub(crate) placed: Placed,
    pub(crate) levels: Option<Levels>,
}

impl Level {
    /// A photo that is where and as it should be.
    pub(crate) const NONE: Level = Level {
        placed: Placed::SAME,
        levels: None,
    };

    /// The photo, brought there.
    pub(crate) fn brought(&self, photo: Rgb) -> Rgb {
        let photo = if self.placed.lies() {
            photo
        } else {
            self.placed.brought(&photo)
        };
        self.relit(photo)
    }

    /// A photo that lies there already, as it is exposed there.
    pub(crate) fn relit(&self, photo: Rgb) -> Rgb {
        match &self.levels {
            Some(levels) => relit(&photo, levels),
            None => photo,
        }
    }

    /// Its camera, brought there.
    pub(crate) fn camera(&self, camera: &Camera) -> Camera {
        if self.placed.lies() {
            *camera
        } else {
            self.placed.brought_camera(camera)
        }
    }

    /// A mask of what was brought there, back on the photo.
    pub(crate) fn returned(&self, mask: Mask) -> Mask {
        if self.placed.lies() {
            return mask;
        }
        let back = self.placed.inverse();
        let gray: Gray = mask.map(|v| f32::from(*v));
        back.brought_gray(&gray).map(|v| v.round() as u8)
    }
}

/// The photo laid on the plate, both reduced by a factor. Its exposure stays: the plate is brought to it.
pub(crate) fn on_plate(photo: &Rgb, plate: &Gray, factor: usize) -> Level {
    // Where they share too little the photo stays, and the cut tells that nothing is alike.
    let placed = register(&photo.gray(), plate).unwrap_or(Placed::SAME);
    Level {
        placed: placed.enlarged(factor as f64),
        levels: None,
    }
}

/// How photos of a turn lie on each other.
pub(crate) fn on_each_other(photos: &[Rgb]) -> Vec<Placed> {
    let grays: Vec<Gray> = photos.par_iter().map(Rgb::gray).collect();
    let placed = registered(&grays).0.into_iter();
    // What shares too little stays where it is, and hardly anything will stand still.
    placed.map(|p| p.unwrap_or(Placed::SAME)).collect()
}

/// What brings photos to the exposure of the middle one, once they are laid on each other.
pub(crate) fn exposed_alike(photos: &[Rgb], placed: &[Placed]) -> Vec<Option<Levels>> {
    let reference = middle(photos, placed);
    let alike = |photo: &Rgb| exposure_beyond(&reference, photo, SAME);
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
    Image {
        width: w,
        height: h,
        data: (0..w * h).into_par_iter().map(one).collect(),
    }
}
