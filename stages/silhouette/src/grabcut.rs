//! The stage that cuts the body out of each photo, without a hand-drawn box.

use crate::backdrop::Backdrop;
use crate::background::{expected, plate_turn};
use crate::boxed::{Rectangle, by_colors};
use crate::coherence::agreed;
use crate::common_place::where_photos_lie_alike;
use crate::empty::{Empty, Levels, empty_scene, everything, on_the_plate};
use crate::exposure::{exposure, relit};
use crate::gmm::Gmm;
use crate::least_cut::Known;
use crate::level::Level;
use crate::params::{CutError, GrabCutParams};
use crate::photo_cut::{Prepared, coarse, fine, prepare};
use crate::segment::Settings;
use rayon::prelude::*;
use shape::{Camera, Cameras, Image, Mask, Masks, Photo, PhotoId, Photos, Rgb};
use stage::{Ctx, Stage, Stop};
use std::sync::Arc;

stage::inputs! {
    /// Photos, with a plate or without.
    pub struct GrabCutInput {
        /// The photos.
        photos: Arc<Photos>,
        /// Their cameras: where the disk is, and where the body cannot be. Without a plate they are needed.
        cameras: Option<Arc<Cameras>>,
    }
}

/// `silhouette.grabcut`: photos, cameras → masks.
pub struct GrabCut;

impl Stage for GrabCut {
    const NAME: &'static str = "silhouette.grabcut";
    const VERSION: u32 = 16;
    const ABOUT: &'static str = "Cuts the body out of each photo by graph cuts, seeded by the plate, or by what stands still, and the disk.";
    type Params = GrabCutParams;
    type Input = GrabCutInput;
    type Output = Masks;
    const METRICS: &'static [&'static str] = &["stands still"];

    fn run(p: &GrabCutParams, input: GrabCutInput, ctx: &Ctx<'_>) -> Result<Masks, Stop> {
        let radius = input.cameras.as_ref().and_then(|c| c.disk_radius_mm);
        let settings = Settings {
            gamma: p.gamma,
            rounds: p.rounds as usize,
            clusters: p.clusters as usize,
        };
        let Some(background) = background(p, &settings, &input, ctx)? else {
            return alone(p, &settings, &input.photos, ctx);
        };
        let level = |id| background.levels.get(&id).unwrap_or(&Level::NONE);
        let cameras = input.cameras.as_deref();
        let cameras = cameras.map(|cameras| where_photos_lie_alike(cameras, &background.levels));
        let camera = |id| {
            let cameras = cameras.as_ref();
            cameras.and_then(|c| c.views.get(id)).map(|v| v.camera)
        };
        let jobs: Vec<OnePhoto<'_>> = input
            .photos
            .iter()
            .map(|(id, photo)| OnePhoto {
                id,
                photo,
                camera: camera(id),
                level: level(id),
                radius,
                background: &background,
            })
            .filter(|job| job.camera.is_some() || input.photos.plate.is_some())
            .collect();
        let steps = ctx.steps("photos", jobs.len() * 2);
        // First a coarse cut of each photo alone, then again with what all of them say together.
        let coarse = |job: &OnePhoto<'_>| {
            let mask = job.coarse(p, &settings, ctx)?;
            steps.tick()?;
            Ok((job.id, mask))
        };
        let first: Vec<(PhotoId, Mask)> =
            jobs.par_iter().map(coarse).collect::<Result<_, Stop>>()?;
        let together = match &cameras {
            // Without a plate the photos have agreed already.
            Some(cameras) if p.coherence && input.photos.plate.is_some() => agreed(&first, cameras),
            _ => Default::default(),
        };
        let whole = |job: &OnePhoto<'_>| {
            let agreed = together.get(&job.id).map_or(&[][..], Vec::as_slice);
            let mask = job.whole(p, &settings, agreed, ctx)?;
            steps.tick()?;
            Ok((job.id, mask))
        };
        let second: Vec<(PhotoId, Mask)> =
            jobs.par_iter().map(whole).collect::<Result<_, Stop>>()?;
        Ok(Masks {
            views: second.into_iter().collect(),
        })
    }
}

/// What is known of the scene without the subject.
struct Background {
    empty: Empty,
    /// How each photo lies in the common place.
    levels: Levels,
    /// Hash of all that it follows from.
    content: stage::Hash,
}

/// The scene without the subject, by the plate or by what stands still; `None` where there is neither,
/// but the user drew a rectangle.
fn background(
    p: &GrabCutParams,
    settings: &Settings,
    input: &GrabCutInput,
    ctx: &Ctx<'_>,
) -> Result<Option<Background>, Stop> {
    let check = || ctx.check().map_err(Stop::from);
    let photos = &input.photos;
    let (empty, levels, content) = match (&photos.plate, &input.cameras) {
        (Some(plate), _) => {
            let pixels = plate.decode()?;
            let levels = on_the_plate(p.coarse_px as usize, photos, &pixels, check)?;
            (Empty::Plate(pixels), levels, plate.content())
        }
        (None, Some(cameras)) => match empty_scene(p, settings, photos, cameras, check) {
            Err(Stop::Failed(why)) if !p.box_px.is_empty() && moves(&*why) => {
                ctx.warn(format!("{why}; so photos are cut by colours alone"));
                return Ok(None);
            }
            Err(stop) => return Err(stop),
            Ok((empty, levels, told)) => {
                ctx.metric("stands still", told.stands, "%");
                told.warnings(photos).into_iter().for_each(|w| ctx.warn(w));
                (empty, levels, everything(photos, cameras))
            }
        },
        (None, None) if !p.box_px.is_empty() => return Ok(None),
        (None, None) => return Err(CutError::NoPlate.into()),
    };
    Ok(Some(Background {
        empty,
        levels,
        content,
    }))
}

