//! The stage that gives cameras their millimetres and their ground.

use crate::frame::circle::moved;
use crate::frame::disk_search::{Rules, edge, still};
use crate::frame::disk_tags::on_disk;
use crate::frame::lengths::{Measure, Seen, by_tags, floor, measures};
use crate::frame::stature::{Stature, stature};
use nalgebra::{Point3, Rotation3};
use shape::{Cameras, Masks, Photos, Scale, Tags};
use stage::{Ctx, Stage, Stop};
use std::sync::Arc;

stage::params! {
    /// What is taken for a disk's edge, and how far scales may disagree.
    pub struct FrameParams {
        /// Whether the edge of a disk is searched: a walk has none.
        disk: bool = true,
        /// How far the step of brightness at the disk's edge must stand out from that of other
        /// circles.
        #[range(1.0..=100.0)]
        least_standout: f64 = 4.0,
        /// Two lengths that disagree by more than this share are told of.
        #[range(0.001..=0.5)]
        disagreement: f64 = 0.02,
        /// Without a mat: two lengths that disagree by more than this share are no scale.
        #[range(0.05..=10.0)]
        contradiction: f64 = 0.2,
        /// Size to which photos are reduced before the disk is searched.
        #[range(200..=4000)]
        search_px: u32 = 900,
        /// In cameras that were found without marker tags: how far a tag's corners may miss their rays, root
        /// mean square. \[px\]
        #[range(0.1..=50.0)]
        tag_px: f64 = 3.0,
    }
}

stage::inputs! {
    /// Cameras that turn about z, and what tells of lengths.
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

/// Two known lengths that cannot both be what they are called.
#[derive(Debug, thiserror::Error)]
#[error(
    "{first} and {other} contradict each other by {percent:.0} %, so nothing tells how large the body is: capture.toml is wrong about one of them \
     (correct it, or leave out the one you are less sure of), or the silhouettes lack legs or head (`tailor show masks --as sheet` shows them), or the \
     cameras are wrong (take more photos, or put a mat on the disk)"
)]
struct Contradiction {
    first: &'static str,
    other: &'static str,
    percent: f64,
}

impl Stage for Frame {
    const NAME: &'static str = "pose.frame";
    const VERSION: u32 = 11;
    const ABOUT: &'static str = "Puts the origin on the disk and scales to millimetres: by the mat, marker tags, a reference length, the disk, or the stature.";
    type Params = FrameParams;
    type Input = FrameInput;
    type Output = Cameras;
    const METRICS: &'static [&'static str] = &["* against *", "scale sigma"];

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
        };
        let measures = measures(cameras, rig, &seen, |warning| ctx.warn(warning));
        if cameras.scale == Scale::Given {
            return Ok(cameras.clone());
        }
        let Some(first) = measures.first() else {
            ctx.warn("nothing tells of millimetres (no mat or tags of known size, reference, disk or stature that could be seen): lengths are relative to the camera ring's radius, called 1000 mm");
            return Ok(on_ground(cameras, ground, 1.0));
        };
        for other in &measures[1..] {
            compare(first, other, cameras.scale, p, ctx)?;
        }
        if let Some(sigma) = first.sigma {
            ctx.metric("scale sigma", sigma * 100.0, "%");
        }
        if cameras.scale == Scale::Mat {
            return Ok(cameras.clone());
        }
        if edge.is_none() && body.is_none() && floor.is_none() {
            ctx.warn("neither the disk's edge nor soles were seen: the ground lies at the lowest feature, so heights and stature may be off; keep feet and disk in view");
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

/// Where crown and soles are, from silhouettes.
fn body(cameras: &Cameras, masks: Option<&Masks>) -> Option<Stature> {
    let views: Vec<_> = cameras.views.join(&masks?.views).collect();
    let views: Vec<_> = views.iter().map(|(_, v, m)| (&v.camera, *m)).collect();
    stature(&views)
}

/// Tells how far another length disagrees with the one that is believed.
///
/// # Errors
/// They contradict each other and neither is a mat's.
fn compare(
    first: &Measure,
    other: &Measure,
    scale: Scale,
    p: &FrameParams,
    ctx: &Ctx<'_>,
) -> Result<(), Contradiction> {
    let off = other.mm_per_unit / first.mm_per_unit - 1.0;
    ctx.metric(
        &format!("{} against {}", other.what, first.what),
        off * 100.0,
        "%",
    );
    if scale != Scale::Mat && off.abs() > p.contradiction {
        return Err(Contradiction {
            first: first.what,
            other: other.what,
            percent: off * 100.0,
        });
    }
    if off.abs() > p.disagreement.max(3.0 * both(first.sigma, other.sigma)) {
        ctx.warn(format!(
            "{} and {} disagree by {:.1} %: {} was taken; check what capture.toml says of both",
            first.what,
            other.what,
            off * 100.0,
            first.what
        ));
    }
    Ok(())
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
