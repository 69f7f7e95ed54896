//! The scene without the subject, for the stage that cuts: a plate, or what all photos say.

use crate::align::alignment::{Alignments, Level, exposed_alike, on_each_other, on_plate};
use crate::align::rectangle::Rectangle;
use crate::align::reduced::reduced;
use crate::label::color_cut::Settings;
use crate::label::see_through_holes::Depths;
use crate::params::{CutError, GrabCutParams};
use crate::room::doubtful_patches::doubtful;
use crate::room::means::Means;
use crate::room::rounds::{Cuts, standing, without_plate};
use crate::scene::still_and_disk::{Scene, Shot, full_side};
use rayon::prelude::*;
use shape::{Camera, Cameras, Image, Photo, PhotoError, PhotoId, Photos, Placed, Rgb};
use stage::Hash;
use std::collections::BTreeMap;

/// The empty scene.
pub(crate) enum Empty {
    /// A photo of it.
    Plate(Rgb),
    /// What stands still while the body turns, the coarse cuts that go with it, how far rays pass
    /// through the hull of the other photos, and reduced pixels that are bits of the room.
    Turn {
        scene: Box<Scene>,
        cuts: BTreeMap<PhotoId, Image<bool>>,
        depths: BTreeMap<PhotoId, Depths>,
        background_patches: BTreeMap<PhotoId, Vec<usize>>,
    },
}

/// Photos that are decoded side by side while means are taken.
const AT_ONCE: usize = 4;
/// Least share of the photos that must stand still. \[%\]
const STANDS: f64 = 15.0;

/// A patch that nothing vouches for is named when it takes more of its mask than this. \[%\]
const DOUBTFUL: f64 = 0.5;

/// Hash of all photos and cameras: the empty scene without a plate follows from all of them.
pub(crate) fn everything(photos: &Photos, cameras: &Cameras) -> Hash {
    let mut bytes = format!("{:?} {:?}", cameras.views, cameras.disk_radius_mm).into_bytes();
    for (_, photo) in photos.iter() {
        bytes.extend_from_slice(photo.content().as_bytes());
    }
    stage::hash(&bytes)
}

/// Of all photos without a plate.
pub(crate) struct EmptyStats {
    /// The share of the photos that stands still. \[%\]
    pub stands: f64,
    /// Photos whose mask holds a patch that nothing vouches for.
    pub doubtful: Vec<PhotoId>,
}

impl EmptyStats {
    /// What to look at, photos by name.
    pub(crate) fn warnings(&self, photos: &Photos) -> Vec<String> {
        let all = "there is no plate: the empty scene is guessed from what stands still, and may cost parts of the body; look at the masks, or take one photo without the subject and call it plate.jpg";
        let one = "a patch of a colour that the body has nowhere else counts as body where no photo shows the empty room: is it a bit of wall beside arm or trunk? girths there may be too large; look at these masks";
        let name = |id: &PhotoId| photos.get(*id).map(|p| p.name.as_str());
        let names: Vec<&str> = self.doubtful.iter().filter_map(name).collect();
        let mut warnings = vec![all.to_owned()];
        if !names.is_empty() {
            warnings.push(format!("{}: {one}", names.join(", ")));
        }
        warnings
    }
}

/// A photo with its camera.
type Known<'a> = (PhotoId, &'a Photo, Camera);

