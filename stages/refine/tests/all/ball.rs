//! A textured ball, photographed from all around, whose surface and motion are known.

use crate::turn;

use nalgebra::{Point3, Rotation3, Vector3};
use refine::pictures::prepare::RefineError;
use refine::{
    CompensateMotion, CompensateMotionInput, Evolve, EvolveInput, Flow, OptimizeSurface,
    OptimizeSurfaceInput,
};
use shape::{Cameras, Mesh, PhotoId};
use stage::{Ctx, Stage, Stop};
use std::sync::Arc;
use turn::{COUNT, RADIUS, ball, camera, off, turn};

fn optimized(contrast: f64, masks: bool, radius: f64) -> Result<Mesh, Stop> {
    optimized_by(contrast, masks, radius, |_| ())
}

fn optimized_by(
    contrast: f64,
    masks: bool,
    radius: f64,
    change: impl Fn(&mut <OptimizeSurface as Stage>::Params),
) -> Result<Mesh, Stop> {
    let (photos, cameras, all) = turn(contrast, &[]);
    let mut p = <OptimizeSurface as Stage>::Params::default();
    (p.edge_px, p.reach_px, p.rounds, p.steps) = (5.0, 0.0, 2, 4);
    change(&mut p);
    let masks = masks.then(|| Arc::new(all));
    let input = OptimizeSurfaceInput {
        mesh: ball(radius).into(),
        photos: photos.into(),
        cameras: cameras.into(),
        masks,
        warps: None,
    };
    OptimizeSurface::run(&p, input, &Ctx::alone())
}

#[test]
fn a_ball_that_is_two_millimetres_too_large_comes_to_its_size() {
    let mesh = optimized(18.0, true, RADIUS + 2.0).unwrap();
    assert_eq!(mesh.validate_closed(), Ok(()));
    assert!(off(&mesh) < 0.12, "{} mm off", off(&mesh));
}

/// What a vertex that hardly moved was read as goes on by its slope: as if it had been read every time, to a
/// hundredth of a pixel.
#[test]
fn photos_that_are_not_read_again_where_the_surface_is_at_rest_give_the_same_surface() {
    let with = |still_px: f64| {
        let set = |p: &mut <OptimizeSurface as Stage>::Params| p.still_px = still_px;
        optimized_by(18.0, true, RADIUS + 1.0, set).unwrap()
    };
    let (every, moved) = (with(0.0), with(0.1));
    assert_ne!(every, moved);
    let apart = |(a, b): (&[f32; 3], &[f32; 3])| {
        let squares = (0..3).map(|i| f64::from(a[i] - b[i]).powi(2));
        squares.sum::<f64>()
    };
    let squares: f64 = every
        .positions
        .iter()
        .zip(&moved.positions)
        .map(apart)
        .sum();
    let rms = (squares / every.positions.len() as f64).sqrt();
    assert!(rms < 0.05, "{rms} mm apart");
    assert!((off(&every) - off(&moved)).abs() < 0.01);
}

/// A search that leaves out who has arrived finds the ball from farther off than slopes reach.
#[test]
fn searches_bring_a_ball_to_its_size_from_afar() {
    let searching = |p: &mut <OptimizeSurface as Stage>::Params| {
        (p.reach_px, p.searches, p.rounds) = (12.0, 2, 3);
    };
    let mesh = optimized_by(18.0, true, RADIUS + 4.0, searching).unwrap();
    assert!(off(&mesh) < 0.15, "{} mm off", off(&mesh));
}

#[test]
fn silhouettes_alone_hold_a_ball_without_texture() {
    let mesh = optimized(0.0, true, RADIUS + 2.0).unwrap();
    assert!(mesh.positions.iter().flatten().all(|x| x.is_finite()));
    assert!(off(&mesh) < 0.4, "{} mm off", off(&mesh));
}

#[test]
fn a_ball_of_one_flat_colour_without_silhouettes_stays_as_it_is() {
    let mesh = optimized(0.0, false, RADIUS).unwrap();
    assert!(off(&mesh) < 0.15, "{} mm off", off(&mesh));
}

