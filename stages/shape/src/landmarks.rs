//! Where on a body to measure: planes found on the surface, or why they were not found.

use crate::Missing;
use serde::{Deserialize, Serialize};
use stage::{Artifact, Corrupt, Packer, Unpacker};

/// A plane.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Plane {
    /// A point of it, amid the section. \[mm\]
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

/// How sure the place of a plane is, as standard deviations; `None` where it is not known.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct PlaneSigma {
    /// Along the normal, against the definition's own place on this body. \[mm\]
    pub level_mm: Option<f64>,
    /// Of the normal's tilt, about the body's left-right axis. \[rad\]
    pub tilt_rad: Option<f64>,
    /// Along the normal, when the same person is measured again. \[mm\]
    pub repeat_mm: Option<f64>,
}

/// Where one girth is taken.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Landmark {
    /// Short name: WC, HC, CC, NC, AC_L, AC_R, …
    pub name: String,
    /// What people call it: `waist`.
    pub label: String,
    /// Its definition, with the standard's number.
    pub definition: String,
    /// Where.
    pub plane: Plane,
    /// Around what.
    pub part: Part,
    /// How sure the plane's place is.
    pub sigma: PlaneSigma,
}

/// Where to measure.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Landmarks {
    /// What was found.
    pub found: Vec<Landmark>,
    /// What was not, and why.
    pub missing: Vec<Missing>,
    /// Named points: crown, crotch, armpit_L, … \[mm\]
    pub points: Vec<(String, [f64; 3])>,
    /// The part of each vertex of the mesh, as `Part as u8`.
    pub parts: Vec<u8>,
    /// Crown above the ground. \[mm\] 0 where unknown.
    pub stature_mm: f64,
}

impl Artifact for Landmarks {
    const KIND: &'static str = "landmarks";
    const FORMAT: u32 = 2;

    fn pack(&self, to: &mut Packer) {
        to.meta(&(&self.found, &self.missing, &self.points, self.stature_mm));
        to.section("parts", &self.parts);
    }

    fn unpack(from: &Unpacker<'_>) -> Result<Self, Corrupt> {
        let (found, missing, points, stature_mm) = from.meta()?;
        Ok(Landmarks {
            found,
            missing,
            points,
            parts: from.section("parts")?,
            stature_mm,
        })
    }
}
