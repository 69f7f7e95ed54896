//! The stage that gives cameras their millimetres and their ground.

use crate::calibration::params::CalibrateParams;
use crate::frame::circle::{RING_MM, moved};
use crate::frame::disk_search::{Rules, edge, still};
use crate::frame::disk_tags::on_disk;
use crate::frame::lengths::{Measure, Seen, by_tags, floor, measures};
use crate::frame::stature::{Stature, stature};
use nalgebra::{Point3, Rotation3};
use shape::{CONTRADICTION, Cameras, Length, Masks, Photos, Scale, Tags};
use stage::{Ctx, Field, Message, Stage, Stop, Template, message};
use std::sync::Arc;

stage::messages! {
    NO_EDGE = "warn-no-edge": "neither the disk's edge nor soles were seen: the ground is put at the lowest feature, so heights and stature may be off; keep feet and disk in view";
    NO_LENGTH = "warn-relative": "no length is known (no mat or tags of known size, reference, disk or stature that could be seen): lengths are relative to the camera ring's radius, called 1000 mm";
    DISAGREE = "warn-disagree": "{other} and {first} disagree by {off:.1 %}: {first} was taken; check both in capture.toml";
    DISAGREE_CM = "warn-disagree-cm": "{other} was given as {given:.1 cm}, but by {first} it is {seen:.1 cm}: {first} was taken; check both (a stature is without shoes)";
    CONTRADICT = "warn-disputed-layout": "{other} and {first} contradict each other by {off:.0 %}, more than either can err: lengths are relative, without centimetres; correct one of the two, or leave out the one that you are less sure of";
    CONTRADICT_CM = "warn-disputed": "{other} was given as {given:.1 cm}, but by {first} it is {seen:.1 cm}, and neither can err by so much: lengths are relative, without centimetres; correct one of the two, leave out the one that you are less sure of, or look whether the masks lack legs or head";
}

stage::params! {
    /// What is taken for a disk's edge, and how far scales may disagree.
    pub struct FrameParams {
        /// Whether the edge of a disk is searched: a walk has none.
        disk: bool = true,
        /// Three in four steps across the disk's edge must be at least so many times as large as is usual across other
        /// circles.
        #[range(0.01..=100.0)]
        #[source(by_hand = "forty captures by twenty cameras: disks' edges from 0.4 on, the strongest of other circles up to 0.23 (docs/lab/disks.md)")]
        least_standout: f64 = 0.3,
        /// Two lengths do not contradict each other, however sure they are, if they disagree by no more than this share.
        #[range(0.001..=0.5)]
        #[source(by_hand = "ten captures, halved and doubled: nothing changes, for no two lengths disagree so far (docs/lab/numbers.md)")]
        disagreement: f64 = 0.02,
        /// Without a mat: two lengths that disagree by more than this share are no scale.
        #[range(0.05..=10.0)]
        #[source(by_hand = "ten captures, halved and doubled: nothing changes, for no two lengths contradict each other (docs/lab/numbers.md)")]
        contradiction: f64 = 0.2,
        /// Size to which photos are reduced before the disk is searched.
        #[range(200..=4000)]
        #[source(structural)]
        search_px: u32 = 900,
        /// In cameras that were found without marker tags: how far a tag's corners may miss their rays, root
        /// mean square. \[px\]
        #[range(0.1..=50.0)]
        #[source(derived = "most_px of pose.calibrate: what features may miss where cameras are believed")]
        tag_px: f64 = CalibrateParams::default().most_px,
        /// How far radial distortion that is not known may move what is at a corner of the photo, as a share of its way from the
        /// middle: a disk is beside the middle, where it is seen larger or smaller by that.
        #[range(0.0..=0.5)]
        #[source(derived = "corner_sigma of pose.calibrate")]
        corner_sigma: f64 = CalibrateParams::default().corner_sigma,
    }
}

stage::inputs! {
    /// Cameras that turn about z, and what gives their lengths.
    pub struct FrameInput {
        /// The cameras, in a frame whose z axis is the disk's.
        cameras: Arc<Cameras>,
        /// The photos, and what the user knows.
        photos: Arc<Photos>,
        /// Silhouettes: for crown and soles.
        masks: Option<Arc<Masks>>,
        /// Marker tags, used where cameras were found without them.
        tags: Option<Arc<Tags>>,
    }
}

/// `pose.frame`: cameras, photos, masks → cameras.
pub struct Frame;

