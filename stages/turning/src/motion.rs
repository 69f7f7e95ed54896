//! The stage that finds how somebody turned on the spot before a standing camera.

use crate::azimuth::{Faces, azimuths};
use crate::error::MotionError;
use crate::given::{MotionInput, MotionParams};
use crate::joints::{Articulated, Sights, TRUNK_SHARE, median, swap};
use crate::read::{followed, lens, sights, without_hands};
use crate::reported::{Found, MOST_OPEN_RAD, cameras, closed, verdict};
use crate::scene::{Motion, Step};
use crate::together::{GoesOn, by_outlines};
use shape::{Cameras, PhotoId, Photos};
use stage::{Ctx, Stage, Stop};

/// `turning.motion`: photos, people, masks → cameras.
pub struct FindMotion;

impl Stage for FindMotion {
    const NAME: &'static str = "turning.motion";
    const VERSION: u32 = 4;
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
        let (lens, unknown) = lens(p, photos)?;
        unknown.into_iter().for_each(|w| ctx.warn(w));
        let mut sights = sights(people, &ids, &lens);
        let joints = by_joints(&mut sights, &ids, photos)?;
        // Outlines of half a turn can be had by many motions: joints tell that it is one.
        let faces: Vec<f64> = joints.motion.steps.iter().map(|s| s.azimuth).collect();
        let name = |i: usize| photos.get(ids[i]).map_or(String::new(), |p| p.name.clone());
        closed(&faces, 1.5 * MOST_OPEN_RAD, name)?;
        let mut found = match p.rounds {
            0 => Found::by_joints(joints.clone()),
            _ => {
                let steps = ctx.steps("rounds", p.rounds as usize);
                let goes_on: GoesOn<'_> = (&|| ctx.check(), &|| steps.tick());
                let joints = (&sights, joints.clone());
                by_outlines(p, &input, (&ids, &lens), joints, goes_on)?
            }
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
