//! The stage that takes the photos of a turn.

use crate::background::Background;
use crate::disk::{Disk, mat_for, rim_for};
use crate::drawn::{Palette, Placed};
use crate::film::Film;
use crate::photograph::{
    Scene, developed, empty_scene, fixed_pose, with_body, with_disk, with_reflection,
};
use crate::restless::Live;
use crate::skin::Look;
use nalgebra::Point3;
use rayon::prelude::*;
use shape::{
    Camera, Cameras, Mat, Mesh, Photo, PhotoId, Photos, Rgb, Rig, Rim, Sway, px_to_film,
    rgb_to_jpeg, rgb_to_png,
};
use stage::{Ctx, Stage, Stop};
use std::path::Path;
use std::sync::Arc;

stage::params! {
    /// How body, disk, background and photos look, and what the user knows.
    pub struct TurnParams {
        /// Contrast of the body's texture: 0 none, 0.05 skin, 1 a printed dress.
        #[range(0.0..=1.0)]
        #[source(structural)]
        contrast: f64 = 0.5,
        /// Size of the finest marks on the body.
        #[range(0.5..=200.0)]
        #[source(structural)]
        finest_mm: f64 = 4.0,
        /// Size of the coarsest marks on the body.
        #[range(1.0..=500.0)]
        #[source(structural)]
        coarsest_mm: f64 = 64.0,
        /// Share of light that comes from all sides; the rest is a Lambert light beside the camera.
        #[range(0.0..=1.0)]
        #[source(structural)]
        ambient: f64 = 0.5,
        /// Standard deviation of the sensor's noise, in levels of 0..=255.
        #[range(0.0..=50.0)]
        #[source(structural)]
        noise_levels: f64 = 1.0,
        /// Whether levels are in proportion to light; else they are sRGB, as cameras write them.
        linear: bool = false,
        /// Rays through each pixel along each of its sides.
        #[range(1..=8)]
        #[source(structural)]
        rays: u32 = 3,
        /// Quality of the JPEG files, 1 to 100; 0 writes PNG, without loss.
        #[range(0..=100)]
        #[source(structural)]
        jpeg_quality: u32 = 93,
        /// Whether a marker mat is on the disk; else it is wood.
        mat: bool = true,
        /// Whether a strip of tags goes around the rim of a disk with a mat.
        rim: bool = false,
        /// Whether there is a photo of the scene without the body.
        plate: bool = true,
        /// By how much the focal length that EXIF tells is too short, as a share of it.
        #[range(-0.2..=0.2)]
        #[source(structural)]
        exif_error: f64 = 0.004,
        /// Background, clothes, skin, light and disk are drawn by this number; 0: the default, skin all over, a disk of wood.
        /// A surface with colours of its own wears these.
        #[range(0..=1000000)]
        #[source(structural)]
        scene: u32 = 0,
        /// How far hands are elsewhere in each photo, one standard deviation a side; the head moves half as far, and a breath
        /// lifts the chest by a quarter.
        #[range(0.0..=200.0)]
        #[source(structural)]
        restless_mm: f64 = 0.0,
        /// How far feet are elsewhere in each photo, one standard deviation a side: legs follow from the hip down.
        #[range(0.0..=200.0)]
        #[source(structural)]
        feet_mm: f64 = 0.0,
        /// How far arms are raised about the shoulders; below 0 they hang closer to the body.
        #[range(-45.0..=90.0)]
        #[source(structural)]
        arms_deg: f64 = 0.0,
        /// How far shorts hang away from the legs at their hem, in folds that hang otherwise in each photo.
        #[range(0.0..=200.0)]
        #[source(structural)]
        worn_mm: f64 = 0.0,
        /// How far the body turns while the camera reads its rows, one after the other.
        #[range(0.0..=45.0)]
        #[source(structural)]
        read_deg: f64 = 0.0,
        /// How many photos are from step to step, as the cameras and the sway have it: above 1, feet are set and keep their
        /// places on the floor while the body turns over them, and all that moves does so smoothly, as in a film.
        #[range(1..=720)]
        #[source(structural)]
        pace: u32 = 1,
        /// How far feet are lifted in a film.
        #[range(0.0..=500.0)]
        #[source(structural)]
        lift_mm: f64 = 0.0,
        /// The share of the time from photo to photo in which rows are read, in a film.
        #[range(0.0..=1.0)]
        #[source(structural)]
        read: f64 = 0.0,
        /// The share of the time from photo to photo in which the shutter is open, in a film.
        #[range(0.0..=1.0)]
        #[source(structural)]
        open: f64 = 0.0,
        /// Seed of textures and noise.
        #[range(0..=1000000)]
        #[chance(seed)]
        #[source(structural)]
        seed: u32 = 1,
    }
}

