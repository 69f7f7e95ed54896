//! What all silhouettes together say of a point in space.

use nalgebra::Point3;
use shape::{Camera, Gray};

/// A silhouette as a distance field, and its camera at the field's size.
pub struct Silhouette {
    /// The camera.
    pub camera: Camera,
    /// Signed distance to the border, positive inside. \[px\]
    pub distance: Gray,
}

impl Silhouette {
    /// How deep inside of the silhouette's cone a point is. \[mm\] `None` where it is out of view.
    pub fn depth_inside(&self, x: &Point3<f64>) -> Option<f32> {
        let (px, depth) = self.camera.project_with_depth(x)?;
        let (w, h) = (self.distance.width as f64, self.distance.height as f64);
        if px.x < 0.0 || px.y < 0.0 || px.x > w - 1.0 || px.y > h - 1.0 {
            return None;
        }
        let far = self.distance.sample(px.x as f32, px.y as f32);
        Some(far * (depth / self.camera.lens.focal[0]) as f32)
    }
}

/// How deep inside of the hull a point is, `dissent` views not counted: their least depths. \[mm\]
/// Views that do not see the point say nothing; a point that fewer than half see is outside.
pub fn consensus(views: &[Silhouette], x: &Point3<f64>, dissent: usize) -> f32 {
    // The least `dissent + 1` depths, ascending; few, so insertion is quick.
    let mut least = [f32::MAX; 16];
    let keep = (dissent + 1).min(least.len());
    let mut seen = 0;
    for view in views {
        let Some(depth) = view.depth_inside(x) else {
            continue;
        };
        seen += 1;
        if depth < least[keep - 1] {
            let at = least[..keep]
                .iter()
                .position(|l| depth < *l)
                .unwrap_or(keep - 1);
            least[at..keep].rotate_right(1);
            least[at] = depth;
        }
    }
    if seen * 2 < views.len() {
        -1e6
    } else {
        least[keep - 1]
    }
}

/// A box around all of space that is body, found on a coarse lattice within the cylinder around
/// the axis that all cameras look into (paper, Fig. 2 b). \[mm\]
pub fn bounds(
    views: &[Silhouette],
    dissent: usize,
    ground: f64,
) -> Option<(Point3<f64>, Point3<f64>)> {
    let nearest = views
        .iter()
        .map(|v| v.camera.centre())
        .map(|c| c.x.hypot(c.y))
        .fold(f64::MAX, f64::min);
    let (reach, cells) = (nearest * 0.8, 96);
    let step = 2.0 * reach / f64::from(cells);
    let (mut lo, mut hi) = (
        Point3::new(f64::MAX, f64::MAX, f64::MAX),
        Point3::new(f64::MIN, f64::MIN, f64::MIN),
    );
    let tall = (3.0 * reach / step) as i32;
    for k in 0..tall {
        for i in 0..=cells {
            for j in 0..=cells {
                let x = Point3::new(
                    -reach + f64::from(i) * step,
                    -reach + f64::from(j) * step,
                    ground + f64::from(k) * step,
                );
                if x.x.hypot(x.y) > reach || f64::from(consensus(views, &x, dissent)) < -step {
                    continue;
                }
                for a in 0..3 {
                    lo[a] = lo[a].min(x[a] - 2.0 * step);
                    hi[a] = hi[a].max(x[a] + 2.0 * step);
                }
            }
        }
    }
    (lo.x < hi.x).then_some((Point3::new(lo.x, lo.y, lo.z.max(ground - 2.0 * step)), hi))
}
