//! The edge of a turning disk: its rim is round, so that it projects to one fixed ellipse.

use nalgebra::{Point3, Vector2, Vector3};
use shape::{Camera, Gray};

/// A disk's upper edge about the z axis, in the camera's unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DiskEdge {
    /// Height of the edge.
    pub height: f64,
    /// Its radius.
    pub radius: f64,
    /// Mean step of brightness across it, 0..=255.
    pub contrast: f64,
    /// The same over the median of all that was tried: how far it stands out.
    pub standout: f64,
}

/// Points around the edge.
const AROUND: usize = 96;

/// Finds the round edge with the strongest step of one sign, within heights and radii. Of edges
/// nearly as strong and as wide (a disk has a lower one too) the upper is taken.
pub fn disk_edge(
    gray: &Gray,
    camera: &Camera,
    heights: [f64; 2],
    radii: [f64; 2],
) -> Option<DiskEdge> {
    let camera = camera.resized(gray.width as u32, gray.height as u32);
    let steps = 70;
    let at = |[lo, hi]: [f64; 2], i: usize, of: usize| lo + (hi - lo) * i as f64 / of as f64;
    let mut tried: Vec<(f64, f64, f64)> = Vec::with_capacity(steps * steps);
    for i in 0..=steps {
        for j in 0..=steps {
            let (z, r) = (at(heights, i, steps), at(radii, j, steps));
            tried.push((z, r, step(gray, &camera, z, r).unwrap_or(0.0)));
        }
    }
    let mut sizes: Vec<f64> = tried.iter().map(|t| t.2).collect();
    sizes.sort_by(f64::total_cmp);
    let usual = sizes[sizes.len() / 2].max(0.1);
    let strongest = tried.iter().copied().max_by(|a, b| a.2.total_cmp(&b.2))?;
    let alike =
        |t: &(f64, f64, f64)| t.2 >= 0.75 * strongest.2 && (t.1 / strongest.1 - 1.0).abs() < 0.15;
    let (mut z, mut r, mut contrast) = tried
        .into_iter()
        .filter(alike)
        .max_by(|a, b| a.0.total_cmp(&b.0).then(a.2.total_cmp(&b.2)))?;
    let mut reach = [
        (heights[1] - heights[0]) / steps as f64,
        (radii[1] - radii[0]) / steps as f64,
    ];
    for _ in 0..12 {
        let mut best = (z, r, contrast);
        for (dz, dr) in (-2..=2).flat_map(|a| (-2..=2).map(move |b| (a, b))) {
            let (z, r) = (
                z + f64::from(dz) * reach[0] * 0.5,
                r + f64::from(dr) * reach[1] * 0.5,
            );
            if let Some(c) = step(gray, &camera, z, r).filter(|c| *c > best.2) {
                best = (z, r, c);
            }
        }
        if best.2 <= contrast {
            reach = reach.map(|r| r * 0.6);
        }
        (z, r, contrast) = best;
    }
    Some(DiskEdge {
        height: z,
        radius: r,
        contrast,
        standout: contrast / usual,
    })
}

/// Mean step of brightness outwards over the half of the edge that faces the camera, its size.
fn step(gray: &Gray, camera: &Camera, height: f64, radius: f64) -> Option<f64> {
    let centre = camera.centre();
    let towards = centre.y.atan2(centre.x);
    let (mut sum, mut count) = (0.0, 0usize);
    for k in 0..AROUND {
        // A little more than half of it: beside the subject the far edge shows too.
        let angle = towards + (k as f64 / (AROUND - 1) as f64 - 0.5) * 4.0;
        let (sin, cos) = angle.sin_cos();
        let at = camera.project(&Point3::new(radius * cos, radius * sin, height))?;
        let ahead = camera.project(&Point3::from(
            Vector3::new(radius * cos, radius * sin, height)
                + Vector3::new(-sin, cos, 0.0) * (radius * 0.01),
        ))?;
        let along = Vector2::new(ahead.x - at.x, ahead.y - at.y).try_normalize(1e-9)?;
        let across = Vector2::new(along.y, -along.x);
        let value = |s: f64| light(gray, at.x + across.x * s, at.y + across.y * s);
        if let (Some(out), Some(inside)) = (value(1.5), value(-1.5)) {
            sum += out - inside;
            count += 1;
        }
    }
    (count > AROUND * 2 / 3).then(|| (sum / count as f64).abs())
}

/// Brightness between pixels.
fn light(gray: &Gray, x: f64, y: f64) -> Option<f64> {
    if x < 0.0 || y < 0.0 || x >= gray.width as f64 - 1.0 || y >= gray.height as f64 - 1.0 {
        return None;
    }
    let (x0, y0) = (x as usize, y as usize);
    let (fx, fy) = (x - x0 as f64, y - y0 as f64);
    let at = |dx: usize, dy: usize| f64::from(gray.at(x0 + dx, y0 + dy));
    let top = at(0, 0) + fx * (at(1, 0) - at(0, 0));
    let bottom = at(0, 1) + fx * (at(1, 1) - at(0, 1));
    Some(top + fy * (bottom - top))
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Rotation3;
    use shape::{Intrinsics, Pose};

    #[test]
    fn a_bright_disk_on_a_dark_floor_is_found() {
        let camera = Camera {
            lens: Intrinsics::simple(400, 300, 500.0),
            pose: Pose {
                rotation: Rotation3::from_euler_angles(2.0, 0.0, 0.0),
                translation: Vector3::new(5.0, 60.0, 1000.0),
            },
        };
        let mut gray = Gray::filled(400, 300, 0.0);
        for y in 0..300 {
            for x in 0..400 {
                let ray = camera.ray([x as f64, y as f64].into());
                let c = camera.centre();
                let at = c + *ray * ((-40.0 - c.z) / ray.z);
                let lit = at.x.hypot(at.y) < 210.0;
                *gray.at_mut(x, y) = if lit { 180.0 } else { 60.0 };
            }
        }
        let found = disk_edge(&gray, &camera, [-150.0, 80.0], [100.0, 300.0]).unwrap();
        proof::near(found.radius, 210.0, 2.0);
        proof::near(found.height, -40.0, 3.0);
    }
}
