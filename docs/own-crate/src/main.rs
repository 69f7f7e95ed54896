//! All of tailor, and a stage more: how much skin is at which height.

use shape::Mesh;
use stage::{AnyArtifact, AnyStage, Artifact, Corrupt, Ctx, Packer, Stage, Stop, Unpacker, erase};
use std::sync::Arc;
use tailor::catalog::{CATALOG, CRATES, IMPORTERS};
use tailor::command;
use tailor::engine::{Catalog, Kind, NamedFiles, WriteError, with_own};
use tailor::kinds::KINDS;

/// What flows out: the surface's area in slices of equal height. \[mm²\]
struct Areas(Vec<f64>);

impl Artifact for Areas {
    const KIND: &'static str = "areas";
    const FORMAT: u32 = 1;

    fn pack(&self, to: &mut Packer) {
        to.meta(&self.0);
    }

    fn unpack(from: &Unpacker<'_>) -> Result<Self, Corrupt> {
        Ok(Areas(from.meta()?))
    }
}

stage::params! {
    /// How finely heights are kept apart.
    pub struct AreaParams {
        /// Slices from the soles to the crown.
        #[range(1..=1000)]
        slices: u32 = 10,
    }
}

stage::inputs! {
    /// A surface.
    pub struct AreaInput {
        /// Its faces.
        mesh: Arc<Mesh>,
    }
}

/// `mine.areas`: mesh → areas. A face belongs to the slice that its middle is in.
struct MeasureAreas;

impl Stage for MeasureAreas {
    const NAME: &'static str = "mine.areas";
    const VERSION: u32 = 1;
    const ABOUT: &'static str = "The surface's area in slices of equal height.";
    const METRICS: &'static [&'static str] = &["area"];
    type Params = AreaParams;
    type Input = AreaInput;
    type Output = Areas;

    fn run(p: &AreaParams, input: AreaInput, ctx: &Ctx<'_>) -> Result<Areas, Stop> {
        let empty = || std::io::Error::other("the surface has no vertices");
        let (low, high) = input.mesh.bounds().ok_or_else(empty)?;
        let mut areas = vec![0.0; p.slices as usize];
        for face in 0..input.mesh.faces.len() {
            let [a, b, c] = input.mesh.triangle(face);
            let share = ((a.z + b.z + c.z) / 3.0 - low.z) / (high.z - low.z);
            let slice = (share * f64::from(p.slices)) as usize;
            areas[slice.min(p.slices as usize - 1)] += input.mesh.area_vector(face).norm() / 2.0;
        }
        ctx.metric("area", areas.iter().sum(), "mm²");
        Ok(Areas(areas))
    }
}

fn files(artifact: AnyArtifact, _: &str, _: Option<AnyArtifact>) -> Result<NamedFiles, WriteError> {
    let areas = artifact.downcast::<Areas>().ok_or("no areas")?;
    let row = |(i, area): (usize, &f64)| format!("{i},{area:.1}\n");
    let rows: String = areas.0.iter().enumerate().map(row).collect();
    let csv = format!("slice,area_mm2\n{rows}");
    Ok(vec![(String::new(), csv.into_bytes())])
}

const STAGES: &[&dyn AnyStage] = &[&erase::<MeasureAreas>()];
const AREAS: Kind = Kind {
    name: Areas::KIND,
    formats: &["csv"],
    beside: None,
    files,
    extension: |_| None,
    facts: |_| vec![],
    names: |_| vec![],
};

static MINE: Catalog = Catalog {
    program: "my-tailor 0.1.0",
    stages: &with_own::<_, { CRATES.len() + 1 }>(STAGES, CRATES),
    kinds: &with_own::<_, { KINDS.len() + 1 }>(AREAS, KINDS),
    importers: IMPORTERS,
    pipelines: CATALOG.pipelines,
};
static PROGRAM: command::Program = tailor::program_over(&MINE);

fn main() -> std::process::ExitCode {
    command::main(&PROGRAM)
}
