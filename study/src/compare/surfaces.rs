//! How far two surfaces are apart, at every vertex and in all.

use follow::Closest;
use rayon::prelude::*;
use serde::Serialize;
use shape::Mesh;

/// How far a surface is from the first. Means are over the area. \[mm\]
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Apart {
    /// Mean distance from the other surface to the first.
    pub mean_mm: f64,
    /// Root of the mean square.
    pub rms_mm: f64,
    /// Nineteen twentieths of the other surface are at most so far away.
    pub p95_mm: f64,
    /// The farthest vertex, from either.
    pub max_mm: f64,
    /// Mean with its sign: positive where the other is outside of the first.
    pub bias_mm: f64,
    /// Mean distance from the first surface to the other.
    pub back_mean_mm: f64,
    /// Volume of the other, less that of the first. \[l\]
    pub volume_l: f64,
}

/// Signed distance from each vertex of `mesh` to `other`: positive outside. \[mm\]
pub(super) fn distances(mesh: &Mesh, other: &Mesh) -> Vec<f64> {
    let tree = Closest::new(other);
    let at = |v: u32| tree.signed(&mesh.point(v)).unwrap_or(0.0);
    (0..mesh.positions.len() as u32)
        .into_par_iter()
        .map(at)
        .collect()
}

/// A third of the area around each vertex. \[mm²\]
fn weights(mesh: &Mesh) -> Vec<f64> {
    let mut weights = vec![0.0; mesh.positions.len()];
    for (f, face) in mesh.faces.iter().enumerate() {
        let third = mesh.area_vector(f).norm() / 6.0;
        face.iter().for_each(|v| weights[*v as usize] += third);
    }
    weights
}

/// How far `b` is from `a`.
pub fn apart(a: &Mesh, b: &Mesh) -> Apart {
    let (there, back) = (distances(b, a), distances(a, b));
    let (wb, wa) = (weights(b), weights(a));
    let total: f64 = wb.iter().sum::<f64>().max(f64::MIN_POSITIVE);
    let mean = |f: &dyn Fn(f64) -> f64| {
        let sum: f64 = there.iter().zip(&wb).map(|(d, w)| f(*d) * w).sum();
        sum / total
    };
    let mut order: Vec<usize> = (0..there.len()).collect();
    order.sort_by(|i, j| there[*i].abs().total_cmp(&there[*j].abs()));
    let (mut filled, mut p95) = (0.0, 0.0);
    for i in order {
        filled += wb[i];
        if filled <= 0.95 * total {
            p95 = there[i].abs();
        }
    }
    let sum: f64 = back.iter().zip(&wa).map(|(d, w)| d.abs() * w).sum();
    let farthest = there.iter().chain(&back).map(|d| d.abs());
    Apart {
        mean_mm: mean(&f64::abs),
        rms_mm: mean(&|d| d * d).sqrt(),
        p95_mm: p95,
        max_mm: farthest.fold(0.0, f64::max),
        bias_mm: mean(&|d| d),
        back_mean_mm: sum / wa.iter().sum::<f64>().max(f64::MIN_POSITIVE),
        volume_l: (b.volume() - a.volume()) * 1e-6,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proof::near;

    /// A sphere by latitude and longitude. \[mm\]
    fn sphere(radius: f32, n: u32) -> Mesh {
        let mut mesh = Mesh::default();
        for i in 0..=n {
            for j in 0..2 * n {
                let (t, p) = (
                    std::f32::consts::PI * i as f32 / n as f32,
                    std::f32::consts::PI * j as f32 / n as f32,
                );
                let at = [
                    libm::sinf(t) * libm::cosf(p),
                    libm::sinf(t) * libm::sinf(p),
                    libm::cosf(t),
                ];
                mesh.positions.push(at.map(|x| x * radius));
            }
        }
        for (i, j) in (0..n).flat_map(|i| (0..2 * n).map(move |j| (i, j))) {
            let at = |i: u32, j: u32| i * 2 * n + j % (2 * n);
            let (a, b, c, d) = (at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
            mesh.faces.extend([[a, b, c], [a, c, d]]);
        }
        mesh
    }

    #[test]
    fn two_spheres_are_apart_by_the_difference_of_their_radii() {
        let (a, b) = (sphere(100.0, 80), sphere(103.0, 80));
        let apart = apart(&a, &b);
        for (got, want) in [
            (apart.mean_mm, 3.0),
            (apart.bias_mm, 3.0),
            (apart.rms_mm, 3.0),
            (apart.p95_mm, 3.0),
            (apart.back_mean_mm, 3.0),
        ] {
            near(got, want, 0.05);
        }
        near(
            apart.volume_l,
            4.0 / 3.0 * std::f64::consts::PI * (1.03f64.powi(3) - 1.0),
            0.002,
        );
        let back = super::apart(&b, &a);
        near(back.bias_mm, -3.0, 0.05);
        assert_eq!(super::apart(&a, &a).max_mm, 0.0);
    }
}
