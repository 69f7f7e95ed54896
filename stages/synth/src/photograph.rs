//! One photo of a body on a disk before a background: all that a fixed camera sees.

use crate::background::Background;
use crate::disk::Disk;
use crate::drawn::{Palette, Placed};
use crate::noise::chance;
use crate::raster::cast;
use crate::shadow::{FACING, Lamp, Shade};
use crate::skin::{Look, albedo};
use nalgebra::{Point2, Point3, Rotation3, Vector3};
use shape::{Camera, Image, Mesh, Pose, Rgb};

/// What is before the camera, and its light.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Scene {
    /// How the body looks.
    pub(crate) look: Look,
    /// Colours of skin, clothes, background and disk.
    pub(crate) palette: Palette,
    /// Where the body is.
    pub(crate) body: Placed,
    /// Walls and floor.
    pub(crate) background: Background,
    /// The disk.
    pub(crate) disk: Option<Disk>,
    /// What throws shadows; `None`: a light beside the camera that throws none.
    pub(crate) lamp: Option<Lamp>,
    /// The share of light that comes from all sides.
    pub(crate) ambient: f64,
    /// Rays through a pixel along each of its sides.
    pub(crate) rays: usize,
    /// Standard deviation of the noise, in levels of 0..=255.
    pub(crate) noise: f32,
}

/// Red, green, blue, linear.
pub(crate) type Linear = Image<[f32; 3]>;

/// Where the light comes from, in the camera's frame: from the upper left, behind the camera.
fn light() -> Vector3<f64> {
    Vector3::new(-0.55, -0.6, -0.6).normalize()
}

/// What a camera sees of the background alone. `fixed` is its pose in that frame.
pub(crate) fn empty_scene(scene: &Scene, camera: &Camera, fixed: &Pose) -> Linear {
    let centre = fixed.centre();
    let back = fixed.rotation.inverse();
    let color = |ray: &Vector3<f64>| {
        let along = back * ray;
        scene.background.color(&centre, &along, spread(camera))
    };
    filled(scene, camera, |_, _| true, color)
}

/// The background with the disk before it, as it is in the world of `camera`.
pub(crate) fn with_disk(scene: &Scene, behind: &Linear, camera: &Camera, fixed: &Pose) -> Linear {
    let Some(disk) = &scene.disk else {
        return behind.clone();
    };
    let (centre, fixed_centre) = (camera.centre(), fixed.centre());
    let (to_world, to_fixed) = (camera.pose.rotation.inverse(), fixed.rotation.inverse());
    let angle = spread(camera);
    let on_disk = |ray: &Vector3<f64>| disk.color(&centre, &(to_world * ray), angle);
    let color = |ray: &Vector3<f64>| {
        on_disk(ray).unwrap_or_else(|| {
            scene
                .background
                .color(&fixed_centre, &(to_fixed * ray), angle)
        })
    };
    // Only pixels near the disk need another look.
    let ray = |x: f64, y: f64| {
        let p = camera.lens.undistort(Point2::new(x, y));
        Vector3::new(p.x, p.y, 1.0)
    };
    let near = |x: usize, y: usize| {
        let (x, y) = (x as f64, y as f64);
        let beside = [
            (0.0, 0.0),
            (-0.7, -0.7),
            (0.7, -0.7),
            (-0.7, 0.7),
            (0.7, 0.7),
        ];
        beside
            .iter()
            .any(|(dx, dy)| on_disk(&ray(x + dx, y + dy)).is_some())
    };
    let seen = filled(scene, camera, near, color);
    let mut all = behind.clone();
    for (to, from) in all.data.iter_mut().zip(seen.data) {
        if from[0] >= 0.0 {
            *to = from;
        }
    }
    all
}

/// Puts the body before the background: its points at `rest` tell how it is painted, `motion` moves it into the world.
pub(crate) fn with_body(
    scene: &Scene,
    behind: &mut Linear,
    (mesh, rest): (&Mesh, &Mesh),
    normals: &[Vector3<f64>],
    camera: &Camera,
    (motion, shade): (Option<&Pose>, Option<&Shade>),
) {
    let rest = &rest.positions[..];
    let moved = motion.map_or(Rotation3::identity(), |m| m.rotation);
    let light = moved.inverse() * (camera.pose.rotation.inverse() * light());
    let (centre, to_world) = (camera.centre(), camera.pose.rotation.inverse());
    let focal = camera.lens.focal[0];
    cast(
        (mesh, rest),
        normals,
        camera,
        motion,
        scene.rays,
        |x, y, seen| {
            let normal = seen.normal.try_normalize(0.0).unwrap_or_default();
            let bright = shade.map_or_else(
                || scene.ambient + (1.0 - scene.ambient) * normal.dot(&light).max(0.0) * FACING,
                |shade| {
                    let p = camera.lens.undistort(Point2::new(x as f64, y as f64));
                    let there = to_world * (Vector3::new(p.x, p.y, 1.0) * seen.depth);
                    shade.light(&(centre + there), &(moved * normal))
                },
            );
            let pixel = (seen.depth / focal) as f32;
            let at = seen.at_rest.map(|x| x as f32).into();
            let painted = || scene.palette.cover(at, &scene.body, pixel);
            let base = seen.color.unwrap_or_else(painted);
            let color = albedo(&scene.look, base, at, pixel);
            let (cover, bright) = (seen.cover as f32, bright as f32);
            let to = behind.at_mut(x, y);
            (0..3).for_each(|c| to[c] += cover * (bright * color[c] - to[c]));
        },
    );
}