stage::failures! {
    /// Two known lengths that cannot both be what they are called.
    pub(crate) enum FrameError {
        /// They contradict each other so far that cameras or masks may be wrong.
        Contradict {
            /// One.
            first: Message,
            /// The other.
            other: Message,
            /// How far. \[%\]
            off: f64,
        } = "fail-contradict": "{first} and {other} contradict each other by {off:.0 %}, so the body's size is not known: capture.toml is wrong about one of them (correct it, or leave out the one you are less sure of), or the silhouettes lack legs or head (`tailor show masks --as sheet` shows them), or the cameras are wrong (take more photos, or put a mat on the disk)",
    }
}

impl Stage for Frame {
    const NAME: &'static str = "pose.frame";
    const VERSION: u32 = 19;
    const ABOUT: &'static str = "Puts the origin on the disk and scales to millimetres: by the mat, marker tags, a reference length, the disk, or the stature.";
    type Params = FrameParams;
    type Input = FrameInput;
    type Output = Cameras;
    const METRICS: &'static [&'static str] = &["* and *: difference", "scale sigma"];

    fn run(p: &FrameParams, input: FrameInput, ctx: &Ctx<'_>) -> Result<Cameras, Stop> {
        let (cameras, rig) = (&*input.cameras, &input.photos.rig);
        let body = body(cameras, input.masks.as_deref());
        let placed = matches!(cameras.scale, Scale::Mat | Scale::Given);
        let tags = input.tags.as_deref().filter(|_| !placed);
        let turning = tags.filter(|_| p.disk);
        let on_disk = turning.and_then(|tags| on_disk(cameras, tags, body.as_ref(), p.tag_px));
        let edge = if placed || !p.disk {
            None
        } else {
            ctx.check()?;
            let still = still(&input.photos, p.search_px)?;
            let rules = Rules {
                standout: p.least_standout,
                contradiction: p.contradiction,
            };
            let look = |s| edge(&s, cameras, (body.as_ref(), on_disk), rig, &rules);
            still.and_then(look)
        };
        let tags = tags.and_then(|tags| by_tags(cameras, tags, rig, p.tag_px));
        let floor = tags.and_then(|t| floor(t, body.as_ref()));
        let floor = floor.or(on_disk.map(|tags| tags.height));
        let ground = match (placed, floor, edge, body) {
            (true, ..) => cameras.ground_mm,
            (_, Some(floor), ..) => floor,
            (_, _, Some(edge), _) => edge.height,
            (_, _, None, Some(body)) => body.ground,
            (_, _, None, None) => lowest(cameras),
        };
        let seen = Seen {
            body,
            edge,
            covered: on_disk.is_some(),
            tags,
            ground,
            by_soles: !placed && floor.is_none() && edge.is_none() && body.is_some(),
            corner_sigma: p.corner_sigma,
        };
        let measures = measures(cameras, rig, &seen, |warning| ctx.warn(warning));
        if cameras.scale == Scale::Given {
            return Ok(cameras.clone());
        }
        let mut pair = match cameras.scale {
            Scale::Disputed(pair) => Some(pair),
            _ => None,
        };
        let Some(first) = measures.first() else {
            if let Some(pair) = pair {
                return Ok(without_scale(cameras, ground, pair));
            }
            return Ok(unscaled(&input, ground, ctx));
        };
        for other in &measures[1..] {
            if compare(first, other, cameras.scale, p, ctx)? {
                pair = pair.or(Some([first.length, other.length]));
            }
        }
        if let Some(pair) = pair {
            return Ok(without_scale(cameras, ground, pair));
        }
        if let Some(sigma) = first.sigma {
            ctx.metric("scale sigma", sigma * 100.0, "%");
        }
        if cameras.scale == Scale::Mat {
            return Ok(cameras.clone());
        }
        if edge.is_none() && body.is_none() && floor.is_none() {
            ctx.warn(message!(NO_EDGE));
        }
        let size = first.mm_per_unit;
        let disk = rig.disk_diameter_mm.map(|d| d / 2.0);
        Ok(Cameras {
            scale: first.scale,
            scale_sigma: first.sigma,
            disk_radius_mm: disk.or(edge.map(|e| e.radius * size)),
            ..on_ground(cameras, ground, size)
        })
    }
}

