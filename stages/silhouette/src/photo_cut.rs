//! One photo: a coarse cut of all of it, then its border at full size.

use crate::backdrop::Backdrop;
use crate::background::on_disk;
use crate::border::soft_border;
use crate::gmm::Gmm;
use crate::least_cut::{Known, Window};
use crate::segment::{Settings, cut, cut_whole, largest, reduced};
use crate::unary::{FLAT, Ground, Noise, background_cost};
use nalgebra::{Point2, Point3};
use shape::{Camera, Image, Mask, Rgb};
use std::ops::Range;

/// A photo made ready: reduced, with what is known of each pixel.
pub struct Prepared {
    /// How many pixels along a side became one.
    pub factor: usize,
    /// The reduced photo.
    pub small: Rgb,
    /// -ln p(pixel | background) of the reduced photo.
    pub cost: Vec<f32>,
    /// The same where the background was seen. Where it was not, and colours are held against those
    /// beside: by how much less it costs than the body does.
    pub explained: Vec<f32>,
    /// What is certain before any cut.
    pub known: Vec<Known>,
    /// How far the reduced photo and what was expected of it differ without a reason. \[levels\]
    pub noise: Noise,
    /// The camera at the reduced size, and the disk's radius. \[mm\]
    pub disk: Option<(Camera, f64)>,
}

/// Where the disk is: the photo's camera and the disk's radius. \[mm\]
pub type Disk<'a> = Option<(&'a Camera, f64)>;

/// What the background costs where nobody saw it: a little more than any colour of the body does, for
/// it is the body that covers it.
pub(crate) const UNSEEN: f32 = FLAT + 14.0;

/// Makes a photo ready to be cut. `without` is what it would show without the subject, `coarse_px`
/// the longest side of the reduced photo.
pub fn prepare(
    pixels: &Rgb,
    without: &Backdrop,
    disk: Disk<'_>,
    coarse_px: usize,
    side_mm: f64,
) -> Prepared {
    let factor = pixels
        .width
        .max(pixels.height)
        .div_ceil(coarse_px.max(1))
        .max(1);
    let (small, expected) = (reduced(pixels, factor), reduced(&without.image, factor));
    let at_small =
        disk.map(|(c, radius)| (c.resized(small.width as u32, small.height as u32), radius));
    let grounds: Vec<Ground> = (0..small.data.len())
        .map(|i| ground(&at_small, 1, i % small.width, i / small.width))
        .collect();
    let on = |x: usize, y: usize| grounds[y * small.width + x];
    let noise = Noise::measure(&small, &expected, &on);
    let all = [0, 0, small.width, small.height];
    let mut cost = background_cost(&small, &expected, noise, &on, 1, all);
    for (i, cost) in cost.iter_mut().enumerate() {
        let (x, y) = (i % small.width * factor, i / small.width * factor);
        let rows = |y: usize| (x..x + factor).all(|x| without.seen.at(x, y));
        if !(y..y + factor).all(rows) {
            *cost = UNSEEN;
        }
    }
    let known = certain(
        &small,
        at_small.as_ref().map(|(c, radius)| (c, *radius)),
        side_mm,
    );
    Prepared {
        factor,
        small,
        explained: cost.clone(),
        cost,
        known,
        noise,
        disk: at_small,
    }
}

/// The coarse cut. `None` if nothing can be body.
pub fn coarse(ready: &Prepared, settings: &Settings) -> Option<(Image<bool>, Gmm)> {
    let (cost, explained) = (&ready.cost, &ready.explained);
    cut_whole(&ready.small, cost, explained, &ready.known, settings)
}