/// Photos, reduced, brought to one place and one exposure, and how each lay.
fn levelled<E: From<PhotoError> + Send>(
    coarse_px: usize,
    known: &[Known<'_>],
    check: &(impl Fn() -> Result<(), E> + Sync),
) -> Result<(Vec<Shot>, Alignments), E> {
    let factor = |pixels: &Rgb| factor(pixels, coarse_px);
    let first = |(_, photo, _): &Known<'_>| {
        check()?;
        let pixels = photo.decode()?;
        Ok(reduced(&pixels, factor(&pixels)))
    };
    let smalls: Vec<Rgb> = known.par_iter().map(first).collect::<Result<_, E>>()?;
    let placed = on_each_other(&smalls);
    // What moves is moved at full size, where no detail is lost.
    let again = |((known, small), placed): ((&Known<'_>, Rgb), &Placed)| {
        let by = f64::from(known.1.width) / small.width as f64;
        let level = Level {
            placed: placed.enlarged(by.floor()),
            levels: None,
        };
        if placed.lies() {
            return Ok((small, level));
        }
        check()?;
        let there = level.brought(known.1.decode()?);
        Ok((reduced(&there, factor(&there)), level))
    };
    let all: Vec<(Rgb, Level)> = known
        .par_iter()
        .zip(smalls)
        .zip(&placed)
        .map(again)
        .collect::<Result<_, E>>()?;
    let (smalls, mut levels): (Vec<Rgb>, Vec<Level>) = all.into_iter().unzip();
    let exposed = exposed_alike(&smalls, &placed);
    levels
        .iter_mut()
        .zip(exposed)
        .for_each(|(l, e)| l.levels = e);
    let shot = |((small, (id, _, camera)), level): ((Rgb, &Known<'_>), &Level)| Shot {
        id: *id,
        camera: level
            .camera(camera)
            .resized(small.width as u32, small.height as u32),
        small: level.relit(small),
    };
    let shots = smalls
        .into_iter()
        .zip(known)
        .zip(&levels)
        .map(shot)
        .collect();
    let ids = known.iter().map(|k| k.0);
    Ok((shots, ids.zip(levels).collect()))
}

/// By how much a photo is reduced.
fn factor(pixels: &Rgb, coarse_px: usize) -> usize {
    let longest = pixels.width.max(pixels.height);
    longest.div_ceil(coarse_px.max(1)).max(1)
}

/// How photos lie on the plate.
pub(crate) fn on_the_plate<E: From<PhotoError> + Send>(
    coarse_px: usize,
    photos: &Photos,
    plate: &Rgb,
    check: impl Fn() -> Result<(), E> + Sync,
) -> Result<Alignments, E> {
    let factor = plate
        .width
        .max(plate.height)
        .div_ceil(coarse_px.max(1))
        .max(1);
    let still = reduced(plate, factor).gray();
    let all: Vec<(PhotoId, &Photo)> = photos.iter().collect();
    let one = |(id, photo): &(PhotoId, &Photo)| {
        check()?;
        let small = reduced(&photo.decode()?, factor);
        Ok((*id, on_plate(&small, &still, factor)))
    };
    all.par_iter().map(one).collect()
}

/// The empty scene out of all photos that have a camera. `check` fails when the user asked to stop.
pub(crate) fn empty_scene<E: From<CutError> + From<PhotoError> + Send>(
    p: &GrabCutParams,
    settings: &Settings,
    photos: &Photos,
    cameras: &Cameras,
    check: impl Fn() -> Result<(), E> + Sync,
) -> Result<(Empty, Alignments, EmptyStats), E> {
    let known: Vec<Known<'_>> = photos
        .iter()
        .filter_map(|(id, photo)| Some((id, photo, cameras.views.get(id)?.camera)))
        .collect();
    let (shots, levels) = levelled(p.coarse_px as usize, &known, &check)?;
    check()?;
    let stands = standing(&shots) * 100.0;
    if stands < STANDS {
        return Err(CutError::Moves(stands).into());
    }
    let first = known
        .first()
        .map(|(_, photo, _)| (photo.width, photo.height));
    let (wide, tall) = first.unwrap_or((0, 0));
    let rectangle = Rectangle::read(&p.box_px, wide, tall).map_err(CutError::from)?;
    let factor = shots.first().map_or(1, |s| wide as usize / s.small.width);
    let within = rectangle.map(|r| (r, factor));
    let Cuts {
        cuts,
        depths,
        background_patches,
    } = without_plate(&shots, cameras, settings, p.disk_side_mm, within);
    let (width, height) = (wide, tall);
    let radius = cameras.disk_radius_mm.unwrap_or(0.0);
    let shares = doubtful(&shots, &cuts, radius);
    let doubtful = shots.iter().zip(shares).filter(|(_, s)| *s > DOUBTFUL);
    let doubtful = doubtful.map(|(shot, _)| shot.id).collect();
    let brought = |(id, _, camera): &Known<'_>| levels[id].camera(camera);
    let all: Vec<Camera> = known.iter().map(brought).collect();
    let mut means = Means::new(
        width as usize,
        height as usize,
        radius,
        full_side(&all, radius),
    );
    let pairs: Vec<_> = known.iter().zip(&cuts).collect();
    for some in pairs.chunks(AT_ONCE) {
        check()?;
        let decoded: Vec<Rgb> = some
            .par_iter()
            .map(|((_, photo, _), _)| photo.decode())
            .collect::<Result<_, PhotoError>>()?;
        for (pixels, ((id, photo, camera), cut)) in decoded.into_iter().zip(some) {
            let level = &levels[id];
            let (pixels, camera) = (level.brought(pixels), level.camera(camera));
            let cut: &Image<bool> = cut
                .as_ref()
                .ok_or_else(|| CutError::Empty(photo.name.clone()))?;
            means.add(&pixels, &camera, cut);
        }
    }
    let ids = known.iter().map(|k| k.0);
    let cuts = ids.zip(cuts).filter_map(|(id, cut)| Some((id, cut?)));
    let empty = Empty::Turn {
        scene: Box::new(means.scene()),
        cuts: cuts.collect(),
        depths,
        background_patches: shots
            .iter()
            .map(|shot| shot.id)
            .zip(background_patches)
            .collect(),
    };
    Ok((empty, levels, EmptyStats { stands, doubtful }))
}
