//! Where on a body to measure: planes found on the surface, or why they were not found.

use crate::{GirthId, Missing, Region, Side, Unit};
use serde::{Deserialize, Serialize};
use stage::{Artifact, Corrupt, Packer, Unpacker};

/// A plane.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Plane {
    /// A point of it, in the middle of the section. \[mm\]
    pub point_mm: [f64; 3],
    /// Its unit normal.
    pub normal: [f64; 3],
}

/// The part of the body that a section must go around.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Part {
    /// Head and neck.
    Head,
    /// From shoulders to crotch.
    Trunk,
    /// The subject's left arm.
    ArmLeft,
    /// The subject's right arm.
    ArmRight,
    /// The subject's left leg.
    LegLeft,
    /// The subject's right leg.
    LegRight,
}

impl Part {
    /// The arm of a side.
    pub fn arm(side: Side) -> Part {
        match side {
            Side::Left => Part::ArmLeft,
            Side::Right => Part::ArmRight,
        }
    }

    /// The leg of a side.
    pub fn leg(side: Side) -> Part {
        match side {
            Side::Left => Part::LegLeft,
            Side::Right => Part::LegRight,
        }
    }
}

/// How sure the place of a plane is, as standard deviations; `None` where it is not known.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct PlaneSigma {
    /// Along the normal, against the definition's own place on this body. \[mm\]
    pub level_mm: Option<f64>,
    /// Of the normal's tilt, about the body's left-right axis. \[rad\]
    pub tilt_rad: Option<f64>,
    /// Along the normal, when the same person is measured again. \[mm\]
    pub repeat_mm: Option<f64>,
    /// How much longer the girth is than in this plane at most, nineteen times in twenty, for a part of the limb is hidden: of a thigh, between where
    /// legs join on the surface and the crotch. \[mm\]
    pub hidden_mm: Option<f64>,
}

/// Where one girth is taken.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Landmark {
    /// The girth that is measured here.
    pub id: GirthId,
    /// Whose definition it follows: `id`'s own, or that of the waist which the user chose.
    pub by: GirthId,
    /// The part of the body.
    pub region: Region,
    /// Short name: WC, HC, CC, NC, AC_L, AC_R, …, or the user's.
    pub name: String,
    /// What people call it: `waist`.
    pub label: String,
    /// Its definition, with the standards behind it.
    pub definition: String,
    /// The plane of the tape.
    pub plane: Plane,
    /// Around what.
    pub part: Part,
    /// How sure the plane's place is.
    pub sigma: PlaneSigma,
}

impl Landmark {
    /// Of a girth of the table, how sure its plane is not known yet.
    pub fn new(id: GirthId, plane: Plane, part: Part) -> Self {
        let row = id.definition();
        Landmark {
            id,
            by: id,
            region: row.region,
            name: id.name(),
            label: id.label(),
            definition: row.line(),
            plane,
            part,
            sigma: PlaneSigma::default(),
        }
    }

    /// The same, by another girth's definition.
    #[must_use]
    pub fn by(self, other: GirthId) -> Self {
        Landmark {
            by: other,
            definition: other.definition().line(),
            ..self
        }
    }
}

/// Where girths are to be measured.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Landmarks {
    /// What the numbers mean.
    pub unit: Unit,
    /// What was found.
    pub found: Vec<Landmark>,
    /// What was not, and why.
    pub missing: Vec<Missing>,
    /// Named points: crown, crotch, armpit_L, … \[mm\]
    pub points: Vec<(String, [f64; 3])>,
    /// The part of each vertex of the mesh, as `Part as u8`.
    pub parts: Vec<u8>,
    /// Crown above the ground; `None` where that is no stature. \[mm\]
    pub stature_mm: Option<f64>,
    /// Standard deviation of the stature: ground, crown and scale. \[mm\]
    pub stature_sigma_mm: Option<f64>,
    /// Height of the ground under the body's feet; `None` where there is none. \[mm\]
    pub ground_mm: Option<f64>,
}

impl Artifact for Landmarks {
    const KIND: &'static str = "landmarks";
    const FORMAT: u32 = 6;

    fn pack(&self, to: &mut Packer) {
        let heights = (self.stature_mm, self.stature_sigma_mm, self.ground_mm);
        to.meta(&(self.unit, &self.found, &self.missing, &self.points, heights));
        to.section("parts", &self.parts);
    }

    fn unpack(from: &Unpacker<'_>) -> Result<Self, Corrupt> {
        let (unit, found, missing, points, heights) = from.meta()?;
        let (stature_mm, stature_sigma_mm, ground_mm) = heights;
        Ok(Landmarks {
            unit,
            found,
            missing,
            points,
            parts: from.section("parts")?,
            stature_mm,
            stature_sigma_mm,
            ground_mm,
        })
    }
}
