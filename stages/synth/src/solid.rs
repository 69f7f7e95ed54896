//! The stage that names a solid: a body, or something plain.

use crate::anatomy::{Build, body};
use shape::{Level, Solid, SolidPart};
use stage::{Ctx, Stage, Stop};

stage::choice! {
    /// What the solid is.
    pub enum Figure {
        /// A standing body with arms, legs and a furrow down its back.
        Body = "body",
        /// An upright elliptic cylinder with rounded ends, on the ground.
        Cylinder = "cylinder",
        /// An ellipsoid on the ground.
        Ellipsoid = "ellipsoid",
        /// A lying torus on the ground.
        Torus = "torus",
    }
}

stage::params! {
    /// What the solid is and how large.
    pub struct SolidParams {
        /// What the solid is.
        figure: Figure = Figure::Body,
        /// Height of a body, a cylinder or an ellipsoid.
        #[range(10.0..=3000.0)]
        #[source(structural)]
        stature_mm: f64 = 1750.0,
        /// Girth of a body's trunk and limbs as a share of the usual.
        #[range(0.7..=1.4)]
        #[source(structural)]
        stout: f64 = 1.0,
        /// Depth of the furrow down a body's back, which silhouettes cannot show.
        #[range(0.0..=60.0)]
        #[source(structural)]
        furrow_mm: f64 = 14.0,
        /// Angle between a body's arms and its trunk.
        #[range(25.0..=80.0)]
        #[source(structural)]
        arms_deg: f64 = 42.0,
        /// Exponent of the trunk's and the cylinder's superellipses; 2 is an ellipse.
        #[range(2.0..=4.0)]
        #[source(structural)]
        exponent: f64 = 2.3,
        /// Half-axis along x of a cylinder or an ellipsoid; radius of a torus's ring.
        #[range(5.0..=1000.0)]
        #[source(structural)]
        wide_mm: f64 = 160.0,
        /// Half-axis along y of a cylinder or an ellipsoid; radius of a torus's tube.
        #[range(5.0..=1000.0)]
        #[source(structural)]
        deep_mm: f64 = 110.0,
    }
}

stage::inputs! {
    /// A made solid needs no inputs.
    pub struct SolidInput {}
}

/// A torus without a hole.
#[derive(Debug, thiserror::Error)]
#[error("a torus whose tube has a radius of {tube} mm needs a ring wider than {ring} mm")]
pub(crate) struct NoHole {
    ring: f64,
    tube: f64,
}

/// `synth.solid`: nothing → a solid given by formula.
pub struct MakeSolid;

impl Stage for MakeSolid {
    const NAME: &'static str = "synth.solid";
    const VERSION: u32 = 2;
    const ABOUT: &'static str =
        "Names a solid whose girths are a formula: a standing body, or something plain.";
    type Params = SolidParams;
    type Input = SolidInput;
    type Output = Solid;

    fn run(p: &SolidParams, _: SolidInput, _: &Ctx<'_>) -> Result<Solid, Stop> {
        let (high, wide, deep) = (p.stature_mm, p.wide_mm, p.deep_mm);
        let middle = |z: f64, x: f64| ("amid".to_owned(), [x, 0.0, z], [0.0, 0.0, 1.0]);
        let plain = |part: SolidPart, plane: (String, [f64; 3], [f64; 3])| Solid {
            parts: vec![part],
            blend_mm: 0.0,
            planes: vec![plane],
        };
        let half = [wide, deep];
        let level = |z: f64| Level {
            z,
            centre: [0.0; 2],
            half,
        };
        Ok(match p.figure {
            Figure::Body => body(&Build {
                stature: high,
                stout: p.stout,
                furrow: p.furrow_mm,
                arms: p.arms_deg.to_radians(),
                exponent: p.exponent,
            }),
            Figure::Cylinder => plain(
                SolidPart::Stack {
                    levels: vec![level(0.0), level(high)],
                    exponent: p.exponent,
                    furrow: None,
                    round: 0.3 * wide.min(deep).min(high),
                },
                middle(high / 2.0, 0.0),
            ),
            Figure::Ellipsoid => plain(
                SolidPart::Ellipsoid {
                    centre: [0.0, 0.0, high / 2.0],
                    half: [wide, deep, high / 2.0],
                },
                middle(high / 2.0, 0.0),
            ),
            Figure::Torus => {
                if wide <= deep {
                    return Err(NoHole {
                        ring: deep,
                        tube: deep,
                    }
                    .into());
                }
                plain(
                    SolidPart::Torus {
                        centre: [0.0, 0.0, deep],
                        ring: wide,
                        tube: deep,
                    },
                    ("amid".to_owned(), [wide, 0.0, deep], [0.0, 1.0, 0.0]),
                )
            }
        })
    }
}
