//! The stage that refines a surface level by level, its energy never rising.

use crate::geometry::remesh::remesh;
use crate::mend::crossing::unfold;
use crate::mend::pinch::pinch;
use crate::mend::repair::mend;
use crate::pictures::prepare::undeform;
use crate::pictures::turn::TurnInput;
use crate::surface::params::OptimizeSurfaceParams;
use crate::surface::round::{RoundStats, one_round};
use crate::surface::sweep::Search;
use shape::{Cameras, Masks, Mesh, Photos, Warps};
use stage::{Ctx, Stage, Stop, message};
use std::sync::Arc;

stage::messages! {
    LITTLE_SEEN = "warn-seen-by-two": "only {share:.0 %} of the surface is seen by two photos or more: take more photos of the turn, or look at the masks";
    AGREE_LESS = "warn-agree-less": "the photos agree less on the optimized surface than on the one that came in: look at masks and cameras before you trust girths to a millimetre";
    CROSSING = "warn-crossing": "{count} {count|pair|pairs} of faces pass through each other: look at the surface there before you take a girth across";
}

stage::inputs! {
    /// A surface and the photos it is compared with.
    pub struct OptimizeSurfaceInput {
        /// Closed; such as a hull.
        mesh: Arc<Mesh>,
        /// Those without a camera are passed over.
        photos: Arc<Photos>,
        /// Where they were taken, the body standing still.
        cameras: Arc<Cameras>,
        /// Silhouettes; without them contours are left to the bending term.
        masks: Option<Arc<Masks>>,
        /// How the body deformed; without them it did not.
        warps: Option<Arc<Warps>>,
    }
}

impl OptimizeSurfaceInput {
    /// What all stages of this crate read.
    fn turn(&self) -> TurnInput {
        TurnInput {
            mesh: self.mesh.clone(),
            photos: self.photos.clone(),
            cameras: self.cameras.clone(),
            masks: self.masks.clone(),
        }
    }
}

/// `refine.optimize_surface`: mesh, photos, cameras, masks → mesh.
pub struct OptimizeSurface;

impl Stage for OptimizeSurface {
    const NAME: &'static str = "refine.optimize_surface";
    const VERSION: u32 = 16;
    const ABOUT: &'static str = "Refines a surface by inter-image consistency, silhouettes and a thin plate, the energy never rising.";
    type Params = OptimizeSurfaceParams;
    type Input = OptimizeSurfaceInput;
    type Output = Mesh;
    const METRICS: &'static [&'static str] = &[
        "consistency",
        "seen twice",
        "contour gap",
        "crossing faces",
        "faces",
    ];

    /// The pictures, and what hangs on the vertices.
    fn memory(p: &OptimizeSurfaceParams, input: &OptimizeSurfaceInput) -> u64 {
        input.turn().memory(&p.size, 1, p.edge_px)
    }

    fn run(
        p: &OptimizeSurfaceParams,
        input: OptimizeSurfaceInput,
        ctx: &Ctx<'_>,
    ) -> Result<Mesh, Stop> {
        let go_on = || ctx.check().map_err(Stop::from);
        let (mut pictures, mesh, footprint) = input.turn().ready(&p.size, go_on, |footprint| {
            let mut mesh = Mesh::clone(&input.mesh);
            mesh.colors.clear();
            if p.edge_px > 0.0 {
                mesh = remesh(&mesh, p.edge_px * footprint, 4);
            }
            unfold(&mut mesh);
            mend(&mut mesh);
            mesh
        })?;
        if let Some(warps) = &input.warps {
            undeform(&mut pictures, &input.photos, &input.cameras, warps);
        }
        let unit = input.mesh.unit;
        // What is needed of photos, masks and the surface is in the pictures and the mesh.
        drop(input);
        stage::machine::give_freed_memory_back();
        let steps = ctx.steps("rounds", p.rounds as usize);
        let mut state = Checkpoint {
            mesh,
            done: 0,
            search: Search::default(),
            stats: RoundStats::default(),
        };
        if let Some(left) = ctx.resume::<Checkpoint>("round") {
            state = left;
            (0..state.done).try_for_each(|_| steps.tick())?;
        }
        for round in state.done..p.rounds {
            let before = state.stats.before;
            let searching = round < p.searches && p.reach_px > 0.0;
            let search = searching.then_some(&mut state.search);
            state.stats = one_round(p, &mut state.mesh, &pictures, footprint, search)?;
            if round > 0 {
                state.stats.before = before;
            }
            state.done = round + 1;
            ctx.checkpoint("round", &state);
            steps.tick()?;
        }
        let Checkpoint {
            mut mesh, stats, ..
        } = state;
        if stats.seen < 0.5 {
            ctx.warn(message!(LITTLE_SEEN, share = stats.seen * 100.0));
        }
        if stats.consistency < stats.before - 0.02 {
            ctx.warn(message!(AGREE_LESS));
        }
        if p.neck_edges > 0 {
            pinch(&mut mesh, p.neck_edges as usize);
        }
        let crossed = mend(&mut mesh);
        if crossed > 0 {
            ctx.warn(message!(CROSSING, count = crossed));
        }
        ctx.metric("consistency", stats.consistency, "");
        ctx.metric("seen twice", stats.seen, "");
        ctx.metric("contour gap", stats.gap_px, "px");
        ctx.metric("crossing faces", crossed as f64, "pairs");
        ctx.metric("faces", mesh.faces.len() as f64, "");
        mesh.unit = unit;
        Ok(mesh)
    }
}

/// What is left of a run that was stopped.
struct Checkpoint {
    mesh: Mesh,
    done: u32,
    search: Search,
    stats: RoundStats,
}

impl stage::Artifact for Checkpoint {
    const KIND: &'static str = "optimize_surface.checkpoint";
    const FORMAT: u32 = 3;
    fn pack(&self, to: &mut stage::Packer) {
        to.meta(&(self.done, self.stats));
        self.mesh.sections(to);
        to.section("places", &self.search.places);
    }
    fn unpack(from: &stage::Unpacker<'_>) -> Result<Self, stage::Corrupt> {
        let (done, stats) = from.meta()?;
        let mesh = Mesh::from_sections(shape::Unit::default(), from)?;
        let places = from.section("places")?;
        let search = Search { places };
        Ok(Checkpoint {
            mesh,
            done,
            search,
            stats,
        })
    }
}
