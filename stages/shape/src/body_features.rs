//! What a surface shows of an upright body before a girth is looked for.

use crate::{Refusal, Unit};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};
use stage::{Artifact, Corrupt, Packer, Unpacker};

/// Where the hip of a body is.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum HipAt {
    /// Where the back reaches farthest between two heights. \[mm\]
    Between(f64, f64),
    /// At a height that the rest of the body tells, with its standard deviation: the buttocks do not show. \[mm\]
    Hidden(f64, f64),
}

/// What a surface shows of an upright body. All that is measured is taken from here and the surface.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BodyFeatures {
    /// What the lengths mean.
    pub unit: Unit,
    /// Why nothing can be measured of it.
    pub refused: Option<Refusal>,
    /// Height of the ground; where none was found, of the lowest point. \[mm\]
    pub ground: f64,
    /// Whether the ground was found.
    pub grounded: bool,
    /// Crown above the ground. \[mm\]
    pub stature: f64,
    /// Its standard deviation: ground, crown and scale; `None` where that of the scale is not known. \[mm\]
    pub stature_sigma: Option<f64>,
    /// The way it faces: horizontal, unit.
    pub front: Vector3<f64>,
    /// Whether feet tell the way it faces; else it is called -y.
    pub front_is_sure: bool,
    /// Where two legs that show become one. \[mm\] `None` without two legs.
    pub crotch: Option<f64>,
    /// Where legs that show become one, however low: thighs that touch join far below the crotch. \[mm\]
    pub legs_join: Option<f64>,
    /// Whether it is a body from crown to soles: its legs show, or all else that shows fits one.
    pub whole: bool,
    /// Whether the surface was carved from outlines, which leave webs in folds of the skin.
    pub carved: bool,
    /// Where the hip is. `None` where nothing tells.
    pub hip: Option<HipAt>,
    /// Height of the narrowest of the neck. \[mm\] `None` without a neck.
    pub neck: Option<f64>,
}

impl BodyFeatures {
    /// Whether it is an upright body whose heights above a ground are known.
    pub fn is_measurable(&self) -> bool {
        self.grounded && self.refused.is_none()
    }
}

impl Artifact for BodyFeatures {
    const KIND: &'static str = "body_features";
    const FORMAT: u32 = 1;

    fn pack(&self, to: &mut Packer) {
        to.meta(self);
    }

    fn unpack(from: &Unpacker<'_>) -> Result<Self, Corrupt> {
        from.meta()
    }
}
