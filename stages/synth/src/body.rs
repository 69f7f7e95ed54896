//! The stage that makes a solid's surface.

use crate::bounds::bounds;
use crate::surface::surface;
use shape::{Mesh, MeshFault, Solid};
use stage::{Ctx, Stage, Stop};
use std::sync::Arc;

stage::params! {
    /// How fine.
    pub struct BodyParams {
        /// Edge length of the cells; a section falls short by (cell / radius)² / 8 of its length.
        #[range(0.2..=50.0)]
        #[source(structural)]
        cell_mm: f64 = 4.0,
    }
}

stage::inputs! {
    /// What the surface is of.
    pub struct BodyInput {
        /// The solid.
        solid: Arc<Solid>,
    }
}

/// Cells that are too large for what is thin.
#[derive(Debug, thiserror::Error)]
#[error("cells of {cell_mm} mm are too coarse for this solid ({fault}): lower `cell_mm`")]
pub(crate) struct TooCoarse {
    cell_mm: f64,
    fault: MeshFault,
}

/// `synth.body`: solid → mesh.
pub struct MakeBody;

impl Stage for MakeBody {
    const NAME: &'static str = "synth.body";
    const VERSION: u32 = 3;
    const ABOUT: &'static str = "Makes the closed surface of a solid; every vertex is on it.";
    type Params = BodyParams;
    type Input = BodyInput;
    type Output = Mesh;
    const METRICS: &'static [&'static str] = &["faces", "volume"];

    fn run(p: &BodyParams, input: BodyInput, ctx: &Ctx<'_>) -> Result<Mesh, Stop> {
        let (low, high) = bounds(&input.solid);
        let mesh = surface(&input.solid, low, high, p.cell_mm);
        mesh.validate_closed().map_err(|fault| TooCoarse {
            cell_mm: p.cell_mm,
            fault,
        })?;
        ctx.metric("faces", mesh.faces.len() as f64, "");
        ctx.metric("volume", mesh.volume() * 1e-6, "l");
        Ok(mesh)
    }
}
