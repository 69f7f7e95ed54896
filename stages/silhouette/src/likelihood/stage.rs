//! The stage that weighs each reduced pixel: how well the empty scene explains it.

use crate::align::rectangle::Rectangle;
use crate::align::reduced::factor;
use crate::cut::least_cut::Known;
use crate::likelihood::behind::Behind;
use crate::likelihood::grain::missed_in_photo;
use crate::likelihood::mirror::{Weighed, gained, mirroring};
use crate::likelihood::person::sense;
use crate::likelihood::prepared::{UNSEEN, prepare};
use crate::params::{CutError, DISK_SIDE_MM};
use crate::scene::backdrop::Backdrop;
use rayon::prelude::*;
use shape::{Aligned, ByPhoto, Evidence, People, Photo, PhotoEvidence, PhotoId, Photos, Scene};
use stage::{Ctx, Stage, Stop};
use std::sync::Arc;

stage::params! {
    /// Where the body cannot be.
    pub struct LikelihoodParams {
        /// Height of the side of the disk below its top that is not body.
        #[range(0.0..=500.0)]
        #[source(derived = "as wherever the disk is known")]
        disk_side_mm: f64 = DISK_SIDE_MM,
    }
}

stage::inputs! {
    /// Photos before a scene.
    pub struct LikelihoodInput {
        /// The photos.
        photos: Arc<Photos>,
        /// How they are aligned, with their cameras.
        aligned: Arc<Aligned>,
        /// The scene without the body.
        scene: Arc<Scene>,
        /// Where a person is, by a learned sense of one.
        people: Option<Arc<People>>,
    }
}

/// `silhouette.likelihood`: photos, aligned, scene → evidence.
pub struct Likelihood;

impl Stage for Likelihood {
    const NAME: &'static str = "silhouette.likelihood";
    const VERSION: u32 = 15;
    const ABOUT: &'static str = "Weighs each reduced pixel against the empty scene, in nats: its colour, its neighbourhood, the grain of disk, floor and walls, and what cannot be body.";
    type Params = LikelihoodParams;
    type Input = LikelihoodInput;
    type Output = Evidence;

    fn run(p: &LikelihoodParams, input: LikelihoodInput, ctx: &Ctx<'_>) -> Result<Evidence, Stop> {
        let (aligned, scene) = (&*input.aligned, &*input.scene);
        let photos = &aligned.photos(&input.photos);
        let people = input.people.as_deref();
        let people = people.map(|people| people.of_photos(&input.photos, photos));
        let people = people.as_ref();
        let behind = Behind::of(scene, aligned, people);
        let all: Vec<(PhotoId, &Photo)> = match scene.is_unknown() {
            true => photos.iter().collect(),
            false => {
                let known = |id| Some((id, photos.get(id)?));
                let can = |(id, _): &(PhotoId, &Photo)| {
                    aligned.camera(*id).is_some() || scene.bodies.is_empty()
                };
                behind.photos().filter_map(known).filter(can).collect()
            }
        };
        let steps = ctx.steps("photos", all.len());
        let before = |(id, photo): &(PhotoId, &Photo)| {
            ctx.check()?;
            let weighed = weighed(*id, photo, aligned, &behind, p.disk_side_mm, vec![])?;
            Ok((*id, weighed))
        };
        let known: &[_] = if scene.is_unknown() { &[] } else { &all };
        let first = known
            .par_iter()
            .map(before)
            .collect::<Result<Vec<_>, Stop>>()?;
        let first: ByPhoto<Weighed> = first.into_iter().collect();
        let gained = gained(&first, aligned).unwrap_or_default();
        let one = |(id, photo): &(PhotoId, &Photo)| {
            ctx.check()?;
            let evidence = match (first.get(*id), gained.get(*id)) {
                (None, _) => of_nothing(photo, aligned)?,
                (Some((evidence, _)), None) => evidence.clone(),
                (_, Some(gained)) => {
                    let gained = gained.clone();
                    weighed(*id, photo, aligned, &behind, p.disk_side_mm, gained)?.0
                }
            };
            let size = [evidence.photo.width, evidence.photo.height];
            let people = people.filter(|_| !scene.is_unknown());
            let evidence = PhotoEvidence {
                person: sense(people, *id, size, evidence.factor as usize),
                ..evidence
            };
            steps.tick()?;
            Ok((*id, evidence))
        };
        let views = all.par_iter().map(one).collect::<Result<Vec<_>, Stop>>()?;
        Ok(Evidence {
            views: views.into_iter().collect(),
        })
    }
}

/// A photo before the scene that is behind it, with what that would show; `gained` is the light of what the disk mirrors.
fn weighed(
    id: PhotoId,
    photo: &Photo,
    aligned: &Aligned,
    behind: &Behind<'_>,
    disk_side_mm: f64,
    gained: Vec<f32>,
) -> Result<Weighed, Stop> {
    let pixels = aligned.of(id).brought(photo.decode()?);
    let without = behind.of_photo(id, &pixels);
    let floor = behind.floor(id);
    let most = aligned.coarse_px as usize;
    let before = |without: &Backdrop| {
        let mut ready = prepare(&pixels, without, floor, most, disk_side_mm);
        missed_in_photo(&mut ready, &without.image);
        ready
    };
    let mut ready = before(&without);
    if !gained.is_empty() {
        let image = mirroring(&without.image, &gained, ready.factor);
        let mirroring = before(&Backdrop {
            image,
            ..without.clone()
        });
        ready.or_mirrored(&mirroring, gained);
    }
    let (known, width, factor) = (&mut ready.known, ready.small.width, ready.factor);
    close(known, width, factor, photo, aligned)?;
    Ok((ready.evidence(), without.image.reduced(factor)))
}

/// A photo of whose scene nothing is known, as it was taken: only the rectangle speaks.
fn of_nothing(photo: &Photo, aligned: &Aligned) -> Result<PhotoEvidence, Stop> {
    let pixels = photo.decode()?;
    let factor = factor(&pixels, aligned.coarse_px as usize);
    let small = pixels.reduced(factor);
    let mut known = vec![Known::Unknown; small.data.len()];
    close(&mut known, small.width, factor, photo, aligned)?;
    Ok(PhotoEvidence {
        factor: factor as u32,
        background: vec![UNSEEN; known.len()],
        mirrored: vec![],
        person: vec![],
        known,
        photo: small,
        noise_levels: 0.0,
    })
}

/// Nothing beyond the user's rectangle is body.
fn close(
    known: &mut [Known],
    width: usize,
    factor: usize,
    photo: &Photo,
    aligned: &Aligned,
) -> Result<(), CutError> {
    if let Some(rectangle) = Rectangle::read(&aligned.box_px, photo.width, photo.height)? {
        rectangle.close(known, width, factor);
    }
    Ok(())
}