/// Cameras whose unit nothing tells; before there are masks, a stature that is given cannot be seen yet.
fn unscaled(input: &FrameInput, ground: f64, ctx: &Ctx<'_>) -> Cameras {
    if input.masks.is_some() || input.photos.rig.stature_mm.is_none() {
        ctx.warn(message!(NO_LENGTH));
    }
    on_ground(&input.cameras, ground, 1.0)
}

/// Where crown and soles are, from silhouettes.
fn body(cameras: &Cameras, masks: Option<&Masks>) -> Option<Stature> {
    let views = cameras.views.join(&masks?.views);
    stature(views.map(|(_, view, mask)| (view.camera, mask.pixels())))
}

/// Tells how far another length disagrees with the one that is believed; whether more than both can err.
///
/// # Errors
/// They contradict each other so far that cameras or silhouettes may be wrong, and neither is a mat's.
fn compare(
    first: &Measure,
    other: &Measure,
    scale: Scale,
    p: &FrameParams,
    ctx: &Ctx<'_>,
) -> Result<bool, FrameError> {
    let off = other.mm_per_unit / first.mm_per_unit - 1.0;
    let bare = |what: Template| what.english.strip_prefix("the ").unwrap_or(what.english);
    let name = format!("{} and {}: difference", bare(other.what), bare(first.what));
    ctx.metric(&name, (off * 1e4).round() / 100.0, "%");
    let settled = matches!(scale, Scale::Mat | Scale::Disputed(_));
    if !settled && off.abs() > p.contradiction {
        return Err(FrameError::Contradict {
            first: Message::new(&first.what, []),
            other: Message::new(&other.what, []),
            off: off * 100.0,
        });
    }
    let far = |errs: f64| off.abs() > CONTRADICTION * errs;
    let errs = libm::hypot(first.errs(), other.errs());
    let disputed = off.abs() > p.disagreement && far(errs);
    if disputed {
        ctx.warn(apart(first, other, off, [CONTRADICT, CONTRADICT_CM]));
    } else if far(both(first.sigma, other.sigma)) {
        // Farther than what is seen can err; by what people err who give it, it may still be right.
        ctx.warn(apart(first, other, off, [DISAGREE, DISAGREE_CM]));
    }
    Ok(disputed)
}

/// The warning on two lengths that disagree: by how much, or what was given and what is seen of it.
fn apart(first: &Measure, other: &Measure, off: f64, [share, cm]: [Template; 2]) -> Message {
    let [by, what] = [first, other].map(|m| Field::from(Message::new(&m.what, [])));
    let (by, what) = (("first", by), ("other", what));
    let Some(mm) = other.given else {
        return Message::new(&share, [by, what, ("off", (100.0 * off.abs()).into())]);
    };
    let (given, seen) = (mm / 10.0, mm / 10.0 / (1.0 + off));
    Message::new(
        &cm,
        [by, what, ("given", given.into()), ("seen", seen.into())],
    )
}

/// The cameras with their ground at height 0, in shares of their own distance from the axis.
fn without_scale(cameras: &Cameras, ground: f64, pair: [Length; 2]) -> Cameras {
    let away = cameras.views.values().map(|v| v.camera.centre());
    let away: Vec<f64> = away.map(|c| libm::hypot(c.x, c.y)).collect();
    let mean = away.iter().sum::<f64>() / away.len().max(1) as f64;
    let size = if mean > 0.0 { RING_MM / mean } else { 1.0 };
    Cameras {
        scale: Scale::Disputed(pair),
        scale_sigma: None,
        ..on_ground(cameras, ground, size)
    }
}

/// The cameras with their ground at height 0, in another unit.
fn on_ground(cameras: &Cameras, ground: f64, mm_per_unit: f64) -> Cameras {
    let origin = Point3::new(0.0, 0.0, ground);
    Cameras {
        ground_mm: 0.0,
        ..moved(cameras, &Rotation3::identity(), &origin, mm_per_unit)
    }
}

/// Standard deviation of the difference of two, as far as it is known.
fn both(a: Option<f64>, b: Option<f64>) -> f64 {
    [a, b].into_iter().flatten().fold(0.0, libm::hypot)
}

/// Height of the lowest features, one in a hundred left out.
fn lowest(cameras: &Cameras) -> f64 {
    let mut all: Vec<f32> = cameras.points.iter().map(|p| p[2]).collect();
    all.sort_by(f32::total_cmp);
    all.get(all.len() / 100).map_or(0.0, |z| f64::from(*z))
}
