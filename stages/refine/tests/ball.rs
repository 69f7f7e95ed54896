//! A textured ball, photographed from all around, whose surface and motion are known.

use nalgebra::{Point3, Rotation3, Vector3};
use refine::{Evolve, EvolveInput, Flow, RefineError, Settle, SettleInput, Steady, SteadyInput};
use shape::{
    ByPhoto, Camera, Cameras, Intrinsics, Mask, Masks, Mesh, Photo, PhotoId, Photos, Pose, Scale,
    View,
};
use stage::{Ctx, Stage, Stop};
use std::sync::Arc;

const RADIUS: f64 = 60.0;
const COUNT: u32 = 12;

/// A camera on a ring, looking at the origin.
fn camera(k: u32) -> Camera {
    let angle = f64::from(k) * std::f64::consts::TAU / f64::from(COUNT);
    let centre = Point3::new(400.0 * angle.cos(), 400.0 * angle.sin(), 90.0);
    let forward = (Point3::origin() - centre).normalize();
    let right = forward.cross(&Vector3::z()).normalize();
    let down = forward.cross(&right);
    let rows =
        nalgebra::Matrix3::from_rows(&[right.transpose(), down.transpose(), forward.transpose()]);
    let rotation = Rotation3::from_matrix_unchecked(rows);
    Camera {
        lens: Intrinsics::simple(160, 160, 400.0),
        pose: Pose {
            rotation,
            translation: -(rotation * centre.coords),
        },
    }
}

/// Brightness of a point of the body: a few waves through space.
fn texture(x: &Point3<f64>, contrast: f64) -> f64 {
    let waves: [[f64; 4]; 6] = [
        [0.30, 0.11, 0.17, 0.0],
        [-0.31, 0.55, 0.18, 1.0],
        [0.12, -0.44, 0.61, 2.0],
        [0.83, 0.39, -0.47, 3.0],
        [-0.71, 0.66, 0.92, 4.0],
        [0.95, -0.88, 0.31, 5.0],
    ];
    let sum: f64 = waves
        .iter()
        .map(|w| (w[0] * x.x + w[1] * x.y + w[2] * x.z + w[3]).sin())
        .sum();
    128.0 + contrast * sum
}

/// The ball moved by `shifts`, as each camera sees it.
fn turn(contrast: f64, shifts: &[Vector3<f64>]) -> (Photos, Cameras, Masks) {
    let (mut photos, mut views, mut masks) = (Photos::default(), vec![], vec![]);
    for k in 0..COUNT {
        let camera = camera(k);
        let at = shifts.get(k as usize).copied().unwrap_or_default();
        let mut image = image::RgbImage::new(160, 160);
        let mut mask = Mask::filled(160, 160, 0);
        for (x, y, pixel) in image.enumerate_pixels_mut() {
            let ray = camera.ray([f64::from(x), f64::from(y)].into());
            let from = camera.centre() - at;
            let (b, c) = (
                from.coords.dot(&ray),
                from.coords.norm_squared() - RADIUS * RADIUS,
            );
            let root = b * b - c;
            let value = if root > 0.0 {
                *mask.at_mut(x as usize, y as usize) = 255;
                texture(&(from + *ray * (-b - root.sqrt())), contrast)
            } else {
                30.0
            };
            *pixel = image::Rgb([value.clamp(0.0, 255.0).round() as u8; 3]);
        }
        let mut file = std::io::Cursor::new(Vec::new());
        image.write_to(&mut file, image::ImageFormat::Png).unwrap();
        let name = format!("{k:04}.png");
        photos.photos.push(Photo {
            name: name.clone(),
            width: 160,
            height: 160,
            orientation: 1,
            focal_35mm: None,
            device: String::new(),
            time_s: None,
            file: file.into_inner().into(),
        });
        views.push((
            PhotoId(k),
            View {
                name,
                camera,
                sigma_mm: 0.0,
                rms_px: 0.0,
                points: 0,
            },
        ));
        masks.push((PhotoId(k), mask));
    }
    let cameras = Cameras {
        views: views.into_iter().collect::<ByPhoto<View>>(),
        scale: Scale::Given,
        scale_sigma: 0.0,
        disk_radius_mm: None,
        ground_mm: -RADIUS,
        points: vec![],
    };
    (
        photos,
        cameras,
        Masks {
            views: masks.into_iter().collect(),
        },
    )
}

