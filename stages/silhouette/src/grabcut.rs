//! The stage that cuts the body out of each photo, without a hand-drawn box.

use crate::background::{expected, on_disk, plate_turn};
use crate::segment::{Known, Settings, Window, coverage, cut, cut_whole, largest, reduced};
use crate::unary::background_cost;
use nalgebra::{Point2, Point3};
use rayon::prelude::*;
use shape::{Camera, Cameras, Image, Mask, Masks, Photo, PhotoId, Photos, Rgb};
use stage::{Ctx, Stage, Stop};
use std::sync::Arc;

stage::params! {
    /// How the body is cut out.
    pub struct GrabCutParams {
        /// Weight of the border's length against colours (γ).
        #[range(0.0..=1000.0)]
        gamma: f64 = 40.0,
        /// Rounds of fitting colours and cutting.
        #[range(1..=20)]
        rounds: u32 = 2,
        /// Clusters of the mixture of the body's colours.
        #[range(1..=20)]
        clusters: u32 = 6,
        /// Longest side at which the first cut is made; the border is cut again at full size.
        #[range(100..=4000)]
        coarse_px: u32 = 800,
        /// Height of the side of the disk below its top that is not body.
        #[range(0.0..=500.0)]
        disk_side_mm: f64 = 150.0,
    }
}

stage::inputs! {
    /// Photos, with their plate.
    pub struct GrabCutInput {
        /// The photos.
        photos: Arc<Photos>,
        /// Their cameras: where the disk is, and where the body cannot be.
        cameras: Option<Arc<Cameras>>,
    }
}

/// Why there are no masks.
#[derive(Debug, thiserror::Error)]
pub enum CutError {
    /// No plate.
    #[error(
        "there is no plate: take one photo of the same scene without the subject and call it plate.jpg"
    )]
    NoPlate,
    /// Nothing found.
    #[error(
        "{0}: nothing in it differs from the plate: is it a photo of the empty scene, or was the camera moved after the plate?"
    )]
    Empty(String),
    /// Everything found.
    #[error(
        "{0}: nearly all of it differs from the plate: was the camera moved, or the light changed, after the plate was taken?"
    )]
    Full(String),
}

/// `silhouette.grabcut`: photos, cameras → masks.
pub struct GrabCut;

impl Stage for GrabCut {
    const NAME: &'static str = "silhouette.grabcut";
    const VERSION: u32 = 1;
    const ABOUT: &'static str =
        "Cuts the body out of each photo by graph cuts, seeded by the plate and the disk.";
    type Params = GrabCutParams;
    type Input = GrabCutInput;
    type Output = Masks;

    fn run(p: &GrabCutParams, input: GrabCutInput, ctx: &Ctx<'_>) -> Result<Masks, Stop> {
        let plate_photo = input.photos.plate.as_ref().ok_or(CutError::NoPlate)?;
        let plate = plate_photo.decode()?;
        let all: Vec<(PhotoId, &Photo)> = input.photos.iter().collect();
        let steps = ctx.steps("photos", all.len());
        let one = |(id, photo): &(PhotoId, &Photo)| -> Result<(PhotoId, Mask), Stop> {
            let camera = input
                .cameras
                .as_ref()
                .and_then(|c| c.views.get(*id))
                .map(|v| v.camera);
            let radius = input.cameras.as_ref().and_then(|c| c.disk_radius_mm);
            let stands = stage::hash(format!("{camera:?} {radius:?}").as_bytes());
            let depends = [photo.content(), plate_photo.content(), stands];
            let masks: Masks = ctx.part("mask", &depends, || {
                let mask = segment(photo, &plate, camera.as_ref(), radius, p)?;
                Ok(Masks {
                    views: [(PhotoId(0), mask)].into_iter().collect(),
                })
            })?;
            steps.tick()?;
            Ok((
                *id,
                masks
                    .views
                    .get(PhotoId(0))
                    .cloned()
                    .unwrap_or(Mask::filled(1, 1, 0)),
            ))
        };
        let views: Vec<_> = all.par_iter().map(one).collect::<Result<_, _>>()?;
        Ok(Masks {
            views: views.into_iter().collect(),
        })
    }
}

