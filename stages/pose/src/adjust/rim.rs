//! Tags on the disk's rim: where their corners are, and what gluing leaves open.
//!
//! A strip of paper bent around a disk is a cylinder; widths stay, as arcs. What is known are the
//! sizes of its tags; where each is glued is not asked. Open are, for all tags, the cylinder's
//! radius and middle and how much taller than wide a printer made them, and, for each tag, where
//! along the rim and how deep it sits.

use nalgebra::{Matrix3xX, Point3, Vector2};
use shape::{Camera, Rim};

/// Open numbers that all tags share: radius \[mm\], middle x and y \[mm\], height over width less one (structural).
pub(crate) const SHARED: usize = 4;
/// Open numbers of each tag: along the rim \[mm\], down \[mm\] (structural).
const OWN: usize = 2;

/// What is believed of the open numbers: standard deviations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct RimBelief {
    /// Of radius and middle. \[mm\]
    pub(crate) round_mm: f64,
    /// Of height over width.
    pub(crate) stretch: f64,
    /// Of where a tag sits. \[mm\]
    pub(crate) glue_mm: f64,
}

/// Tags on a rim that are seen, as they are now.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct OnRim {
    rim: Rim,
    /// The scene's point that is the first corner of the first tag; four a tag follow.
    pub(crate) first: usize,
    /// Each tag's angle about the axis and its middle's height, before its own open numbers. \[rad, mm\]
    middles: Vec<[f64; 2]>,
    /// The open numbers: shared ones, then two a tag; 0 for what is believed.
    open: Vec<f64>,
}

impl OnRim {
    /// Tags whose middles are at about these angles and heights. \[rad, mm\]
    pub(crate) fn new(rim: &Rim, first: usize, middles: Vec<[f64; 2]>) -> Self {
        let open = vec![0.0; SHARED + OWN * middles.len()];
        OnRim {
            rim: *rim,
            first,
            middles,
            open,
        }
    }

    /// How many numbers are open.
    pub(crate) fn unknowns(&self) -> usize {
        self.open.len()
    }

    /// The open numbers, in multiples of what is believed of each, and that.
    pub(crate) fn beliefs(&self, b: &RimBelief) -> impl Iterator<Item = (f64, f64)> {
        let sigma = move |i: usize| match i {
            0..=2 => b.round_mm,
            3 => b.stretch,
            _ => b.glue_mm,
        };
        let open = self.open.clone().into_iter().enumerate();
        open.map(move |(i, v)| (v, sigma(i)))
    }

    /// After a step of the open numbers.
    pub(crate) fn moved(&self, step: &[f64]) -> OnRim {
        let open = self.open.iter().zip(step).map(|(a, b)| a + b).collect();
        OnRim {
            open,
            ..self.clone()
        }
    }

    /// All corners: top left, top right, bottom right, bottom left of each tag. \[mm\]
    pub(crate) fn corners(&self) -> Vec<Point3<f64>> {
        (0..4 * self.middles.len()).map(|i| self.at(i)).collect()
    }

    /// Share of a tag's width, and of its height, at a corner; from its middle.
    fn place(corner: usize) -> [f64; 2] {
        [[-0.5, 0.5], [0.5, 0.5], [0.5, -0.5], [-0.5, -0.5]][corner % 4]
    }

    /// A point of a tag: how far along its width and height from its middle.
    fn point(&self, tag: usize, [along, up]: [f64; 2]) -> Point3<f64> {
        let [out, x, y, stretch] = [0, 1, 2, 3].map(|i| self.open[i]);
        let own = SHARED + OWN * tag;
        let (sin, cos) = libm::sincos(self.angle(tag, along));
        let r = self.rim.radius_mm + out;
        let z = self.middles[tag][1] - self.open[own + 1] + up * self.rim.tag_mm * (1.0 + stretch);
        Point3::new(x + r * cos, y + r * sin, z)
    }

    fn angle(&self, tag: usize, along: f64) -> f64 {
        let arc = self.open[SHARED + OWN * tag] + along * self.rim.tag_mm;
        self.middles[tag][0] + arc / self.rim.radius_mm
    }

    fn at(&self, i: usize) -> Point3<f64> {
        self.point(i / 4, Self::place(i))
    }

    /// Which open numbers move a corner, and its derivative by them.
    pub(crate) fn by_open(&self, i: usize) -> ([usize; SHARED + OWN], Matrix3xX<f64>) {
        let (tag, [along, up]) = (i / 4, Self::place(i));
        let own = SHARED + OWN * tag;
        let (sin, cos) = libm::sincos(self.angle(tag, along));
        let around = (self.rim.radius_mm + self.open[0]) / self.rim.radius_mm;
        let mut d = Matrix3xX::zeros(SHARED + OWN);
        (d[(0, 0)], d[(1, 0)]) = (cos, sin);
        (d[(0, 1)], d[(1, 2)]) = (1.0, 1.0);
        d[(2, 3)] = up * self.rim.tag_mm;
        (d[(0, 4)], d[(1, 4)]) = (-around * sin, around * cos);
        d[(2, 5)] = -1.0;
        ([0, 1, 2, 3, own, own + 1], d)
    }
}

