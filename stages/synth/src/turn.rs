//! The stage that takes the photos of a turn.

use crate::background::Background;
use crate::disk::{Disk, mat_for, rim_for};
use crate::drawn::{Palette, Placed};
use crate::film::Film;
use crate::photograph::{
    Scene, developed, empty_scene, fixed_pose, with_body, with_disk, with_reflection,
};
use crate::restless::Live;
use crate::shaded::{darken, shade};
use crate::shadow::Lamp;
use crate::skin::Look;
use crate::turn_params::TurnParams;
use nalgebra::Point3;
use rayon::prelude::*;
use shape::{
    Camera, Cameras, Mat, Mesh, Photo, PhotoId, Photos, Rgb, Rig, Rim, Sway, px_to_film,
    rgb_to_jpeg, rgb_to_png,
};
use stage::{Ctx, Stage, Stop};
use std::path::Path;
use std::sync::Arc;

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
        let live = live(p);
        let film = Film::of(&live, cameras, input.sway.as_deref(), (mesh, &normals));
        let steps = ctx.steps("photos", cameras.views.len());
        let take = |(i, (id, view)): (usize, &(PhotoId, shape::View))| -> Result<Photo, Stop> {
            let camera = &view.camera;
            let same = camera.lens == first.lens;
            let own = (!same).then(|| empty_scene(&scene, camera, &fixed));
            let mut seen = with_disk(&scene, own.as_ref().unwrap_or(&behind), camera, &fixed);
            let motion = input.sway.as_ref().and_then(|s| s.views.get(*id));
            with_reflection(&scene, &mut seen, mesh, camera, motion);
            if p.pace > 1 {
                seen = film.exposed(&seen, i, camera, |seen, now| {
                    with_body(
                        &scene,
                        seen,
                        (now, mesh),
                        &now.normals(),
                        camera,
                        (motion, None),
                    );
                });
            } else {
                let live =
                    (!live.rests()).then(|| live.body((mesh, &normals), id.0, camera, motion));
                let now = live.as_ref().unwrap_or(mesh);
                let shade = shade(&scene, camera, &fixed, Some((now, motion)));
                if let Some(shade) = &shade {
                    darken(&scene, shade, &mut seen, camera, &fixed);
                }
                let by = (motion, shade.as_ref());
                with_body(&scene, &mut seen, (now, mesh), &now.normals(), camera, by);
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
            let mut empty = with_disk(&scene, &behind, &first, &fixed);
            if let Some(shade) = shade(&scene, &first, &fixed, None) {
                darken(&scene, &shade, &mut empty, &first, &fixed);
            }
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

fn live(p: &TurnParams) -> Live {
    Live {
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
        lamp: (p.lamp_deg > 0.0).then(|| Lamp {
            right: p.lamp_right_deg.to_radians(),
            up: p.lamp_up_deg.to_radians(),
            radius: p.lamp_deg.to_radians(),
        }),
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
