//! What was measured, with intervals and curves.

use crate::Plane;
use serde::{Deserialize, Serialize};
use stage::{Artifact, Corrupt, Packer, Unpacker};

/// One girth.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Girth {
    /// Short name: WC, HC, CC, NC, AC_L, AC_R, …
    pub name: String,
    /// What people call it: `waist`.
    pub label: String,
    /// Its definition, with the standard's number.
    pub definition: String,
    /// Length of the section's contour. \[mm\]
    pub contour_mm: f64,
    /// Length of a tape around it: of the convex hull in the plane. \[mm\]
    pub tape_mm: f64,
    /// Length of the paper's closed cubic spline. \[mm\]
    pub spline_mm: f64,
    /// From the silhouettes alone, where limbs stand clear. \[mm\]
    pub silhouette_mm: Option<f64>,
    /// The tape's interval that holds the truth nine times in ten. \[mm\]
    pub interval_mm: [f64; 2],
    /// Where it was taken.
    pub plane: Plane,
    /// The contour, closed, without repeating the first point. \[mm\]
    pub contour: Vec<[f32; 3]>,
}

/// A girth that could not be measured.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Missing {
    /// Short name.
    pub name: String,
    /// Why, and what would help.
    pub why: String,
}

/// Girth of the trunk over height.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Profile {
    /// Height above the ground. \[mm\]
    pub height_mm: Vec<f64>,
    /// Tape around the trunk there. \[mm\]
    pub tape_mm: Vec<f64>,
}

/// All that was measured.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Girths {
    /// The girths.
    pub girths: Vec<Girth>,
    /// What could not be measured.
    pub missing: Vec<Missing>,
    /// Ratios and other derived numbers: WHR, WHtR, … with a note each (empty, or `experimental`).
    pub ratios: Vec<(String, f64, String)>,
    /// Crown above the ground. \[mm\]
    pub stature_mm: Option<f64>,
    /// Weight, as the user gave it. \[kg\]
    pub weight_kg: Option<f64>,
    /// Body mass index. \[kg/m²\]
    pub bmi: Option<f64>,
    /// Volume of the body. \[l\]
    pub volume_l: Option<f64>,
    /// Girth of the trunk over height.
    pub profile: Profile,
}

impl Girths {
    /// The girth of a name.
    pub fn get(&self, name: &str) -> Option<&Girth> {
        self.girths.iter().find(|g| g.name == name)
    }
}

impl Artifact for Girths {
    const KIND: &'static str = "girths";
    const FORMAT: u32 = 1;

    fn pack(&self, to: &mut Packer) {
        to.meta(self);
    }

    fn unpack(from: &Unpacker<'_>) -> Result<Self, Corrupt> {
        from.meta()
    }
}