/// The border of a coarse cut again at full size, window by window so that memory stays small.
pub fn fine(
    pixels: &Rgb,
    without: &Backdrop,
    ready: &Prepared,
    coarse: &Image<bool>,
    gmm: &Gmm,
    settings: &Settings,
) -> Mask {
    let factor = ready.factor;
    let Backdrop {
        image: without,
        seen,
    } = without;
    let on = |x: usize, y: usize| ground(&ready.disk, factor, x, y);
    // The ground of every pixel is dear, and that of its neighbourhood serves.
    let (wide, tall) = (pixels.width.div_ceil(8), pixels.height.div_ceil(8));
    let places = (0..tall).flat_map(|y| (0..wide).map(move |x| (8 * x, 8 * y)));
    let near: Vec<Ground> = places.map(|(x, y)| on(x, y)).collect();
    let noise = Noise::measure(pixels, without, &|x, y| near[y / 8 * wide + x / 8]);
    if factor == 1 {
        return soft_border(pixels, without, coarse, noise);
    }
    let band = band(coarse);
    let at = |i: usize| {
        let (x, y) = (i % pixels.width, i / pixels.width);
        (
            (x / factor).min(coarse.width - 1),
            (y / factor).min(coarse.height - 1),
        )
    };
    let settled = |i: usize| {
        let (x, y) = at(i);
        match (band.at(x, y), coarse.at(x, y)) {
            (true, _) => ready.known[y * coarse.width + x],
            (false, false) => Known::Background,
            (false, true) => Known::Body,
        }
    };
    let side = |(x, y): (usize, usize)| coarse.at(x, y);
    let mut sides = Image {
        width: pixels.width,
        height: pixels.height,
        data: (0..pixels.data.len()).map(|i| side(at(i))).collect(),
    };
    for tile in tiles(&band) {
        let window = tile.with_margin(coarse, factor);
        let area = [window.x, window.y, window.width, window.height];
        let mut cost = background_cost(pixels, without, noise, &on, 2, area);
        for (i, cost) in cost.iter_mut().enumerate() {
            let (x, y) = (window.x + i % window.width, window.y + i / window.width);
            if !seen.at(x, y) {
                *cost = UNSEEN;
            }
        }
        let body = cut(pixels, &cost, &window, gmm, settings, &settled);
        for y in tile.y.start * factor..tile.y.end * factor {
            for x in tile.x.start * factor..tile.x.end * factor {
                *sides.at_mut(x, y) = body[(y - window.y) * window.width + x - window.x];
            }
        }
    }
    let cost = |i: usize| {
        let (x, y) = at(i);
        let i = y * coarse.width + x;
        [ready.cost[i], ready.explained[i]]
    };
    soft_border(pixels, without, &largest(&sides, &cost), noise)
}

/// A square of coarse pixels, clipped to the photo.
struct Tile {
    x: Range<usize>,
    y: Range<usize>,
}

impl Tile {
    /// What is cut of it at full size: a margin of four coarse pixels around the tile is cut too, then
    /// thrown away.
    fn with_margin(&self, coarse: &Image<bool>, factor: usize) -> Window {
        let widened = |r: &Range<usize>, most: usize| {
            let (start, end) = (r.start.saturating_sub(4), (r.end + 4).min(most));
            (start * factor, (end - start) * factor)
        };
        let (x, width) = widened(&self.x, coarse.width);
        let (y, height) = widened(&self.y, coarse.height);
        Window {
            x,
            y,
            width,
            height,
        }
    }
}

/// The tiles of 16 pixels in which some of the band lies, row by row.
fn tiles(band: &Image<bool>) -> Vec<Tile> {
    const SIDE: usize = 16;
    let along = |most: usize| {
        let starts = (0..most).step_by(SIDE);
        starts.map(move |start| start..(start + SIDE).min(most))
    };
    let all = along(band.height).flat_map(|y| along(band.width).map(move |x| (x, y.clone())));
    let on_band = |tile: &Tile| {
        let mut rows = tile.y.clone();
        rows.any(|y| tile.x.clone().any(|x| band.at(x, y)))
    };
    all.map(|(x, y)| Tile { x, y }).filter(on_band).collect()
}

/// The subject's shadow may fall deep on the disk and the floor around it: this many disk radii.
const SHADOW_RADII: f64 = 5.0;

/// What the background is at a pixel. Without a camera a shadow may fall anywhere.
fn ground(disk: &Option<(Camera, f64)>, factor: usize, x: usize, y: usize) -> Ground {
    let Some((camera, radius)) = disk else {
        return Ground::Floor;
    };
    let small = |v: usize| (v as f64 + 0.5) / factor as f64 - 0.5;
    let hit = on_disk(
        camera,
        Point2::new(small(x), small(y)),
        radius * SHADOW_RADII,
    );
    match hit {
        None => Ground::Room,
        Some(hit) if libm::hypot(hit.x, hit.y) < *radius => Ground::Disk,
        Some(_) => Ground::Floor,
    }
}

/// Coarse pixels within two of the border.
pub(crate) fn band(sides: &Image<bool>) -> Image<bool> {
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
        let (s, c) = libm::sincos(f64::from(i) * std::f64::consts::TAU / 720.0);
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
                let away = libm::hypot(centre.x, centre.y) / libm::hypot(ray.x, ray.y).max(1e-9);
                centre.z + ray.z * away < -0.2 * side_mm
            };
            if below && on_disk(camera, at_px, radius).is_none() || beside {
                known[y * image.width + x] = Known::Background;
            }
        }
    }
    known
}
