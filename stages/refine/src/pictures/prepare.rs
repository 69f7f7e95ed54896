//! The pictures of a turn, made ready from photos, cameras and masks.

use crate::pictures::picture::{Picture, Shown};
use rayon::prelude::*;
use shape::{
    Camera, Cameras, Intrinsics, LOOKED_AT_MPX, MaskRuns, Masks, Mesh, Outline, PhotoError,
    PhotoId, Photos, View, Warps, within,
};
use stage::Hash;
use std::sync::Arc;

stage::failures! {
    /// Why a mesh cannot be refined.
    pub enum RefineError {
        /// Too few photos.
        TooFew(count: usize) = "fail-surface-few": "only {count} photos have a camera, but a surface needs at least 2 that see it",
        /// A mesh with holes, or that touches itself.
        Mesh(fault: String) = "fail-surface-fault": "the mesh cannot be refined ({fault}); repair it, or start from `hull.carve`",
        /// A mesh without faces.
        Empty = "fail-surface-empty": "the mesh has no face",
        /// Photos and cameras that do not belong together.
        Size {
            /// The photo.
            name: String,
            /// Its size.
            photo: String,
            /// The camera's.
            camera: String,
        } = "fail-photo-size": "photo {name} is {photo} pixels, but its camera was calibrated for {camera}",
        /// No part of the mesh is seen twice.
        Unseen = "fail-surface-unseen": "no part of the mesh is seen by two photos: do mesh and cameras belong together?",
    }
}

impl From<shape::MeshFault> for RefineError {
    fn from(fault: shape::MeshFault) -> Self {
        RefineError::Mesh(fault.to_string())
    }
}

/// Checks a mesh before anything is done to it.
///
/// # Errors
///
/// The mesh is empty or not closed.
pub fn check(mesh: &Mesh) -> Result<(), RefineError> {
    mesh.validate_closed()?;
    if mesh.faces.is_empty() {
        return Err(RefineError::Empty);
    }
    Ok(())
}

/// A photo is never halved below so many pixels of its longer side: a coarser one shows no limb. By hand: not on
/// record.
const LEAST_PX: u32 = 500;

/// The size at which a photo of a size is looked at first, before it is halved. \[px\]
pub(crate) fn looked_at(lens: &Intrinsics, most_mpx: f64) -> Intrinsics {
    let size = [lens.width, lens.height];
    let [width, height] = within(size, most_mpx.max(LOOKED_AT_MPX));
    match size == [width, height] {
        true => *lens,
        false => lens.resized(width, height),
    }
}

/// How often a photo is halved: until it has at most `most_mpx` million pixels, then `level` times
/// more, but not below [`LEAST_PX`].
pub(crate) fn halvings([width, height]: [u32; 2], level: u32, most_mpx: f64) -> u32 {
    let mpx = |k: u32| f64::from(width >> k) * f64::from(height >> k) / 1e6;
    let first = (0..8).find(|k| mpx(*k) <= most_mpx).unwrap_or(8);
    let fits = |k: &u32| width.max(height) >> k >= LEAST_PX;
    (0..=first + level).rev().find(fits).unwrap_or(0).max(first)
}

/// The cameras whose photo is there, in turning order: the order of [`pictures`].
pub fn posed<'a>(photos: &Photos, cameras: &'a Cameras) -> Vec<(PhotoId, &'a View)> {
    let views = cameras.views.iter();
    views.filter(|(id, _)| photos.get(*id).is_some()).collect()
}

