//! The stage that cuts the body out of each photo, without a hand-drawn box.

use crate::align::alignment::Level;
use crate::align::cameras::where_photos_lie_alike;
use crate::align::rectangle::Rectangle;
use crate::border::by_colors::by_colors;
use crate::empty::{Empty, empty_scene, everything, on_the_plate};
use crate::label::color_cut::Settings;
use crate::label::consensus::agreed;
use crate::one_photo::{Background, OnePhoto};
use crate::params::{CutError, GrabCutParams};
use rayon::prelude::*;
use shape::{Cameras, Mask, Masks, Photo, PhotoId, Photos};
use stage::{Ctx, Stage, Stop};
use std::sync::{Arc, Mutex};

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
    const VERSION: u32 = 23;
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
            thinner: 0.0,
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
                kept: Mutex::default(),
            })
            .filter(|job| job.camera.is_some() || input.photos.plate.is_some())
            .collect();
        // Without a plate the photos have agreed already.
        let agreeing = cameras
            .as_ref()
            .filter(|_| p.coherence && input.photos.plate.is_some());
        let passes = 1 + usize::from(agreeing.is_some());
        let steps = ctx.steps("photos", jobs.len() * passes);
        // First a coarse cut of each photo alone, then again with what all of them say together.
        let coarse = |job: &OnePhoto<'_>| {
            let mask = remembered(job, ctx, "coarse", &[], || job.coarse::<Stop>(p, &settings))?;
            steps.tick()?;
            Ok((job.id, mask))
        };
        let together = match agreeing {
            Some(cameras) => {
                let first = jobs.par_iter().map(coarse);
                agreed(&first.collect::<Result<Vec<_>, Stop>>()?, cameras)
            }
            None => Default::default(),
        };
        let whole = |job: &OnePhoto<'_>| {
            let agreed = together.get(&job.id).map_or(&[][..], Vec::as_slice);
            let said: Vec<u8> = agreed.iter().map(|k| *k as u8).collect();
            let more = [stage::hash(&said)];
            let whole = || job.whole::<Stop>(p, &settings, agreed);
            let mask = remembered(job, ctx, "mask", &more, whole)?;
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

/// A mask of a photo, found again when nothing that it depends on has changed.
fn remembered(
    job: &OnePhoto<'_>,
    ctx: &Ctx<'_>,
    label: &str,
    more: &[stage::Hash],
    make: impl FnOnce() -> Result<Mask, Stop>,
) -> Result<Mask, Stop> {
    let stands = format!("{:?} {:?}", job.camera, job.radius);
    let mut depends = vec![
        job.photo.content(),
        job.background.content,
        stage::hash(stands.as_bytes()),
    ];
    depends.extend_from_slice(more);
    let only = |mask| Masks {
        views: [(PhotoId(0), mask)].into_iter().collect(),
    };
    let masks: Masks = ctx.part(label, &depends, || Ok(only(make()?)))?;
    let mask = masks.views.get(PhotoId(0)).cloned();
    mask.ok_or_else(|| CutError::Empty(job.photo.name.clone()).into())
}
