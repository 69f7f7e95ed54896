//! The stage that cuts the body out of each photo, without a hand-drawn box.

use crate::backdrop::Backdrop;
use crate::background::{expected, plate_turn};
use crate::boxed::{Rectangle, by_colors};
use crate::coherence::agreed;
use crate::empty::{Empty, empty_scene, everything, on_the_plate};
use crate::exposure::{exposure, relit};
use crate::gmm::Gmm;
use crate::level::Level;
use crate::params::{CutError, GrabCutParams};
use crate::photo_cut::{Prepared, coarse, fine, prepare};
use crate::segment::Settings;
use rayon::prelude::*;
use shape::{Camera, Cameras, Image, Mask, Masks, Photo, PhotoId, Photos, Rgb, View};
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
    const VERSION: u32 = 15;
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
        let check = || ctx.check().map_err(Stop::from);
        let (empty, levels, told) = match (&input.photos.plate, &input.cameras) {
            (Some(plate), _) => {
                let pixels = plate.decode()?;
                let levels = on_the_plate(p.coarse_px as usize, &input.photos, &pixels, check)?;
                (Empty::Plate(pixels), levels, plate.content())
            }
            (None, Some(cameras)) => {
                match empty_scene(p, &settings, &input.photos, cameras, check) {
                    Err(Stop::Failed(why)) if !p.box_px.is_empty() && moves(&*why) => {
                        ctx.warn(format!("{why}; so photos are cut by colours alone"));
                        return alone(p, &settings, &input.photos, ctx);
                    }
                    Err(stop) => return Err(stop),
                    Ok((empty, levels, told)) => {
                        ctx.metric("stands still", told.stands, "%");
                        told.warnings(&input.photos)
                            .into_iter()
                            .for_each(|w| ctx.warn(w));
                        (empty, levels, everything(&input.photos, cameras))
                    }
                }
            }
            (None, None) if !p.box_px.is_empty() => {
                return alone(p, &settings, &input.photos, ctx);
            }
            (None, None) => return Err(CutError::NoPlate.into()),
        };
        let level = |id| levels.get(&id).unwrap_or(&Level::NONE);
        // Cameras as they would be where all photos lie alike.
        let brought = |(id, view): (PhotoId, &View)| {
            let camera = level(id).camera(&view.camera);
            let view = View {
                camera,
                ..view.clone()
            };
            (id, view)
        };
        let cameras = input.cameras.as_deref().map(|cameras| Cameras {
            views: cameras.views.iter().map(brought).collect(),
            ..cameras.clone()
        });
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
                empty: &empty,
                told,
            })
            .filter(|job| job.camera.is_some() || input.photos.plate.is_some())
            .collect();
        let steps = ctx.steps("photos", jobs.len() * 2);
        // First a coarse cut of each photo alone, then again with what all of them say together.
        let first: Vec<(PhotoId, Mask)> = jobs
            .par_iter()
            .map(|job| {
                let mask = job.remembered(ctx, "coarse", &[], || {
                    let (_, _, ready) = job.ready(p)?;
                    let (sides, _) = job.checked(job.cut(&ready, &settings))?;
                    Ok(sides.map(|b| if *b { 255 } else { 0 }))
                })?;
                steps.tick()?;
                Ok((job.id, mask))
            })
            .collect::<Result<_, Stop>>()?;
        let together = match &cameras {
            // Without a plate the photos have agreed already.
            Some(cameras) if p.coherence && input.photos.plate.is_some() => agreed(&first, cameras),
            _ => Default::default(),
        };
        let second: Vec<(PhotoId, Mask)> = jobs
            .par_iter()
            .map(|job| {
                let agreed = together.get(&job.id);
                let said: Vec<u8> = agreed.into_iter().flatten().map(|k| *k as u8).collect();
                let mask = job.remembered(ctx, "mask", &[stage::hash(&said)], || {
                    let (pixels, without, mut ready) = job.ready(p)?;
                    ready.agree(agreed.into_iter().flatten(), &[]);
                    let (sides, gmm) = job.checked(job.cut(&ready, &settings))?;
                    let mask = fine(&pixels, &without, &ready, &sides, &gmm, &settings);
                    Ok(job.level.returned(mask))
                })?;
                steps.tick()?;
                Ok((job.id, mask))
            })
            .collect::<Result<_, Stop>>()?;
        Ok(Masks {
            views: second.into_iter().collect(),
        })
    }
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
    empty: &'a Empty,
    /// Hash of all that the empty scene follows from.
    told: stage::Hash,
}

impl OnePhoto<'_> {
    /// The photo, what it would show without the subject, and what follows from both.
    fn ready(&self, p: &GrabCutParams) -> Result<(Rgb, Backdrop, Prepared), Stop> {
        let disk = self.camera.as_ref().zip(self.radius);
        let pixels = self.level.brought(self.photo.decode()?);
        let without = match (self.empty, &self.camera) {
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
        let Empty::Turn(_, cuts) = self.empty else {
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
            self.told,
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
