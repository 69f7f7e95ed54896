//! Light of a lamp or a window and from all sides, and what a body and a disk keep of it from a place.

use crate::depths::{CELLS, Depths, beside};
use crate::disk::Disk;
use nalgebra::{Point3, Rotation3, Vector3};
use shape::{Mesh, Pose};
use std::f64::consts::{PI, TAU};

/// Directions that the lamp's face is seen in (structural: what is made).
const LAMP_DIRECTIONS: usize = 24;
/// Directions of the light from all sides (structural: what is made).
const ALL_DIRECTIONS: usize = 96;
/// Corners of the circle that a disk throws its shadow by (structural: a circle to 0.1 %).
const CORNERS: u32 = 96;
/// How much of the lamp's light a surface that faces it gets; as without shadows (structural: what is made).
pub(crate) const FACING: f64 = 1.25;

/// Where a lamp is, seen from the body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Lamp {
    /// How far to the right of the camera. \[rad\]
    pub(crate) right: f64,
    /// How far above the horizon. \[rad\]
    pub(crate) up: f64,
    /// Radius of its face. \[rad\]
    pub(crate) radius: f64,
}

impl Lamp {
    /// Unit vectors towards its face, in axes in which the camera is at -y.
    fn directions(&self) -> Vec<Vector3<f64>> {
        let (across, high) = (libm::sincos(self.right), libm::sincos(self.up));
        let middle = Vector3::new(across.0 * high.1, -across.1 * high.1, high.0);
        let (right, up) = beside(&middle);
        let one = |k: usize| {
            let far = self.radius * ((k as f64 + 0.5) / LAMP_DIRECTIONS as f64).sqrt();
            let (sin, cos) = libm::sincos(k as f64 * golden());
            (middle + libm::tan(far) * (cos * right + sin * up)).normalize()
        };
        (0..LAMP_DIRECTIONS).map(one).collect()
    }
}

/// Directions from all sides, evenly.
fn all_around() -> Vec<Vector3<f64>> {
    let one = |k: usize| {
        let z = 1.0 - (2 * k + 1) as f64 / ALL_DIRECTIONS as f64;
        let (sin, cos) = libm::sincos(k as f64 * golden());
        let flat = (1.0 - z * z).sqrt();
        Vector3::new(flat * cos, flat * sin, z)
    };
    (0..ALL_DIRECTIONS).map(one).collect()
}

/// The golden angle: a spiral with it leaves no gaps (Vogel 1979). \[rad\]
fn golden() -> f64 {
    PI * (3.0 - 5f64.sqrt())
}

/// What is before the light in one photo's world.
pub(crate) struct Shade {
    lamp: Vec<Depths>,
    around: Vec<Depths>,
    /// The share of light that comes from all sides.
    ambient: f64,
    /// Points so near to what is before the light are that themselves. \[mm\]
    slack: f64,
}

impl Shade {
    /// Of a body, as it is in the photo's world, and a disk; `to_world` turns axes in which the camera is at -y into those.
    pub(crate) fn of(
        lamp: &Lamp,
        ambient: f64,
        body: Option<&Mesh>,
        disk: Option<&Disk>,
        to_world: &Rotation3<f64>,
    ) -> Shade {
        let mut points = Vec::new();
        let mut faces = Vec::new();
        if let Some(mesh) = body {
            points.extend((0..mesh.positions.len() as u32).map(|v| mesh.point(v)));
            faces.extend_from_slice(&mesh.faces);
        }
        if let Some(disk) = disk {
            let first = points.len() as u32;
            points.push(Point3::origin());
            for k in 0..CORNERS {
                let (sin, cos) = libm::sincos(f64::from(k) * TAU / f64::from(CORNERS));
                points.push(Point3::new(disk.radius * cos, disk.radius * sin, 0.0));
                faces.push([first, first + 1 + k, first + 1 + (k + 1) % CORNERS]);
            }
        }
        let far = points.iter().map(|p| p.coords.norm()).fold(0.0, f64::max);
        let map = |d: Vector3<f64>| Depths::of(&points, &faces, to_world * d);
        Shade {
            lamp: lamp.directions().into_iter().map(map).collect(),
            around: all_around().into_iter().map(map).collect(),
            ambient,
            slack: 2.5 * far / CELLS,
        }
    }