/// One photo: a coarse cut of all, then the border at full size.
fn segment(
    photo: &Photo,
    plate: &Rgb,
    camera: Option<&Camera>,
    radius: Option<f64>,
    p: &GrabCutParams,
) -> Result<Mask, Stop> {
    let pixels = photo.decode()?;
    let disk = camera.zip(radius).map(|(camera, radius)| {
        let (angle, _) = plate_turn(&pixels, plate, camera, radius);
        (camera, radius, angle)
    });
    let without = expected(plate, disk);
    let settings = Settings {
        gamma: p.gamma,
        rounds: p.rounds as usize,
        clusters: p.clusters as usize,
    };
    let longest = pixels.width.max(pixels.height);
    let factor = longest.div_ceil(p.coarse_px as usize).max(1);
    let small = reduced(&pixels, factor);
    let cost = background_cost(&small, &reduced(&without, factor));
    let camera_small = camera.map(|c| c.resized(small.width as u32, small.height as u32));
    let known = certain(&small, camera_small.as_ref(), radius, p.disk_side_mm);
    let empty = || CutError::Empty(photo.name.clone());
    let (coarse, gmm) = cut_whole(&small, &cost, &known, &settings).ok_or_else(empty)?;
    let share = coarse.data.iter().filter(|b| **b).count() as f64 / coarse.data.len() as f64;
    if share < 0.002 {
        return Err(empty().into());
    }
    if share > 0.9 {
        return Err(CutError::Full(photo.name.clone()).into());
    }
    if factor == 1 {
        return Ok(coverage(&coarse));
    }
    let band = band(&coarse);
    let at = |i: usize| {
        let (x, y) = (i % pixels.width, i / pixels.width);
        (
            (x / factor).min(coarse.width - 1),
            (y / factor).min(coarse.height - 1),
        )
    };
    let cost = background_cost(&pixels, &without);
    let mut sides = Image {
        width: pixels.width,
        height: pixels.height,
        data: (0..pixels.data.len())
            .map(|i| {
                let (x, y) = at(i);
                coarse.at(x, y)
            })
            .collect(),
    };
    // Windows along the border, so that memory stays small; each is cut with what is settled fixed.
    let tile = 16usize;
    let (tiles_x, tiles_y) = (coarse.width.div_ceil(tile), coarse.height.div_ceil(tile));
    for t in 0..tiles_x * tiles_y {
        let (tx, ty) = ((t % tiles_x) * tile, (t / tiles_x) * tile);
        let inside = |x: usize, y: usize| x < coarse.width && y < coarse.height && band.at(x, y);
        if !(ty..ty + tile).any(|y| (tx..tx + tile).any(|x| inside(x, y))) {
            continue;
        }
        // A margin of four coarse pixels around the tile is cut too, then thrown away.
        let window = Window {
            x: tx.saturating_sub(4) * factor,
            y: ty.saturating_sub(4) * factor,
            width: ((tx + tile + 4).min(coarse.width)) * factor - tx.saturating_sub(4) * factor,
            height: ((ty + tile + 4).min(coarse.height)) * factor - ty.saturating_sub(4) * factor,
        };
        let fixed = |i: usize| {
            let (x, y) = at(i);
            match (band.at(x, y), coarse.at(x, y)) {
                (true, _) => known[y * coarse.width + x],
                (false, false) => Known::Background,
                (false, true) => Known::Unknown,
            }
        };
        let mut raised = cost.clone_window(&window, pixels.width, &|i| {
            let (x, y) = at(i);
            !band.at(x, y) && coarse.at(x, y)
        });
        let local = sub(&pixels, &window);
        let whole = Window {
            x: 0,
            y: 0,
            width: window.width,
            height: window.height,
        };
        let of = |i: usize| {
            fixed((window.y + i / window.width) * pixels.width + window.x + i % window.width)
        };
        let body = cut(&local, &raised.split_off(0), &whole, &gmm, &settings, &of);
        for y in ty * factor..((ty + tile) * factor).min(pixels.height) {
            for x in tx * factor..((tx + tile) * factor).min(pixels.width) {
                let (lx, ly) = (x - window.x, y - window.y);
                if lx < window.width && ly < window.height {
                    *sides.at_mut(x, y) = body[ly * window.width + lx];
                }
            }
        }
    }
    Ok(coverage(&largest(&sides)))
}

