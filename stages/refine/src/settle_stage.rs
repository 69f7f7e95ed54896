//! The stage that refines a surface level by level, its energy never rising.

use crate::crossing::unfold;
use crate::evolve_stage::Flow;
use crate::mend::mend;
use crate::need::Need;
use crate::pinch::pinch;
use crate::remesh::remesh;
use crate::round::{Told, one_round};
use crate::scene::{check, footprint, pictures, unbend};
use shape::{Cameras, Masks, Mesh, Photos, Warps};
use stage::{Ctx, Stage, Stop};
use std::sync::Arc;

stage::params! {
    /// How the surface settles.
    pub struct SettleParams {
        /// Level of the Gaussian pyramid: photos are halved so many times, 500 pixels left.
        #[range(0..=6)]
        level: u32 = 0,
        /// Photos are halved first until they have at most so many million pixels.
        #[range(0.1..=100.0)]
        most_mpx: f64 = 6.0,
        /// Edge of the mesh, in pixels of the level on the surface; 0 keeps the mesh as it is.
        #[range(0.0..=50.0)]
        edge_px: f64 = 4.0,
        /// Whether each vertex follows its own pull (eq. 3) or its neighbourhood's weighted median (eq. 6).
        flow: Flow = Flow::Rigid,
        /// Weight of near neighbours in the median (eq. 7).
        #[range(0.0..=1000.0)]
        eta: f64 = 1.0,
        /// Weight of alike curved neighbours in the median (eq. 7).
        #[range(0.0..=1000.0)]
        kappa: f64 = 1.0,
        /// Points of a patch from its middle to its side.
        #[range(1..=5)]
        patch: u32 = 4,
        /// Whether a linear change of brightness across a patch is taken out, as shade is.
        level_patch: bool = true,
        /// Greatest angle between the surface's normal and a line of sight.
        #[range(10.0..=85.0)]
        tilt_deg: f64 = 65.0,
        /// Least angle between two photos that are compared.
        #[range(0.0..=90.0)]
        pair_from_deg: f64 = 3.0,
        /// Greatest angle between two photos that are compared.
        #[range(5.0..=180.0)]
        pair_to_deg: f64 = 50.0,
        /// Texture counts in full from this many times the noise's variance.
        #[range(0.0..=1000.0)]
        noise_gain: f64 = 4.0,
        /// Length below which detail is smoothed where texture is plain, in pixels of the level.
        #[range(0.0..=200.0)]
        smooth_px: f64 = 8.0,
        /// Rings of neighbours over which curvature is averaged: what is as round as these rests.
        #[range(0..=50)]
        rest_rings: u32 = 3,
        /// Weight of the silhouettes.
        #[range(0.0..=100.0)]
        rim: f64 = 0.3,
        /// Weight of the visual hull: what shows outside of a silhouette is drawn back into all of them.
        #[range(0.0..=100.0)]
        bound: f64 = 10.0,
        /// How far outside of a silhouette the surface may show, in pixels of the level.
        #[range(0.0..=100.0)]
        slack_px: f64 = 3.0,
        /// What hangs on a neck of at most so many edges is cut off; 0 keeps it.
        #[range(0..=8)]
        neck_edges: u32 = 6,
        /// How far inward a better place is looked for first, in pixels of the level; 0 is nowhere.
        #[range(0.0..=100.0)]
        reach_px: f64 = 0.0,
        /// Rounds that begin with such a search.
        #[range(0..=100)]
        searches: u32 = 1,
        /// Times that visibility is looked at anew.
        #[range(1..=100)]
        rounds: u32 = 3,
        /// Most steps between two looks.
        #[range(1..=100)]
        steps: u32 = 4,
    }
}

stage::inputs! {
    /// A surface and the photos it is held against.
    pub struct SettleInput {
        /// Closed; such as a hull.
        mesh: Arc<Mesh>,
        /// Those without a camera are passed over.
        photos: Arc<Photos>,
        /// Where they were taken, the body standing still.
        cameras: Arc<Cameras>,
        /// Silhouettes; without them rims are left to the plate.
        masks: Option<Arc<Masks>>,
        /// How the body bent; without them it did not.
        warps: Option<Arc<Warps>>,
    }
}