/// A ball cut from an octahedron.
fn ball(radius: f64) -> Mesh {
    let side: i32 = 14;
    let mut places = std::collections::BTreeMap::new();
    let mut mesh = Mesh::default();
    let mut vertex = |p: [i32; 3]| -> u32 {
        *places.entry(p).or_insert_with(|| {
            let v = Vector3::from(p.map(f64::from)).normalize() * radius;
            mesh.positions.push([v.x as f32, v.y as f32, v.z as f32]);
            mesh.positions.len() as u32 - 1
        })
    };
    let mut faces = vec![];
    for signs in 0..8 {
        let s = [0, 1, 2].map(|i| if signs >> i & 1 == 0 { 1 } else { -1 });
        for i in 0..side {
            for j in 0..side - i {
                let at = |i: i32, j: i32| [s[0] * i, s[1] * j, s[2] * (side - i - j)];
                let mut add = |a, b, c| {
                    let [a, b, c] = [a, b, c].map(&mut vertex);
                    faces.push(if s[0] * s[1] * s[2] > 0 {
                        [a, b, c]
                    } else {
                        [a, c, b]
                    });
                };
                add(at(i, j), at(i + 1, j), at(i, j + 1));
                if i + j < side - 1 {
                    add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
                }
            }
        }
    }
    mesh.faces = faces;
    mesh.validate_closed().unwrap();
    assert!(mesh.volume() > 0.0);
    mesh
}

/// Mean distance of the band that the cameras see well from the true ball. \[mm\]
fn off(mesh: &Mesh) -> f64 {
    let band = (0..mesh.positions.len() as u32)
        .map(|v| mesh.point(v))
        .filter(|x| x.z > -25.0 && x.z < 45.0);
    let far: Vec<f64> = band.map(|x| (x.coords.norm() - RADIUS).abs()).collect();
    far.iter().sum::<f64>() / far.len() as f64
}

fn settled(contrast: f64, masks: bool, radius: f64) -> Result<Mesh, Stop> {
    let (photos, cameras, all) = turn(contrast, &[]);
    let mut p = <Settle as Stage>::Params::default();
    (p.edge_px, p.reach_px, p.rounds, p.steps) = (5.0, 0.0, 2, 4);
    let masks = masks.then(|| Arc::new(all));
    let input = SettleInput {
        mesh: ball(radius).into(),
        photos: photos.into(),
        cameras: cameras.into(),
        masks,
    };
    Settle::run(&p, input, &Ctx::alone())
}

#[test]
fn a_ball_that_is_two_millimetres_too_large_settles_to_its_size() {
    let mesh = settled(18.0, true, RADIUS + 2.0).unwrap();
    assert_eq!(mesh.validate_closed(), Ok(()));
    assert!(off(&mesh) < 0.12, "{} mm off", off(&mesh));
}

#[test]
fn silhouettes_alone_hold_a_ball_without_texture() {
    let mesh = settled(0.0, true, RADIUS + 2.0).unwrap();
    assert!(mesh.positions.iter().flatten().all(|x| x.is_finite()));
    assert!(off(&mesh) < 0.4, "{} mm off", off(&mesh));
}

#[test]
fn a_ball_of_one_flat_colour_without_silhouettes_stays_as_it_is() {
    let mesh = settled(0.0, false, RADIUS).unwrap();
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
fn a_body_that_shifts_between_photos_is_held_still() {
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
    let mut p = <Steady as Stage>::Params::default();
    (p.level, p.rounds) = (0, 16);
    let input = SteadyInput {
        mesh: ball(RADIUS).into(),
        photos: photos.into(),
        cameras: cameras.into(),
        masks: Some(masks.into()),
    };
    let steady = Steady::run(&p, input, &Ctx::alone()).unwrap();
    let (mut before, mut after) = (0.0, 0.0);
    for (k, shift) in shifts.iter().enumerate() {
        // Where the middle of the ball was on the photo, and where the steady camera sees it.
        let true_px = camera(k as u32).project(&Point3::from(*shift)).unwrap();
        let still = camera(k as u32).project(&Point3::origin()).unwrap();
        let found = steady
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
        stage::to_bytes(&pool.install(|| settled(18.0, true, RADIUS + 1.0)).unwrap())
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
        let input = SettleInput {
            mesh: mesh.into(),
            photos: photos.clone(),
            cameras: cameras.into(),
            masks: None,
        };
        match Settle::run(&Default::default(), input, &Ctx::alone()) {
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