/// The photos that have a camera, at one level: each halved until it has at most `most_mpx`
/// million pixels, then `level` times more, 500 pixels left. What a photo shows is kept beside its file for the stages that
/// look at it next, but at level 0, with which what was kept goes. `check` fails when the user asked to stop.
///
/// # Errors
///
/// A photo cannot be decoded, fewer than two have cameras, or what `check` refuses.
pub fn pictures<E: From<RefineError> + From<PhotoError> + Send>(
    photos: &Photos,
    cameras: &Cameras,
    masks: Option<&Masks>,
    level: u32,
    most_mpx: f64,
    check: impl Fn() -> Result<(), E> + Sync,
) -> Result<Vec<Picture>, E> {
    let views = posed(photos, cameras);
    if views.len() < 2 {
        return Err(RefineError::TooFew(views.len()).into());
    }
    let smaller = photos.within(most_mpx.max(LOOKED_AT_MPX));
    views
        .par_iter()
        .map(|(id, view)| {
            check()?;
            let photo = photos.get(*id).expect("bug: a camera without a photo");
            let lens = &view.camera.lens;
            if [photo.width, photo.height] != [lens.width, lens.height] {
                return Err(RefineError::Size {
                    name: photo.name.clone(),
                    photo: format!("{}×{}", photo.width, photo.height),
                    camera: format!("{}×{}", lens.width, lens.height),
                }
                .into());
            }
            let mask = masks.and_then(|m| m.views.get(*id));
            let mask =
                mask.filter(|m| (m.width as u32, m.height as u32) == (lens.width, lens.height));
            let lens = &looked_at(lens, most_mpx);
            let camera = Camera {
                lens: *lens,
                pose: view.camera.pose,
            };
            let halvings = halvings([lens.width, lens.height], level, most_mpx);
            let by = made_by(lens, mask, halvings);
            if let Some(shown) = photo.file.kept::<Shown>(by) {
                return Ok(Picture::of(&shown, &camera));
            }
            if level == 0 {
                photo.file.drop_kept::<Shown>();
            }
            let decoded = smaller.get(*id).unwrap_or(photo).decode()?;
            let mask = mask.map(|m| m.pixels().resized(decoded.width, decoded.height));
            let mask = mask.as_ref();
            let outline = mask.and_then(|mask| Outline::of(&decoded, mask));
            let mut shown = Shown::new(decoded.gray(), lens, mask, halvings);
            if let Some(outline) = outline {
                shown = shown.with_outline(&outline, lens);
            }
            let shown = Arc::new(shown);
            // At full size it would take as much again as the stage that looks at it.
            if level > 0 {
                photo.file.keep(by, &shown);
            }
            Ok(Picture::of(&shown, &camera))
        })
        .collect()
}

/// The hash of all that what a photo shows is made by, but for the photo.
fn made_by(lens: &Intrinsics, mask: Option<&MaskRuns>, halvings: u32) -> Hash {
    let mut by = format!("{halvings} {lens:?}").into_bytes();
    if let Some(mask) = mask {
        by.extend_from_slice(mask.content().as_bytes());
    }
    stage::hash(&by)
}

/// Takes out of [`pictures`] of the same photos and cameras how the body deformed.
pub fn undeform(pictures: &mut [Picture], photos: &Photos, cameras: &Cameras, warps: &Warps) {
    let ids = posed(photos, cameras);
    let each = pictures.par_iter_mut().zip(&ids);
    each.for_each(|(picture, (id, view))| {
        if let Some(warp) = warps.views.get(*id) {
            *picture = picture.undeformed(warp, view.camera.lens.width);
        }
    });
}

/// What a pixel covers on the mesh, the median over vertices and pictures. \[mm\]
pub fn footprint(mesh: &Mesh, pictures: &[Picture]) -> f64 {
    let stride = (mesh.positions.len() / 500).max(1);
    let all = (0..mesh.positions.len()).step_by(stride).flat_map(|v| {
        pictures
            .iter()
            .filter_map(move |p| p.project(&mesh.point(v as u32)).map(|x| p.footprint(x.1)))
    });
    shape::upper_median(all).unwrap_or(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn photos_are_halved_to_the_level_but_never_to_a_thumbnail() {
        for (size, level, halved) in [
            ([1600, 2400], 2, 2),
            ([4016, 6016], 2, 3),
            ([800, 1200], 2, 1),
            ([400, 600], 2, 0),
            ([300, 200], 3, 0),
        ] {
            assert_eq!(halvings(size, level, 6.0), halved, "{size:?}");
        }
    }
}
