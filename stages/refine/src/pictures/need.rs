//! How much memory the stages of this crate take beside their input, from sizes alone.
//!
//! What a pixel and a vertex take was read off peaks of single stages on turns of 18 photos of 1 and 4 megapixels.

use crate::pictures::crop::Crop;
use crate::pictures::pinhole::{halved_size, pinhole};
use crate::pictures::prepare::{halvings, looked_at, posed};
use shape::{Cameras, Intrinsics, MaskRuns, Masks, Mesh, Outline, Photos};

/// Of a pixel of a picture: brightness, and the distance to the silhouette (structural: what the buffers hold). \[bytes\]
const PICTURE_PIXEL: f64 = 4.0;

/// Of a pixel of a photo on its way to a picture: colours, brightness, distances, each before and
/// after a step. One photo a thread (structural: what the buffers hold). \[bytes\]
const PHOTO_PIXEL: f64 = 36.0;

/// Of a pixel of a photo that is looked at smaller, before it is: colours, and its mask (structural: what the buffers
/// hold). \[bytes\]
const DECODED_PIXEL: f64 = 4.0;

/// Of a vertex: what each photo shows there, its equations, its neighbours. \[bytes\]
/// It is structural: what the memory is planned by.
const VERTEX: f64 = 2500.0;

/// Of a vertex of a surface that only gives way to one with other edges: itself and its neighbours. \[bytes\]
/// It is structural: what the memory is planned by.
const LEFT_VERTEX: f64 = 300.0;

/// Vertices for a pixel of a silhouette at a pixel's spacing: the surface of what is round has π times
/// the area of its outline, and an equilateral triangle with sides 1 has √3/4, two of them a vertex (derived).
const VERTICES: f64 = std::f64::consts::PI / 0.866;

/// Of a body whose silhouettes nobody gave, the share of a photo that it covers.
/// It is structural: what the memory is planned by.
const COVERS: f64 = 0.3;

/// What [`pictures`](crate::pictures::prepare::pictures) takes: those that stay, and what it takes to make them.
pub(crate) struct Need {
    /// Pixels of all pictures.
    pixels: f64,
    /// Of the largest photo, on its way to a picture. \[bytes\]
    photo: f64,
    /// Photos whose outlines are known.
    outlines: f64,
    /// Pixels of a picture that the body covers, in the middle.
    body: f64,
}

impl Need {
    /// From the sizes of photos at a level of the pyramid.
    pub(crate) fn new(
        photos: &Photos,
        cameras: &Cameras,
        masks: Option<&Masks>,
        level: u32,
        most_mpx: f64,
    ) -> Need {
        let mut need = Need {
            pixels: 0.0,
            photo: 0.0,
            outlines: 0.0,
            body: 0.0,
        };
        let views = posed(photos, cameras);
        for (id, view) in &views {
            let pixels = |lens: &Intrinsics| f64::from(lens.width) * f64::from(lens.height);
            let lens = looked_at(&view.camera.lens, most_mpx);
            let halvings = halvings([lens.width, lens.height], level, most_mpx);
            let whole = halved_size(&lens, halvings);
            let picture = (whole[0] * whole[1]) as f64;
            let mask = masks.and_then(|masks| masks.views.get(*id));
            let share = mask.map_or(COVERS, MaskRuns::share);
            need.outlines += f64::from(u8::from(mask.is_some()));
            let shown = pinhole(&lens, whole);
            need.pixels += mask.map_or(picture, |mask| {
                Crop::around(&mask.pixels(), &view.camera.lens, &shown).area() as f64
            });
            let larger = pixels(&view.camera.lens) - pixels(&lens);
            let photo = pixels(&lens) * PHOTO_PIXEL + larger * DECODED_PIXEL;
            need.photo = need.photo.max(photo);
            need.body += picture * share / views.len() as f64;
        }
        need
    }

    /// Of the pictures, so many of each, and of making them. \[bytes\]
    pub(crate) fn pictures(&self, copies: u32) -> f64 {
        let threads = rayon::current_num_threads() as f64;
        f64::from(copies) * self.pixels * PICTURE_PIXEL
            + threads * self.photo
            + self.outlines * (Outline::MOST_PIXELS * size_of::<f32>()) as f64
    }

    /// Of a surface with so long edges, or of the one that is there where none are asked for. \[px, bytes\]
    pub(crate) fn surface(&self, edge_px: f64, mesh: &Mesh) -> f64 {
        let came = mesh.positions.len() as f64;
        match edge_px > 0.0 {
            true => self.body * VERTICES / (edge_px * edge_px) * VERTEX + came * LEFT_VERTEX,
            false => came * VERTEX,
        }
    }
}