stage::inputs! {
    /// A body and the cameras that see it.
    pub struct TurnInput {
        /// The body at rest.
        mesh: Arc<Mesh>,
        /// The true cameras.
        cameras: Arc<Cameras>,
        /// How the body moves between photos.
        sway: Option<Arc<Sway>>,
    }
}

/// Cameras that see nothing.
#[derive(Debug, thiserror::Error)]
#[error("there is no camera, so there is no photo to take")]
pub(crate) struct NoCamera;

/// `synth.turn`: mesh, cameras → photos.
pub struct TakePhotos;

impl Stage for TakePhotos {
    const NAME: &'static str = "synth.turn";
    const VERSION: u32 = 9;
    const ABOUT: &'static str = "Takes the photos of a turn of any mesh: in its own colours or textured, lit, on a disk before furniture.";
    type Params = TurnParams;
    type Input = TurnInput;
    type Output = Photos;
    const METRICS: &'static [&'static str] = &["photos"];

    fn run(p: &TurnParams, input: TurnInput, ctx: &Ctx<'_>) -> Result<Photos, Stop> {
        let (mesh, cameras) = (&input.mesh, &input.cameras);
        let first = cameras.views.values().next().ok_or(NoCamera)?.camera;
        let fixed = fixed_pose(&first.pose);
        let mat = cameras.disk_radius_mm.filter(|_| p.mat).map(mat_for);
        let rim = cameras.disk_radius_mm.zip(mat).filter(|_| p.rim);
        let rim = rim.map(|(radius, mat)| rim_for(radius, &mat));
        let scene = scene(p, cameras, &first, mesh, mat, rim);
        let behind = empty_scene(&scene, &first, &fixed);
        let normals = mesh.normals();
        let live = Live {
            hands_mm: p.restless_mm,
            feet_mm: p.feet_mm,
            worn_mm: p.worn_mm,
            arms_rad: p.arms_deg.to_radians(),
            read_rad: p.read_deg.to_radians(),
            pace: p.pace,
            lift_mm: p.lift_mm,
            read: p.read,
            open: p.open,
            seed: p.seed,
        };
        let film = Film::of(&live, cameras, input.sway.as_deref(), (mesh, &normals));
        let steps = ctx.steps("photos", cameras.views.len());
        let take = |(i, (id, view)): (usize, &(PhotoId, shape::View))| -> Result<Photo, Stop> {
            let camera = &view.camera;
            let same = camera.lens == first.lens;
            let own = (!same).then(|| empty_scene(&scene, camera, &fixed));
            let mut seen = with_disk(&scene, own.as_ref().unwrap_or(&behind), camera, &fixed);
            let motion = input.sway.as_ref().and_then(|s| s.views.get(*id));
            with_reflection(&scene, &mut seen, mesh, camera, motion);
            if live.rests() {
                with_body(&scene, &mut seen, (mesh, mesh), &normals, camera, motion);
            } else if p.pace > 1 {
                seen = film.exposed(&seen, i, camera, |seen, now| {
                    with_body(&scene, seen, (now, mesh), &now.normals(), camera, motion);
                });
            } else {
                let now = live.body((mesh, &normals), id.0, camera, motion);
                with_body(
                    &scene,
                    &mut seen,
                    (&now, mesh),
                    &now.normals(),
                    camera,
                    motion,
                );
            }
            let rgb = developed(
                &seen,
                scene.noise,
                p.linear,
                p.seed.wrapping_mul(1009) + 2 + id.0,
            );
            steps.tick()?;
            Ok(photo(p, &view.name, &rgb, camera))
        };
        let photos = cameras.views.as_slice().par_iter().enumerate().map(take);
        let photos: Vec<Photo> = photos.collect::<Result<_, _>>()?;
        let plate = p.plate.then(|| {
            let empty = with_disk(&scene, &behind, &first, &fixed);
            let rgb = developed(&empty, scene.noise, p.linear, p.seed.wrapping_mul(1009) + 1);
            photo(p, "plate.jpg", &rgb, &first)
        });
        ctx.metric("photos", photos.len() as f64, "");
        let rig = Rig {
            step: step(cameras),
            focal_35mm: photos[0].focal_35mm,
            stature_mm: mesh.bounds().map(|b| b.1.z - cameras.ground_mm),
            disk_diameter_mm: cameras.disk_radius_mm.map(|r| 2.0 * r),
            mat,
            rim,
            ..Rig::default()
        };
        Ok(Photos { photos, plate, rig })
    }
}