/// Whether nothing stands still.
fn moves(why: &(dyn std::error::Error + Send + Sync + 'static)) -> bool {
    matches!(why.downcast_ref(), Some(CutError::Moves(_)))
}

/// Each photo by itself, within the user's rectangle, by its colours.
fn alone(
    p: &GrabCutParams,
    settings: &Settings,
    photos: &Photos,
    ctx: &Ctx<'_>,
) -> Result<Masks, Stop> {
    let all: Vec<(PhotoId, &Photo)> = photos.iter().collect();
    let steps = ctx.steps("photos", all.len());
    let cut = |(id, photo): &(PhotoId, &Photo)| {
        let nothing = || CutError::Empty(photo.name.clone());
        let rectangle = Rectangle::read(&p.box_px, photo.width, photo.height);
        let rectangle = rectangle.map_err(CutError::from)?.ok_or_else(nothing)?;
        let pixels = photo.decode()?;
        let mask = by_colors(&pixels, &rectangle, settings, p.coarse_px as usize);
        steps.tick()?;
        Ok((*id, mask.ok_or_else(nothing)?))
    };
    let views = all.par_iter().map(cut).collect::<Result<Vec<_>, Stop>>()?;
    Ok(Masks {
        views: views.into_iter().collect(),
    })
}

/// One photo with all that its mask depends on.
struct OnePhoto<'a> {
    id: PhotoId,
    photo: &'a Photo,
    /// Its camera, where all photos lie alike.
    camera: Option<Camera>,
    level: &'a Level,
    radius: Option<f64>,
    background: &'a Background,
}

impl OnePhoto<'_> {
    /// A coarse cut of the photo alone, at the reduced size.
    fn coarse(&self, p: &GrabCutParams, settings: &Settings, ctx: &Ctx<'_>) -> Result<Mask, Stop> {
        self.remembered(ctx, "coarse", &[], || {
            let (_, _, ready) = self.ready(p)?;
            let (sides, _) = self.checked(self.cut(&ready, settings))?;
            Ok(sides.map(|b| if *b { 255 } else { 0 }))
        })
    }

    /// The mask at full size, with what all photos say together of each reduced pixel.
    fn whole(
        &self,
        p: &GrabCutParams,
        settings: &Settings,
        agreed: &[Known],
        ctx: &Ctx<'_>,
    ) -> Result<Mask, Stop> {
        let said: Vec<u8> = agreed.iter().map(|k| *k as u8).collect();
        self.remembered(ctx, "mask", &[stage::hash(&said)], || {
            let (pixels, without, mut ready) = self.ready(p)?;
            ready.agree(agreed.iter(), &[]);
            let (sides, gmm) = self.checked(self.cut(&ready, settings))?;
            let mask = fine(&pixels, &without, &ready, &sides, &gmm, settings);
            Ok(self.level.returned(mask))
        })
    }

    /// The photo, what it would show without the subject, and what follows from both.
    fn ready(&self, p: &GrabCutParams) -> Result<(Rgb, Backdrop, Prepared), Stop> {
        let disk = self.camera.as_ref().zip(self.radius);
        let pixels = self.level.brought(self.photo.decode()?);
        let without = match (&self.background.empty, &self.camera) {
            (Empty::Plate(plate), _) => {
                let lit = exposure(&pixels, plate).map(|levels| relit(plate, &levels));
                let plate = lit.as_ref().unwrap_or(plate);
                let turned = disk.map(|(camera, radius)| {
                    let turn = plate_turn(&pixels, plate, camera, radius).0;
                    (camera, radius, turn)
                });
                Backdrop::whole(expected(plate, turned))
            }
            (Empty::Turn(scene, _), Some(camera)) => scene.behind(&pixels, camera),
            (Empty::Turn(scene, _), None) => scene.room.clone(),
        };
        let (most, side) = (p.coarse_px as usize, p.disk_side_mm);
        let mut ready = prepare(&pixels, &without, disk, most, side);
        let size = (self.photo.width, self.photo.height);
        let rectangle = Rectangle::read(&p.box_px, size.0, size.1).map_err(CutError::from)?;
        if let Some(rectangle) = rectangle {
            rectangle.close(&mut ready.known, ready.small.width, ready.factor);
        }
        Ok((pixels, without, ready))
    }

    /// The coarse cut: without a plate that on which all photos agreed.
    fn cut(&self, ready: &Prepared, settings: &Settings) -> Option<(Image<bool>, Gmm)> {
        let Empty::Turn(_, cuts) = &self.background.empty else {
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

    /// A mask of this photo, found again when nothing that it depends on has changed.
    fn remembered(
        &self,
        ctx: &Ctx<'_>,
        label: &str,
        more: &[stage::Hash],
        make: impl FnOnce() -> Result<Mask, Stop>,
    ) -> Result<Mask, Stop> {
        let stands = format!("{:?} {:?}", self.camera, self.radius);
        let mut depends = vec![
            self.photo.content(),
            self.background.content,
            stage::hash(stands.as_bytes()),
        ];
        depends.extend_from_slice(more);
        let only = |mask| Masks {
            views: [(PhotoId(0), mask)].into_iter().collect(),
        };
        let masks: Masks = ctx.part(label, &depends, || Ok(only(make()?)))?;
        let mask = masks.views.get(PhotoId(0)).cloned();
        mask.ok_or_else(|| CutError::Empty(self.photo.name.clone()).into())
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