/// The angle at which a ray through a pixel meets a cylinder about the axis, on the side of the
/// camera, and at which height. \[rad, mm\]
pub(crate) fn met(camera: &Camera, px: [f64; 2], radius: f64) -> Option<(f64, f64)> {
    let p = camera.lens.undistort(px.into());
    let from = camera.centre();
    let ray = camera.pose.rotation.inverse() * nalgebra::Vector3::new(p.x, p.y, 1.0);
    let a = ray.x * ray.x + ray.y * ray.y;
    let b = from.x * ray.x + from.y * ray.y;
    let c = from.x * from.x + from.y * from.y - radius * radius;
    let under = b * b - a * c;
    if under <= 0.0 || a <= 0.0 {
        return None;
    }
    let at = from + ray * ((-b - under.sqrt()) / a);
    Some((libm::atan2(at.y, at.x), at.z))
}

/// By how much corners are seen away from where they are, because straight lines are laid through
/// sides that are arcs: each corner that lines through the middle four fifths of its sides would
/// give, less the corner itself. \[px\] `None` for a tag behind the camera.
pub(crate) fn straightened(eye: &Camera, on_rim: &OnRim, tag: usize) -> Option<[Vector2<f64>; 4]> {
    let see = |place: [f64; 2]| eye.project(&on_rim.point(tag, place)).map(|p| p.coords);
    let corner = |i: usize| see(OnRim::place(i));
    let corners = [corner(0)?, corner(1)?, corner(2)?, corner(3)?];
    // How far the line of least squares is beside the chord, upper and lower side.
    let mut beside = [Vector2::zeros(); 2];
    for (side, up) in [0.5, -0.5].into_iter().enumerate() {
        let (a, b) = (see([-0.5, up])?, see([0.5, up])?);
        // Points of a side (structural: samples).
        const COUNT: i32 = 9;
        for k in 0..COUNT {
            let along = -0.4 + 0.8 * (f64::from(k) + 0.5) / f64::from(COUNT);
            beside[side] += (see([along, up])? - a.lerp(&b, along + 0.5)) / f64::from(COUNT);
        }
    }
    let cross = |a: Vector2<f64>, b: Vector2<f64>| a.x * b.y - a.y * b.x;
    let mut off = [Vector2::zeros(); 4];
    for (i, to) in off.iter_mut().enumerate() {
        // Along the upright side, to where it meets the line.
        let upright = corners[3 - i] - corners[i];
        let across = match i {
            0 | 1 => corners[1] - corners[0],
            _ => corners[2] - corners[3],
        };
        *to = upright * (cross(beside[i / 2], across) / cross(upright, across));
    }
    Some(off)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn on_rim() -> OnRim {
        let rim = Rim {
            tag_mm: 24.0,
            first_id: 12,
            count: 40,
            radius_mm: 225.0,
        };
        OnRim::new(&rim, 0, vec![[0.3, -15.0], [1.1, -15.0]])
    }

    #[test]
    fn corners_run_around_as_printed_and_their_arcs_are_as_long() {
        let c = on_rim().corners();
        assert!((c[0].z + 3.0).abs() < 1e-12 && (c[2].z + 27.0).abs() < 1e-12);
        let angle = |p: &Point3<f64>| libm::atan2(p.y, p.x);
        // From outside, what is further to the right is further counter-clockwise.
        proof::near((angle(&c[1]) - angle(&c[0])) * 225.0, 24.0, 1e-9);
        proof::near(angle(&c[4]) + angle(&c[5]), 2.2, 1e-12);
    }

    #[test]
    fn derivatives_by_open_numbers_are_those_of_the_corners() {
        let place = on_rim().moved(&[0.4, -0.3, 0.2, 0.002, 1.0, -0.5, 0.1, 0.2]);
        for corner in 0..8 {
            let (which, d) = place.by_open(corner);
            for (k, open) in which.into_iter().enumerate() {
                let with = |by: f64| {
                    let mut step = vec![0.0; place.unknowns()];
                    step[open] = by;
                    place.moved(&step).at(corner)
                };
                let slope = (with(1e-4) - with(-1e-4)) / 2e-4;
                assert!((slope - d.column(k)).norm() < 1e-6, "{corner} {open}");
            }
        }
    }
}