fn scene(
    p: &TurnParams,
    cameras: &Cameras,
    first: &Camera,
    mesh: &Mesh,
    mat: Option<Mat>,
    rim: Option<Rim>,
) -> Scene {
    let palette = Palette::drawn(p.scene);
    let nowhere = (Point3::origin(), Point3::origin());
    let ends = mesh.bounds().unwrap_or(nowhere);
    let middle = nalgebra::center(&ends.0, &ends.1);
    // Without a disk the body is on the floor.
    let thick = 0.25 * cameras.disk_radius_mm.unwrap_or(0.0);
    let disk = |radius: f64| Disk {
        radius,
        thick,
        mat,
        rim,
        seed: p.seed,
        palette,
    };
    Scene {
        look: Look {
            contrast: p.contrast as f32,
            finest: p.finest_mm as f32,
            coarsest: p.coarsest_mm.max(p.finest_mm) as f32,
            seed: p.seed,
        },
        background: Background::around(&fixed_pose(&first.pose).centre(), thick, p.seed, palette),
        disk: cameras.disk_radius_mm.map(disk),
        palette,
        body: Placed {
            foot: Point3::new(middle.x, middle.y, ends.0.z),
            tall: (ends.1.z - ends.0.z).max(1.0),
        },
        ambient: palette.ambient.unwrap_or(p.ambient),
        rays: p.rays as usize,
        noise: p.noise_levels as f32,
    }
}

fn photo(p: &TurnParams, name: &str, rgb: &Rgb, camera: &Camera) -> Photo {
    let (ending, file) = match p.jpeg_quality {
        0 => ("png", rgb_to_png(rgb)),
        quality => ("jpg", rgb_to_jpeg(rgb, quality as u8)),
    };
    let focal = px_to_film(camera.lens.focal[0], camera.lens.width, camera.lens.height);
    let name = Path::new(name).with_extension(ending);
    Photo {
        name: name.to_string_lossy().into_owned(),
        width: camera.lens.width,
        height: camera.lens.height,
        orientation: 1,
        focal_35mm: Some(focal / (1.0 + p.exif_error)),
        device: "synthetic".into(),
        time_s: None,
        file: file.into(),
    }
}

/// The even step that a user would tell, from how the cameras follow each other around the axis;
/// `None` if they do not. \[rad\]
fn step(cameras: &Cameras) -> Option<f64> {
    let centres: Vec<_> = cameras.views.values().map(|v| v.camera.centre()).collect();
    let turn = |w: &[nalgebra::Point3<f64>]| {
        let (a, b) = (&w[0], &w[1]);
        // The camera goes around one way as the disk turns the other.
        -libm::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y)
    };
    let turns: Vec<f64> = centres.windows(2).map(turn).collect();
    let mean = turns.iter().sum::<f64>() / turns.len().max(1) as f64;
    let even = !turns.is_empty() && turns.iter().all(|t| (t - mean).abs() < 0.05);
    even.then(|| (mean.to_degrees() * 2.0).round().to_radians() / 2.0)
}
