//! The stage that finds how somebody turned on the spot before a standing camera.

use crate::again::{odd, sought};
use crate::azimuth::{Faces, azimuths};
use crate::error::MotionError;
use crate::joints::{Articulated, Equations, Sights, TRUNK_SHARE, median, swap};
use crate::outlines::{Agreement, Outline, equations};
use crate::scene::{Motion, Step};
use crate::told::{cameras, verdict};
use nalgebra::Point2;
use rayon::prelude::*;
use shape::{Cameras, Found, Intrinsics, Mask, Masks, People, PhotoId, Photos, film_to_px};
use stage::{Cancelled, Ctx, Stage, Stop, message};
use std::sync::Arc;

stage::messages! {
    NO_FOCAL = "warn-turning-focal": "neither the photos nor capture.toml have the focal length: {focal:.0 mm}, as of phones' main cameras, was taken; give --focal";
}

stage::params! {
    /// How the motion of somebody who turns on the spot is found.
    pub struct MotionParams {
        /// Rounds in which joints and outlines settle together; 0: by joints alone.
        #[range(0..=200)]
        #[source(structural)]
        rounds: u32 = 30,
        /// Longest side to which outlines are reduced.
        #[range(100..=4000)]
        #[source(structural)]
        outline_px: u32 = 700,
        /// How many sights of joints a photo's outline counts as.
        #[range(0.1..=1000.0)]
        outline_weight: f64 = 20.0,
        /// Focal length as if on 36 × 24 mm film where neither EXIF nor capture.toml tells it: of phones' main cameras
        /// 24 to 28 mm.
        #[range(10.0..=300.0)]
        #[source(by_hand = "main cameras of phones: 24 to 28 mm")]
        focal_35mm: f64 = 26.0,
    }
}

stage::inputs! {
    /// Photos of somebody who turns.
    pub struct MotionInput {
        /// The photos, for lens and names.
        photos: Arc<Photos>,
        /// Joints, and a coarse mask where there is no other.
        people: Arc<People>,
        /// Silhouettes, where they are known.
        masks: Option<Arc<Masks>>,
    }
}

/// `turning.motion`: photos, people, masks → cameras.
pub struct FindMotion;

/// Photos that are needed at least: one every 45°.
pub(crate) const LEAST_PHOTOS: usize = 8;

impl Stage for FindMotion {
    const NAME: &'static str = "turning.motion";
    const VERSION: u32 = 1;
    const ABOUT: &'static str = "Finds how somebody turned on the spot before a standing camera, by joints and outlines, and gives the cameras as seen from the body.";
    type Params = MotionParams;
    type Input = MotionInput;
    type Output = Cameras;
    const METRICS: &'static [&'static str] = &[
        "turned",
        "widest step",
        "wander",
        "outlines disagree",
        "corrected by outlines",
    ];

    fn run(p: &MotionParams, input: MotionInput, ctx: &Ctx<'_>) -> Result<Cameras, Stop> {
        let (photos, people) = (&*input.photos, &*input.people);
        let mut ids = followed(&input)?;
        let lens = lens(p, photos, ctx)?;
        let mut sights = sights(people, &ids, &lens);
        let joints = by_joints(&mut sights, &ids, photos)?;
        let mut found = match p.rounds {
            0 => (joints.clone(), None, vec![]),
            _ => by_outlines(p, &input, (&ids, &lens), (&sights, joints.clone()), ctx)?,
        };
        let cut = input.masks.is_some();
        let seen = verdict(&joints, &found, (&ids, photos), cut)?;
        ctx.metric("turned", seen.turned.to_degrees(), "°");
        ctx.metric("widest step", seen.open.to_degrees(), "°");
        ctx.metric("wander", 100.0 * seen.wander, "% of the distance");
        if let Some(loose) = seen.loose {
            ctx.metric("corrected by outlines", seen.corrected.to_degrees(), "°");
            ctx.metric("outlines disagree", 100.0 * loose, "% of the height");
        }
        seen.warnings.into_iter().for_each(|w| ctx.warn(w));
        if cut {
            for photo in found.2.drain(..).rev() {
                ids.remove(photo);
                found.0.motion.steps.remove(photo);
                for of in &mut sights {
                    of.remove(photo);
                }
            }
        }
        Ok(cameras(&found, &sights, (&ids, photos), lens))
    }
}

/// The photos that show the person, and have a mask where there are some.
fn followed(input: &MotionInput) -> Result<Vec<PhotoId>, MotionError> {
    let masked = |id: PhotoId| {
        input
            .masks
            .as_ref()
            .is_none_or(|m| m.views.get(id).is_some())
    };
    let all = input.photos.iter().map(|(id, _)| id);
    let seen = all.filter(|id| input.people.subject(*id).is_some() && masked(*id));
    let ids: Vec<PhotoId> = seen.collect();
    match ids.len() {
        n if n < LEAST_PHOTOS => Err(MotionError::NoPerson {
            seen: n,
            of: input.photos.photos.len(),
            least: LEAST_PHOTOS,
        }),
        _ => Ok(ids),
    }
}