/// Part of a cost image, with certain body raised beyond doubt.
trait CloneWindow {
    fn clone_window(&self, w: &Window, stride: usize, body: &dyn Fn(usize) -> bool) -> Vec<f32>;
}

impl CloneWindow for Vec<f32> {
    fn clone_window(&self, w: &Window, stride: usize, body: &dyn Fn(usize) -> bool) -> Vec<f32> {
        let places =
            (0..w.width * w.height).map(|i| (w.y + i / w.width) * stride + w.x + i % w.width);
        places
            .map(|i| if body(i) { 1e5 } else { self[i] })
            .collect()
    }
}

/// Part of an image.
fn sub(image: &Rgb, w: &Window) -> Rgb {
    let rows = (w.y..w.y + w.height).flat_map(|y| image.row(y)[w.x..w.x + w.width].to_vec());
    Rgb {
        width: w.width,
        height: w.height,
        data: rows.collect(),
    }
}

/// Coarse pixels within two of the border.
fn band(sides: &Image<bool>) -> Image<bool> {
    let (w, h) = (sides.width as i32, sides.height as i32);
    let mut band = Image {
        width: sides.width,
        height: sides.height,
        data: vec![false; sides.data.len()],
    };
    for y in 0..h {
        for x in 0..w {
            let here = sides.at(x as usize, y as usize);
            let differs = |dx: i32, dy: i32| {
                let (nx, ny) = (x + dx, y + dy);
                nx >= 0 && ny >= 0 && nx < w && ny < h && sides.at(nx as usize, ny as usize) != here
            };
            let near = (-2..=2).any(|dy| (-2..=2).any(|dx| differs(dx, dy)));
            *band.at_mut(x as usize, y as usize) = near;
        }
    }
    band
}

/// What cannot be body: below the disk's top, and outside of the cylinder above the disk.
fn certain(image: &Rgb, camera: Option<&Camera>, radius: Option<f64>, side_mm: f64) -> Vec<Known> {
    let mut known = vec![Known::Unknown; image.data.len()];
    let (Some(camera), Some(radius)) = (camera, radius) else {
        return known;
    };
    // The disk's front rim: pixels below the top's outline in each column see its side or the floor.
    let mut front = vec![f64::MAX; image.width];
    for i in 0..720 {
        let (s, c) = (f64::from(i) * std::f64::consts::TAU / 720.0).sin_cos();
        if let Some(px) = camera.project(&Point3::new(radius * c, radius * s, 0.0)) {
            let x = px.x.round();
            if x >= 0.0 && x < image.width as f64 {
                let lowest = &mut front[x as usize];
                *lowest = if *lowest == f64::MAX {
                    px.y
                } else {
                    lowest.max(px.y)
                };
            }
        }
    }
    for y in 0..image.height {
        for x in 0..image.width {
            let at_px = Point2::new(x as f64, y as f64);
            let below = front[x] != f64::MAX && at_px.y > front[x];
            let beside = front[x] == f64::MAX && side_mm > 0.0 && {
                // Left and right of the disk nothing below its top can be body.
                let centre = camera.centre();
                let ray = camera.ray(at_px);
                let away = centre.x.hypot(centre.y) / ray.x.hypot(ray.y).max(1e-9);
                centre.z + ray.z * away < -0.2 * side_mm
            };
            if below && on_disk(camera, at_px, radius).is_none() || beside {
                known[y * image.width + x] = Known::Background;
            }
        }
    }
    known
}