#[test]
fn both_evolutions_of_the_paper_come_closer_and_differ() {
    let (photos, cameras, masks) = turn(18.0, &[]);
    let (photos, cameras, masks) = (Arc::new(photos), Arc::new(cameras), Arc::new(masks));
    let run = |flow: Flow| {
        let mut p = <Evolve as Stage>::Params::default();
        (p.flow, p.lambda, p.time_step, p.iterations) = (flow, 0.2, 0.02, 60);
        let input = EvolveInput {
            mesh: ball(RADIUS + 1.0).into(),
            photos: photos.clone(),
            cameras: cameras.clone(),
            masks: Some(masks.clone()),
        };
        Evolve::run(&p, input, &Ctx::alone()).unwrap()
    };
    let (rigid, median) = (run(Flow::Rigid), run(Flow::WeightedMedian));
    assert!(off(&rigid) < 0.5, "rigid: {} mm off", off(&rigid));
    assert!(off(&median) < 0.5, "median: {} mm off", off(&median));
    assert_ne!(rigid, median);
}

#[test]
fn a_body_that_shifts_between_photos_is_kept_still() {
    let mut dice = proof::Dice(8);
    let mut shifts: Vec<_> = (0..COUNT)
        .map(|_| Vector3::new(dice.normal(), dice.normal(), 0.0) * 1.5)
        .collect();
    // What all photos share is no sway: neither in the world nor in the cameras' own axes.
    for _ in 0..10 {
        let mean = shifts.iter().sum::<Vector3<f64>>() / f64::from(COUNT);
        shifts.iter_mut().for_each(|s| *s -= mean);
        let turn = |k: u32| {
            Rotation3::new(Vector3::z() * f64::from(k) * std::f64::consts::TAU / f64::from(COUNT))
        };
        let own: Vector3<f64> = (0..COUNT)
            .map(|k| turn(k).inverse() * shifts[k as usize])
            .sum();
        (0..COUNT).for_each(|k| shifts[k as usize] -= turn(k) * own / f64::from(COUNT));
    }
    let (photos, cameras, masks) = turn(18.0, &shifts);
    let mut p = <CompensateMotion as Stage>::Params::default();
    (p.look.size.level, p.rounds) = (0, 16);
    let input = CompensateMotionInput {
        mesh: ball(RADIUS).into(),
        photos: photos.into(),
        cameras: cameras.into(),
        masks: Some(masks.into()),
    };
    let compensated = CompensateMotion::run(&p, input, &Ctx::alone()).unwrap();
    let (mut before, mut after) = (0.0, 0.0);
    for (k, shift) in shifts.iter().enumerate() {
        // Where the middle of the ball was on the photo, and where the compensated camera sees it.
        let true_px = camera(k as u32).project(&Point3::from(*shift)).unwrap();
        let still = camera(k as u32).project(&Point3::origin()).unwrap();
        let found = compensated
            .views
            .get(PhotoId(k as u32))
            .unwrap()
            .camera
            .project(&Point3::origin())
            .unwrap();
        before += (true_px - still).norm_squared();
        after += (true_px - found).norm_squared();
    }
    assert!(
        after < 0.05 * before,
        "{:.2} px of {:.2} px are left",
        after.sqrt(),
        before.sqrt()
    );
}

#[test]
fn equal_inputs_give_equal_bytes_with_one_thread_and_with_three() {
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        stage::to_bytes(
            &pool
                .install(|| optimized_by(18.0, true, RADIUS + 1.0, |p| p.reach_px = 6.0))
                .unwrap(),
        )
    };
    assert!(with(1) == with(3));
}

#[test]
fn meshes_with_holes_and_photos_without_cameras_are_refused() {
    let mut mesh = ball(RADIUS);
    mesh.faces.pop();
    let (photos, mut cameras, _) = turn(18.0, &[]);
    let photos = Arc::new(photos);
    let run = |mesh: Mesh, cameras: Cameras| {
        let input = OptimizeSurfaceInput {
            mesh: mesh.into(),
            photos: photos.clone(),
            cameras: cameras.into(),
            masks: None,
            warps: None,
        };
        match OptimizeSurface::run(&Default::default(), input, &Ctx::alone()) {
            Err(Stop::Failed(error)) => error.downcast::<RefineError>().unwrap().to_string(),
            _ => panic!("it went through"),
        }
    };
    assert!(run(mesh, cameras.clone()).contains("cannot be refined"));
    cameras.views = cameras
        .views
        .iter()
        .take(1)
        .map(|(id, v)| (id, v.clone()))
        .collect();
    assert!(run(ball(RADIUS), cameras).contains("only 1 photos"));
}
