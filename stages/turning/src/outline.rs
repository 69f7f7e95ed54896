//! One photo's silhouette: points of its border, and how deep a point is in it.

use nalgebra::{Point2, Vector2, Vector3};
use shape::{Gray, Intrinsics, Mask, signed_distance};

/// One photo's silhouette.
pub struct Outline {
    /// Signed distance to the border, positive inside. \[px of the field\]
    distance: Gray,
    /// The lens at the field's size.
    lens: Intrinsics,
    /// Points of the border, on the plane z = 1, and what each counts for.
    pub(crate) border: Vec<(Vector2<f64>, f64)>,
}

/// About so many points of each outline are asked (structural: samples).
const POINTS: usize = 240;
impl Outline {
    /// Of a mask at the size of its photo or smaller, and what a place on the plane z = 1 counts for.
    pub fn of(mask: &Mask, lens: &Intrinsics, counts: impl Fn(&Vector2<f64>) -> f64) -> Outline {
        let lens = lens.resized(mask.width as u32, mask.height as u32);
        let all: Vec<(Vector2<f64>, f64)> = border(mask)
            .into_iter()
            .map(|p| {
                let at = lens.undistort(p);
                (at, counts(&at))
            })
            .collect();
        // As many of what counts as of what does not.
        let thinned = |counts: bool| {
            let of: Vec<_> = all.iter().filter(|p| (p.1 >= 1.0) == counts).collect();
            let every = (2 * of.len() / POINTS).max(1);
            of.into_iter().step_by(every).copied().collect::<Vec<_>>()
        };
        Outline {
            border: [thinned(true), thinned(false)].concat(),
            distance: signed_distance(mask),
            lens,
        }
    }

    /// How deep a point in the camera's frame is in the silhouette; [`f64::MAX`] out of view, where nothing denies it.
    /// \[distance to the axis\]
    pub(crate) fn depth(&self, at: &Vector3<f64>) -> f64 {
        let Some(px) = self.lens.project(at) else {
            return f64::MAX;
        };
        let (w, h) = (self.distance.width as f64, self.distance.height as f64);
        if px.x < 0.0 || px.y < 0.0 || px.x > w - 1.0 || px.y > h - 1.0 {
            return f64::MAX;
        }
        let far = f64::from(self.distance.sample(px.x as f32, px.y as f32));
        far * at.z / self.lens.focal[0]
    }

    /// How far the silhouette reaches to either side, on the plane z = 1.
    pub(crate) fn breadth(&self) -> f64 {
        self.border.iter().map(|p| p.0.x.abs()).fold(0.0, f64::max)
    }
}

/// Points where a mask's cover crosses one half, along rows, then along columns.
pub(crate) fn border(mask: &Mask) -> Vec<Point2<f64>> {
    let mut all = Vec::new();
    let cross = |a: u8, b: u8| {
        let (a, b) = (f64::from(a) - 127.5, f64::from(b) - 127.5);
        (a * b < 0.0).then(|| a / (a - b))
    };
    for y in 1..mask.height.saturating_sub(1) {
        for x in 1..mask.width.saturating_sub(2) {
            if let Some(t) = cross(mask.at(x, y), mask.at(x + 1, y)) {
                all.push(Point2::new(x as f64 + t, y as f64));
            }
            if y + 2 < mask.height
                && let Some(t) = cross(mask.at(x, y), mask.at(x, y + 1))
            {
                all.push(Point2::new(x as f64, y as f64 + t));
            }
        }
    }
    all
}
