//! One arm or leg: its line, its joints, its pieces.

use super::arm_seen::ArmSeen;
use super::bend::{self, Line};
use super::follow::Knot;
use nalgebra::Point3;
use shape::Plane;

/// Which limb.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// From the hand to the shoulder.
    Arm,
    /// From the foot to the hip.
    Leg,
}

/// A place on a limb's line.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Joint {
    /// Way along the line from the tip. \[mm\]
    pub s: f64,
    /// Its standard deviation. \[mm\]
    pub sigma: f64,
    /// Its standard deviation when the same body is captured again, where that is known. \[mm\]
    pub again: Option<f64>,
}

/// A piece of a limb between two joints.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Segment {
    /// From the acromion to the elbow.
    UpperArm,
    /// From the elbow to the wrist.
    Forearm,
    /// From the hip (trochanter) to the knee.
    Thigh,
    /// From the knee to the ankle.
    Shank,
}

/// An arm or a leg.
#[derive(Debug, Clone)]
pub struct Limb {
    /// The limb.
    pub kind: Kind,
    /// 1 the body's left, -1 its right.
    pub side: f64,
    /// Sections square to its line that are its own alone, from the tip on.
    pub knots: Vec<Knot>,
    /// Wrist or ankle.
    pub end: Joint,
    /// Elbow or knee.
    pub middle: Joint,
    /// Acromion or hip.
    pub root: Joint,
    /// Covariance of middle and root. \[mm²\]
    pub shared: f64,
    /// How far elbow or knee are bent; 0 below what tells of them. \[rad\]
    pub bent: f64,
    /// Where the limb's skin meets that of trunk or other leg: armpit or crotch. \[mm\]
    pub fold: Point3<f64>,
    /// Of a leg: the crotch. \[mm\] along the line.
    pub crotch: f64,
    /// The straight line of upper arm or thigh.
    pub root_line: Option<Line>,
    /// Of an arm: what its joints are estimated from.
    pub seen: Option<ArmSeen>,
    /// Of an arm: where the tip of the elbow and the acromion are as far away.
    pub mid_upper_arm: Option<Joint>,
}

impl Limb {
    /// Where the line is; straight on beyond its ends. \[mm\]
    pub fn point(&self, s: f64) -> Point3<f64> {
        let (Some(first), Some(last)) = (self.knots.first(), self.knots.last()) else {
            return Point3::origin();
        };
        if s >= last.s {
            return match self.root_line {
                Some(line) => line.nearest(last.centre) + line.along * (s - last.s),
                None => last.centre + last.along * (s - last.s),
            };
        }
        let above = self.knots.partition_point(|k| k.s < s).max(1);
        let (a, b) = (
            &self.knots[above - 1],
            &self.knots[above.min(self.knots.len() - 1)],
        );
        let t = (s.max(first.s) - a.s) / (b.s - a.s).max(1e-9);
        Point3::from(a.centre.coords.lerp(&b.centre.coords, t.clamp(0.0, 1.0)))
    }

    /// Where its last section of its own is. \[mm\]
    pub fn clear_to(&self) -> f64 {
        self.knots.last().map_or(0.0, |k| k.s)
    }

    /// The two joints of a segment, the one near the trunk first; `None` if it is another limb's.
    pub fn ends(&self, segment: Segment) -> Option<(Joint, Joint)> {
        match (segment, self.kind) {
            (Segment::UpperArm, Kind::Arm) | (Segment::Thigh, Kind::Leg) => {
                Some((self.root, self.middle))
            }
            (Segment::Forearm, Kind::Arm) | (Segment::Shank, Kind::Leg) => {
                Some((self.middle, self.end))
            }
            _ => None,
        }
    }

    /// The straight line of a segment, toward the trunk.
    pub fn axis(&self, segment: Segment) -> Option<Line> {
        let (near, far) = self.ends(segment)?;
        let trim = 0.12 * (near.s - far.s);
        let within = |k: &&Knot| (far.s + trim..=near.s - trim).contains(&k.s) && k.round > 0.9;
        let own = bend::line(self.knots.iter().filter(within));
        match segment {
            Segment::UpperArm | Segment::Thigh => self.root_line.or(own),
            Segment::Forearm | Segment::Shank => own,
        }
    }

    /// The plane square to a segment's line at a share of the way from its joint near the trunk (0) to
    /// the other (1), its normal toward the tip, and the place's standard deviation. \[mm\]
    pub fn at_share(&self, segment: Segment, share: f64) -> Option<(Plane, f64)> {
        let (near, far) = self.ends(segment)?;
        let s = near.s + share * (far.s - near.s);
        self.at(segment, s, share)
    }

    /// The plane across an upper arm midway between acromion and the tip of the elbow (olecranon), and how
    /// sure its place is. \[mm\]
    pub fn mid_upper_arm(&self) -> Option<(Plane, Joint)> {
        let joint = self.mid_upper_arm?;
        let (plane, _) = self.at(Segment::UpperArm, joint.s, 0.5)?;
        Some((plane, joint))
    }

    /// The plane square to a segment's line at a place of it, about that share of its way.
    fn at(&self, segment: Segment, s: f64, share: f64) -> Option<(Plane, f64)> {
        let (near, far) = self.ends(segment)?;
        let line = self.axis(segment)?;
        let shared = match segment {
            Segment::UpperArm | Segment::Thigh => self.shared,
            Segment::Forearm | Segment::Shank => 0.0,
        };
        let (a, b) = (1.0 - share, share);
        let square = (a * near.sigma).powi(2) + (b * far.sigma).powi(2) + 2.0 * a * b * shared;
        let point = match self.seen {
            // Ways are along the straight line there.
            Some(seen) if segment == Segment::UpperArm => line.point + line.along * (s - seen.last),
            _ => self.point(s),
        };
        let plane = Plane {
            point_mm: point.into(),
            normal: (-line.along).into(),
        };
        Some((plane, square.max(0.0).sqrt()))
    }
}
