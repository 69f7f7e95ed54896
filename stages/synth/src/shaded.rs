//! Shadows on the background and the disk of one photo.

use crate::photograph::{Linear, Scene};
use crate::shadow::{Shade, moved};
use nalgebra::{Point2, Point3, Rotation3, Vector3};
use rayon::prelude::*;
use shape::{Camera, Mesh, Pose};

/// Turns axes in which the camera is at -y into a photo's world; `fixed` is its pose in the former.
fn to_world(camera: &Camera, fixed: &Pose) -> Rotation3<f64> {
    camera.pose.rotation.inverse() * fixed.rotation
}

/// What keeps light off in one photo: the disk and the body, moved into the photo's world; `None` if nothing throws shadows.
pub(crate) fn shade(
    scene: &Scene,
    camera: &Camera,
    fixed: &Pose,
    body: Option<(&Mesh, Option<&Pose>)>,
) -> Option<Shade> {
    let lamp = scene.lamp?;
    let body = body.map(|(mesh, motion)| moved(mesh, motion));
    let turned = to_world(camera, fixed);
    let disk = scene.disk.as_ref();
    Some(Shade::of(
        &lamp,
        scene.ambient,
        body.as_ref(),
        disk,
        &turned,
    ))
}

/// Darkens what is seen of the background and the disk by what keeps light off it.
pub(crate) fn darken(
    scene: &Scene,
    shade: &Shade,
    seen: &mut Linear,
    camera: &Camera,
    fixed: &Pose,
) {
    let turned = to_world(camera, fixed);
    let (centre, fixed_centre) = (camera.centre(), fixed.centre());
    let width = camera.lens.width as usize;
    let rows = seen.data.par_chunks_mut(width).enumerate();
    rows.for_each(|(y, row)| {
        for (x, to) in row.iter_mut().enumerate() {
            let p = camera.lens.undistort(Point2::new(x as f64, y as f64));
            let ray = camera.pose.rotation.inverse() * Vector3::new(p.x, p.y, 1.0);
            let disk = scene.disk.as_ref().and_then(|d| d.met(&centre, &ray));
            let (at, normal) = disk.unwrap_or_else(|| {
                let hit = scene
                    .background
                    .met(&fixed_centre, &(turned.inverse() * ray));
                let mut normal = Vector3::zeros();
                normal[hit.wall.0] = -hit.wall.1;
                let off = turned * (hit.at - fixed_centre);
                (Point3::from(centre + off), turned * normal)
            });
            let share = shade.share(&at, &normal) as f32;
            (0..3).for_each(|c| to[c] *= share);
        }
    });
}
