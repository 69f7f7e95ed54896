//! One photo: a coarse cut of all of it, then its border at full size.

use crate::background::{expected, on_disk, plate_turn};
use crate::gmm::Gmm;
use crate::segment::{Known, Settings, Window, coverage, cut, cut_whole, largest, reduced};
use crate::unary::background_cost;
use nalgebra::{Point2, Point3};
use shape::{Camera, Image, Mask, Rgb};

/// A photo made ready: reduced, and what it would show without the subject.
pub struct Prepared {
    /// How many pixels along a side became one.
    pub factor: usize,
    /// The reduced photo.
    pub small: Rgb,
    /// -ln p(pixel | background) of the reduced photo.
    pub cost: Vec<f32>,
    /// What is certain before any cut.
    pub known: Vec<Known>,
    /// The photo without the subject, at full size.
    pub without: Rgb,
    /// The camera at the reduced size, and the disk's radius. \[mm\]
    pub disk: Option<(Camera, f64)>,
}

/// A pixel that costs the background no more than this shows it beyond doubt.
const CERTAIN: f32 = 6.92 + 0.4;

impl Prepared {
    /// Takes over what all photos say together. Where this one shows the background to the level,
    /// the others may not call it body: a gap between the legs is seen on two photos of eighteen.
    pub fn agree<'a>(&mut self, agreed: impl Iterator<Item = &'a Known>) {
        for ((known, cost), agreed) in self.known.iter_mut().zip(&self.cost).zip(agreed) {
            let against = *agreed == Known::Body && *cost < CERTAIN;
            if *known == Known::Unknown && !against {
                *known = *agreed;
            }
        }
    }
}

/// Where the disk is: the photo's camera and the disk's radius. \[mm\]
pub type Disk<'a> = Option<(&'a Camera, f64)>;

/// Makes a photo ready to be cut. `coarse_px` is the longest side of the reduced photo.
pub fn prepare(
    pixels: &Rgb,
    plate: &Rgb,
    disk: Disk<'_>,
    coarse_px: usize,
    side_mm: f64,
) -> Prepared {
    let turned =
        disk.map(|(camera, radius)| (camera, radius, plate_turn(pixels, plate, camera, radius).0));
    let without = expected(plate, turned);
    let factor = pixels
        .width
        .max(pixels.height)
        .div_ceil(coarse_px.max(1))
        .max(1);
    let small = reduced(pixels, factor);
    let at_small =
        disk.map(|(c, radius)| (c.resized(small.width as u32, small.height as u32), radius));
    let cost = background_cost(&small, &reduced(&without, factor), &|x, y| {
        shaded(&at_small, 1, x, y)
    });
    let known = certain(
        &small,
        at_small.as_ref().map(|(c, radius)| (c, *radius)),
        side_mm,
    );
    Prepared {
        factor,
        small,
        cost,
        known,
        without,
        disk: at_small,
    }
}

/// The coarse cut. `None` if nothing can be body.
pub fn coarse(ready: &Prepared, settings: &Settings) -> Option<(Image<bool>, Gmm)> {
    cut_whole(&ready.small, &ready.cost, &ready.known, settings)
}

/// The border of a coarse cut again at full size, window by window so that memory stays small.
pub fn fine(
    pixels: &Rgb,
    ready: &Prepared,
    coarse: &Image<bool>,
    gmm: &Gmm,
    settings: &Settings,
) -> Mask {
    let factor = ready.factor;
    if factor == 1 {
        return coverage(coarse);
    }
    let band = band(coarse);
    let at = |i: usize| {
        let (x, y) = (i % pixels.width, i / pixels.width);
        (
            (x / factor).min(coarse.width - 1),
            (y / factor).min(coarse.height - 1),
        )
    };
    let cost = background_cost(pixels, &ready.without, &|x, y| {
        shaded(&ready.disk, factor, x, y)
    });
    let settled = |i: usize| {
        let (x, y) = at(i);
        match (band.at(x, y), coarse.at(x, y)) {
            (true, _) => ready.known[y * coarse.width + x],
            (false, false) => Known::Background,
            (false, true) => Known::Body,
        }
    };
    let side = |i: usize| {
        let (x, y) = at(i);
        coarse.at(x, y)
    };
    let data = (0..pixels.data.len()).map(side).collect();
    let mut sides = Image {
        width: pixels.width,
        height: pixels.height,
        data,
    };
    let tile = 16usize;
    let (tiles_x, tiles_y) = (coarse.width.div_ceil(tile), coarse.height.div_ceil(tile));
    for t in 0..tiles_x * tiles_y {
        let (tx, ty) = ((t % tiles_x) * tile, (t / tiles_x) * tile);
        let on_band = |x: usize, y: usize| x < coarse.width && y < coarse.height && band.at(x, y);
        if !(ty..ty + tile).any(|y| (tx..tx + tile).any(|x| on_band(x, y))) {
            continue;
        }
        // A margin of four coarse pixels around the tile is cut too, then thrown away.
        let (x0, y0) = (tx.saturating_sub(4), ty.saturating_sub(4));
        let window = Window {
            x: x0 * factor,
            y: y0 * factor,
            width: ((tx + tile + 4).min(coarse.width) - x0) * factor,
            height: ((ty + tile + 4).min(coarse.height) - y0) * factor,
        };
        let body = cut(pixels, &cost, &window, gmm, settings, &settled);
        for y in ty * factor..((ty + tile).min(coarse.height)) * factor {
            for x in tx * factor..((tx + tile).min(coarse.width)) * factor {
                *sides.at_mut(x, y) = body[(y - window.y) * window.width + x - window.x];
            }
        }
    }
    coverage(&largest(&sides, &cost))
}

/// The subject's shadow may fall deep on the disk and the floor around it: this many disk radii.
const SHADOW_RADII: f64 = 5.0;

/// Whether a deep shadow of the subject may fall on what a pixel shows. Anywhere without a camera.
fn shaded(disk: &Option<(Camera, f64)>, factor: usize, x: usize, y: usize) -> bool {
    let Some((camera, radius)) = disk else {
        return true;
    };
    let small = |v: usize| (v as f64 + 0.5) / factor as f64 - 0.5;
    on_disk(
        camera,
        Point2::new(small(x), small(y)),
        radius * SHADOW_RADII,
    )
    .is_some()
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
fn certain(image: &Rgb, disk: Disk<'_>, side_mm: f64) -> Vec<Known> {
    let mut known = vec![Known::Unknown; image.data.len()];
    let Some((camera, radius)) = disk else {
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
