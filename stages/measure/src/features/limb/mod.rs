//! Arms and legs by their own centre lines: from the tip to where each joins the trunk.

pub(crate) mod arm;
pub(crate) mod bend;
pub(crate) mod cuts;
pub(crate) mod follow;
pub(crate) mod graph;
pub(crate) mod leg;
pub(crate) mod tips;

use crate::features::body::Body;
use bend::Line;
use cuts::Cuts;
pub(crate) use follow::away;
use follow::{Knot, bands, followed};
use graph::Graph;
use nalgebra::Point3;
use shape::{Mesh, Part, Plane, Refusal};
use tips::{Tip, land, tips};

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
    /// Which.
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

    /// The plane across an upper arm midway between acromion and the tip of the olecranon. The tip lies
    /// behind the elbow's joint and turns with the forearm: up beside a straight arm's joint, down below
    /// a bent one's.
    pub fn amid_upper_arm(&self, stature: f64) -> Option<(Plane, f64)> {
        let (sin, cos) = self.bent.sin_cos();
        let tip = self.middle.s + OLECRANON * stature * (cos - sin);
        self.at(Segment::UpperArm, (self.root.s + tip) / 2.0, 0.5)
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
        let plane = Plane {
            point_mm: self.point(s).into(),
            normal: (-line.along).into(),
        };
        Some((plane, square.max(0.0).sqrt()))
    }
}

/// The limbs of a body.
pub struct Limbs<'a> {
    pub(crate) cuts: Cuts<'a>,
    arms: [Result<Limb, Refusal>; 2],
    legs: [Result<Limb, Refusal>; 2],
    /// The part of each vertex that belongs to a limb.
    pub(crate) parts: Vec<Option<Part>>,
}

impl Limbs<'_> {
    /// The arm of a side (1 left, -1 right).
    pub fn arm(&self, side: f64) -> Result<&Limb, Refusal> {
        self.arms[usize::from(side < 0.0)].as_ref().map_err(|r| *r)
    }

    /// The leg of a side.
    pub fn leg(&self, side: f64) -> Result<&Limb, Refusal> {
        self.legs[usize::from(side < 0.0)].as_ref().map_err(|r| *r)
    }
}

/// How far the tip of the olecranon lies from the elbow's axis along and behind the ulna, as a share of
/// stature: some 20 mm.
const OLECRANON: f64 = 0.012;
/// Lengths as shares of stature: cells of the graph, cells of the faces, steps of the bands.
const CELL: f64 = 1.0 / 160.0;
const FACES: f64 = 1.0 / 40.0;
const BAND: f64 = 0.005;
/// Arms and legs stand out at least so far, as a share of stature.
const ARM: f64 = 0.2;
const LEG: f64 = 0.12;
/// Feet are lower than this share of stature, hands higher.
const LOW: f64 = 0.15;

/// Follows the limbs of a body.
pub fn limbs<'a>(mesh: &'a Mesh, body: &Body) -> Limbs<'a> {
    let stature = body.stature;
    let cuts = Cuts::new(mesh, FACES * stature);
    let mut found = Limbs {
        cuts,
        arms: [const { Err(Refusal::NoLimb) }; 2],
        legs: [const { Err(Refusal::NoLegs) }; 2],
        parts: vec![None; mesh.positions.len()],
    };
    let graph = Graph::new(mesh, CELL * stature);
    let Some(crown) = (0..graph.at.len()).max_by(|a, b| {
        let (a, b) = (graph.at[*a].z, graph.at[*b].z);
        a.total_cmp(&b)
    }) else {
        return found;
    };
    let way = graph.ways(crown as u32);
    let all = tips(&graph, &way, LEG * stature);
    let high = |t: &&Tip| graph.at[t.node as usize].z - body.ground;
    let hands: Vec<&Tip> = all
        .iter()
        .filter(|t| high(t) > LOW * stature && t.long > ARM * stature)
        .collect();
    let feet: Vec<&Tip> = all.iter().filter(|t| high(t) <= LOW * stature).collect();
    let out = |t: &Tip| {
        let middle = body
            .trunk(body.ground + 0.6 * stature)
            .map_or(Point3::origin(), |r| r.centre);
        (graph.at[t.node as usize] - middle).dot(&body.left)
    };
    let side = |tips: &[&Tip], t: &Tip| {
        let rank = tips.iter().filter(|o| out(o) > out(t)).count();
        match tips.len() {
            2 => [1.0, -1.0][rank],
            _ => out(t).signum(),
        }
    };
    if feet.len() == 2 {
        for tip in &feet {
            let side = side(&feet, tip);
            let at = usize::from(side < 0.0);
            found.legs[at] = one(&graph, &way, tip, Kind::Leg, side, body, &mut found);
        }
    }
    if hands.len() <= 2 {
        for tip in &hands {
            let side = side(&hands, tip);
            let at = usize::from(side < 0.0);
            found.arms[at] = one(&graph, &way, tip, Kind::Arm, side, body, &mut found);
        }
    }
    found
}

/// Follows one limb.
fn one(
    graph: &Graph,
    way: &[f64],
    tip: &Tip,
    kind: Kind,
    side: f64,
    body: &Body,
    found: &mut Limbs<'_>,
) -> Result<Limb, Refusal> {
    let own = land(graph, way, tip);
    let from = graph.ways(tip.node);
    let middles = bands(graph, &from, from[tip.fold as usize], BAND * body.stature);
    let mut limb = Limb {
        kind,
        side,
        knots: followed(&found.cuts, &middles, body.stature),
        end: Joint::default(),
        middle: Joint::default(),
        root: Joint::default(),
        shared: 0.0,
        bent: 0.0,
        fold: graph.at[tip.fold as usize],
        crotch: 0.0,
        root_line: None,
    };
    let told = match kind {
        Kind::Arm => arm::joints(&found.cuts, &mut limb, body.stature),
        Kind::Leg => leg::joints(&mut limb, body.ground, body.stature),
    };
    told.ok_or(Refusal::NoLimb)?;
    let [left, right] = match kind {
        Kind::Arm => [Part::ArmLeft, Part::ArmRight],
        Kind::Leg => [Part::LegLeft, Part::LegRight],
    };
    let part = if side > 0.0 { left } else { right };
    for (v, node) in graph.of.iter().enumerate() {
        if *node != u32::MAX && own[*node as usize] {
            found.parts[v] = Some(part);
        }
    }
    Ok(limb)
}
