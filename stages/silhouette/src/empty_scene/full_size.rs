//! The photos of a turn where they are aligned: reduced, to be cut; then at full size, for the scene's colours.

use crate::align::reduced::factor;
use crate::empty_scene::means::Means;
use crate::scene::still_and_disk::{Shot, full_side};
use rayon::prelude::*;
use shape::{Aligned, Camera, Image, Photo, PhotoError, PhotoId, Rgb, Seen};

/// Photos that are decoded side by side while means are taken (structural: memory).
const AT_ONCE: usize = 4;

/// Photos, reduced, at one place and one exposure. `check` fails when the user asked to stop.
pub(crate) fn shots<E: From<PhotoError> + Send>(
    aligned: &Aligned,
    known: &[(PhotoId, &Photo)],
    check: impl Fn() -> Result<(), E> + Sync,
) -> Result<Vec<Shot>, E> {
    let one = |(id, photo): &(PhotoId, &Photo)| {
        check()?;
        let alignment = aligned.of(*id);
        let pixels = photo.decode()?;
        // Levels are changed once a photo is small, as they were found.
        let pixels = match alignment.placed.is_identity() {
            true => pixels,
            false => alignment.placed.brought(&pixels),
        };
        let small = pixels.reduced(factor(&pixels, aligned.coarse_px as usize));
        let (width, height) = (small.width as u32, small.height as u32);
        let shot = aligned.camera(*id).map(|camera| Shot {
            id: *id,
            camera: camera.resized(width, height),
            small: alignment.exposed(small),
        });
        Ok(shot)
    };
    let shots: Vec<Option<Shot>> = known.par_iter().map(one).collect::<Result<_, E>>()?;
    Ok(shots.into_iter().flatten().collect())
}

/// Photos with the body on each.
pub(crate) struct Views<'a> {
    pub(crate) aligned: &'a Aligned,
    pub(crate) known: &'a [(PhotoId, &'a Photo)],
    /// The reduced photos: true is body.
    pub(crate) cuts: &'a [Image<bool>],
    /// The disk's radius, 0 without one. \[mm\]
    pub(crate) radius: f64,
}

/// The still background and the disk's map at full size: means of the photos that show them.
pub(crate) fn at_full_size<E: From<PhotoError>>(
    views: &Views<'_>,
    check: impl Fn() -> Result<(), E>,
) -> Result<(Seen, Option<Seen>), E> {
    let Views {
        aligned,
        known,
        cuts,
        radius,
    } = views;
    let size = known.first();
    let (width, height) = size.map_or((0, 0), |(_, p)| (p.width as usize, p.height as usize));
    let cameras: Vec<Camera> = known
        .iter()
        .filter_map(|(id, _)| aligned.camera(*id))
        .collect();
    let mut means = Means::new(width, height, *radius, full_side(&cameras, *radius));
    let pairs: Vec<_> = known.iter().zip(*cuts).zip(&cameras).collect();
    for some in pairs.chunks(AT_ONCE) {
        check()?;
        let decoded: Vec<Rgb> = some
            .par_iter()
            .map(|(((_, photo), _), _)| photo.decode())
            .collect::<Result<_, PhotoError>>()?;
        for (pixels, (((id, _), cut), camera)) in decoded.into_iter().zip(some) {
            means.add(&aligned.of(*id).brought(pixels), camera, cut);
        }
    }
    Ok(means.seen())
}
