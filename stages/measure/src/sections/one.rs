//! What one section gives, or why it gives nothing; and the plain case, nothing taken off.

use crate::geometry::section::{flat, length, tape};
use crate::geometry::slices::Ring;
use crate::geometry::spline::{closed_spline_length, paper_girth};
use nalgebra::Point3;
use shape::{Mesh, Plane, Refusal};

/// What one section gives.
#[derive(Debug, Clone)]
pub struct SectionMeasurement {
    /// The curve around the part alone. \[mm\]
    pub contour: Vec<Point3<f64>>,
    /// Its length. \[mm\]
    pub contour_mm: f64,
    /// Length of a tape around it. \[mm\]
    pub tape_mm: f64,
    /// What the paper's spline runs through.
    pub spline: Spline,
    /// Share of the way around that another limb hides: bridged.
    pub bridged: f64,
    /// Standard deviation of what the hidden part adds. \[mm\]
    pub sigma_mm: f64,
}

/// What the paper's spline runs through.
#[derive(Debug, Clone)]
pub enum Spline {
    /// Points of the mesh near the contour.
    Mesh,
    /// These, in the plane, where a limb was taken off. \[mm\]
    Knots(Vec<[f64; 2]>),
}

impl SectionMeasurement {
    /// Length of the paper's spline; where there is none, the contour's. It takes longer than the tape, so sections that are only
    /// compared do without. \[mm\]
    pub fn spline_mm(&self, mesh: &Mesh) -> f64 {
        let length = match &self.spline {
            Spline::Mesh => paper_girth(mesh, &self.contour),
            Spline::Knots(knots) => closed_spline_length(knots),
        };
        length.unwrap_or(self.contour_mm)
    }
}

/// Why a section gives no girth.
pub type Why = Refusal;

pub(crate) const NOTHING: Why = Refusal::NoSection;
pub(crate) const NO_ARMS: Why = Refusal::NoArms;
pub(crate) const FUSED: Why = Refusal::Fused;
pub(crate) const HAND: Why = Refusal::Hand;

pub(crate) fn plain(plane: &Plane, ring: Ring) -> Result<SectionMeasurement, Why> {
    let points = flat(&ring.curve, plane);
    let contour_mm = length(&points);
    Ok(SectionMeasurement {
        contour_mm,
        tape_mm: tape(&points),
        spline: Spline::Mesh,
        contour: ring.curve,
        bridged: 0.0,
        sigma_mm: 0.0,
    })
}
