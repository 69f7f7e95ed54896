//! A solid given by formula: parts whose inside is where a function is negative, softly joined.

use serde::{Deserialize, Serialize};
use stage::{Artifact, Corrupt, Packer, Unpacker};

/// A level of a [`Part::Stack`]: a superellipse across the axis.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Level {
    /// Height in the world. \[mm\]
    pub z: f64,
    /// Middle, in world x and y. \[mm\]
    pub centre: [f64; 2],
    /// Half-axes along world x and y. \[mm\]
    pub half: [f64; 2],
}

/// An upright furrow down the back (+y) of a [`Part::Stack`].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Furrow {
    /// How deep at its deepest. \[mm\]
    pub deep: f64,
    /// Half its width, where it is 1/e as deep. \[mm\]
    pub wide: f64,
    /// Height of its deepest place. \[mm\]
    pub z: f64,
    /// Half its length: it ends there. \[mm\]
    pub long: f64,
}

/// One part of a solid. All in the world, lengths in millimetres.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Part {
    /// An ellipsoid along the world's axes.
    Ellipsoid {
        /// Its middle. \[mm\]
        centre: [f64; 3],
        /// Half-axes. \[mm\]
        half: [f64; 3],
    },
    /// A horizontal torus.
    Torus {
        /// Its middle. \[mm\]
        centre: [f64; 3],
        /// Radius of the circle within the tube. \[mm\]
        ring: f64,
        /// Radius of the tube. \[mm\]
        tube: f64,
    },
    /// An elliptic cone with rounded ends; its half-axes change evenly along it.
    Limb {
        /// Middle of one end. \[mm\]
        from: [f64; 3],
        /// Middle of the other end. \[mm\]
        to: [f64; 3],
        /// Half-axes at `from`: level across the limb, and across that. \[mm\]
        half_from: [f64; 2],
        /// Half-axes at `to`. \[mm\]
        half_to: [f64; 2],
        /// The ends are rounded over so much of the length. \[mm\]
        round: f64,
    },
    /// Superellipses |x/a|ⁿ + |y/b|ⁿ = 1 stacked upright; between levels, cubic Hermite.
    Stack {
        /// From below upward.
        levels: Vec<Level>,
        /// The exponent n; 2 is an ellipse.
        exponent: f64,
        /// A furrow down the back.
        furrow: Option<Furrow>,
        /// The ends are rounded over so much of the height. \[mm\]
        round: f64,
    },
}

/// A solid given by formula.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Solid {
    /// Its parts.
    pub parts: Vec<Part>,
    /// Parts are joined softly where both surfaces are nearer than this. \[mm\]
    pub blend_mm: f64,
    /// Sections that are of interest: short name, point, unit normal. \[mm\]
    pub planes: Vec<(String, [f64; 3], [f64; 3])>,
}

impl Artifact for Solid {
    const KIND: &'static str = "solid";
    const FORMAT: u32 = 1;

    fn pack(&self, to: &mut Packer) {
        to.meta(self);
    }

    fn unpack(from: &Unpacker<'_>) -> Result<Self, Corrupt> {
        from.meta()
    }
}
