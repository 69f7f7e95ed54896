//! A body in segments that move on their own: trunk, head, and two of each limb.

use nalgebra::{Point3, Vector3};
use shape::{Adjacency, Mesh, Part};

/// The parts of a body by which volumes are reported.
pub const PARTS: [Part; 6] = [
    Part::Head,
    Part::Trunk,
    Part::ArmLeft,
    Part::ArmRight,
    Part::LegLeft,
    Part::LegRight,
];

/// Where along a limb, as a share of its reach from the trunk, its second segment begins: elbow, knee. Where exactly
/// matters little, for motions go over into each other there. By hand: not on record.
const SECOND_SHARE: f64 = 0.52;
/// How wide about that the joint is looked for, as a share of the reach. By hand: not on record.
const JOINT_SHARE_WIDE: f64 = 0.05;

/// One segment: which it hangs on, and where.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Segment {
    /// The part of the body.
    pub(crate) part: Part,
    /// The segment that it hangs on, and the joint; none for the trunk. \[mm\]
    pub(crate) hangs: Option<(usize, Point3<f64>)>,
}

/// A body in segments: each after what it hangs on, the trunk first.
#[derive(Debug, Clone, PartialEq)]
pub struct Segments {
    pub(crate) all: Vec<Segment>,
    /// The segment of each vertex.
    pub(crate) of: Vec<usize>,
}

impl Segments {
    /// The part of each vertex.
    pub fn parts(&self) -> Vec<Part> {
        self.of.iter().map(|s| self.all[*s].part).collect()
    }
}

fn middle(points: &[Point3<f64>]) -> Option<Point3<f64>> {
    let sum: Vector3<f64> = points.iter().map(|p| p.coords).sum();
    (!points.is_empty()).then(|| Point3::from(sum / points.len() as f64))
}

/// The segments of a mesh whose vertices have parts (`Part as u8`). A part that nowhere touches the trunk moves with it.
pub fn segments(mesh: &Mesh, parts: &[u8]) -> Segments {
    let around = Adjacency::new(mesh);
    let is = |v: u32, part: Part| parts[v as usize] == part as u8;
    let mut found = Segments {
        all: vec![Segment {
            part: Part::Trunk,
            hangs: None,
        }],
        of: vec![0; mesh.positions.len()],
    };
    for part in PARTS.into_iter().filter(|p| *p != Part::Trunk) {
        let own: Vec<u32> = (0..mesh.positions.len() as u32)
            .filter(|v| is(*v, part))
            .collect();
        let beside = |v: &&u32| around.vertices(**v).iter().any(|w| is(*w, Part::Trunk));
        let border: Vec<Point3<f64>> = own.iter().filter(beside).map(|v| mesh.point(*v)).collect();
        let Some(joint) = middle(&border) else {
            continue;
        };
        let first = found.all.len();
        found.all.push(Segment {
            part,
            hangs: Some((0, joint)),
        });
        own.iter().for_each(|v| found.of[*v as usize] = first);
        if part == Part::Head {
            continue;
        }
        let far = |v: &u32| (mesh.point(*v) - joint).norm();
        let reach = own.iter().map(far).fold(0.0, f64::max);
        let share = |v: &u32| far(v) / reach.max(f64::MIN_POSITIVE);
        let near = own
            .iter()
            .filter(|v| (share(v) - SECOND_SHARE).abs() < JOINT_SHARE_WIDE);
        let near: Vec<Point3<f64>> = near.map(|v| mesh.point(*v)).collect();
        if let Some(second) = middle(&near) {
            let at = found.all.len();
            found.all.push(Segment {
                part,
                hangs: Some((first, second)),
            });
            let beyond = own.iter().filter(|v| share(v) > SECOND_SHARE);
            beyond.for_each(|v| found.of[*v as usize] = at);
        }
    }
    found
}
