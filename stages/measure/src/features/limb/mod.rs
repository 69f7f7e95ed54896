//! Arms and legs by their own centre lines: from the tip to where each joins the trunk.

pub(crate) mod arm;
pub(crate) mod arm_seen;
pub(crate) mod bend;
pub(crate) mod cuts;
pub(crate) mod follow;
pub(crate) mod graph;
pub(crate) mod leg;
pub(crate) mod one;
pub(crate) mod tips;

use crate::features::body::Body;
pub use arm_seen::ArmSeen;
use cuts::Cuts;
pub(crate) use follow::away;
use follow::{bands, followed};
use graph::Graph;
use nalgebra::Point3;
pub use one::{Joint, Kind, Limb, Segment};
use shape::{Mesh, Part, Refusal};
use tips::{Tip, fold, land, tips};

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
    ///
    /// # Errors
    ///
    /// Why there is no arm on that side.
    pub fn arm(&self, side: f64) -> Result<&Limb, Refusal> {
        self.arms[usize::from(side < 0.0)].as_ref().map_err(|r| *r)
    }

    /// Both arms, as far as they were followed.
    pub(crate) fn arms_mut(&mut self) -> impl Iterator<Item = &mut Result<Limb, Refusal>> {
        self.arms.iter_mut()
    }

    /// The leg of a side.
    ///
    /// # Errors
    ///
    /// Why there is no leg on that side.
    pub fn leg(&self, side: f64) -> Result<&Limb, Refusal> {
        self.legs[usize::from(side < 0.0)].as_ref().map_err(|r| *r)
    }
}

/// Lengths as shares of stature: cells of the graph, cells of the faces, steps of the bands (structural: samples).
const CELL: f64 = 1.0 / 160.0;
/// Cells of the faces (structural: samples).
const FACES: f64 = 1.0 / 40.0;
/// Steps of the bands (structural: samples).
const BAND: f64 = 0.005;
/// Arms reach out at least so far, as a share of stature: forearms with hands are 0.237 long at least (ANSUR II).
const LEAST_ARM: f64 = 0.2;
/// Legs reach out at least so far, as a share of stature: to below the knee, at 0.24 at least (ANSUR II).
const LEAST_LEG: f64 = 0.12;
/// Feet are lower than this share of stature, hands higher: the malleolus is at 0.053 at most, fingertips at 0.31 at
/// least (ANSUR II).
const LOW_SHARE: f64 = 0.15;

/// Follows the limbs of a body. Where an arm's joints are is not known yet.
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
    let all = tips(&graph, &way, LEAST_LEG * stature);
    let high = |t: &&Tip| graph.at[t.node as usize].z - body.ground;
    let hands: Vec<&Tip> = all
        .iter()
        .filter(|t| high(t) > LOW_SHARE * stature && t.long > LEAST_ARM * stature)
        .collect();
    let feet: Vec<&Tip> = all
        .iter()
        .filter(|t| high(t) <= LOW_SHARE * stature)
        .collect();
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
    let fold = fold(graph, way, (tip, &own, &from), CELL * body.stature);
    let middles = bands(graph, &from, fold.way, BAND * body.stature);
    let mut limb = Limb {
        kind,
        side,
        knots: followed(&found.cuts, &middles, body.stature),
        end: Joint::default(),
        middle: Joint::default(),
        root: Joint::default(),
        shared: 0.0,
        bent: 0.0,
        fold: fold.at,
        crotch: 0.0,
        root_line: None,
        seen: None,
        mid_upper_arm: None,
    };
    let reported = match kind {
        Kind::Arm => arm::seen(&found.cuts, &mut limb, body),
        Kind::Leg => leg::joints(&mut limb, body.ground, body.stature),
    };
    reported.ok_or(Refusal::NoLimb)?;
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
