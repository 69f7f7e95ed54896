//! The stage that takes a surface from elsewhere: a scan, or any mesh as PLY.

use shape::{Mesh, mesh_from_ply};
use stage::{Ctx, Files, FilesError, Stage, Stop};
use std::sync::Arc;

stage::choice! {
    /// The unit that a file's numbers are in.
    pub enum Unit {
        /// Millimetres.
        Mm = "mm",
        /// Centimetres.
        Cm = "cm",
        /// Metres.
        M = "m",
        /// Inches.
        Inch = "in",
    }
}

impl Unit {
    fn mm(self) -> f64 {
        match self {
            Unit::Mm => 1.0,
            Unit::Cm => 10.0,
            Unit::M => 1000.0,
            Unit::Inch => 25.4,
        }
    }
}

stage::choice! {
    /// The axis that points up.
    pub enum Up {
        /// x.
        X = "x",
        /// y.
        Y = "y",
        /// z.
        Z = "z",
    }
}

stage::params! {
    /// How to read a surface.
    pub struct SurfaceParams {
        /// Unit of the file's numbers. A file that calls its lengths relative keeps them so, unless a unit
        /// other than mm is said.
        unit: Unit = Unit::Mm,
        /// The axis that points up.
        up: Up = Up::Z,
    }
}

stage::inputs! {
    /// A surface from elsewhere.
    pub struct SurfaceInput {
        /// One PLY file.
        files: Arc<Files>,
    }
}

/// Why there is no surface.
#[derive(Debug, thiserror::Error)]
pub enum SurfaceError {
    /// None or several.
    #[error("one PLY file is wanted, but {0} are there")]
    Count(usize),
    /// Not a mesh.
    #[error("{0} cannot be read as a PLY mesh: {1}")]
    Ply(String, String),
    /// A mesh that sections cannot be taken of.
    #[error("{0}: {1}")]
    Fault(String, shape::MeshFault),
    /// Nothing in it.
    #[error("{0} has no faces: a mesh is wanted, not a cloud of points")]
    Empty(String),
    /// A size that no body has.
    #[error(
        "{name} is {high_mm:.0} mm high when its numbers are read as {unit}: set `unit`, or `up` if another axis points up"
    )]
    Size {
        /// The file.
        name: String,
        /// Its height. \[mm\]
        high_mm: f64,
        /// The unit it was read in.
        unit: &'static str,
    },
    /// A file that cannot be read.
    #[error(transparent)]
    Files(#[from] FilesError),
}

/// Heights of bodies, from an infant to more than the tallest person. \[mm\]
const HEIGHTS: std::ops::RangeInclusive<f64> = 200.0..=3000.0;

/// `capture.surface`: files → mesh.
pub struct Surface;

impl Stage for Surface {
    const NAME: &'static str = "capture.surface";
    const VERSION: u32 = 1;
    const ABOUT: &'static str = "Takes a closed surface from elsewhere, such as a scan, as PLY.";
    type Params = SurfaceParams;
    type Input = SurfaceInput;
    type Output = Mesh;

    fn run(p: &SurfaceParams, input: SurfaceInput, ctx: &Ctx<'_>) -> Result<Mesh, Stop> {
        let entries = &input.files.entries;
        let [entry] = entries.as_slice() else {
            return Err(SurfaceError::Count(entries.len()).into());
        };
        let bytes = input.files.read(entry).map_err(SurfaceError::from)?;
        let mesh = mesh_from_ply(&bytes)
            .map_err(|e| SurfaceError::Ply(entry.name.clone(), e.to_string()))?;
        Ok(upright(mesh, p, &entry.name, ctx)?)
    }
}

/// Brings a mesh to millimetres with z up, and checks it.
fn upright(
    mut mesh: Mesh,
    p: &SurfaceParams,
    name: &str,
    ctx: &Ctx<'_>,
) -> Result<Mesh, SurfaceError> {
    if mesh.faces.is_empty() {
        return Err(SurfaceError::Empty(name.into()));
    }
    let mm = p.unit.mm() as f32;
    if p.unit != Unit::Mm {
        mesh.unit = shape::Unit::Metric;
    }
    let metric = mesh.unit == shape::Unit::Metric;
    for at in &mut mesh.positions {
        let [x, y, z] = at.map(|v| v * mm);
        // Turned, never mirrored.
        *at = match p.up {
            Up::X => [y, z, x],
            Up::Y => [z, x, y],
            Up::Z => [x, y, z],
        };
    }
    match mesh.validate_closed() {
        Ok(()) => {}
        // Holes and seams are borne: sections that do not close are refused where they matter.
        Err(fault @ (shape::MeshFault::Open(..) | shape::MeshFault::Pinched(_))) => {
            ctx.warn(format!(
                "{name}: {fault}; sections across it may be missing"
            ));
        }
        Err(fault) => return Err(SurfaceError::Fault(name.into(), fault)),
    }
    let high_mm = mesh.bounds().map_or(0.0, |(low, high)| high.z - low.z);
    if metric && !HEIGHTS.contains(&high_mm) {
        let unit = match p.unit {
            Unit::Mm => "mm",
            Unit::Cm => "cm",
            Unit::M => "m",
            Unit::Inch => "in",
        };
        let name = name.into();
        return Err(SurfaceError::Size {
            name,
            high_mm,
            unit,
        });
    }
    Ok(mesh)
}
