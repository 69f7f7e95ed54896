//! The stage that compensates the motion of a swaying body: cameras as seen from the body instead of the disk.

use crate::evidence::contours::pulls;
use crate::evidence::scene::Scene;
use crate::geometry::remesh::remesh;
use crate::motion::gauge::Gauge;
use crate::motion::normal_equations::point_shifts;
use crate::motion::params::LookParams;
use crate::motion::sway::{
    MotionPrior, NormalEquations, add_equations_of_contours, equations_of_brightness, moved,
};
use crate::pictures::picture::Picture;
use crate::pictures::prepare::posed;
use crate::pictures::turn::TurnInput;
use nalgebra::{Point3, Vector6};
use shape::{Adjacency, Camera, Cameras, Mesh};
use stage::{Ctx, Stage, Stop};

stage::params! {
    /// How the body's motion is looked for.
    pub struct CompensateMotionParams {
        /// What is looked at.
        #[group(flat)]
        look: LookParams = LookParams::at(2),
        /// Whether brightness is used, or silhouettes alone.
        brightness: bool = true,
        /// Weight of a point of the silhouettes' contour, against a patch that fits.
        #[range(0.0..=100.0)]
        contour_weight: f64 = 0.05,
        /// Shift at the ankles that is expected, one standard deviation.
        #[range(0.0001..=100.0)]
        shift_mm: f64 = 10.0,
        /// Turn that is expected, one standard deviation.
        #[range(0.0001..=20.0)]
        turn_deg: f64 = 0.7,
        /// Rounds.
        #[range(1..=100)]
        #[source(structural)]
        rounds: u32 = 8,
    }
}

/// A surface, be it a hull, and the photos that it should fit.
pub type CompensateMotionInput = TurnInput;

/// `refine.compensate_motion`: mesh, photos, cameras, masks → cameras.
pub struct CompensateMotion;

impl Stage for CompensateMotion {
    const NAME: &'static str = "refine.compensate_motion";
    const VERSION: u32 = 9;
    const ABOUT: &'static str = "Finds how the body swayed against the disk, six numbers a photo, and gives the cameras as seen from the body.";
    type Params = CompensateMotionParams;
    type Input = CompensateMotionInput;
    type Output = Cameras;
    const METRICS: &'static [&'static str] = &["sway at the chest", "greatest sway", "last change"];

    /// The pictures, and what hangs on the vertices.
    fn memory(p: &CompensateMotionParams, input: &CompensateMotionInput) -> u64 {
        input.memory(&p.look.size, 1, p.look.edge_px)
    }

    fn run(
        p: &CompensateMotionParams,
        input: CompensateMotionInput,
        ctx: &Ctx<'_>,
    ) -> Result<Cameras, Stop> {
        let mut cameras = Cameras::clone(&input.cameras);
        let posed = posed(&input.photos, &input.cameras);
        let go_on = || ctx.check().map_err(Stop::from);
        let (mut pictures, mesh, footprint) = input.ready(&p.look.size, go_on, |footprint| {
            remesh(&input.mesh, p.look.edge_px * footprint, 3)
        })?;
        let around = Adjacency::new(&mesh);
        let prior = MotionPrior {
            shift_mm: p.shift_mm,
            turn: p.turn_deg.to_radians(),
            pivot: Point3::new(0.0, 0.0, cameras.ground_mm),
            contour_weight: p.contour_weight,
            footprint,
        };
        let still: Vec<Camera> = posed.iter().map(|(_, view)| view.camera).collect();
        let mut motions = vec![Vector6::zeros(); posed.len()];
        let steps = ctx.steps("rounds", p.rounds as usize);
        let mut last = 0.0;
        for _ in 0..p.rounds {
            last = one_round(
                p,
                &mesh,
                &around,
                &mut pictures,
                &still,
                &prior,
                &mut motions,
            );
            steps.tick()?;
        }
        let top = mesh.bounds().map_or(0.0, |(_, hi)| hi.z) - prior.pivot.z;
        let chest = Point3::new(0.0, 0.0, prior.pivot.z + 0.75 * top);
        let far: Vec<f64> = still
            .iter()
            .zip(&motions)
            .map(|(c, m)| {
                let (a, b) = (
                    c.pose.apply(&chest),
                    moved(c, m, &prior.pivot).pose.apply(&chest),
                );
                (a - b).norm()
            })
            .collect();
        let rms = (far.iter().map(|f| f * f).sum::<f64>() / far.len().max(1) as f64).sqrt();
        let unit = cameras.scale.unit();
        let metric = |name: &str, mm: f64| {
            let (value, unit) = unit.length(mm);
            ctx.metric(name, value, unit);
        };
        metric("sway at the chest", rms);
        metric("greatest sway", far.iter().copied().fold(0.0, f64::max));
        metric("last change", last);
        for (((id, _), camera), motion) in posed.iter().zip(&still).zip(&motions) {
            let view = cameras.views.get_mut(*id).expect("bug: listed above");
            view.camera = moved(camera, motion, &prior.pivot);
        }
        Ok(cameras)
    }
}

/// Improves all motions once; the greatest change at breast height. \[mm\]
fn one_round(
    p: &CompensateMotionParams,
    mesh: &Mesh,
    around: &Adjacency,
    pictures: &mut [Picture],
    still: &[Camera],
    prior: &MotionPrior,
    motions: &mut [Vector6<f64>],
) -> f64 {
    let window = p.look.patches.window();
    let rules = p.look.rules();
    let scene = Scene::new(mesh, around, pictures, &window, &rules);
    let mut equations = if p.brightness {
        let shifts = point_shifts(&scene, prior.footprint);
        equations_of_brightness(pictures.len(), &shifts, prior)
    } else {
        NormalEquations::none(pictures.len())
    };
    let pulls = pulls(&scene, 6.0);
    add_equations_of_contours(&mut equations, mesh, &scene.normals, &pulls, prior);
    let centres: Vec<_> = still.iter().map(Camera::centre).collect();
    let moves = equations.solve(prior, &Gauge::new(&centres), motions);
    motions
        .iter_mut()
        .zip(&moves)
        .for_each(|(m, step)| *m += step);
    for ((picture, camera), motion) in pictures.iter_mut().zip(still).zip(motions.iter()) {
        picture.moved(&moved(camera, motion, &prior.pivot));
    }
    let change = moves
        .iter()
        .map(|d| d.fixed_rows::<3>(0).norm() * 1000.0 + d.fixed_rows::<3>(3).norm());
    change.fold(0.0, f64::max)
}
