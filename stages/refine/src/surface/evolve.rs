//! The paper's evolution: rigid (eq. 3) or by the weighted median (eq. 5–7), step by explicit step.

use crate::evidence::agreement::{Agreement, agreement};
use crate::evidence::patch::Pairing;
use crate::evidence::scene::{Scene, VisibilityRules};
use crate::evidence::visibility::Visibility;
use crate::geometry::curvature::Laplacian;
use crate::geometry::remesh::{relax, remesh};
use crate::pictures::picture::Picture;
use crate::pictures::prepare::{RefineError, footprint};
use crate::pictures::turn::TurnInput;
use crate::surface::params::{EvolveParams, Flow};
use crate::surface::progress::Progress;
use crate::surface::smooth::medians;
use rayon::prelude::*;
use shape::{Adjacency, Mesh};
use stage::{Ctx, Stage, Stop, message};

stage::messages! {
    WORSE = "warn-evolve": "the evolution made the photos agree less; the mesh is handed on as it came: look at masks and cameras";
}

/// A surface, such as a hull, and the photos that it is compared with.
pub type EvolveInput = TurnInput;

/// `refine.evolve`: mesh, photos, cameras, masks → mesh.
pub struct Evolve;

impl Stage for Evolve {
    const NAME: &'static str = "refine.evolve";
    const VERSION: u32 = 8;
    const ABOUT: &'static str = "Evolves a surface towards inter-image consistency as the paper does: rigid (eq. 3) or by the weighted median (eq. 5-7).";
    type Params = EvolveParams;
    type Input = EvolveInput;
    type Output = Mesh;
    const METRICS: &'static [&'static str] =
        &["consistency before", "consistency", "seen twice", "faces"];

    /// The pictures, and what hangs on the vertices.
    fn memory(p: &EvolveParams, input: &EvolveInput) -> u64 {
        input.memory(&p.size, 1, p.edge_px)
    }

    fn run(p: &EvolveParams, input: EvolveInput, ctx: &Ctx<'_>) -> Result<Mesh, Stop> {
        let pictures = input.pictures(&p.size, || ctx.check().map_err(Stop::from))?;
        let footprint = footprint(&input.mesh, &pictures);
        let mut mesh = Mesh {
            colors: vec![],
            ..Mesh::clone(&input.mesh)
        };
        if p.edge_px > 0.0 {
            mesh = remesh(&mesh, p.edge_px * footprint, 4);
        }
        let mut state = Progress {
            best: mesh.clone(),
            mesh,
            done: 0,
            score: -1.0,
            first: -1.0,
            seen: 0.0,
        };
        let looks = p.iterations.div_ceil(p.look_every);
        let steps = ctx.steps("looks", looks as usize + 1);
        if let Some(left) = ctx.resume::<Progress>("look") {
            state = left;
            (0..state.done).try_for_each(|_| steps.tick())?;
        }
        for look in state.done..=looks {
            let left = p.iterations - (look * p.look_every).min(p.iterations);
            let stats = some_steps(
                p,
                &mut state.mesh,
                &pictures,
                footprint,
                left.min(p.look_every),
            );
            if stats.seen == 0.0 {
                return Err(RefineError::Unseen.into());
            }
            state.seen = stats.seen;
            state.keep(stats.before, &stats.start);
            state.done = look + 1;
            ctx.checkpoint("look", &state);
            steps.tick()?;
        }
        if state.score <= state.first && p.iterations > 0 {
            ctx.warn(message!(WORSE));
        }
        ctx.metric("consistency before", state.first, "");
        ctx.metric("consistency", state.score, "");
        ctx.metric("seen twice", state.seen, "");
        ctx.metric("faces", state.best.faces.len() as f64, "");
        Ok(Mesh {
            unit: input.mesh.unit,
            ..state.best
        })
    }
}

/// What was found before some steps were made.
struct StepStats {
    before: f64,
    seen: f64,
    start: Mesh,
}

/// Looks at the mesh, then makes `count` steps, visibility fixed.
fn some_steps(
    p: &EvolveParams,
    mesh: &mut Mesh,
    pictures: &[Picture],
    footprint: f64,
    count: u32,
) -> StepStats {
    let window = p.patches.window();
    let pairing = Pairing {
        cosine: [libm::cos(p.pair_to_deg.to_radians()) as f32 - 1e-6, 1.0],
    };
    let rules = VisibilityRules::new(p.patches.tilt_deg, pairing, 1.0);
    let around = Adjacency::new(mesh);
    let start = mesh.clone();
    let mut visible = Visibility::new(&Scene::new(mesh, &around, pictures, &window, &rules));
    let mut before = None;
    for step in 0..=count {
        for v in 0..visible.len() {
            visible.frame_mut(v).x = mesh.point(v as u32);
        }
        let agreements: Vec<Agreement> = (0..visible.len())
            .into_par_iter()
            .with_min_len(128)
            .map(|v| {
                agreement::<1>(
                    pictures,
                    visible.of(v),
                    visible.frame(v),
                    0.0,
                    &window,
                    rules.pairing,
                )
            })
            .collect();
        before.get_or_insert_with(|| consistency(&agreements));
        if step == count {
            break;
        }
        let laplacian = Laplacian::new(mesh, &around);
        let normals = mesh.normals();
        let curvature = laplacian.mean_curvature(mesh, &normals);
        let own: Vec<f64> = agreements.iter().map(|a| a.slope).collect();
        let psi = match p.flow {
            Flow::Rigid => own,
            Flow::WeightedMedian => medians(
                mesh,
                &around,
                &curvature,
                &own,
                p.rings,
                (p.eta, p.kappa),
                footprint,
            ),
        };
        for v in 0..normals.len() {
            // Pixels: H and ψ are an inverse length, Δt a square.
            let speed = (psi[v] - p.lambda * curvature[v]) * footprint;
            let far = (p.time_step * speed).clamp(-1.0, 1.0) * footprint;
            let to = mesh.point(v as u32) + normals[v] * far;
            mesh.positions[v] = [to.x as f32, to.y as f32, to.z as f32];
        }
    }
    relax(mesh, &around);
    StepStats {
        before: before.unwrap_or(0.0),
        seen: visible.share(),
        start,
    }
}

/// Mean correlation of all pairs, by their weights.
fn consistency(agreements: &[Agreement]) -> f64 {
    let (score, weight) = agreements
        .iter()
        .fold((0.0, 0.0), |s, a| (s.0 + a.score, s.1 + a.weight));
    score / f64::max(weight, 1e-9)
}