/// `refine.settle`: mesh, photos, cameras, masks → mesh.
pub struct Settle;

impl Stage for Settle {
    const NAME: &'static str = "refine.settle";
    const VERSION: u32 = 9;
    const ABOUT: &'static str = "Refines a surface by inter-image consistency, silhouettes and a thin plate, the energy never rising.";
    type Params = SettleParams;
    type Input = SettleInput;
    type Output = Mesh;
    const METRICS: &'static [&'static str] = &[
        "consistency",
        "seen twice",
        "rim gap",
        "crossing faces",
        "faces",
    ];

    /// The pictures, and what hangs on the vertices.
    fn memory(p: &SettleParams, input: &SettleInput) -> u64 {
        let (photos, cameras) = (&input.photos, &input.cameras);
        let masks = input.masks.as_deref();
        let need = Need::new(photos, cameras, masks, p.level, p.most_mpx);
        (need.pictures(1) + need.surface(p.edge_px, &input.mesh)) as u64
    }

    fn run(p: &SettleParams, input: SettleInput, ctx: &Ctx<'_>) -> Result<Mesh, Stop> {
        check(&input.mesh)?;
        let masks = input.masks.as_deref();
        let mut pictures = pictures(
            &input.photos,
            &input.cameras,
            masks,
            p.level,
            p.most_mpx,
            || ctx.check().map_err(Stop::from),
        )?;
        if let Some(warps) = &input.warps {
            unbend(&mut pictures, &input.photos, &input.cameras, warps);
        }
        let footprint = footprint(&input.mesh, &pictures);
        let mut mesh = Mesh::clone(&input.mesh);
        mesh.colors.clear();
        if p.edge_px > 0.0 {
            mesh = remesh(&mesh, p.edge_px * footprint, 4);
        }
        unfold(&mut mesh);
        mend(&mut mesh);
        let steps = ctx.steps("rounds", p.rounds as usize);
        let mut state = Checkpoint {
            mesh,
            done: 0,
            told: Told::default(),
        };
        if let Some(left) = ctx.resume::<Checkpoint>("round") {
            state = left;
            (0..state.done).try_for_each(|_| steps.tick())?;
        }
        for round in state.done..p.rounds {
            let before = state.told.before;
            state.told = one_round(p, &mut state.mesh, &pictures, footprint, round < p.searches)?;
            if round > 0 {
                state.told.before = before;
            }
            state.done = round + 1;
            ctx.checkpoint("round", &state);
            steps.tick()?;
        }
        let Checkpoint { mut mesh, told, .. } = state;
        if told.seen < 0.5 {
            ctx.warn(format!(
                "only {:.0} % of the surface is seen by two photos or more",
                told.seen * 100.0
            ));
        }
        if told.consistency < told.before - 0.02 {
            ctx.warn("the photos agree less on the settled surface than on the one that came in");
        }
        if p.neck_edges > 0 {
            pinch(&mut mesh, p.neck_edges as usize);
        }
        let crossed = mend(&mut mesh);
        if crossed > 0 {
            ctx.warn(format!("{crossed} pairs of faces pass through each other"));
        }
        ctx.metric("consistency", told.consistency, "");
        ctx.metric("seen twice", told.seen, "");
        ctx.metric("rim gap", told.gap_px, "px");
        ctx.metric("crossing faces", crossed as f64, "pairs");
        ctx.metric("faces", mesh.faces.len() as f64, "");
        Ok(mesh)
    }
}

/// What is left of a run that was stopped.
struct Checkpoint {
    mesh: Mesh,
    done: u32,
    told: Told,
}

impl stage::Artifact for Checkpoint {
    const KIND: &'static str = "settle.checkpoint";
    const FORMAT: u32 = 1;
    fn pack(&self, to: &mut stage::Packer) {
        to.meta(&(self.done, self.told));
        self.mesh.pack(to);
    }
    fn unpack(from: &stage::Unpacker<'_>) -> Result<Self, stage::Corrupt> {
        let (done, told) = from.meta()?;
        let mesh = Mesh::unpack(from)?;
        Ok(Checkpoint { mesh, done, told })
    }
}
