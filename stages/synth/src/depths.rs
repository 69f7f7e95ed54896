//! What is nearest to a light along one direction, on a grid: a shadow map (Williams 1978).

use nalgebra::{Point3, Vector3};

/// Cells of a map of depths along its longer side (structural: some 6 mm of a person).
pub(crate) const CELLS: f64 = 320.0;

/// Two unit vectors that are square to one and to each other.
pub(crate) fn beside(along: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>) {
    let other = if along.z.abs() < 0.9 {
        Vector3::z()
    } else {
        Vector3::x()
    };
    let right = other.cross(along).normalize();
    (right, along.cross(&right))
}

/// The nearest things to the light along one direction, by cells square to it.
pub(crate) struct Depths {
    /// The direction, of unit length.
    pub(crate) towards: Vector3<f64>,
    right: Vector3<f64>,
    up: Vector3<f64>,
    /// Middle of the first cell. \[mm\]
    low: [f64; 2],
    /// Cells per millimetre.
    fine: f64,
    width: usize,
    height: usize,
    nearest: Vec<f32>,
}

impl Depths {
    /// Of faces between points, along a unit vector.
    pub(crate) fn of(points: &[Point3<f64>], faces: &[[u32; 3]], towards: Vector3<f64>) -> Depths {
        let (right, up) = beside(&towards);
        let flat = |p: &Point3<f64>| [right, up, towards].map(|axis| axis.dot(&p.coords));
        let placed: Vec<[f64; 3]> = points.iter().map(flat).collect();
        let end = |k: usize, from: f64, of: fn(f64, f64) -> f64| {
            placed.iter().map(|p| p[k]).fold(from, of)
        };
        let [low, high] = [
            [0, 1].map(|k| end(k, f64::MAX, f64::min)),
            [0, 1].map(|k| end(k, f64::MIN, f64::max)),
        ];
        let size = (high[0] - low[0]).max(high[1] - low[1]).max(1e-9);
        let fine = CELLS / size;
        let [width, height] = [0, 1].map(|k| ((high[k] - low[k]).max(0.0) * fine) as usize + 3);
        let mut depths = Depths {
            towards,
            right,
            up,
            low: low.map(|x| x - 1.0 / fine),
            fine,
            width,
            height,
            nearest: vec![f32::MIN; width * height],
        };
        for face in faces {
            depths.add(face.map(|v| placed[v as usize]));
        }
        depths
    }

    /// A triangle: its corners right, up and towards the light. \[mm\]
    fn add(&mut self, corners: [[f64; 3]; 3]) {
        let [a, b, c] = corners.map(|p| [self.cell(p[0], 0), self.cell(p[1], 1), p[2]]);
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
        if area == 0.0 {
            return;
        }
        let range = |k: usize, cells: usize| {
            let (low, high) = (a[k].min(b[k]).min(c[k]), a[k].max(b[k]).max(c[k]));
            (low.ceil().max(0.0) as usize)..=(high.floor().max(0.0) as usize).min(cells - 1)
        };
        for y in range(1, self.height) {
            for x in range(0, self.width) {
                let (px, py) = (x as f64, y as f64);
                let part = |p: [f64; 3], q: [f64; 3]| {
                    ((p[0] - px) * (q[1] - py) - (q[0] - px) * (p[1] - py)) / area
                };
                let (u, v) = (part(b, c), part(c, a));
                let w = 1.0 - u - v;
                if u.min(v).min(w) < -1e-9 {
                    continue;
                }
                let depth = u * a[2] + v * b[2] + w * c[2];
                let at = &mut self.nearest[y * self.width + x];
                *at = at.max(depth as f32);
            }
        }
    }

    fn cell(&self, mm: f64, axis: usize) -> f64 {
        (mm - self.low[axis]) * self.fine
    }

    /// How free the way to the light is, from 0 to 1, from a place.
    pub(crate) fn free(&self, at: &Point3<f64>, slack: f64) -> f64 {
        let x = self.cell(self.right.dot(&at.coords), 0);
        let y = self.cell(self.up.dot(&at.coords), 1);
        let outside = x < 0.0 || y < 0.0;
        if outside || x >= (self.width - 1) as f64 || y >= (self.height - 1) as f64 {
            return 1.0;
        }
        let deep = self.towards.dot(&at.coords) + slack;
        let (i, j) = (x as usize, y as usize);
        let (u, v) = (x - i as f64, y - j as f64);
        let one = |dx: usize, dy: usize| {
            let before = f64::from(self.nearest[(j + dy) * self.width + i + dx]) > deep;
            if before { 0.0 } else { 1.0 }
        };
        let row = |dy: usize| (1.0 - u) * one(0, dy) + u * one(1, dy);
        (1.0 - v) * row(0) + v * row(1)
    }
}
