//! One photo of a turn on its way to its mask: a coarse cut, then, with what all say, the whole.

use crate::align::alignment::{Alignments, Level};
use crate::align::exposure::{self, exposure, relit};
use crate::align::rectangle::Rectangle;
use crate::border::full_size::fine;
use crate::cut::least_cut::Known;
use crate::empty::Empty;
use crate::label::color_cut::Settings;
use crate::label::color_cut::coarse;
use crate::likelihood::gmm::Gmm;
use crate::likelihood::grain::missed_in_photo;
use crate::likelihood::prepared::{Prepared, prepare};
use crate::params::{CutError, GrabCutParams};
use crate::plate::expected::{expected, plate_turn};
use crate::scene::backdrop::Backdrop;
use shape::{Camera, Image, Mask, Photo, PhotoError, PhotoId, Rgb};
use std::sync::Mutex;

/// What is known of the scene without the subject.
pub(crate) struct Background {
    pub(crate) empty: Empty,
    /// How each photo lies in the common place.
    pub(crate) levels: Alignments,
    /// Hash of all that it follows from.
    pub(crate) content: stage::Hash,
}

/// One photo with all that its mask depends on.
pub(crate) struct OnePhoto<'a> {
    pub(crate) id: PhotoId,
    pub(crate) photo: &'a Photo,
    /// Its camera, where all photos lie alike.
    pub(crate) camera: Option<Camera>,
    pub(crate) level: &'a Level,
    pub(crate) radius: Option<f64>,
    pub(crate) background: &'a Background,
    /// What the coarse cut found out, for the mask.
    pub(crate) kept: Mutex<Option<Kept>>,
}

/// What follows from a photo at full size and is small.
pub(crate) struct Kept {
    lit: Lit,
    ready: Prepared,
}

/// How the plate comes to what a photo shows.
struct Lit {
    levels: Option<exposure::Levels>,
    /// By how much the disk is turned. \[rad\]
    turn: Option<f64>,
}

impl OnePhoto<'_> {
    /// A coarse cut of the photo alone, at the reduced size.
    pub(crate) fn coarse<E: From<CutError> + From<PhotoError>>(
        &self,
        p: &GrabCutParams,
        settings: &Settings,
    ) -> Result<Mask, E> {
        let (_, _, kept) = self.ready::<E>(p)?;
        let (sides, _) = self.checked(self.cut(&kept.ready, settings))?;
        if let Ok(mut free) = self.kept.lock() {
            *free = Some(kept);
        }
        Ok(sides.map(|b| if *b { 255 } else { 0 }))
    }

    /// The mask at full size, with what all photos say together of each reduced pixel.
    pub(crate) fn whole<E: From<CutError> + From<PhotoError>>(
        &self,
        p: &GrabCutParams,
        settings: &Settings,
        agreed: &[Known],
    ) -> Result<Mask, E> {
        let kept = self.kept.lock().ok().and_then(|mut kept| kept.take());
        let (pixels, without, Kept { mut ready, .. }) = match kept {
            Some(kept) => self.again(kept)?,
            None => self.ready::<E>(p)?,
        };
        if !agreed.is_empty() {
            ready.agree(agreed.iter(), &[]);
        }
        let (sides, gmm) = self.checked(self.cut(&ready, settings))?;
        let (depths, background_patches) = match &self.background.empty {
            Empty::Turn {
                depths,
                background_patches,
                ..
            } => (depths.get(&self.id), background_patches.get(&self.id)),
            Empty::Plate(_) => (None, None),
        };
        ready.lay_bare(background_patches.map_or(&[][..], Vec::as_slice));
        let mask = fine(&pixels, &without, &ready, &sides, &gmm, depths, settings);
        Ok(self.level.returned(mask))
    }

    /// The photo, what it would show without the subject, and what follows from both.
    fn ready<E: From<CutError> + From<PhotoError>>(
        &self,
        p: &GrabCutParams,
    ) -> Result<(Rgb, Backdrop, Kept), E> {
        let disk = self.camera.as_ref().zip(self.radius);
        let pixels = self.level.brought(self.photo.decode()?);
        let lit = self.lit(&pixels);
        let without = self.without(&pixels, &lit);
        let (most, side) = (p.coarse_px as usize, p.disk_side_mm);
        let mut ready = prepare(&pixels, &without, disk, most, side);
        missed_in_photo(&mut ready, &without.image);
        let size = (self.photo.width, self.photo.height);
        let rectangle = Rectangle::read(&p.box_px, size.0, size.1).map_err(CutError::from)?;
        if let Some(rectangle) = rectangle {
            rectangle.close(&mut ready.known, ready.small.width, ready.factor);
        }
        Ok((pixels, without, Kept { lit, ready }))
    }

    /// The same once more: photos at full size would fill the memory between both cuts.
    fn again(&self, kept: Kept) -> Result<(Rgb, Backdrop, Kept), PhotoError> {
        let pixels = self.level.brought(self.photo.decode()?);
        let without = self.without(&pixels, &kept.lit);
        Ok((pixels, without, kept))
    }

    /// How the plate was lit and turned, if there is one.
    fn lit(&self, pixels: &Rgb) -> Lit {
        let Empty::Plate(plate) = &self.background.empty else {
            return Lit {
                levels: None,
                turn: None,
            };
        };
        let levels = exposure(pixels, plate);
        let lit = levels.as_ref().map(|levels| relit(plate, levels));
        let plate = lit.as_ref().unwrap_or(plate);
        let disk = self.camera.as_ref().zip(self.radius);
        let turn = disk.map(|(camera, radius)| plate_turn(pixels, plate, camera, radius).0);
        Lit { levels, turn }
    }

    /// What the photo would show without the subject.
    fn without(&self, pixels: &Rgb, lit: &Lit) -> Backdrop {
        match (&self.background.empty, &self.camera) {
            (Empty::Plate(plate), camera) => {
                let relit = lit.levels.as_ref().map(|levels| relit(plate, levels));
                let disk = camera.as_ref().zip(self.radius).zip(lit.turn);
                let turned = disk.map(|((camera, radius), turn)| (camera, radius, turn));
                Backdrop::whole(expected(relit.as_ref().unwrap_or(plate), turned))
            }
            (Empty::Turn { scene, .. }, Some(camera)) => scene.behind(pixels, camera),
            (Empty::Turn { scene, .. }, None) => scene.room.clone(),
        }
    }

    /// The coarse cut: without a plate that on which all photos agreed.
    fn cut(&self, ready: &Prepared, settings: &Settings) -> Option<(Image<bool>, Gmm)> {
        let Empty::Turn { cuts, .. } = &self.background.empty else {
            return coarse(ready, settings);
        };
        let sides = cuts.get(&self.id)?;
        let of_body = sides
            .data
            .iter()
            .zip(&ready.small.data)
            .filter(|(b, _)| **b);
        let colors: Vec<[u8; 3]> = of_body.map(|(_, c)| *c).step_by(7).collect();
        Some((sides.clone(), Gmm::fit(&colors, settings.clusters)?))
    }

    /// A coarse cut that is neither empty nor full.
    fn checked<T>(&self, cut: Option<(Image<bool>, T)>) -> Result<(Image<bool>, T), CutError> {
        let name = || self.photo.name.clone();
        let (sides, more) = cut.ok_or_else(|| CutError::Empty(name()))?;
        let share = sides.data.iter().filter(|b| **b).count() as f64 / sides.data.len() as f64;
        match share {
            s if s < 0.002 => Err(CutError::Empty(name())),
            s if s > 0.9 => Err(CutError::Full(name())),
            _ => Ok((sides, more)),
        }
    }
}
