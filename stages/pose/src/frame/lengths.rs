//! The lengths that are known of a capture, and what each makes of the cameras' unit.

use crate::calibration::prior::radial_of;
use crate::frame::disk_edge::DiskEdge;
use crate::frame::stature::Stature;
use crate::frame::tag_scale::{Known, TagScale, tag_scale};
use crate::frame::two_points::{NoLength, between};
use crate::mat::recognise::printed;
use nalgebra::Point3;
use shape::{Cameras, GIVEN_STATURE, Length, Reference, Rig, Scale, Tags};
use stage::{Message, Template, message};

stage::messages! {
    BY_STATURE = "find-from-reference-stature": "the reference length (stature)";
    BY_DISK = "find-from-reference-disk": "the reference length (disk)";
    BY_TAG = "find-from-reference-tag": "the reference length (tag size)";
    BY_POINTS = "find-from-reference-points": "the reference length (two points)";
    UNKNOWN_KIND = "warn-reference": "the reference of kind `{kind}` is not known here: `points`, `subject_height`, `disk_diameter` and `tag_size` are";
    TWO_TAGS = "warn-two-tags": "[mat] has tags of {mat} mm, [reference] of {reference} mm: [mat] was taken; measure a printed tag and correct the other";
}

/// A length that is known, and what it makes of a unit.
pub(crate) struct Measure {
    pub(crate) what: Template,
    pub(crate) scale: Scale,
    pub(crate) mm_per_unit: f64,
    pub(crate) sigma: Option<f64>,
    /// Which length it is.
    pub(crate) length: Length,
    /// The length as it was given; none of what is no single length. \[mm\]
    pub(crate) given: Option<f64>,
    /// Standard deviation of what was given, as people give it, as a share.
    pub(crate) slip: f64,
}

impl Measure {
    /// Standard deviation with what people err who give it, as far as it is known; a share.
    pub(crate) fn errs(&self) -> f64 {
        libm::hypot(self.sigma.unwrap_or(0.0), self.slip)
    }
}

/// What was seen of body and disk, in the cameras' unit.
pub(crate) struct Seen {
    pub(crate) body: Option<Stature>,
    pub(crate) edge: Option<DiskEdge>,
    /// Whether something printed is on the disk.
    pub(crate) covered: bool,
    pub(crate) tags: Option<TagScale>,
    /// Height of the ground.
    pub(crate) ground: f64,
    /// Whether soles alone give the ground.
    pub(crate) by_soles: bool,
    /// Standard deviation of what radial distortion does at a corner of the photo, as a share of its way from the middle.
    pub(crate) corner_sigma: f64,
}

/// Standard deviation of a stature that is given and silhouettes show, as a share. By hand: looked at six captures,
/// halved and doubled: no more than chance (docs/lab/numbers.md).
const STATURE_SIGMA: f64 = 0.003;
/// The same of what rounded soles hide of it: they seem to be higher than they are. By hand: looked at on a made figure
/// with feet like balls, 1.0 %; a shoe's edge is sharper. Where disk, tags or a floor give the ground, nothing is
/// hidden.
const SOLES_SIGMA: f64 = 0.01;

/// Standard deviation of a disk's edge, as a share of its radius. By hand: looked at forty captures by twenty cameras, two
/// thirds of a disk's edge and more on the photos (docs/lab/disks.md).
const DISK_SIGMA: f64 = 0.004;

/// By what share a length at a height of the axis may be seen too large beside one at the photo's middle, for k1 may be off:
/// σ r² (the first term of the radial polynomial).
fn distorted(cameras: &Cameras, height: f64, corner_sigma: f64) -> Option<f64> {
    let camera = &cameras.views.values().next()?.camera;
    let at = camera.pose.apply(&Point3::new(0.0, 0.0, height));
    let radial = radial_of(corner_sigma, &camera.lens);
    Some(radial * (at.x * at.x + at.y * at.y) / (at.z * at.z))
}

/// Standard deviation of a length that is read off a ruler in whole millimetres: even from half of one below to half of one above. \[mm\]
/// (derived: 1/√12.)
const RULER_MM: f64 = 0.289;

/// The edge that is seen of a covered disk may be its cover's, which ends so far within it, or where the disk's own
/// edge begins to be rounded. By hand: looked at how paper is cut. \[mm\]
const CUT_MM: f64 = 3.0;

