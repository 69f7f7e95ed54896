//! The disk that turns, with a marker mat or plain wood on it, as a formula of the place.

use crate::drawn::Palette;
use crate::noise::{chance, octaves};
use nalgebra::{Point3, Vector3};
use shape::tag36h11::modules;
use shape::{Mat, Rim};

/// How much light paper gives back (structural: what is made).
const PAPER_ALBEDO: f32 = 0.8;

/// A disk: its top is z = 0, its axis is z. \[mm\]
#[derive(Debug, Clone, Copy)]
pub(crate) struct Disk {
    /// Its radius.
    pub(crate) radius: f64,
    /// How thick it is.
    pub(crate) thick: f64,
    /// What is on it.
    pub(crate) mat: Option<Mat>,
    /// What is glued around its rim.
    pub(crate) rim: Option<Rim>,
    /// Which of all such disks.
    pub(crate) seed: u32,
    /// How it looks without a mat, and what it then mirrors.
    pub(crate) palette: Palette,
}

/// The mat for a disk: tags as large as leave the ring its white margins.
pub(crate) fn mat_for(radius: f64) -> Mat {
    Mat {
        tag_mm: (0.2 * radius).round(),
        first_id: 0,
        count: 16,
        ring_mm: (0.83 * radius).round(),
    }
}

/// The strip for a disk's rim.
pub(crate) fn rim_for(radius: f64, mat: &Mat) -> Rim {
    Rim {
        tag_mm: (0.12 * radius).round(),
        first_id: mat.first_id + mat.count,
        count: 40,
        radius_mm: radius,
    }
}

impl Disk {
    /// The colour that a ray meets on the disk, linear; `None` where it misses.
    pub(crate) fn color(
        &self,
        from: &Point3<f64>,
        along: &Vector3<f64>,
        spread: f64,
    ) -> Option<[f32; 3]> {
        if let Some((t, hit)) = self.top_met(from, along) {
            return Some(self.top(hit.x, hit.y, (t * spread) as f32));
        }
        let (t, hit) = self.rim_met(from, along)?;
        // The strip is as tall as a tag with a margin of an eighth at either side.
        if let Some(rim) = self.rim.filter(|rim| -hit.z < 1.25 * rim.tag_mm) {
            let ink = in_rim_tag(&rim, libm::atan2(hit.y, hit.x), -hit.z);
            return Some([if ink { 0.02 } else { PAPER_ALBEDO }; 3]);
        }
        let at = hit.coords.map(|x| x as f32).into();
        let grain = octaves(at, 40.0, 5.0, (t * spread) as f32, self.seed + 21);
        Some([0.05 * (1.0 + 0.3 * grain); 3])
    }

    /// Where a ray meets its top or its rim, and the normal there.
    pub(crate) fn met(
        &self,
        from: &Point3<f64>,
        along: &Vector3<f64>,
    ) -> Option<(Point3<f64>, Vector3<f64>)> {
        let top = self
            .top_met(from, along)
            .map(|(_, hit)| (hit, Vector3::z()));
        top.or_else(|| {
            let (_, hit) = self.rim_met(from, along)?;
            Some((hit, Vector3::new(hit.x, hit.y, 0.0) / self.radius))
        })
    }

    /// How far along a ray its rim is met, a cylinder about z, and where.
    fn rim_met(&self, from: &Point3<f64>, along: &Vector3<f64>) -> Option<(f64, Point3<f64>)> {
        let a = along.x * along.x + along.y * along.y;
        let b = from.x * along.x + from.y * along.y;
        let c = from.x * from.x + from.y * from.y - self.radius * self.radius;
        let under = b * b - a * c;
        if a == 0.0 || under < 0.0 {
            return None;
        }
        let t = (-b - under.sqrt()) / a;
        let hit = from + along * t;
        (t > 0.0 && (-self.thick..=0.0).contains(&hit.z)).then_some((t, hit))
    }

    /// How far along a ray its top is met, and where.
    pub(crate) fn top_met(
        &self,
        from: &Point3<f64>,
        along: &Vector3<f64>,
    ) -> Option<(f64, Point3<f64>)> {
        let t = -from.z / along.z;
        let hit = from + along * t;
        let within = hit.x * hit.x + hit.y * hit.y <= self.radius * self.radius;
        (along.z < 0.0 && from.z > 0.0 && within).then_some((t, hit))
    }

    fn top(&self, x: f64, y: f64, pixel: f32) -> [f32; 3] {
        let at = [x as f32, y as f32, 0.0];
        let Some(mat) = &self.mat else {
            let grain = octaves([at[0] * 0.15, at[1], 0.0], 60.0, 3.0, pixel, self.seed + 22);
            let Palette {
                disk, gloss, wall, ..
            } = self.palette;
            return [0, 1, 2]
                .map(|c| (1.0 - gloss) * disk[c] * (1.0 + 0.3 * grain) + gloss * wall[c]);
        };
        let ink = if in_tag(mat, x, y) {
            0.02
        } else {
            PAPER_ALBEDO
        };
        let inner = mat.ring_mm - 0.75 * mat.tag_mm;
        let size = (0.035 * self.radius) as f32;
        let cell = [
            (at[0] / size).floor() as i32,
            (at[1] / size).floor() as i32,
            3,
        ];
        let dot = |k: u32| chance(cell, self.seed + 30 + k);
        let middle = [0, 1].map(|i| (cell[i] as f32 + 0.3 + 0.4 * dot(i as u32)) * size);
        let far = libm::hypotf(at[0] - middle[0], at[1] - middle[1]);
        let dotted =
            libm::hypot(x, y) < inner && far < size * (0.12 + 0.17 * dot(2)) && dot(3) < 0.8;
        [if dotted { 0.05 + 0.4 * dot(4) } else { ink }; 3]
    }
}

/// Whether a place on a mat is black of a tag.
fn in_tag(mat: &Mat, x: f64, y: f64) -> bool {
    let step = std::f64::consts::TAU / f64::from(mat.count);
    let i = (libm::atan2(y, x) / step).round();
    let (sin, cos) = libm::sincos(i * step);
    let (out, left) = (x * cos + y * sin - mat.ring_mm, y * cos - x * sin);
    // Printed columns run from the left as one looks outward, rows from the outside inward.
    let module = mat.tag_mm / 8.0;
    let (column, row) = (
        ((mat.tag_mm / 2.0 - left) / module).floor(),
        ((mat.tag_mm / 2.0 - out) / module).floor(),
    );
    let inside = |k: f64| (0.0..8.0).contains(&k);
    let id = mat.first_id + (i as i64).rem_euclid(i64::from(mat.count)) as u32;
    inside(column)
        && inside(row)
        && modules(id).is_some_and(|white| !white[row as usize][column as usize])
}

/// Whether a place on a rim's strip is black of a tag: its angle, and how deep it is. \[rad, mm\]
fn in_rim_tag(rim: &Rim, angle: f64, deep: f64) -> bool {
    let step = std::f64::consts::TAU / f64::from(rim.count);
    let i = (angle / step).round();
    let module = rim.tag_mm / 8.0;
    // From outside, further to the right is further counter-clockwise.
    let column = (((angle - i * step) * rim.radius_mm + rim.tag_mm / 2.0) / module).floor();
    let row = ((deep - module) / module).floor();
    let inside = |k: f64| (0.0..8.0).contains(&k);
    let id = rim.first_id + (i as i64).rem_euclid(i64::from(rim.count)) as u32;
    inside(column)
        && inside(row)
        && modules(id).is_some_and(|white| !white[row as usize][column as usize])
}
