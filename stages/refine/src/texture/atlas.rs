//! Charts, flattened and packed onto one picture.

use crate::texture::charts::Chart;
use nalgebra::{Point2, Point3, Vector3};
use shape::{Camera, Mesh, PhotoId};

/// What a chart is flattened onto.
pub enum Sheet<'a> {
    /// Its photo; in pixels of it.
    Photo(&'a Camera),
    /// For what no photo shows: the plane across its mean normal, by two axes; in millimetres.
    Plane([Vector3<f64>; 2]),
}

impl<'a> Sheet<'a> {
    /// Of a chart whose photo is one of `views`.
    pub fn new(mesh: &Mesh, chart: &Chart, views: &'a [(PhotoId, Camera)]) -> Self {
        if let Some((_, camera)) = views.get(usize::from(chart.photo)) {
            return Sheet::Photo(camera);
        }
        let areas = chart.faces.iter().map(|f| mesh.area_vector(*f as usize));
        let normal = areas.sum::<Vector3<f64>>();
        let normal = normal.try_normalize(0.0).unwrap_or_else(Vector3::z);
        let aside = if normal.x.abs() < 0.7 {
            Vector3::x()
        } else {
            Vector3::y()
        };
        let across = normal.cross(&aside).normalize();
        Sheet::Plane([across, normal.cross(&across)])
    }

    /// Where a point is on it.
    pub fn at(&self, x: &Point3<f64>) -> Point2<f64> {
        match self {
            Sheet::Photo(camera) => camera.project(x).unwrap_or_default(),
            Sheet::Plane(axes) => Point2::from(axes.map(|a| a.dot(&x.coords))),
        }
    }

    /// The box around a chart: least and greatest coordinates.
    pub fn bounds(&self, mesh: &Mesh, chart: &Chart) -> [Point2<f64>; 2] {
        let corners = chart.faces.iter().flat_map(|f| mesh.triangle(*f as usize));
        let start = [f64::MAX, f64::MIN].map(|x| Point2::new(x, x));
        corners
            .map(|x| self.at(&x))
            .fold(start, |[lo, hi], q| [lo.inf(&q), hi.sup(&q)])
    }
}

/// Where boxes of these sizes are on a square, side by side on shelves, and by what they were
/// shrunk to fit. \[px\] Sizes are those at full scale; `margin` is left around each.
pub fn packed(sizes: &[[f64; 2]], side: usize, margin: usize) -> (Vec<[usize; 2]>, f64) {
    let mut order: Vec<usize> = (0..sizes.len()).collect();
    order.sort_by(|a, b| sizes[*b][1].total_cmp(&sizes[*a][1]).then(a.cmp(b)));
    let area: f64 = sizes.iter().map(|s| s[0] * s[1]).sum();
    let mut scale = ((side * side) as f64 / area.max(1.0)).sqrt().min(1.0);
    loop {
        let mut places = vec![[0, 0]; sizes.len()];
        let (mut x, mut y, mut shelf, mut fits) = (0, 0, 0, true);
        for i in &order {
            let [w, h] = sizes[*i].map(|s| (s * scale).ceil() as usize + 1 + 2 * margin);
            if x + w > side {
                (x, y, shelf) = (0, y + shelf, 0);
            }
            fits &= w <= side && y + h <= side;
            places[*i] = [x + margin, y + margin];
            x += w;
            shelf = shelf.max(h);
        }
        if fits || scale < 1e-3 {
            return (places, scale);
        }
        scale *= 0.95;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::charts::{NOWHERE, charts, neighbours};

    #[test]
    fn boxes_are_apart_and_within_the_square() {
        let mut dice = proof::Dice(4);
        let sizes: Vec<_> = (0..60)
            .map(|_| [dice.within(2.0, 300.0), dice.within(2.0, 500.0)])
            .collect();
        let (places, scale) = packed(&sizes, 512, 2);
        assert!(scale > 0.05 && scale <= 1.0);
        let mut used = vec![false; 512 * 512];
        for (p, s) in places.iter().zip(&sizes) {
            for y in p[1]..p[1] + (s[1] * scale).ceil() as usize {
                for x in p[0]..p[0] + (s[0] * scale).ceil() as usize {
                    assert!(
                        !std::mem::replace(&mut used[y * 512 + x], true),
                        "two boxes share a pixel"
                    );
                }
            }
        }
    }

    #[test]
    fn what_no_photo_shows_is_laid_flat() {
        let mesh = crate::geometry::solids::sphere(10.0, 4);
        let below = |f: usize| mesh.triangle(f).iter().all(|x| x.z < -9.0);
        let labels: Vec<u16> = (0..mesh.faces.len())
            .map(|f| if below(f) { NOWHERE } else { 0 })
            .collect();
        let charts = charts(&neighbours(&mesh), &labels);
        let sole = charts.iter().find(|c| c.photo == NOWHERE).unwrap();
        assert!(sole.faces.len() > 20);
        let sheet = Sheet::new(&mesh, sole, &[]);
        let flat = |f: u32| mesh.triangle(f as usize).map(|x| sheet.at(&x));
        for f in &sole.faces {
            let [a, b, c] = flat(*f);
            let area = 0.5 * ((b - a).perp(&(c - a))).abs();
            let whole = 0.5 * mesh.area_vector(*f as usize).norm();
            assert!(area > 0.8 * whole, "{area} of {whole}");
        }
        let [lo, hi] = sheet.bounds(&mesh, sole);
        proof::near(hi.x - lo.x, 8.7, 0.8);
        proof::near(hi.y - lo.y, 8.7, 0.8);
    }
}