/// The lengths that are known and were seen, the one to be believed first.
pub(crate) fn measures(
    cameras: &Cameras,
    rig: &Rig,
    seen: &Seen,
    warn: impl Fn(Message),
) -> Vec<Measure> {
    let mut measures = printed_marks(cameras, seen);
    let tall = |mm: f64, what, scale| {
        let body = seen.body.as_ref()?;
        let height = body.crown - seen.ground;
        let (soles, hidden) = match seen.by_soles {
            true => (body.ground_spread, SOLES_SIGMA),
            false => (0.0, 0.0),
        };
        let spread =
            libm::hypot(body.crown_spread, soles) / (cameras.views.len().max(1) as f64).sqrt();
        (height > 0.0).then(|| Measure {
            what,
            scale,
            mm_per_unit: mm / height,
            sigma: Some(libm::hypot(
                spread / height,
                libm::hypot(STATURE_SIGMA, hidden),
            )),
            length: Length::Stature.or_reference(scale),
            given: Some(mm),
            slip: GIVEN_STATURE,
        })
    };
    let round = |mm: f64, what, scale| {
        let edge = seen.edge.as_ref()?;
        let cut = if seen.covered { 2.0 * CUT_MM / mm } else { 0.0 };
        Some(Measure {
            what,
            scale,
            mm_per_unit: mm / 2.0 / edge.radius,
            sigma: Some(libm::hypot(
                libm::hypot(DISK_SIGMA, cut),
                distorted(cameras, edge.height, seen.corner_sigma)?,
            )),
            length: Length::Disk.or_reference(scale),
            given: Some(mm),
            slip: 0.0,
        })
    };
    if let Some(reference) = &rig.reference {
        let mm = reference.length_mm;
        measures.extend(match reference.kind.as_str() {
            "subject_height" => tall(mm, BY_STATURE, Scale::Reference),
            "disk_diameter" => round(mm, BY_DISK, Scale::Reference),
            "points" => pointed(cameras, reference)
                .map_err(|why| warn(why.message()))
                .ok(),
            "tag_size" => tag_size(mm, rig, measures.first(), &warn),
            other => {
                warn(message!(UNKNOWN_KIND, kind = other));
                None
            }
        });
    }
    let disk = rig.disk_diameter_mm;
    measures.extend(disk.and_then(|mm| round(mm, Length::Disk.template(), Scale::Disk)));
    let stature = rig.stature_mm;
    measures.extend(stature.and_then(|mm| tall(mm, Length::Stature.template(), Scale::Stature)));
    measures
}

/// What marks of known size give: the mat that made the cameras, or tags that did not.
fn printed_marks(cameras: &Cameras, seen: &Seen) -> Vec<Measure> {
    let mat = (cameras.scale == Scale::Mat).then_some(Measure {
        what: Length::Mat.template(),
        scale: Scale::Mat,
        mm_per_unit: 1.0,
        sigma: cameras.scale_sigma,
        length: Length::Mat,
        given: None,
        slip: 0.0,
    });
    let tags = seen.tags.map(|tags| Measure {
        what: Length::Tags.template(),
        scale: Scale::Tags,
        mm_per_unit: tags.mm_per_unit,
        sigma: Some(tags.sigma),
        length: Length::Tags,
        given: None,
        slip: 0.0,
    });
    mat.into_iter().chain(tags).collect()
}

/// A reference that is the size of the mat's tags: another length where that differs from the mat's own.
fn tag_size(
    mm: f64,
    rig: &Rig,
    marks: Option<&Measure>,
    warn: &impl Fn(Message),
) -> Option<Measure> {
    let tag = rig.mat?.tag_mm;
    if (mm / tag - 1.0).abs() <= 0.002 {
        return None;
    }
    warn(message!(TWO_TAGS, mat = tag, reference = mm));
    Some(Measure {
        what: BY_TAG,
        scale: Scale::Reference,
        mm_per_unit: marks?.mm_per_unit * mm / tag,
        sigma: Some(RULER_MM / mm),
        length: Length::Reference,
        given: Some(mm),
        slip: 0.0,
    })
}

/// What two points that somebody pointed at give.
fn pointed(cameras: &Cameras, reference: &Reference) -> Result<Measure, NoLength> {
    let found = between(cameras, reference)?;
    Ok(Measure {
        what: BY_POINTS,
        scale: Scale::Reference,
        mm_per_unit: reference.length_mm / found.length,
        sigma: Some(found.sigma),
        length: Length::Reference,
        given: Some(reference.length_mm),
        slip: 0.0,
    })
}

/// What marker tags of known size give, where they did not make the cameras.
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

/// The ground of tags that are level, unless they are above the feet, as on a table.
pub(crate) fn floor(tags: TagScale, body: Option<&Stature>) -> Option<f64> {
    let low = |at: &f64| body.is_none_or(|b| *at < b.ground + 0.1 * (b.crown - b.ground));
    tags.ground.filter(low)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;
    use shape::{Camera, Intrinsics, View};

    #[test]
    fn what_a_lens_may_bend_grows_with_the_square_of_the_way_from_the_middle() {
        // From 3 m, at 1 m above the disk and level: the disk is a third of the distance below the middle.
        let lens = Intrinsics::simple(900, 1200, 1700.0);
        let from = Point3::new(3000.0, 0.0, 1000.0);
        let camera = Camera::looking(lens, from, from - Vector3::x() * 3000.0);
        let cameras = Cameras::of(
            [(shape::PhotoId(0), View::of("0000.jpg", camera))],
            Scale::Nothing,
        );
        let corner = 750.0 / 1700.0;
        let want = 0.005 / (corner * corner) / 9.0;
        proof::near(distorted(&cameras, 0.0, 0.005).unwrap(), want, 1e-9);
        proof::near(distorted(&cameras, 1000.0, 0.005).unwrap(), 0.0, 1e-9);
    }
}
