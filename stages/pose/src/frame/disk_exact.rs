//! A disk's edge to a part of a pixel: a circle that was found nearly, laid on the edges of profiles across it.

use crate::frame::edge_profile::{BANDS_PX, EDGES_PX, Profile};
use nalgebra::{Matrix3, Point3, Vector2, Vector3};
use shape::{Camera, Gray};

/// How far outwards profiles reach: over the widest band that is tried (structural: samples). \[px\]
const OUTWARDS_PX: f64 = BANDS_PX[1];
/// How far inwards profiles reach: as much before the innermost edge that is tried as that is off (structural: samples).
/// \[px\]
const INWARDS_PX: f64 = -2.0 * EDGES_PX[0];
/// Step of a profile (structural: samples).
const STEP: f64 = 0.25;
/// Arcs around the edge, each of which has a profile (structural: samples).
const ARCS: usize = 16;
/// Lines across each arc, of which the mean is its profile (structural: samples).
const LINES: usize = 12;
/// Fewest arcs that show an edge: half of them (derived).
const LEAST_ARCS: usize = ARCS / 2;
/// Rounds of circle and profiles (structural: the second hardly changes it).
const ROUNDS: usize = 3;
/// How far to both sides of an edge it is looked whether it grows brighter. By hand: looked at six captures: halved, no
/// more than chance; doubled, size +0.78 % for one (docs/lab/numbers.md). \[px\]
pub(super) const NEAR: f64 = 1.5;
/// Least standard deviation of an arc's edge. By hand: looked at six captures, halved and doubled: no more than chance
/// (docs/lab/numbers.md). \[px\]
const LEAST_SIGMA_PX: f64 = 0.1;

/// A rim: its height, its radius, and how far its middle is aside of the axis, to the left of who looks from the camera. Cameras
/// know their axis by who turns about it, and who sways moves it.
pub(super) type Rim = Vector3<f64>;

/// An arc of the circle: light across it, outwards, and by how much it would move there were the rim higher, wider and farther
/// aside by one.
struct Arc {
    far: bool,
    profile: Profile,
    by: Rim,
}

/// How far outwards of an arc its edge is \[px\], and the same three.
type Edge = (f64, Rim);

/// A rim laid on its edge, in light as the near side shows it and as the far one does. `None` where too little of it shows one.
pub(crate) fn exact(light: &[Gray; 2], camera: &Camera, mut rim: Rim) -> Option<Rim> {
    for _ in 0..ROUNDS {
        let arcs: Vec<Arc> = (0..ARCS)
            .filter_map(|k| arc(light, camera, &rim, k))
            .collect();
        let brighter = [false, true].map(|far| {
            let of = arcs.iter().filter(|a| a.far == far);
            of.map(|a| a.profile.change(NEAR)).sum::<f64>() > 0.0
        });
        let edge = |a: &Arc| Some((a.profile.edge(brighter[usize::from(a.far)])?, a.by));
        let edges: Vec<Edge> = arcs.iter().filter_map(edge).collect();
        if edges.len() < LEAST_ARCS {
            return None;
        }
        rim += laid(&edges)?;
    }
    Some(rim)
}

/// Which way is aside: to the left of who looks from the camera at the axis.
pub(super) fn aside(camera: &Camera) -> Vector3<f64> {
    let centre = camera.centre();
    let away = libm::hypot(centre.x, centre.y);
    Vector3::new(centre.y, -centre.x, 0.0) / away
}

/// The part of an edge whose place is looked at, a little more than the half towards the camera: beside the subject the far edge
/// shows, too, and is nearly level at its farthest (structural: samples). \[rad\]
const PART_RAD: f64 = 4.0;

/// The angle about the axis at a share of a part of an edge that is towards the camera.
pub(super) fn angle(camera: &Camera, share: f64, part_rad: f64) -> f64 {
    let centre = camera.centre();
    libm::atan2(centre.y, centre.x) + (share - 0.5) * part_rad
}

/// Whether an edge at an angle is on the far side of a disk, whose own side is hidden behind it.
pub(super) fn is_far(camera: &Camera, radius: f64, angle: f64) -> bool {
    let (sin, cos) = libm::sincos(angle);
    let centre = camera.centre();
    centre.x * cos + centre.y * sin < radius
}