/// The lens, as EXIF or the user have it.
fn lens(p: &MotionParams, photos: &Photos, ctx: &Ctx<'_>) -> Result<Intrinsics, MotionError> {
    let first = photos.photos.first().ok_or(MotionError::NoPerson {
        seen: 0,
        of: 0,
        least: LEAST_PHOTOS,
    })?;
    let (width, height) = (first.width, first.height);
    let film = |mm: f64| film_to_px(mm, width, height);
    let told = photos.rig.focal_px;
    let told = told.or(photos.rig.focal_35mm.or(first.focal_35mm).map(film));
    if told.is_none() {
        ctx.warn(message!(NO_FOCAL, focal = p.focal_35mm));
    }
    let mut lens = Intrinsics::simple(width, height, told.unwrap_or_else(|| film(p.focal_35mm)));
    if let Some(centre) = photos.rig.centre_px {
        lens.centre = centre;
    }
    Ok(lens)
}

/// How far beyond the photo's border a joint is taken as the network guesses it, as a share of the photo's size: of a body
/// that is cut off at the hips, hips are a guess that is worth more than none.
const BEYOND: f64 = 0.25;

/// All joints in the photo or little beyond its border, on the plane z = 1.
fn sights(people: &People, ids: &[PhotoId], lens: &Intrinsics) -> Sights {
    let (w, h) = (f64::from(lens.width), f64::from(lens.height));
    let sight = |id: &PhotoId, joint: usize| {
        let [x, y] = people.subject(*id)?.joints[joint].at_px.map(f64::from);
        let near = |at: f64, size: f64| at >= -BEYOND * size && at < (1.0 + BEYOND) * size;
        let inside = near(x, w) && near(y, h);
        inside.then(|| lens.undistort(Point2::new(x, y)))
    };
    (0..Found::JOINTS.len())
        .map(|joint| ids.iter().map(|id| sight(id, joint)).collect())
        .collect()
}

/// Places of wrists and fingers, structural: hands move by themselves.
const HANDS: std::ops::RangeInclusive<usize> = 15..=22;
/// The motion by joints alone.
fn by_joints(
    sights: &mut Sights,
    ids: &[PhotoId],
    photos: &Photos,
) -> Result<Articulated, MotionError> {
    let count = ids.len();
    let all = sights.clone();
    let middle = |i: usize, [a, b]: [usize; 2]| Some((all[a][i]?.y + all[b][i]?.y) / 2.0);
    let trunk = |i: usize| Some(middle(i, [23, 24])? - middle(i, [11, 12])?);
    let mut tall: Vec<f64> = (0..count).filter_map(&trunk).collect();
    let height = median(&mut tall) / TRUNK_SHARE;
    if height < 0.0 {
        return Err(MotionError::UpsideDown);
    }
    let lost: Vec<&str> = (0..count)
        .filter(|i| trunk(*i).is_none())
        .filter_map(|i| Some(photos.get(ids[i])?.name.as_str()))
        .collect();
    if 4 * lost.len() > count {
        return Err(MotionError::NoTrunk(lost.join(", ")));
    }
    let faces = azimuths(sights, count, height.max(1e-6));
    for i in (0..count).filter(|i| faces[*i].swapped) {
        swap(sights, i);
    }
    let step = |face: &Faces| Step {
        azimuth: face.azimuth,
        off: [0.0; 2],
    };
    let steps = faces.iter().map(step).collect();
    let used = without_hands(sights);
    Ok(Articulated::placed(&used, Motion { pitch: 0.0, steps }).settled(&used))
}

/// The sights without those of hands.
fn without_hands(sights: &Sights) -> Sights {
    let mut used = sights.clone();
    for joint in HANDS {
        used[joint].iter_mut().for_each(|s| *s = None);
    }
    used
}

/// The motion by joints and outlines together.
fn by_outlines(
    p: &MotionParams,
    input: &MotionInput,
    (ids, lens): (&[PhotoId], &Intrinsics),
    (sights, mut found): (&Sights, Articulated),
    ctx: &Ctx<'_>,
) -> Result<(Articulated, Option<Agreement>, Vec<usize>), Stop> {
    let outline = |id: &PhotoId| -> Result<Outline, Cancelled> {
        ctx.check()?;
        let (w, h) = (lens.width as usize, lens.height as usize);
        let coarse = || input.people.subject(*id).map(|found| found.mask(w, h));
        let mask = match &input.masks {
            Some(masks) => masks.views.get(*id).cloned(),
            None => coarse(),
        };
        let mask = mask.unwrap_or_else(|| Mask::filled(w, h, 0));
        Ok(Outline::of(&reduced(&mask, p.outline_px as usize), lens))
    };
    let outlines: Vec<Outline> = ids.par_iter().map(outline).collect::<Result<_, _>>()?;
    let used = without_hands(sights);
    let steps = ctx.steps("rounds", p.rounds as usize);
    let mut agreement = None;
    for round in 0..p.rounds {
        let mut all = Equations::none(found.unknowns());
        found.equations(&used, &mut all);
        let lax = lax(round);
        agreement = equations(&outlines, &found.motion, (p.outline_weight, lax), &mut all);
        let Some(by) = all.solved(DAMPING) else { break };
        found.stepped(&by);
        if round == p.rounds / 2 {
            sought(&outlines, &mut found.motion);
        }
        steps.tick()?;
        if by.amax() < SETTLED && round > p.rounds / 2 {
            break;
        }
    }
    let odd = odd(&outlines, &found.motion);
    Ok((found, agreement, odd))
}

/// How much farther off than at the end a ray may be before it weighs half: arms that are off by all of a first error are
/// what tells the azimuth.
pub(crate) fn lax(round: u32) -> f64 {
    1.0 + 4.0 * libm::pow(0.7, f64::from(round))
}

/// Share of its own stiffness by which each unknown is damped.
const DAMPING: f64 = 1e-4;
/// A round that moves everything by less has settled: 0.01°, 0.5 mm of 2.5 m.
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
