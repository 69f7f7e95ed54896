//! One photo made ready to be cut: what each of its reduced pixels costs as background.

use crate::align::reduced::factor;
use crate::cut::least_cut::Known;
use crate::likelihood::background::{FLAT, Noise, background_cost};
use crate::likelihood::body::STRANGE;
use crate::likelihood::floor::Floor;
use crate::likelihood::grounds::Grounds;
use crate::likelihood::local_light::{lit, local_light};
use crate::likelihood::neighbourhoods::REACH_PX;
use crate::likelihood::noise::Cast;
use crate::scene::backdrop::Backdrop;
use crate::scene::disk_plane::on_disk;
use nalgebra::{Point2, Point3};
use shape::{PhotoEvidence, Rgb};

/// A photo made ready: reduced, with what is known of each pixel.
pub struct Prepared {
    /// How many pixels along a side became one.
    pub factor: usize,
    /// The reduced photo.
    pub small: Rgb,
    /// -ln p(pixel | background) of the reduced photo.
    pub cost: Vec<f32>,
    /// Log-odds of the body by a person's sense; empty where there is none.
    pub person: Vec<f32>,
    /// Light that pixels gain by what the disk mirrors of the body, three channels each; empty where it mirrors nothing.
    pub mirrored: Vec<f32>,
    /// How many times as bright each pixel is as the scene there; empty where they are alike.
    pub light: Vec<f32>,
    /// What the background costs a pixel at most, by what no scene foresees; `None` until all other photos are weighed in. \[nats\]
    pub unforeseen: Option<f32>,
    /// What is certain before any cut.
    pub known: Vec<Known>,
    /// How far the reduced photo and what was expected of it differ without a reason. \[levels\]
    pub noise: Noise,
    /// The floor before the camera at the reduced size.
    pub floor: Option<Floor>,
}

impl Prepared {
    /// Of evidence that was found; `floor` as in [`Prepared`].
    pub(crate) fn of(evidence: &PhotoEvidence, floor: Option<Floor>) -> Self {
        Prepared {
            factor: evidence.factor as usize,
            small: evidence.photo.clone(),
            cost: evidence.background.clone(),
            person: evidence.person.clone(),
            mirrored: evidence.mirrored.clone(),
            light: evidence.light.clone(),
            unforeseen: None,
            known: evidence.known.clone(),
            noise: Noise::even(evidence.noise_levels),
            floor,
        }
    }

    /// A cost as background, if nothing was foreseen at most. \[nats\]
    pub(crate) fn foreseen_or_not(&self, cost: f32) -> f32 {
        cost.min(self.unforeseen.unwrap_or(f32::MAX))
    }

    /// As it is stored.
    pub(crate) fn evidence(self) -> PhotoEvidence {
        PhotoEvidence {
            factor: self.factor as u32,
            photo: self.small,
            background: self.cost,
            person: self.person,
            mirrored: self.mirrored,
            light: self.light,
            known: self.known,
            noise_levels: self.noise.still,
        }
    }

    /// Raises what a pixel costs as background to so much beyond what matches to the level.
    pub(crate) fn raise(&mut self, i: usize, beyond: f32) {
        if beyond > 0.0 {
            self.cost[i] = self.cost[i].max(FLAT + beyond);
        }
    }
}

/// Half the side of neighbourhoods of the reduced photo (derived: of at least two pixels each). \[px\]
pub(crate) const COARSE_REACH_PX: usize = REACH_PX / 2;

/// What the background costs where nobody saw it: a little more than any colour of the body does, for it is the body
/// that covers it (structural: by ln 2; at 9.8 and 19.6 more than [`FLAT`] masks are equal). \[nats\]
pub(crate) const UNSEEN: f32 = STRANGE as f32 + std::f32::consts::LN_2;

/// Makes a photo ready to be cut. `without` is what it would show without the subject, `coarse_px`
/// the longest side of the reduced photo, `sense` a person's log-odds for its size and factor.
pub fn prepare(
    pixels: &Rgb,
    without: &Backdrop,
    floor: Option<Floor>,
    coarse_px: usize,
    side_mm: f64,
    sense: &dyn Fn([usize; 2], usize) -> Vec<f32>,
) -> Prepared {
    let factor = factor(pixels, coarse_px);
    let (small, expected) = (pixels.reduced(factor), without.image.reduced(factor));
    let floor = floor.map(|floor| floor.resized(small.width, small.height));
    let grounds = Grounds::of(floor.as_ref(), 1, small.width, small.height);
    let on = |x: usize, y: usize| grounds.at(x, y);
    let person = sense([small.width, small.height], factor);
    let noise = Noise::measure(&small, &expected, &on, COARSE_REACH_PX);
    let cast = Cast::measure([&small, &expected], &on, &person, &noise, COARSE_REACH_PX);
    let light = local_light([&small, &expected], &on, &person, &noise, COARSE_REACH_PX);
    let bright = (!light.is_empty()).then(|| lit(&expected, &light, 1));
    let noise = bright.as_ref().map_or(noise, |bright| {
        Noise::measure(&small, bright, &on, COARSE_REACH_PX)
    });
    let noise = Noise { cast, ..noise };
    let all = [0, 0, small.width, small.height];
    let costs = |expected| background_cost(&small, expected, noise, &on, COARSE_REACH_PX, all);
    let mut cost = costs(&expected);
    if let Some(bright) = &bright {
        let both = cost.iter_mut().zip(costs(bright));
        both.for_each(|(cost, other)| *cost = cost.min(other));
    }
    for (i, cost) in cost.iter_mut().enumerate() {
        let (x, y) = (i % small.width * factor, i / small.width * factor);
        let rows = |y: usize| (x..x + factor).all(|x| without.seen.at(x, y));
        if !(y..y + factor).all(rows) {
            *cost = UNSEEN;
        }
    }
    let known = certain(&small, floor.as_ref(), side_mm);
    Prepared {
        factor,
        small,
        person,
        mirrored: Vec::new(),
        light,
        unforeseen: None,
        cost,
        known,
        noise,
        floor,
    }
}

/// What cannot be body: below the disk's top, and outside of the cylinder above the disk.
fn certain(image: &Rgb, floor: Option<&Floor>, side_mm: f64) -> Vec<Known> {
    let mut known = vec![Known::Unknown; image.data.len()];
    let Some(Floor {
        camera, touched, ..
    }) = floor.filter(|floor| floor.is_disk)
    else {
        return known;
    };
    let radius = *touched;
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
            // Left and right of the disk nothing below its top can be body.
            let beside = front[x] == f64::MAX
                && side_mm > 0.0
                && camera.height_at_axis(at_px) < -0.2 * side_mm;
            if below && on_disk(camera, at_px, radius).is_none() || beside {
                known[y * image.width + x] = Known::Background;
            }
        }
    }
    known
}
