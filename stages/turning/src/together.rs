//! The motion by joints, outlines and features together.

use crate::given::{MotionInput, MotionParams};
use crate::joints::{Articulated, Equations, Sights};
use crate::odd::odd;
use crate::outline::Outline;
use crate::outlines::equations;
use crate::points::{self, Point};
use crate::read::without_hands;
use crate::reported::Found;
use crate::trunk::Trunk;
use nalgebra::{Point2, Vector2};
use rayon::prelude::*;
use shape::{Intrinsics, Mask, MaskRuns, Observation, PhotoId};
use stage::Cancelled;

/// Whether to go on: asked for each photo, and after each round.
pub(crate) type GoesOn<'a> = (
    &'a (dyn Fn() -> Result<(), Cancelled> + Sync),
    &'a dyn Fn() -> Result<(), Cancelled>,
);

/// The motion by joints and outlines together.
///
/// # Errors
///
/// The user asked to stop.
pub(crate) fn by_outlines(
    p: &MotionParams,
    input: &MotionInput,
    (ids, lens): (&[PhotoId], &Intrinsics),
    (sights, mut found): (&Sights, Articulated),
    (photo, after): GoesOn<'_>,
) -> Result<Found, Cancelled> {
    let trunks: Vec<Trunk> = (0..ids.len()).map(|i| Trunk::of(sights, i)).collect();
    let outline = |(i, id): (usize, &PhotoId)| -> Result<Outline, Cancelled> {
        photo()?;
        let (w, h) = (lens.width as usize, lens.height as usize);
        let coarse = || input.people.subject(*id).map(|found| found.mask(w, h));
        let mask = match &input.masks {
            Some(masks) => masks.views.get(*id).map(MaskRuns::pixels),
            None => coarse(),
        };
        let mask = mask.unwrap_or_else(|| Mask::filled(w, h, 0));
        let limb = |at: &Vector2<f64>| match trunks[i].holds(at) {
            true => 1.0,
            false => p.limb_weight,
        };
        Ok(Outline::of(
            &reduced(&mask, p.outline_px as usize),
            lens,
            limb,
        ))
    };
    let outlines = ids.par_iter().enumerate().map(outline);
    let outlines: Vec<Outline> = outlines.collect::<Result<_, _>>()?;
    let points = points_of(input, (ids, lens), &trunks, p.limb_weight);
    let used = without_hands(sights);
    let (mut agreement, mut fit) = (None, None);
    for round in 0..p.rounds {
        let mut all = Equations::none(found.unknowns());
        found.equations(&used, &mut all);
        let lax = lax(round);
        agreement = equations(&outlines, &found.motion, (p.outline_weight, lax), &mut all);
        fit = points::equations(&points, &found.motion, (p.outline_weight, lax), &mut all);
        let Some(by) = all.solved(DAMPING) else { break };
        found.stepped(&by);
        after()?;
        if by.amax() < SETTLED && round > p.rounds / 2 {
            break;
        }
    }
    let odd = agreement
        .as_ref()
        .map_or(vec![], |all| odd(&outlines, &found.motion, all));
    Ok(Found {
        body: found,
        agreement,
        fit,
        odd,
    })
}

/// Features of the body as the photos that are followed show them; what one counts for that is a limb's.
fn points_of(
    input: &MotionInput,
    (ids, lens): (&[PhotoId], &Intrinsics),
    trunks: &[Trunk],
    limb: f64,
) -> Vec<Point> {
    let sight = |seen: &Observation| {
        let photo = ids.binary_search(&seen.photo).ok()?;
        let [x, y] = seen.at_px.map(f64::from);
        let body = input.people.subject(ids[photo])?;
        let inside = body.log_odds(Point2::new(x, y))? > 0.0;
        inside.then(|| (photo, lens.undistort(Point2::new(x, y))))
    };
    let point = |track: &Vec<Observation>| {
        let seen: Vec<_> = track.iter().filter_map(sight).collect();
        let trunk = seen.iter().all(|(photo, at)| trunks[*photo].holds(at));
        let counts = if trunk { 1.0 } else { limb };
        (seen.len() > 1).then_some(Point { seen, counts })
    };
    let tracks = input.tracks.iter().flat_map(|tracks| &tracks.points);
    tracks.filter_map(point).collect()
}

/// How much farther off than at the end a ray may be before it weighs half: arms that are off by all of a first error are
/// what tells the azimuth.
pub(crate) fn lax(round: u32) -> f64 {
    1.0 + 4.0 * libm::pow(0.7, f64::from(round))
}

/// Share of its own stiffness by which each unknown is damped (structural: a guard against what nothing determines; it
/// decides how fast a search ends, not where).
const DAMPING: f64 = 1e-4;
/// A round that moves everything by less has settled: 0.01°, 0.5 mm of 2.5 m (structural: a search's end).
const SETTLED: f64 = 2e-4;

/// A mask whose longest side is at most so long, each pixel the mean of those it covers.
fn reduced(mask: &Mask, longest: usize) -> Mask {
    let by = mask.width.max(mask.height).div_ceil(longest.max(1)).max(1);
    let (width, height) = (mask.width / by, mask.height / by);
    let mean = |i: usize| {
        let (x, y) = (i % width * by, i / width * by);
        let all = (0..by * by).map(|k| u32::from(mask.at(x + k % by, y + k / by)));
        (all.sum::<u32>() / (by * by) as u32) as u8
    };
    Mask {
        width,
        height,
        data: (0..width * height).map(mean).collect(),
    }
}
