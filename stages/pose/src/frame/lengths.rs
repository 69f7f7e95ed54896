//! The lengths that are known of a capture, and what each makes of the cameras' unit.

use crate::frame::disk_edge::DiskEdge;
use crate::frame::stature::Stature;
use crate::frame::tag_scale::{Known, TagScale, tag_scale};
use crate::frame::two_points::{NoLength, between};
use crate::mat::recognise::printed;
use shape::{Cameras, Reference, Rig, Scale, Tags};

/// A length that is known, and what it makes of a unit.
pub(crate) struct Measure {
    pub(crate) what: &'static str,
    pub(crate) scale: Scale,
    pub(crate) mm_per_unit: f64,
    pub(crate) sigma: Option<f64>,
}

/// What was seen of body and disk, in the cameras' unit.
pub(crate) struct Seen {
    pub(crate) body: Option<Stature>,
    pub(crate) edge: Option<DiskEdge>,
    /// Whether something printed lies on the disk.
    pub(crate) covered: bool,
    pub(crate) tags: Option<TagScale>,
    /// Height of the ground.
    pub(crate) ground: f64,
    /// Whether soles alone tell of the ground.
    pub(crate) by_soles: bool,
}

/// Standard deviation of a stature that somebody told and silhouettes show, as a share (by hand).
const TALL: f64 = 0.003;
/// The same of what rounded soles hide of it: they seem to stand higher than they do (by hand: 1.0 % on a made figure with feet
/// like balls; a shoe's edge is sharper). Where disk, tags or a floor tell of the ground, nothing is hidden.
const SOLES: f64 = 0.01;

/// The edge that is seen of a covered disk may be its cover's, which ends so far within it, or where the disk's own edge
/// begins to be rounded (by hand: as paper is cut). \[mm\]
const CUT_MM: f64 = 3.0;

/// The lengths that are known and were seen, the one to be believed first.
pub(crate) fn measures(
    cameras: &Cameras,
    rig: &Rig,
    seen: &Seen,
    warn: impl Fn(String),
) -> Vec<Measure> {
    let mut measures = Vec::new();
    if cameras.scale == Scale::Mat {
        measures.push(Measure {
            what: "the mat",
            scale: Scale::Mat,
            mm_per_unit: 1.0,
            sigma: cameras.scale_sigma,
        });
    }
    measures.extend(seen.tags.map(|tags| Measure {
        what: "the marker tags",
        scale: Scale::Tags,
        mm_per_unit: tags.mm_per_unit,
        sigma: Some(tags.sigma),
    }));
    let tall = |mm: f64, what, scale| {
        let body = seen.body.as_ref()?;
        let height = body.crown - seen.ground;
        let (soles, hidden) = match seen.by_soles {
            true => (body.ground_spread, SOLES),
            false => (0.0, 0.0),
        };
        let spread =
            libm::hypot(body.crown_spread, soles) / (cameras.views.len().max(1) as f64).sqrt();
        (height > 0.0).then(|| Measure {
            what,
            scale,
            mm_per_unit: mm / height,
            sigma: Some(libm::hypot(spread / height, libm::hypot(TALL, hidden))),
        })
    };
    let round = |mm: f64, what, scale| {
        let edge = seen.edge.as_ref()?;
        let cut = if seen.covered { 2.0 * CUT_MM / mm } else { 0.0 };
        Some(Measure {
            what,
            scale,
            mm_per_unit: mm / 2.0 / edge.radius,
            sigma: Some(libm::hypot(0.004, cut)),
        })
    };
    if let Some(reference) = &rig.reference {
        let mm = reference.length_mm;
        measures.extend(match reference.kind.as_str() {
            "subject_height" => tall(mm, "the reference length (stature)", Scale::Reference),
            "disk_diameter" => round(mm, "the reference length (disk)", Scale::Reference),
            "points" => pointed(cameras, reference)
                .map_err(|why| warn(why.to_string()))
                .ok(),
            "tag_size" => {
                let tag = rig.mat.map(|mat| mat.tag_mm);
                if let Some(tag) = tag.filter(|tag| (mm / tag - 1.0).abs() > 0.002) {
                    warn(format!("[mat] says that tags are {tag} mm, [reference] that they are {mm} mm: [mat] was taken; measure a printed tag and correct the other"));
                }
                None
            }
            other => {
                warn(format!(
                    "the reference of kind `{other}` is not known here: `points`, `subject_height`, `disk_diameter` and `tag_size` are"
                ));
                None
            }
        });
    }
    let disk = rig.disk_diameter_mm;
    measures.extend(disk.and_then(|mm| round(mm, "the disk's diameter", Scale::Disk)));
    let stature = rig.stature_mm;
    measures.extend(stature.and_then(|mm| tall(mm, "the stature", Scale::Stature)));
    measures
}

/// What two points that somebody pointed at tell.
fn pointed(cameras: &Cameras, reference: &Reference) -> Result<Measure, NoLength> {
    let found = between(cameras, reference)?;
    Ok(Measure {
        what: "the reference length (two points)",
        scale: Scale::Reference,
        mm_per_unit: reference.length_mm / found.length,
        sigma: Some(found.sigma),
    })
}

/// What marker tags of known size tell, where they did not make the cameras.
pub(crate) fn by_tags(cameras: &Cameras, tags: &Tags, rig: &Rig, most_px: f64) -> Option<TagScale> {
    let tag_mm = rig.mat.map(|mat| mat.tag_mm).or(rig.tag_mm)?;
    let recognised = || printed(tags, tag_mm, rig.disk_diameter_mm);
    let mat = rig.mat.or_else(recognised);
    let known = Known {
        tag_mm,
        mat: mat.as_ref(),
        most_px,
    };
    tag_scale(cameras, tags, &known)
}

/// The ground of tags that lie level, unless they lie above the feet, as on a table.
pub(crate) fn floor(tags: TagScale, body: Option<&Stature>) -> Option<f64> {
    let low = |at: &f64| body.is_none_or(|b| *at < b.ground + 0.1 * (b.crown - b.ground));
    tags.ground.filter(low)
}
