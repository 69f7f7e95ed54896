//! The stage that makes photos of a turn comparable.

use crate::align::alignment::{exposed_alike, on_each_other, on_plate};
use crate::align::rectangle::Rectangle;
use crate::align::reduced::factor;
use crate::raster::only;
use rayon::prelude::*;
use shape::{
    Aligned, Alignment, ByPhoto, Cameras, LOOKED_AT_MPX, Photo, PhotoId, Photos, Placed, Rgb,
};
use stage::{Ctx, Stage, Stop};
use std::sync::Arc;

stage::params! {
    /// At which size photos are compared, and where the body is.
    pub struct AlignParams {
        /// Photos are looked at with so many million pixels at most; masks come back at the photos' own size.
        #[range(0.01..=100.0)]
        #[source(structural)]
        most_mpx: f64 = LOOKED_AT_MPX,
        /// Longest side at which photos are compared and first cut; the border is cut again at full size.
        #[range(100..=4000)]
        #[source(structural)]
        coarse_px: u32 = 800,
        /// A rectangle that holds the body on every photo, [left, top, right, bottom]; beyond it
        /// nothing is body. With it photos are cut by their colours alone where there is neither a
        /// plate nor anything still. Empty for none.
        box_px: Vec<f64> = vec![],
    }
}

stage::inputs! {
    /// Photos, with a plate or without.
    pub struct AlignInput {
        /// The photos.
        photos: Arc<Photos>,
        /// Their cameras: where the disk is, and where the body cannot be. Without a plate they are needed.
        cameras: Option<Arc<Cameras>>,
    }
}

/// `silhouette.align`: photos, cameras → aligned.
pub struct Align;

impl Stage for Align {
    const NAME: &'static str = "silhouette.align";
    const VERSION: u32 = 3;
    const ABOUT: &'static str = "Aligns photos with the plate, or with each other, and finds what brings them to one exposure.";
    type Params = AlignParams;
    type Input = AlignInput;
    type Output = Aligned;

    fn run(p: &AlignParams, input: AlignInput, ctx: &Ctx<'_>) -> Result<Aligned, Stop> {
        for (_, photo) in input.photos.iter() {
            Rectangle::read(&p.box_px, photo.width, photo.height)?;
        }
        let photos = &input.photos.within(p.most_mpx);
        let cameras = input.cameras.as_deref().map(|c| c.of_photos(photos));
        let coarse_px = p.coarse_px as usize;
        let views = match (&photos.plate, &cameras) {
            (Some(plate), _) => placed_on(plate, photos, coarse_px, ctx)?,
            (None, Some(cameras)) => alike(photos, cameras, coarse_px, ctx)?,
            (None, None) => ByPhoto::default(),
        };
        Ok(Aligned {
            views,
            most_mpx: p.most_mpx,
            cameras,
            coarse_px: p.coarse_px,
            box_px: on_smaller(&p.box_px, &input.photos, photos),
        })
    }
}

/// What the user drew on the photos, on the same photos looked at smaller. \[px\]
fn on_smaller(box_px: &[f64], photos: &Photos, smaller: &Photos) -> Vec<f64> {
    let sizes = photos.photos.first().zip(smaller.photos.first());
    let scale = sizes.map_or(1.0, |(large, small)| {
        f64::from(small.width) / f64::from(large.width)
    });
    box_px.iter().map(|px| px * scale).collect()
}

/// How photos are aligned with the plate.
fn placed_on(
    plate: &Photo,
    photos: &Photos,
    coarse_px: usize,
    ctx: &Ctx<'_>,
) -> Result<ByPhoto<Alignment>, Stop> {
    let steps = ctx.steps("photos", photos.photos.len());
    let pixels = plate.decode()?;
    let by = factor(&pixels, coarse_px);
    let still = pixels.reduced(by).gray();
    drop(pixels);
    let all: Vec<(PhotoId, &Photo)> = photos.iter().collect();
    let one = |(id, photo): &(PhotoId, &Photo)| {
        let alone = || {
            let small = photo.decode()?.reduced(by);
            Ok(Aligned {
                views: only(on_plate(&small, &still, by)),
                most_mpx: 0.0,
                cameras: None,
                coarse_px: 0,
                box_px: vec![],
            })
        };
        let found: Aligned = ctx.part("alignment", &[photo.content(), plate.content()], alone)?;
        steps.tick()?;
        Ok((*id, found.of(PhotoId(0)).clone()))
    };
    all.par_iter()
        .map(one)
        .collect::<Result<Vec<_>, Stop>>()
        .map(|v| v.into_iter().collect())
}

/// How photos that have a camera are aligned with each other, and what brings them to one exposure.
fn alike(
    photos: &Photos,
    cameras: &Cameras,
    coarse_px: usize,
    ctx: &Ctx<'_>,
) -> Result<ByPhoto<Alignment>, Stop> {
    let known = photos
        .iter()
        .filter(|(id, _)| cameras.views.get(*id).is_some());
    let known: Vec<(PhotoId, &Photo)> = known.collect();
    let small = |(_, photo): &(PhotoId, &Photo)| {
        ctx.check()?;
        let pixels = photo.decode()?;
        Ok(pixels.reduced(factor(&pixels, coarse_px)))
    };
    let smalls: Vec<Rgb> = known.par_iter().map(small).collect::<Result<_, Stop>>()?;
    let placed = on_each_other(&smalls);
    // What moves is moved at full size, where no detail is lost.
    let again = |((known, small), placed): ((&(PhotoId, &Photo), Rgb), &Placed)| {
        let by = f64::from(known.1.width) / small.width as f64;
        let alignment = Alignment {
            placed: placed.enlarged(by.floor()),
            tones: None,
        };
        if placed.is_identity() {
            return Ok((small, alignment));
        }
        ctx.check()?;
        let there = alignment.brought(known.1.decode()?);
        Ok((there.reduced(factor(&there, coarse_px)), alignment))
    };
    let all: Vec<(Rgb, Alignment)> = known
        .par_iter()
        .zip(smalls)
        .zip(&placed)
        .map(again)
        .collect::<Result<_, Stop>>()?;
    let (smalls, mut views): (Vec<Rgb>, Vec<Alignment>) = all.into_iter().unzip();
    let exposed = exposed_alike(&smalls, &placed);
    for (view, tones) in views.iter_mut().zip(exposed) {
        view.tones = tones;
    }
    let ids = known.iter().map(|(id, _)| *id);
    Ok(ids.zip(views).collect())
}
