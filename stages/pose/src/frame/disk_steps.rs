//! Steps of colour across a circle, and how sure an edge they are.

use nalgebra::{Point2, Vector3};
use shape::Rgb;

/// Steps of the three levels outwards along a circle, of its near side and of its far one: beyond the near side is the disk's
/// own side, beyond the far one the floor, which may be darker and brighter than the disk.
#[derive(Default)]
pub(super) struct Steps {
    /// How many there would be on a picture with all of the circle.
    pub(super) points: usize,
    pub(super) sides: [Vec<Vector3<f64>>; 2],
}

impl Steps {
    /// How many there are.
    pub(super) fn count(&self) -> usize {
        self.sides.iter().map(Vec::len).sum()
    }

    /// Which way the levels of each side change, of length 1.
    pub(super) fn ways(&self) -> [Vector3<f64>; 2] {
        let sum = |side: &Vec<Vector3<f64>>| side.iter().sum::<Vector3<f64>>();
        [0, 1].map(|i| sum(&self.sides[i]).try_normalize(1e-9).unwrap_or_default())
    }

    /// What three in four of the steps reach, those of each side counted the way its sum goes.
    pub(super) fn evident(&self) -> f64 {
        let ways = self.ways();
        let of = |i: usize| {
            let side = &self.sides[i];
            let mut steps: Vec<f64> = side.iter().map(|step| step.dot(&ways[i])).collect();
            steps.sort_by(f64::total_cmp);
            let reached = steps.get(steps.len() / 4).copied().unwrap_or_default();
            reached.max(0.0) * side.len() as f64
        };
        (of(0) + of(1)) / self.points as f64
    }

    /// The mean change, the same way all along each side.
    pub(super) fn mean(&self) -> f64 {
        let sum = |side: &Vec<Vector3<f64>>| side.iter().sum::<Vector3<f64>>().norm();
        self.sides.iter().map(sum).sum::<f64>() / self.count().max(1) as f64
    }

    /// The usual size of a step.
    pub(super) fn usual(&self) -> f64 {
        let all = self.sides.iter().flatten().map(|step| step.norm());
        shape::upper_median(all).unwrap_or_default()
    }
}

/// Levels between pixels.
pub(super) fn levels(picture: &Rgb, at: Point2<f64>) -> Option<Vector3<f64>> {
    let [w, h] = [picture.width, picture.height].map(|side| side as f64 - 1.0);
    if !((0.0..w).contains(&at.x) && (0.0..h).contains(&at.y)) {
        return None;
    }
    let (x0, y0) = (at.x as usize, at.y as usize);
    let (fx, fy) = (at.x - x0 as f64, at.y - y0 as f64);
    let four = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(dx, dy)| picture.at(x0 + dx, y0 + dy));
    let of = |c: usize| shape::bilinear(four.map(|levels| f64::from(levels[c])), [fx, fy]);
    Some(Vector3::new(of(0), of(1), of(2)))
}
