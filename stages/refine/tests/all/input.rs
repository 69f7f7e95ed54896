//! What the refinement does with surfaces and photos that are not as they should be.

use crate::turn;

use nalgebra::{Point3, Vector3};
use refine::pictures::prepare::{RefineError, pictures};
use refine::{OptimizeSurface, OptimizeSurfaceInput};
use shape::{Camera, Intrinsics, LOOKED_AT_MPX, Mesh, Photo, PhotoId, Photos, Rgb, Scale, View};
use stage::{Ctx, Stage, Stop};
use turn::{RADIUS, ball, off, turn};

/// Optimizes a mesh before a textured ball, after something was done to the cameras.
fn optimized(mesh: Mesh, spoil: impl Fn(&mut shape::Cameras)) -> Result<Mesh, Stop> {
    let (photos, mut cameras, masks) = turn(18.0, &[]);
    spoil(&mut cameras);
    let mut p = <OptimizeSurface as Stage>::Params::default();
    (p.edge_px, p.rounds, p.steps) = (5.0, 1, 3);
    let input = OptimizeSurfaceInput {
        mesh: mesh.into(),
        photos: photos.into(),
        cameras: cameras.into(),
        masks: Some(masks.into()),
        warps: None,
    };
    OptimizeSurface::run(&p, input, &Ctx::alone())
}

fn refused(result: Result<Mesh, Stop>) -> String {
    match result {
        Err(Stop::Failed(error)) => error.downcast::<RefineError>().unwrap().to_string(),
        Err(_) => panic!("it was stopped"),
        Ok(_) => panic!("it went through"),
    }
}

/// Two photos of a pattern, of more pixels than photos are looked at with.
fn large() -> Photos {
    let (width, height) = (2600, 2000);
    let level = |i: usize| ((i % width) / 9 * 5 + (i / width) / 7 * 3) as u8;
    let data = (0..width * height).map(|i| [level(i), 90, 200]).collect();
    let pixels = Rgb {
        width,
        height,
        data,
    };
    let file = shape::rgb_to_png(&pixels);
    let photo = |name: &str| Photo::of(name, [width as u32, height as u32], file.clone());
    Photos {
        photos: vec![photo("0.png"), photo("1.png")],
        ..Photos::default()
    }
}

#[test]
fn a_photo_of_many_pixels_is_seen_as_the_same_photo_with_fewer() {
    let large = large();
    let lens = Intrinsics {
        width: 2600,
        height: 2000,
        focal: [3000.0; 2],
        centre: [1310.0, 980.0],
        radial: [0.01, 0.0],
    };
    let camera = Camera::looking(lens, Point3::new(0.0, -900.0, 200.0), Point3::origin());
    let views = [0, 1].map(|i| (PhotoId(i), View::of(format!("{i}.png"), camera)));
    let cameras = shape::Cameras::of(views, Scale::Nothing);
    let fewer = |photo: &Photo| {
        let pixels = photo.within(LOOKED_AT_MPX).decode().unwrap();
        let size = [pixels.width as u32, pixels.height as u32];
        Photo::of(&photo.name, size, shape::rgb_to_png(&pixels))
    };
    let small = Photos {
        photos: large.photos.iter().map(fewer).collect(),
        ..Photos::default()
    };
    assert_eq!(small.photos[0].width, 2280);
    let seen = |photos: &Photos, cameras| {
        pictures(photos, cameras, None, 1, LOOKED_AT_MPX, || {
            Ok::<(), Stop>(())
        })
    };
    let of_large = seen(&large, &cameras).unwrap_or_else(|_| panic!("large"));
    let of_small = seen(&small, &cameras.of_photos(&small)).unwrap_or_else(|_| panic!("small"));
    for (large, small) in of_large.iter().zip(&of_small) {
        assert_eq!(large.whole, small.whole);
        assert!(large.gray == small.gray && large.projection == small.projection);
    }
}

#[test]
fn a_place_that_is_no_number_is_refused() {
    for bad in [f32::NAN, f32::INFINITY] {
        let mut mesh = ball(RADIUS);
        mesh.positions[7][1] = bad;
        let why = refused(optimized(mesh, |_| ()));
        assert!(why.contains("cannot be refined"), "{why}");
    }
}

#[test]
fn needles_are_remeshed_away_and_harm_nobody() {
    let mut mesh = ball(RADIUS + 1.0);
    // Vertices slide onto their neighbours until a hair is left between them.
    for f in (0..mesh.faces.len()).step_by(97) {
        let [a, b, _] = mesh.faces[f];
        let (p, q) = (mesh.positions[a as usize], mesh.positions[b as usize]);
        mesh.positions[a as usize] = [0, 1, 2].map(|i| q[i] + (p[i] - q[i]) * 1e-3);
    }
    let mesh = optimized(mesh, |_| ()).unwrap();
    assert_eq!(mesh.validate_closed(), Ok(()));
    assert!(mesh.positions.iter().flatten().all(|x| x.is_finite()));
    assert!(off(&mesh) < 0.4, "{} mm off", off(&mesh));
}

#[test]
fn several_parts_are_optimized_side_by_side() {
    let mut mesh = ball(RADIUS + 1.0);
    let mut small = ball(3.0);
    small.positions.iter_mut().for_each(|p| p[2] += 90.0);
    let first = mesh.positions.len() as u32;
    mesh.positions.extend(&small.positions);
    let faces = small.faces.iter().map(|f| f.map(|v| v + first));
    mesh.faces.extend(faces);
    let mesh = optimized(mesh, |_| ()).unwrap();
    assert_eq!(mesh.validate_closed(), Ok(()));
    let above = mesh.positions.iter().filter(|p| p[2] > 80.0).count();
    assert!(above > 0, "the small part is still there");
    assert!(off(&mesh) < 0.4, "{} mm off", off(&mesh));
}

#[test]
fn a_photo_that_looks_elsewhere_is_passed_over() {
    let aside = |cameras: &mut shape::Cameras| {
        let turned = |(id, view): (PhotoId, &shape::View)| {
            let mut view = view.clone();
            if id == PhotoId(3) {
                view.camera.pose.translation += Vector3::new(9000.0, 0.0, 0.0);
            }
            (id, view)
        };
        cameras.views = cameras.views.iter().map(turned).collect();
    };
    let mesh = optimized(ball(RADIUS + 1.0), aside).unwrap();
    assert!(off(&mesh) < 0.3, "{} mm off", off(&mesh));
}

#[test]
fn a_mesh_that_no_photo_shows_is_refused() {
    let mut mesh = ball(RADIUS);
    mesh.positions.iter_mut().for_each(|p| p[0] += 50_000.0);
    let why = refused(optimized(mesh, |_| ()));
    assert!(why.contains("belong together"), "{why}");
}
