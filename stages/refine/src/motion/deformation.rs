//! The stage that estimates how the body deformed between photos: a field of offsets a photo.

use crate::evidence::contours::pulls;
use crate::evidence::scene::Scene;
use crate::geometry::remesh::remesh;
use crate::motion::field::{Constraints, FieldPrior, carried_on, momentum, seen_off};
use crate::motion::normal_equations::point_shifts;
use crate::motion::params::LookParams;
use crate::pictures::prepare::posed;
use crate::pictures::turn::TurnInput;
use rayon::prelude::*;
use shape::{Adjacency, Warp, Warps};
use stage::{Ctx, Stage, Stop};

stage::params! {
    /// How the deformation is found; pixels are those of the level.
    pub struct EstimateDeformationParams {
        /// What is looked at.
        #[group(flat)]
        look: LookParams = LookParams::at(1),
        /// Weight of a point of the silhouettes' contour, against one that is known to a pixel.
        #[range(0.0..=100.0)]
        contour_weight: f64 = 0.2,
        /// Distance of the field's nodes, in pixels of the level.
        #[range(4.0..=500.0)]
        cell_px: f64 = 24.0,
        /// Offset that is expected, one standard deviation, in pixels of the level.
        #[range(0.01..=50.0)]
        shift_px: f64 = 2.0,
        /// Difference of neighbouring nodes that is expected, one standard deviation, in pixels of the level.
        #[range(0.001..=50.0)]
        differ_px: f64 = 0.3,
        /// Rounds.
        #[range(1..=100)]
        #[source(structural)]
        rounds: u32 = 8,
    }
}

/// An optimized surface, so that what is left is not its shape, and the photos of it.
pub type EstimateDeformationInput = TurnInput;

/// `refine.estimate_deformation`: mesh, photos, cameras, masks → warps.
pub struct EstimateDeformation;

impl Stage for EstimateDeformation {
    const NAME: &'static str = "refine.estimate_deformation";
    const VERSION: u32 = 8;
    const ABOUT: &'static str = "Finds how arms, head and chest moved against the rest of the body: a smooth field of offsets a photo.";
    type Params = EstimateDeformationParams;
    type Input = EstimateDeformationInput;
    type Output = Warps;
    const METRICS: &'static [&'static str] = &["deformation"];

    /// The pictures, and what hangs on the vertices.
    fn memory(p: &EstimateDeformationParams, input: &EstimateDeformationInput) -> u64 {
        input.memory(&p.look.size, 2, p.look.edge_px)
    }

    fn run(
        p: &EstimateDeformationParams,
        input: EstimateDeformationInput,
        ctx: &Ctx<'_>,
    ) -> Result<Warps, Stop> {
        let posed = posed(&input.photos, &input.cameras);
        let go_on = || ctx.check().map_err(Stop::from);
        let (deformed, mesh, footprint) = input.ready(&p.look.size, go_on, |footprint| {
            remesh(&input.mesh, p.look.edge_px * footprint, 3)
        })?;
        let around = Adjacency::new(&mesh);
        let prior = FieldPrior {
            shift_px: p.shift_px,
            differ_px: p.differ_px,
            contour_weight: p.contour_weight,
        };
        let window = p.look.patches.window();
        let rules = p.look.rules();
        let none =
            |p: &crate::pictures::picture::Picture, cell| Warp::none(p.whole[0], p.whole[1], cell);
        let mut warps: Vec<Warp> = deformed.iter().map(|b| none(b, p.cell_px)).collect();
        let mut ahead = warps.clone();
        let steps = ctx.steps("rounds", p.rounds as usize);
        for round in 0..p.rounds {
            let undeformed: Vec<_> = deformed
                .par_iter()
                .zip(&ahead)
                .map(|(b, w)| b.undeformed(w, b.whole[0] as u32))
                .collect();
            let scene = Scene::new(&mesh, &around, &undeformed, &window, &rules);
            let shifts = point_shifts(&scene, footprint);
            let contours = pulls(&scene, 6.0);
            let constraints = Constraints::new(&scene, shifts, &contours, &prior, footprint);
            let next = constraints.solve(&ahead, &prior);
            ahead = carried_on(&next, &warps, momentum(round));
            warps = next;
            steps.tick()?;
        }
        let stride = (mesh.positions.len() / 2000).max(1);
        let some = (0..mesh.positions.len() as u32).step_by(stride);
        let off: Vec<f64> = some
            .map(|v| seen_off(&warps, &deformed, &mesh.point(v)))
            .collect();
        let rms = (off.iter().map(|o| o * o).sum::<f64>() / off.len().max(1) as f64).sqrt();
        let (deformation, unit) = input.cameras.scale.unit().length(rms * footprint);
        ctx.metric("deformation", deformation, unit);
        let whole = posed
            .iter()
            .zip(warps)
            .zip(&deformed)
            .map(|(((id, view), w), b)| {
                let scale = f64::from(view.camera.lens.width) / b.whole[0] as f64;
                let offsets = w.offsets.iter().map(|o| o.map(|o| o * scale as f32));
                let warp = Warp {
                    cell_px: w.cell_px * scale,
                    columns: w.columns,
                    offsets: offsets.collect(),
                };
                (*id, warp)
            });
        Ok(Warps {
            views: whole.collect(),
        })
    }
}
