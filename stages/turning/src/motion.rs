//! The stage that finds how somebody turned on the spot before a standing camera.

use crate::azimuth::{Faces, azimuths};
use crate::error::MotionError;
use crate::joints::{Articulated, Sights, TRUNK_SHARE, median, swap};
use crate::read::{followed, lens, sights, without_hands};
use crate::scene::{Motion, Step};
use crate::together::by_outlines;
use crate::told::{Found, cameras, verdict};
use shape::{Cameras, Masks, People, PhotoId, Photos, Tracks};
use stage::{Ctx, Stage, Stop};
use std::sync::Arc;

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
        outline_weight: f64 = 100.0,
        /// What a point of an outline counts for that is an arm's, a leg's or the head's: they move by themselves.
        #[range(0.0..=1.0)]
        limb_weight: f64 = 0.4,
        /// How many sights of joints a photo's features count as.
        #[range(0.0..=10000.0)]
        feature_weight: f64 = 100.0,
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
        /// Features of skin and clothes, where they are followed.
        tracks: Option<Arc<Tracks>>,
    }
}

/// `turning.motion`: photos, people, masks → cameras.
pub struct FindMotion;

/// Photos that are needed at least: one every 45°.
pub(crate) const LEAST_PHOTOS: usize = 8;

impl Stage for FindMotion {
    const NAME: &'static str = "turning.motion";
    const VERSION: u32 = 2;
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
        "features",
        "features disagree",
    ];

    fn run(p: &MotionParams, input: MotionInput, ctx: &Ctx<'_>) -> Result<Cameras, Stop> {
        let (photos, people) = (&*input.photos, &*input.people);
        let mut ids = followed(&input)?;
        let lens = lens(p, photos, ctx)?;
        let mut sights = sights(people, &ids, &lens);
        let joints = by_joints(&mut sights, &ids, photos)?;
        let mut found = match p.rounds {
            0 => Found::by_joints(joints.clone()),
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
        if let Some(fit) = found.fit {
            ctx.metric("features", fit.sights as f64 / ids.len() as f64, "a photo");
            ctx.metric("features disagree", fit.spread * lens.focal[0], "px");
        }
        seen.warnings.into_iter().for_each(|w| ctx.warn(w));
        if cut {
            for photo in found.odd.drain(..).rev() {
                ids.remove(photo);
                found.body.motion.steps.remove(photo);
                for of in &mut sights {
                    of.remove(photo);
                }
            }
        }
        Ok(cameras(&found, &sights, (&ids, photos), lens))
    }
}

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
        ..Step::default()
    };
    let steps = faces.iter().map(step).collect();
    let used = without_hands(sights);
    Ok(Articulated::placed(&used, Motion { pitch: 0.0, steps }).settled(&used))
}
