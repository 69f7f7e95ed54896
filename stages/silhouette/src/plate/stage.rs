//! The stage that takes a photo of the empty scene as the scene.

use crate::align::exposure::exposure;
use crate::plate::expected::plate_turn;
use crate::raster::only;
use rayon::prelude::*;
use shape::{Aligned, InPhoto, Photo, PhotoId, Photos, Rgb, Scene, Seen, toned};
use stage::{Ctx, Stage, Stop};
use std::sync::Arc;

stage::inputs! {
    /// Photos with a plate; without one nothing is known.
    pub struct PlateInput {
        /// The photos.
        photos: Arc<Photos>,
        /// How they are aligned with the plate.
        aligned: Arc<Aligned>,
    }
}

/// `silhouette.plate`: photos, aligned → scene.
pub struct Plate;

impl Stage for Plate {
    const NAME: &'static str = "silhouette.plate";
    const VERSION: u32 = 3;
    const ABOUT: &'static str = "Takes the plate as the empty scene: what its levels are on each photo, and how the disk on it is turned. Without a plate all is unknown.";
    type Params = ();
    type Input = PlateInput;
    type Output = Scene;

    fn run(_: &(), input: PlateInput, ctx: &Ctx<'_>) -> Result<Scene, Stop> {
        let aligned = &*input.aligned;
        let photos = &aligned.photos(&input.photos);
        let Some(plate) = &photos.plate else {
            return Ok(Scene::unknown());
        };
        let pixels = plate.decode()?;
        let all: Vec<(PhotoId, &Photo)> = photos.iter().collect();
        let steps = ctx.steps("photos", all.len());
        let one = |(id, photo): &(PhotoId, &Photo)| {
            let alignment = format!(
                "{:?} {:?} {:?}",
                aligned.of(*id),
                aligned.camera(*id),
                aligned.disk_radius_mm()
            );
            let depends = [
                photo.content(),
                plate.content(),
                stage::hash(alignment.as_bytes()),
            ];
            let alone = || {
                let brought = aligned.of(*id).brought(photo.decode()?);
                Ok(Scene {
                    views: only(in_photo(&brought, &pixels, aligned, *id)),
                    ..Scene::unknown()
                })
            };
            let found: Scene = ctx.part("in photo", &depends, alone)?;
            steps.tick()?;
            let view = found.views.get(PhotoId(0)).cloned();
            Ok((*id, view.unwrap_or_default()))
        };
        let views = all.par_iter().map(one).collect::<Result<Vec<_>, Stop>>()?;
        Ok(Scene {
            still: Seen::whole(pixels),
            views: views.into_iter().collect(),
            ..Scene::unknown()
        })
    }
}

/// How the plate comes to what a photo would show of it.
fn in_photo(photo: &Rgb, plate: &Rgb, aligned: &Aligned, id: PhotoId) -> InPhoto {
    let tones = exposure(photo, plate);
    let lit = tones.as_ref().map(|tones| toned(plate, tones));
    let plate = lit.as_ref().unwrap_or(plate);
    let disk = aligned.camera(id).zip(aligned.disk_radius_mm());
    let disk_turn = disk.map(|(camera, radius)| plate_turn(photo, plate, &camera, radius).0);
    InPhoto { tones, disk_turn }
}
