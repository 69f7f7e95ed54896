//! What lengths mean: millimetres, or shares of something of unknown size.

use serde::{Deserialize, Serialize};
use stage::{Field, message};

stage::messages! {
    OF_RING = "length-relative": "{length:.4} of the camera ring's radius";
}

/// What the numbers mean.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Unit {
    /// Millimetres are millimetres.
    #[default]
    Metric,
    /// Nothing of known length was given: 1000 "mm" are the radius of the camera ring.
    Relative,
}

impl Unit {
    /// A length to be printed: millimetres, or shares of the camera ring's radius; with its unit.
    pub fn length(self, mm: f64) -> (f64, &'static str) {
        match self {
            Unit::Metric => (mm, "mm"),
            Unit::Relative => (mm / 1000.0, "relative"),
        }
    }

    /// A volume to be printed: litres, or shares of the cube of the camera ring's radius; with its unit.
    pub fn volume(self, mm3: f64) -> (f64, &'static str) {
        match self {
            Unit::Metric => (mm3 * 1e-6, "l"),
            Unit::Relative => (mm3 * 1e-9, "relative"),
        }
    }

    /// A length in a sentence: `12 mm`, or `0.0120 of the camera ring's radius`.
    pub fn words(self, mm: f64) -> String {
        self.field(mm).to_string()
    }

    /// The same in a message.
    pub fn field(self, mm: f64) -> Field {
        match self {
            Unit::Metric => Field::number(mm, 0, "mm"),
            Unit::Relative => message!(OF_RING, length = mm / 1000.0).into(),
        }
    }
}
