//! The stage that refines a surface level by level, its energy never rising.

use crate::crossing::{crossings, part, unfold};
use crate::curvature::Laplacian;
use crate::energy::Forces;
use crate::evolve_stage::Flow;
use crate::patch::{Pairing, Window};
use crate::picture::Picture;
use crate::remesh::{relax, remesh};
use crate::rims::pulls;
use crate::scene::{RefineError, check, footprint, pictures, unbend};
use crate::settle::{Rest, settle};
use crate::sights::{Sighting, Sights};
use crate::smooth::ring_median;
use crate::sweep;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};
use shape::{Adjacency, Cameras, Masks, Mesh, Photos, Warps};
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
    const VERSION: u32 = 6;
    const ABOUT: &'static str = "Refines a surface by inter-image consistency, silhouettes and a thin plate, the energy never rising.";
    type Params = SettleParams;
    type Input = SettleInput;
    type Output = Mesh;

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
        let Checkpoint { mesh, told, .. } = state;
        if told.seen < 0.5 {
            ctx.warn(format!(
                "only {:.0} % of the surface is seen by two photos or more",
                told.seen * 100.0
            ));
        }
        if told.consistency < told.before - 0.02 {
            ctx.warn("the photos agree less on the settled surface than on the one that came in");
        }
        let crossed = crossings(&mesh).len();
        if crossed * 1000 > mesh.faces.len() {
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

/// What a round found.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
struct Told {
    before: f64,
    consistency: f64,
    seen: f64,
    gap_px: f64,
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

/// Looks anew, then steps while the energy falls.
fn one_round(
    p: &SettleParams,
    mesh: &mut Mesh,
    pictures: &[Picture],
    footprint: f64,
    begin: bool,
) -> Result<Told, Stop> {
    let window = Window::new(p.patch as usize, p.level_patch);
    let cosine = [p.pair_to_deg, p.pair_from_deg].map(|d| d.to_radians().cos() as f32);
    let rules = Sighting {
        most_tilt: p.tilt_deg.to_radians(),
        spacing_px: 1.0,
        pairing: Pairing { cosine },
        noise_gain: p.noise_gain,
    };
    let around = Adjacency::new(mesh);
    let start = mesh.positions.clone();
    let mut told = Told::default();
    let searches = usize::from(begin && p.reach_px > 0.0);
    for step in 0..p.steps as usize + searches {
        let searching = step < searches;
        let sights = Sights::new(mesh, &around, pictures, &window, &rules);
        told.seen = sights.share();
        if told.seen == 0.0 {
            return Err(RefineError::Unseen.into());
        }
        let normals = mesh.normals();
        let pulls = pulls(mesh, &around, &normals, pictures, 3.0);
        let laplacian = Laplacian::new(mesh, &around);
        // A typical pair-stiffness of 0.04 a pixel² balances the plate at the length asked for.
        let plate = 0.04 * p.smooth_px.powi(4) * footprint.powi(2);
        let x: Vec<Vector3<f64>> = (0..mesh.positions.len() as u32)
            .map(|v| mesh.point(v).coords)
            .collect();
        let rest = Rest::new(&laplacian, &x, &normals, p.rest_rings as usize);
        let forces = Forces {
            rest: &rest,
            pictures,
            sights: &sights,
            rules: &rules,
            window: &window,
            pulls: &pulls,
            laplacian: &laplacian,
            footprint,
            rim: p.rim,
            plate,
            anchor: 1e-4,
        };
        let still = vec![0.0; x.len()];
        let seen = forces.agreements::<true>(&still);
        let (score, weight) = seen
            .iter()
            .fold((0.0, 0.0), |s, a| (s.0 + a.score, s.1 + a.weight));
        told.consistency = score / f64::max(weight, 1e-9);
        if step == 0 {
            told.before = told.consistency;
        }
        let gaps: f64 = pulls.iter().map(|p| p.weight * p.gap * p.gap).sum();
        told.gap_px =
            (gaps / pulls.iter().map(|p| p.weight).sum::<f64>().max(1e-9)).sqrt() / footprint;
        let before = forces.energy(&seen, &still, &x);
        let mut springs = forces.springs(&seen);
        if searching {
            sweep::follow(&forces, &around, p.reach_px, &seen, &mut springs);
        } else if p.flow == Flow::WeightedMedian {
            ring_median(
                mesh,
                &around,
                &laplacian,
                &normals,
                &mut springs,
                (p.eta, p.kappa),
                footprint,
            );
        }
        let d = settle(&springs, &laplacian, &x, &normals, &rest, plate, 60);
        let most = if searching { p.reach_px } else { 3.0 } * footprint;
        let d: Vec<f64> = d.iter().map(|d| d.clamp(-most, most)).collect();
        let taken = if searching {
            1.0
        } else {
            forces.falls(&x, &d, before)
        };
        if taken == 0.0 {
            break;
        }
        for (v, d) in d.iter().enumerate() {
            let to = x[v] + normals[v] * (d * taken);
            mesh.positions[v] = [to.x as f32, to.y as f32, to.z as f32];
        }
        relax(mesh);
    }
    part(mesh, &start, &around);
    Ok(told)
}
