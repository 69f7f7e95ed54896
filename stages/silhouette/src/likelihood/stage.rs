//! The stage that weighs each reduced pixel: how well the empty scene explains it.

use crate::align::rectangle::Rectangle;
use crate::align::reduced::factor;
use crate::cut::least_cut::Known;
use crate::likelihood::behind::Behind;
use crate::likelihood::grain::missed_in_photo;
use crate::likelihood::local_light::lit;
use crate::likelihood::mirror::{Weighed, gained, mirroring};
use crate::likelihood::person::sense;
use crate::likelihood::prepared::{Prepared, UNSEEN, prepare};
use crate::params::{CutError, DISK_SIDE_MM};
use crate::scene::backdrop::Backdrop;
use rayon::prelude::*;
use shape::{
    Aligned, ByPhoto, Evidence, People, Photo, PhotoEvidence, PhotoId, Photos, Rgb, Scene,
};
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
    const VERSION: u32 = 17;
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
        let turn = Turn {
            aligned,
            people,
            behind,
            disk_side_mm: p.disk_side_mm,
        };
        let before = |(id, photo): &(PhotoId, &Photo)| {
            ctx.check()?;
            Ok((*id, turn.weighed(*id, photo)?))
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
                (Some((evidence, _)), Some(gained)) => {
                    turn.with_mirrored(evidence, gained, *id, photo)?
                }
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

/// What photos of a turn are weighed by.
struct Turn<'a> {
    aligned: &'a Aligned,
    people: Option<&'a People>,
    behind: Behind<'a>,
    disk_side_mm: f64,
}

impl Turn<'_> {
    /// A photo before the scene that is behind it, with what that would show.
    fn weighed(&self, id: PhotoId, photo: &Photo) -> Result<Weighed, Stop> {
        let pixels = self.aligned.of(id).brought(photo.decode()?);
        let without = self.behind.of_photo(id, &pixels);
        let (mut ready, shown) = self.ready(id, &pixels, &without);
        let (known, width, factor) = (&mut ready.known, ready.small.width, ready.factor);
        close(known, width, factor, photo, self.aligned)?;
        Ok((ready.evidence(), shown))
    }

    /// The same, where pixels that gain the light of what the disk mirrors cost as much as with it, if that is less.
    fn with_mirrored(
        &self,
        evidence: &PhotoEvidence,
        gained: &[f32],
        id: PhotoId,
        photo: &Photo,
    ) -> Result<PhotoEvidence, Stop> {
        let pixels = self.aligned.of(id).brought(photo.decode()?);
        let without = self.behind.of_photo(id, &pixels);
        let image = mirroring(&without.image, gained, evidence.factor as usize);
        let (mirroring, _) = self.ready(id, &pixels, &Backdrop { image, ..without });
        let mut evidence = evidence.clone();
        let costs = evidence.background.iter_mut().zip(&mirroring.cost);
        for ((cost, with), gained) in costs.zip(gained.chunks(3)) {
            if gained != [0.0; 3] {
                *cost = cost.min(*with);
            }
        }
        evidence.mirrored = gained.to_vec();
        Ok(evidence)
    }

    /// A photo before what it would show without the subject, and that, reduced.
    fn ready(&self, id: PhotoId, pixels: &Rgb, without: &Backdrop) -> (Prepared, Rgb) {
        let (floor, most) = (self.behind.floor(id), self.aligned.coarse_px as usize);
        let sense = |size, factor| sense(self.people, id, size, factor);
        let mut ready = prepare(pixels, without, floor, most, self.disk_side_mm, &sense);
        let shown = lit(&without.image.reduced(ready.factor), &ready.light, 1);
        missed_in_photo(&mut ready, &shown);
        (ready, shown)
    }
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
        light: vec![],
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
