//! The photos, the silhouettes and the bending term as a surface's energy, pulls and stiffness.

use crate::evidence::agreement::{Agreement, agreement};
use crate::evidence::contours::Pull;
use crate::evidence::patch::Window;
use crate::evidence::scene::VisibilityRules;
use crate::evidence::visibility::Visibility;
use crate::geometry::curvature::Laplacian;
use crate::pictures::picture::Picture;
use crate::surface::step::{DataTerm, Rest};
use nalgebra::Vector3;
use rayon::prelude::*;

/// A surface under its forces, visibility and frames fixed: the energy is
/// `Σ_v a_v (Σ_pairs w (1 − M) + ½ contour_weight (gap/φ)² + ½ hull_weight (out/φ)²) + ½ bending Σ_v area_v (n·L x − rest)²` with `a = area/φ²`,
/// φ the pixel's footprint; so its balance is the same at every scale.
pub struct Forces<'a> {
    /// The pictures.
    pub pictures: &'a [Picture],
    /// Who sees whom, and the patches' frames.
    pub visible: &'a Visibility,
    /// Which pictures are compared.
    pub rules: &'a VisibilityRules,
    /// The patch.
    pub window: &'a Window,
    /// The silhouettes' pulls.
    pub pulls: &'a [Pull],
    /// What resists bending.
    pub laplacian: &'a Laplacian,
    /// What a pixel covers on the surface. \[mm\]
    pub footprint: f64,
    /// Weight of a contour that is a pixel off, against a pair that does not agree at all.
    pub contour_weight: f64,
    /// How far inward each vertex has to go to show inside of all silhouettes \[mm\]; may be empty.
    pub outside: &'a [f64],
    /// Weight of a vertex that has a pixel to go.
    pub hull_weight: f64,
    /// The bending term's rest shape.
    pub rest: &'a Rest,
    /// The bending term's stiffness. \[mm²\]
    pub bending: f64,
    /// Pull back to where the vertex is, where nobody knows better.
    pub anchor: f64,
}

impl Forces<'_> {
    /// How much a vertex counts: its area in pixels.
    pub fn area(&self, v: usize) -> f64 {
        self.laplacian.areas[v] / (self.footprint * self.footprint)
    }

    /// How the pictures agree at each vertex, displaced by `d` mm, with derivatives if `N` is 1; pictures
    /// are read where it is not `known`.
    pub fn agreements<const N: usize>(
        &self,
        d: &[f64],
        known: impl Fn(usize) -> Option<Agreement> + Sync,
    ) -> Vec<Agreement> {
        let one = |v: usize| {
            if let Some(known) = known(v) {
                return known;
            }
            let (visible, frame) = (self.visible.of(v), self.visible.frame(v));
            if visible.len() < 2 {
                return Agreement::default();
            }
            agreement::<N>(
                self.pictures,
                visible,
                frame,
                d[v],
                self.window,
                self.rules.pairing,
            )
        };
        (0..d.len())
            .into_par_iter()
            .with_min_len(128)
            .map(one)
            .collect()
    }

    /// The photos' and the silhouettes' pull on each vertex where it is.
    pub fn data_term(&self, seen: &[Agreement]) -> DataTerm {
        let mut data_term = DataTerm {
            pull: vec![0.0; seen.len()],
            stiffness: vec![0.0; seen.len()],
        };
        let inverse = 1.0 / (self.footprint * self.footprint);
        for (v, a) in seen.iter().enumerate() {
            let area = self.area(v);
            data_term.pull[v] = area * a.slope;
            data_term.stiffness[v] = area * (a.stiffness + self.anchor * inverse);
        }
        for p in self.pulls {
            let v = p.vertex as usize;
            let weight = self.area(v) * self.contour_weight * p.weight * inverse;
            data_term.pull[v] -= weight * p.gap * p.slope;
            data_term.stiffness[v] += weight * p.slope * p.slope;
        }
        for (v, gap) in self.outside.iter().enumerate().filter(|o| *o.1 > 0.0) {
            let weight = self.area(v) * self.hull_weight * inverse;
            data_term.pull[v] -= weight * gap;
            data_term.stiffness[v] += weight;
        }
        data_term
    }

    /// The energy with the vertices displaced by `d` mm along their normals.
    pub fn energy(&self, seen: &[Agreement], d: &[f64], x: &[Vector3<f64>]) -> f64 {
        let photo: f64 = (0..d.len())
            .map(|v| self.area(v) * (seen[v].weight - seen[v].score))
            .sum();
        let inverse = 1.0 / (self.footprint * self.footprint);
        let contours: f64 = self
            .pulls
            .iter()
            .map(|p| {
                let gap = p.gap + p.slope * d[p.vertex as usize];
                self.area(p.vertex as usize) * self.contour_weight * p.weight * gap * gap * inverse
            })
            .sum();
        let drawn = self.outside.iter().enumerate().filter(|o| *o.1 > 0.0);
        let bounds: f64 = drawn
            .map(|(v, gap)| self.area(v) * self.hull_weight * (gap + d[v]).powi(2) * inverse)
            .sum();
        let normal = |v: usize| self.visible.frame(v).normal;
        let moved: Vec<_> = (0..d.len()).map(|v| x[v] + normal(v) * d[v]).collect();
        let normals: Vec<_> = (0..d.len()).map(normal).collect();
        let curvature = self.rest.energy(self.laplacian, &moved, &normals);
        photo + 0.5 * (contours + bounds) + self.bending * curvature
    }
    /// The longest of a few shares of a step that lowers the energy; 0 where none does. Photos are read
    /// where the step leads farther than `near` mm from where they were read last, `off` mm inward of here;
    /// elsewhere what was `seen` goes on by its slope and stiffness.
    pub fn falls(
        &self,
        x: &[Vector3<f64>],
        d: &[f64],
        seen: &[Agreement],
        (off, near): (&[f64], f64),
    ) -> f64 {
        let before = self.energy(seen, &vec![0.0; d.len()], x);
        for share in [1.0, 0.5, 0.25, 0.1] {
            let d: Vec<f64> = d.iter().map(|d| d * share).collect();
            let seen = self.agreements::<0>(&d, |v| {
                ((off[v] + d[v]).abs() <= near).then(|| seen[v].ahead(d[v]))
            });
            if self.energy(&seen, &d, x) < before {
                return share;
            }
        }
        0.0
    }
}
