//! Planes across arms and calves, from their own lines and joints.

use crate::features::body::Body;
use crate::features::extent::extent;
use crate::features::limb::follow::Knot;
use crate::features::limb::{Limb, Limbs, Segment};
use crate::geometry::slices::Ring;
use nalgebra::{Point3, Vector3};
use shape::{Mesh, Part, Plane, PlaneSigma, Refusal};

/// A plane and how sure it is.
pub(crate) type Placed = (Plane, PlaneSigma);

/// How sure the line of a segment is. By hand: looked at three scans, at 0.7 and 1.4 of it: intervals change by at most
/// 1 and 1 %. \[rad\]
const TILT_RAD: f64 = 2.5 * std::f64::consts::PI / 180.0;
/// A leg that leans less, 15°, is taken level, as the standard has it. By hand: looked at three scans, at 0.7 and 1.4
/// of it: tapes move by at most 0 and 0.32 %, intervals change by at most 0 and 2 %. \[cos\]
pub(super) const LEAST_UPRIGHT: f64 = 0.966;
pub(super) fn sure(level: f64) -> PlaneSigma {
    PlaneSigma {
        level_mm: Some(level),
        tilt_rad: Some(TILT_RAD),
        ..PlaneSigma::default()
    }
}

/// Square to a segment's line at a share of the way from its joint near the trunk (0) to the other (1),
/// and how sure its place is.
///
/// # Errors
///
/// If the limb has no such segment, or its line is not known.
pub fn share(limb: &Limb, segment: Segment, share: f64) -> Result<Placed, Refusal> {
    let (plane, sigma) = limb.at_share(segment, share).ok_or(Refusal::NoLimb)?;
    Ok((plane, sure(sigma)))
}

/// Across an upper arm midway between acromion and elbow (ISO 8559-1 5.3.16), centred on the arm's own ring where
/// the surface shows one.
pub(crate) fn upper_arm(limbs: &Limbs<'_>, side: f64) -> Result<Placed, Refusal> {
    let arm = limbs.arm(side)?;
    if arm.clear_to() < arm.middle.s {
        return Err(Refusal::Fused);
    }
    let (plane, middle) = arm.mid_upper_arm().ok_or(Refusal::NoLimb)?;
    let sigma = PlaneSigma {
        repeat_mm: middle.again,
        ..sure(middle.sigma)
    };
    Ok((plane, sigma))
}

/// A ring of one leg, level or square to its line, and the plane it is in.
pub(super) struct Across<'a> {
    limbs: &'a Limbs<'a>,
    leg: &'a Limb,
    /// Normal of the planes, downward.
    down: Vector3<f64>,
    within: f64,
}

impl<'a> Across<'a> {
    pub(super) fn new(
        limbs: &'a Limbs<'a>,
        leg: &'a Limb,
        down: Vector3<f64>,
        stature: f64,
    ) -> Self {
        Across {
            limbs,
            leg,
            down,
            within: 0.2 * stature,
        }
    }

    /// At a place of the leg's line.
    pub(super) fn at(&self, s: f64) -> Option<(Plane, Ring)> {
        self.through(self.leg.point(s))
    }

    /// Around a point.
    pub(super) fn through(&self, point: Point3<f64>) -> Option<(Plane, Ring)> {
        let plane = Plane {
            point_mm: point.into(),
            normal: self.down.into(),
        };
        let ring = self.limbs.cuts.ring(&plane, self.within, 0.0)?;
        let mut plane = plane;
        plane.point_mm = ring.centre.into();
        Some((plane, ring))
    }
}

/// Whether a ring reaches the line of the other leg. `None` if that is not known.
pub(super) fn holds_other(limbs: &Limbs<'_>, body: &Body, side: f64, ring: &Ring) -> Option<bool> {
    let left = body.left * side;
    let (other, (inner, _)) = (limbs.leg(-side).ok()?, extent(ring, &left)?);
    let off = |k: &&Knot| (k.centre.z - ring.centre.z).abs();
    let near = other.knots.iter().min_by(|a, b| off(a).total_cmp(&off(b)));
    Some(near.is_none_or(|k| inner < k.centre.coords.dot(&left)))
}

/// The part of each vertex: limbs by their own land, head above the neck; the rest is trunk.
pub fn parts(mesh: &Mesh, body: &Body, limbs: &Limbs<'_>) -> Vec<u8> {
    let neck = body.neck.unwrap_or(f64::MAX);
    let part = |v: usize| match limbs.parts[v] {
        Some(part) => part,
        None if f64::from(mesh.positions[v][2]) > neck => Part::Head,
        None => Part::Trunk,
    };
    (0..mesh.positions.len()).map(|v| part(v) as u8).collect()
}
