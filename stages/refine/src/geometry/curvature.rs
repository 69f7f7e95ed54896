//! Curvature of a mesh: cotangent Laplacian over mixed areas (Meyer, Desbrun, Schröder and Barr
//! 2003, eq. 8 and fig. 4), and the shape operator.

use nalgebra::{Matrix2, Point3, Vector2, Vector3};
use rayon::prelude::*;
use shape::{Adjacency, Mesh};

/// The cotangent Laplacian as compressed rows: `(Lx)_v = Σ_j weight_vj (x_j − x_v)`. \[1/mm²\]
pub struct Laplacian {
    starts: Vec<u32>,
    columns: Vec<u32>,
    weights: Vec<f64>,
    /// The mixed area around each vertex. \[mm²\]
    pub areas: Vec<f64>,
}

/// What a face gives to one of its corners.
struct Corner {
    /// Cotangent of the angle.
    cot: f64,
    /// The share of the face's mixed area. \[mm²\]
    area: f64,
}

/// What a face gives to its corners.
fn corners(mesh: &Mesh, f: usize) -> [Corner; 3] {
    let corners = mesh.triangle(f);
    let double = mesh.area_vector(f).norm();
    let cot = [0, 1, 2].map(|i| {
        let [a, b, c] = [0, 1, 2].map(|k| corners[(i + k) % 3]);
        ((b - a).dot(&(c - a)) / double.max(1e-12)).clamp(-20.0, 20.0)
    });
    [0, 1, 2].map(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let squared = |p: usize| (corners[i] - corners[p]).norm_squared();
        let area = if cot.iter().all(|c| *c >= 0.0) {
            (squared(j) * cot[k] + squared(k) * cot[j]) / 8.0
        } else if cot[i] < 0.0 {
            double / 4.0
        } else {
            double / 8.0
        };
        Corner { cot: cot[i], area }
    })
}

/// Which corner of a face a vertex is.
fn place(mesh: &Mesh, f: u32, v: u32) -> usize {
    let at = mesh.faces[f as usize].iter().position(|x| *x == v);
    at.expect("bug: adjacency")
}

impl Laplacian {
    /// Of a valid mesh. Cotangents are kept within ±20 and areas above a millionth of the mean,
    /// so that needles do no harm.
    pub fn new(mesh: &Mesh, around: &Adjacency) -> Self {
        let count = mesh.positions.len();
        let faces = (0..mesh.faces.len()).into_par_iter().with_min_len(4096);
        let corners: Vec<[Corner; 3]> = faces.map(|f| corners(mesh, f)).collect();
        // All sums in the order of faces: equal bytes every time.
        let area = |v: u32| -> f64 {
            let faces = around.faces(v).iter();
            let own = faces.map(|f| corners[*f as usize][place(mesh, *f, v)].area);
            own.fold(0.0, |sum, a| sum + a)
        };
        let vertices = || (0..count as u32).into_par_iter().with_min_len(4096);
        let mut areas: Vec<f64> = vertices().map(area).collect();
        let mean = areas.iter().sum::<f64>() / count.max(1) as f64;
        areas
            .iter_mut()
            .for_each(|a| *a = a.max(mean * 1e-6).max(f64::MIN_POSITIVE));
        let mut starts = vec![0; count + 1];
        for v in 0..count {
            starts[v + 1] = starts[v] + around.vertices(v as u32).len() as u32;
        }
        let row = |v: u32| {
            let ring = around.vertices(v);
            let mut weights = vec![0.0; ring.len()];
            for f in around.faces(v) {
                let (face, at) = (mesh.faces[*f as usize], place(mesh, *f, v));
                // Each edge at the vertex is opposite the face's third corner.
                for (to, before) in [(1, 2), (2, 1)] {
                    let j = ring.binary_search(&face[(at + to) % 3]);
                    let cot = corners[*f as usize][(at + before) % 3].cot;
                    weights[j.expect("bug: adjacency")] += cot / 2.0;
                }
            }
            let area = areas[v as usize];
            weights.iter_mut().for_each(|w| *w /= area);
            weights
        };
        Laplacian {
            starts,
            columns: (0..count as u32)
                .flat_map(|v| around.vertices(v))
                .copied()
                .collect(),
            weights: vertices().flat_map_iter(row).collect(),
            areas,
        }
    }

    /// A row: neighbours and their weights.
    #[inline]
    pub fn row(&self, v: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let range = self.places(v);
        let columns = self.columns[range.clone()].iter();
        columns
            .map(|c| *c as usize)
            .zip(self.weights[range].iter().copied())
    }

    /// Where a row's neighbours are among those of all rows.
    #[inline]
    pub fn places(&self, v: usize) -> std::ops::Range<usize> {
        self.starts[v] as usize..self.starts[v + 1] as usize
    }