/// One arc of the part that is looked at.
fn arc(light: &[Gray; 2], camera: &Camera, rim: &Rim, k: usize) -> Option<Arc> {
    let count = ((OUTWARDS_PX + INWARDS_PX) / STEP) as usize + 1;
    let mut profile = Profile {
        first: -INWARDS_PX,
        step: STEP,
        light: vec![0.0; count],
    };
    let (mut by, left) = (Rim::zeros(), aside(camera));
    let small = 0.01 * rim.y;
    let middle = (k as f64 + 0.5) / ARCS as f64;
    let far = is_far(camera, rim.y, angle(camera, middle, PART_RAD));
    let gray = &light[usize::from(far)];
    for line in 0..LINES {
        let place = (k * LINES + line) as f64 / (ARCS * LINES - 1) as f64;
        let angle = angle(camera, place, PART_RAD);
        let project = |rim: Rim, turn: f64| {
            let (sin, cos) = libm::sincos(angle + turn);
            camera.project(&(Point3::new(rim.y * cos, rim.y * sin, rim.x) + left * rim.z))
        };
        let at = project(*rim, 0.0)?;
        let along = (project(*rim, 0.01)? - at).try_normalize(1e-9)?;
        let [higher, wider, farther] =
            [Rim::x(), Rim::y(), Rim::z()].map(|one| project(rim + one * small, 0.0));
        let [higher, wider, farther] = [higher?, wider?, farther?].map(|to| (to - at) / small);
        let across = Vector2::new(along.y, -along.x);
        let across = across * across.dot(&wider).signum();
        by += Rim::new(
            across.dot(&higher),
            across.dot(&wider),
            across.dot(&farther),
        );
        for (i, sum) in profile.light.iter_mut().enumerate() {
            let px = at + across * (i as f64 * STEP - INWARDS_PX);
            let [w, h] = [gray.width, gray.height].map(|n| n as f64 - 1.0);
            if !((0.0..w).contains(&px.x) && (0.0..h).contains(&px.y)) {
                return None;
            }
            *sum += f64::from(gray.sample(px.x as f32, px.y as f32)) / LINES as f64;
        }
    }
    by /= LINES as f64;
    Some(Arc { far, profile, by })
}

/// How much higher, wider and farther aside the rim is best; edges that are far off count little (Tukey).
fn laid(edges: &[Edge]) -> Option<Rim> {
    let mut more = Rim::zeros();
    for _ in 0..10 {
        let off = |(off, by): &Edge| off - by.dot(&more);
        let far = shape::upper_median(edges.iter().map(|e| off(e).abs())).unwrap_or_default();
        let bound = 4.685 * (far / 0.6745).max(LEAST_SIGMA_PX);
        let (mut normal, mut right) = (Matrix3::zeros(), Rim::zeros());
        for edge in edges {
            let u = off(edge) / bound;
            let weight = (1.0 - u * u).max(0.0) * (1.0 - u * u).max(0.0);
            normal += edge.1 * edge.1.transpose() * weight;
            right += edge.1 * (weight * edge.0);
        }
        more = normal.cholesky()?.solve(&right);
    }
    Some(more)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Rotation3;
    use shape::{Intrinsics, Pose};

    /// A camera, and what it sees: a disk of radius 210 with a white band within its edge, blurred in light.
    fn seen(blur_px: f64) -> (Camera, Gray) {
        let camera = Camera {
            lens: Intrinsics::simple(400, 300, 420.0),
            pose: Pose {
                rotation: Rotation3::from_euler_angles(2.3, 0.0, 0.0),
                translation: Vector3::new(5.0, 20.0, 1000.0),
            },
        };
        let centre = camera.centre();
        let shown = |x: f64, y: f64| {
            let ray = camera.ray([x, y].into());
            let at = centre + *ray * ((-40.0 - centre.z) / ray.z);
            match libm::hypot(at.x, at.y) {
                r if r < 204.0 => 75.0,
                r if r < 210.0 => 230.0,
                _ => 30.0,
            }
        };
        // Nine rays a pixel and the blur, in one: places around it, weighed.
        let places: Vec<(f64, f64, f64)> = (-12..=12)
            .flat_map(|i| (-12..=12).map(move |j| (f64::from(i) / 3.0, f64::from(j) / 3.0)))
            .map(|(x, y)| {
                (
                    x,
                    y,
                    libm::exp(-0.5 * (x * x + y * y) / (blur_px * blur_px)),
                )
            })
            .filter(|p| p.2 > 1e-3)
            .collect();
        let all: f64 = places.iter().map(|p| p.2).sum();
        let mut gray = Gray::filled(400, 300, 0.0);
        for (i, to) in gray.data.iter_mut().enumerate() {
            let (x, y) = ((i % 400) as f64, (i / 400) as f64);
            let sum = places.iter().map(|(dx, dy, w)| w * shown(x + dx, y + dy));
            *to = (sum.sum::<f64>() / all) as f32;
        }
        (camera, gray)
    }

    #[test]
    fn a_disk_is_as_wide_however_sharp_its_edge_shows() {
        // A pixel is 2.4 mm.
        let radius = |blur| {
            let (camera, gray) = seen(blur);
            let rim = exact(&[gray.clone(), gray], &camera, Rim::new(-39.0, 212.0, 1.0)).unwrap();
            proof::near(rim.x, -40.0, 1.5);
            proof::near(rim.y, 210.0, 0.5);
            proof::near(rim.z, 0.0, 0.3);
            rim.y
        };
        proof::near(radius(0.4), radius(1.2), 0.4);
    }
}