    /// The light that a place with a unit normal gets; 1 is the light of all sides together where nothing is before it.
    pub(crate) fn light(&self, at: &Point3<f64>, normal: &Vector3<f64>) -> f64 {
        self.mixed(|maps| self.seen(maps, at, normal))
    }

    /// The same as a share of what it would get if nothing were before the light.
    pub(crate) fn share(&self, at: &Point3<f64>, normal: &Vector3<f64>) -> f64 {
        let facing = |m: &Depths| m.towards.dot(normal).max(0.0);
        let free = self.mixed(|maps| maps.iter().map(facing).sum());
        if free > 0.0 {
            self.light(at, normal) / free
        } else {
            1.0
        }
    }

    /// Light from all sides and the lamp's together, from sums over the directions of each.
    fn mixed(&self, sum: impl Fn(&[Depths]) -> f64) -> f64 {
        let [around, lamp] = [&self.around, &self.lamp].map(|maps| sum(maps));
        let all = ALL_DIRECTIONS as f64 / 4.0;
        self.ambient * around / all + (1.0 - self.ambient) * FACING * lamp / LAMP_DIRECTIONS as f64
    }

    fn seen(&self, maps: &[Depths], at: &Point3<f64>, normal: &Vector3<f64>) -> f64 {
        let off = at + normal * self.slack;
        let one = |m: &Depths| {
            let facing = m.towards.dot(normal);
            if facing > 0.0 {
                facing * m.free(&off, self.slack)
            } else {
                0.0
            }
        };
        maps.iter().map(one).sum()
    }
}

/// A body as a photo's world has it.
pub(crate) fn moved(mesh: &Mesh, motion: Option<&Pose>) -> Mesh {
    let Some(motion) = motion else {
        return mesh.clone();
    };
    let mut moved = mesh.clone();
    for v in 0..mesh.positions.len() as u32 {
        moved.positions[v as usize] = motion.apply(&mesh.point(v)).map(|x| x as f32).into();
    }
    moved
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A plate of 1 m, 500 mm above the ground.
    fn plate() -> Mesh {
        let at = |x: f32, y: f32| [x, y, 500.0];
        Mesh {
            positions: vec![
                at(-500.0, -500.0),
                at(500.0, -500.0),
                at(500.0, 500.0),
                at(-500.0, 500.0),
            ],
            faces: vec![[0, 1, 2], [0, 2, 3]],
            ..Mesh::default()
        }
    }

    fn shade(up: f64, ambient: f64) -> Shade {
        let lamp = Lamp {
            right: 90f64.to_radians(),
            up: up.to_radians(),
            radius: 0.01,
        };
        let same = Rotation3::identity();
        Shade::of(&lamp, ambient, Some(&plate()), None, &same)
    }

    #[test]
    fn a_shadow_falls_away_from_the_lamp_as_far_as_the_lamp_is_low() {
        let shade = shade(45.0, 0.0);
        let at = |x: f64| shade.share(&Point3::new(x, 0.0, 0.0), &Vector3::z());
        for (x, want) in [
            (-1100.0, 1.0),
            (-950.0, 0.0),
            (-500.0, 0.0),
            (-50.0, 0.0),
            (100.0, 1.0),
        ] {
            assert!((at(x) - want).abs() < 1e-9, "{x}: {}", at(x));
        }
        let top = shade.light(&Point3::new(0.0, 0.0, 500.0), &Vector3::z());
        assert!(
            (top / (FACING * 0.5f64.sqrt()) - 1.0).abs() < 0.02,
            "its own top: {top}"
        );
    }

    #[test]
    fn light_from_all_sides_is_kept_off_as_much_as_the_view_of_it_is() {
        let shade = shade(45.0, 1.0);
        let at = |z: f64| shade.light(&Point3::new(0.0, 0.0, z), &Vector3::z());
        // A square's share of the view of a point below its middle (Howell, A catalog of radiation heat transfer, B-4).
        let share = |gap: f64| {
            let a = 500.0 / gap;
            let root = (1.0f64 + a * a).sqrt();
            4.0 / TAU * 2.0 * (a / root) * libm::atan(a / root)
        };
        for gap in [250.0, 500.0, 1000.0] {
            let (is, want) = (at(500.0 - gap), 1.0 - share(gap));
            assert!((is - want).abs() < 0.03, "{gap}: {is} {want}");
        }
        let up = shade.light(&Point3::new(0.0, 0.0, 500.0), &Vector3::z());
        assert!((up - 1.0).abs() < 0.01, "its own top: {up}");
    }
}