/// Puts what a disk that is no mat mirrors of the body on it.
pub(crate) fn with_reflection(
    scene: &Scene,
    behind: &mut Linear,
    mesh: &Mesh,
    camera: &Camera,
    motion: Option<&Pose>,
) {
    let Palette { gloss, wall, .. } = scene.palette;
    let Some(disk) = scene.disk.filter(|d| d.mat.is_none() && gloss > 0.0) else {
        return;
    };
    let still = Pose {
        rotation: Rotation3::identity(),
        translation: Vector3::zeros(),
    };
    let motion = motion.unwrap_or(&still);
    let mut mirrored = mesh.clone();
    for v in 0..mesh.positions.len() as u32 {
        let p = motion.apply(&mesh.point(v));
        mirrored.positions[v as usize] = [p.x as f32, p.y as f32, -p.z as f32];
    }
    mirrored.faces.iter_mut().for_each(|f| f.swap(1, 2));
    let normals = mirrored.normals();
    let (centre, to_world) = (camera.centre(), camera.pose.rotation.inverse());
    let light = to_world * light();
    let focal = camera.lens.focal[0];
    cast(
        (&mirrored, &mirrored.positions),
        &normals,
        camera,
        None,
        scene.rays,
        |x, y, seen| {
            let p = camera.lens.undistort(Point2::new(x as f64, y as f64));
            let ray = to_world * Vector3::new(p.x, p.y, 1.0);
            if disk.top_met(&centre, &ray).is_none() {
                return;
            }
            let normal = seen.normal.try_normalize(0.0).unwrap_or_default();
            let normal = Vector3::new(normal.x, normal.y, -normal.z);
            let bright =
                scene.ambient + (1.0 - scene.ambient) * normal.dot(&light).max(0.0) * FACING;
            let above = Point3::new(seen.at_rest.x, seen.at_rest.y, -seen.at_rest.z);
            let back = motion.rotation.inverse() * (above.coords - motion.translation);
            let at = back.map(|c| c as f32).into();
            let pixel = (seen.depth / focal) as f32;
            let painted = || scene.palette.cover(at, &scene.body, pixel);
            let base = seen.color.unwrap_or_else(painted);
            let color = albedo(&scene.look, base, at, pixel);
            let to = behind.at_mut(x, y);
            (0..3).for_each(|c| {
                to[c] += gloss * seen.cover as f32 * (bright as f32 * color[c] - wall[c])
            });
        },
    );
}

/// As a file has it: sRGB or, if `linear`, in proportion to light; with noise by seed.
pub(crate) fn developed(image: &Linear, noise: f32, linear: bool, seed: u32) -> Rgb {
    let mut i = 0;
    image.map(|color| {
        i += 1;
        let grain = |c: usize| {
            let four = (0..4).map(|k| chance([i, c as i32, k], seed));
            // Four even numbers make a nearly normal one, of variance 1/3.
            (four.sum::<f32>() - 2.0) * 3f32.sqrt() * noise
        };
        [0, 1, 2].map(|c| {
            let light = color[c].clamp(0.0, 1.0);
            let level = if linear {
                255.0 * light
            } else {
                shape::level_of_light(light)
            };
            let grain = if noise > 0.0 { grain(c) } else { 0.0 };
            (level + grain).round().clamp(0.0, 255.0) as u8
        })
    })
}

/// The angle of a pixel. \[rad\]
fn spread(camera: &Camera) -> f64 {
    1.0 / camera.lens.focal[0]
}

/// Mean colour over each wanted pixel's rays, directions in the camera's frame; -1 elsewhere.
fn filled(
    scene: &Scene,
    camera: &Camera,
    wanted: impl Fn(usize, usize) -> bool,
    color: impl Fn(&Vector3<f64>) -> [f32; 3],
) -> Linear {
    let (width, height) = (camera.lens.width as usize, camera.lens.height as usize);
    let rays = scene.rays;
    let place = |k: usize| (k as f64 + 0.5) / rays as f64 - 0.5;
    let mut image = Linear::filled(width, height, [-1.0; 3]);
    for y in 0..height {
        for x in (0..width).filter(|x| wanted(*x, y)) {
            let mut sum = [0.0; 3];
            for k in 0..rays * rays {
                let px = Point2::new(x as f64 + place(k % rays), y as f64 + place(k / rays));
                let p = camera.lens.undistort(px);
                let one = color(&Vector3::new(p.x, p.y, 1.0).normalize());
                (0..3).for_each(|c| sum[c] += one[c]);
            }
            *image.at_mut(x, y) = sum.map(|s| s / (rays * rays) as f32);
        }
    }
    image
}

/// The pose of a fixed camera, for the first photo's camera: the world at that moment, turned about z
/// so that the camera is at -y. The background is built around it.
pub(crate) fn fixed_pose(first: &Pose) -> Pose {
    let centre: Point3<f64> = first.centre();
    let angle = libm::atan2(centre.y, centre.x) + std::f64::consts::FRAC_PI_2;
    Pose {
        rotation: first.rotation * Rotation3::from_axis_angle(&Vector3::z_axis(), angle),
        translation: first.translation,
    }
}
