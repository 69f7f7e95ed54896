//! The first body in the pose of another capture, and girths there at the first one's levels.

use super::part_of::landmark;
use super::series::Visit;
use crate::sections::{limbs, parts, section_at};
use follow::{Halves, Posed, Segments, Target, carried, posed, segments};
use nalgebra::Point3;
use shape::{Mesh, Part, Plane, Refusal};

/// A girth of the first capture taken on another one.
#[derive(Debug, Clone, PartialEq)]
pub struct Tape {
    /// The girth's name.
    pub name: String,
    /// Its length there, or why there is none. \[mm\]
    pub tape_mm: Result<f64, Refusal>,
    /// How much of its standard deviation is the level's: half of what the tape changes when the level is carried by one
    /// half of the surface's points and by the other. \[mm\]
    pub level_mm: f64,
}

/// The first surface laid on another.
pub struct Laid {
    /// The first in the other's pose.
    pub posed: Posed,
    /// The same by every other point, and by the other ones.
    halves: [Mesh; 2],
    /// The segments of the first.
    pub segments: Segments,
}

/// How far from its middle a tape may be, in radii of a circle as long.
const NEAR: f64 = 1.5;

/// Lays the first on another.
pub fn lay(first: &Visit, other: &Visit) -> Laid {
    let labels = parts(&first.mesh, &first.body, &limbs(&first.mesh, &first.body));
    let segments = segments(&first.mesh, &labels);
    let target = Target::new(&other.mesh);
    let by = |halves| posed(&first.mesh, &segments, &target, halves);
    Laid {
        posed: by(Halves::Both),
        halves: [by(Halves::Even).mesh, by(Halves::Odd).mesh],
        segments,
    }
}

/// Whether what moves with a part carries a plane of another.
fn goes_with(of: Part, part: Part) -> bool {
    let core = |p: Part| matches!(p, Part::Head | Part::Trunk);
    of == part || (core(of) && core(part))
}

/// Every girth of the first capture that has a plane, on the other capture at the level carried there.
pub fn tapes(first: &Visit, laid: &Laid, other: &Visit) -> Vec<Tape> {
    let of = laid.segments.parts();
    let tape = |girth: &crate::girth_file::ReadGirth| -> Option<Tape> {
        let (point_mm, normal) = girth.plane?;
        let plane = Plane { point_mm, normal };
        let part = landmark(girth, plane)?.part;
        let reach = NEAR * 10.0 * girth.tape / std::f64::consts::TAU;
        let near =
            |mesh: &Mesh, v: usize| (mesh.point(v as u32) - Point3::from(point_mm)).norm() < reach;
        let on = |moved: &Mesh| -> Result<f64, Refusal> {
            let there = carried(&plane, &first.mesh, moved, |v| goes_with(of[v], part));
            // A limb that was not parted from the trunk there: what is about the tape's middle.
            let about = || carried(&plane, &first.mesh, moved, |v| near(&first.mesh, v));
            let there = there.or_else(about).ok_or(Refusal::NoSection)?;
            let mark = landmark(girth, there).ok_or(Refusal::NoSection)?;
            Ok(section_at(&other.mesh, Some(&other.body), &mark)?.tape_mm)
        };
        let level = match laid.halves.each_ref().map(&on) {
            [Ok(a), Ok(b)] => (a - b).abs() / 2.0,
            _ => 0.0,
        };
        Some(Tape {
            name: girth.name.clone(),
            tape_mm: on(&laid.posed.mesh),
            level_mm: level,
        })
    };
    first
        .capture
        .girths
        .girths
        .iter()
        .filter_map(tape)
        .collect()
}