    /// The neighbours of all rows, one row after the other.
    pub fn columns(&self) -> &[u32] {
        &self.columns
    }

    /// `L x` for vectors: twice the mean curvature times the inward normal, for positions.
    pub fn apply(&self, x: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
        let one = |v: usize| {
            self.row(v)
                .fold(Vector3::zeros(), |sum, (j, w)| sum + (x[j] - x[v]) * w)
        };
        (0..x.len())
            .into_par_iter()
            .with_min_len(4096)
            .map(one)
            .collect()
    }

    /// Mean curvature of each vertex, positive where the surface bulges outward. \[1/mm\]
    pub fn mean_curvature(&self, mesh: &Mesh, normals: &[Vector3<f64>]) -> Vec<f64> {
        let x: Vec<_> = (0..mesh.positions.len() as u32)
            .map(|v| mesh.point(v).coords)
            .collect();
        let laplace = self.apply(&x);
        laplace
            .iter()
            .zip(normals)
            .map(|(l, n)| -0.5 * l.dot(n))
            .collect()
    }
}

/// Two tangents that make a right-handed frame with a unit normal.
pub fn tangents(n: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let axis = if n.z.abs() < 0.9 {
        Vector3::z()
    } else {
        Vector3::x()
    };
    let a = axis.cross(n).normalize();
    [a, n.cross(&a)]
}

/// The shape operator at each vertex in its [`tangents`]: `[l, m, n]` of the height
/// `−½(l u² + 2 m u v + n v²)` over the tangent plane, by least squares over the neighbours'
/// normals. Clamped to `most`. \[1/mm\]
pub fn shape_operators(
    mesh: &Mesh,
    around: &Adjacency,
    normals: &[Vector3<f64>],
    most: f64,
) -> Vec<[f64; 3]> {
    let one = |v: u32| -> [f64; 3] {
        let (x, n): (Point3<f64>, _) = (mesh.point(v), normals[v as usize]);
        if n == Vector3::zeros() {
            return [0.0; 3];
        }
        let [a, b] = tangents(&n);
        // S (u, v)ᵀ = change of the normal; unknowns l, m, n by normal equations.
        let (mut ata, mut atb) = (nalgebra::Matrix3::zeros(), Vector3::zeros());
        for j in around.vertices(v) {
            let d = mesh.point(*j) - x;
            let d = Vector2::new(d.dot(&a), d.dot(&b));
            let change = normals[*j as usize] - n;
            let rows = [Vector3::new(d.x, d.y, 0.0), Vector3::new(0.0, d.x, d.y)];
            for (row, to) in rows.iter().zip([change.dot(&a), change.dot(&b)]) {
                ata += row * row.transpose();
                atb += row * to;
            }
        }
        let Some(inverse) = ata.try_inverse() else {
            return [0.0; 3];
        };
        let s = inverse * atb;
        let size = Matrix2::new(s.x, s.y, s.y, s.z).norm();
        let scale = if size > most { most / size } else { 1.0 };
        if size.is_finite() {
            [s.x * scale, s.y * scale, s.z * scale]
        } else {
            [0.0; 3]
        }
    };
    (0..mesh.positions.len() as u32)
        .into_par_iter()
        .map(one)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::solids::sphere;

    #[test]
    fn a_sphere_of_radius_r_has_mean_curvature_one_over_r_everywhere() {
        let mesh = sphere(50.0, 4);
        let around = Adjacency::new(&mesh);
        let laplacian = Laplacian::new(&mesh, &around);
        for h in laplacian.mean_curvature(&mesh, &mesh.normals()) {
            proof::near(h, 1.0 / 50.0, 0.03 / 50.0);
        }
        let all: f64 = laplacian.areas.iter().sum();
        proof::near(all, 4.0 * std::f64::consts::PI * 2500.0, 0.005 * all);
        for [l, m, n] in shape_operators(&mesh, &around, &mesh.normals(), 1.0) {
            // Normals weighted by uneven faces are a little off: so are their differences.
            proof::near(l, 0.02, 0.0025);
            proof::near(n, 0.02, 0.0025);
            proof::near(m, 0.0, 0.0025);
        }
    }

    #[test]
    fn needles_and_flat_corners_give_finite_numbers() {
        let mut mesh = sphere(50.0, 2);
        mesh.positions[7] = mesh.positions[8];
        let laplacian = Laplacian::new(&mesh, &Adjacency::new(&mesh));
        let curvature = laplacian.mean_curvature(&mesh, &mesh.normals());
        assert!(curvature.iter().all(|h| h.is_finite()));
    }
}
