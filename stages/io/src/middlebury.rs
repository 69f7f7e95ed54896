//! Cameras as Middlebury's `_par.txt`.

use nalgebra::Point2;
use shape::{Cameras, Intrinsics};
use std::fmt::Write;

/// A lens that bends lines, which the format cannot express.
#[derive(Debug, thiserror::Error)]
#[error(
    "`_par.txt` knows no distortion, but the lens bends lines by up to {px:.1} px: write `colmap` or `json`, or undistort the photos first"
)]
pub struct Distorted {
    px: f64,
}

/// Distortion of at most so much is left out. By hand: not on record. \[px\]
const MOST_PX: f64 = 1.0;

/// `_par.txt` of the Middlebury multi-view benchmark: how many cameras, then for each its image,
/// K row by row, R row by row, t; in millimetres, `x_in_camera = R x_in_world + t`. Blanks in names
/// become `_`. An error for a lens with distortion.
///
/// # Errors
///
/// A lens has distortion, which the format cannot hold.
pub fn cameras_to_middlebury(cameras: &Cameras) -> Result<String, Distorted> {
    let mut text = format!("{}\n", cameras.views.len());
    for view in cameras.views.values() {
        let (lens, pose) = (&view.camera.lens, &view.camera.pose);
        let px = bent_px(lens);
        if px > MOST_PX {
            return Err(Distorted { px });
        }
        text.push_str(&view.name.replace(char::is_whitespace, "_"));
        for m in [lens.matrix(), *pose.rotation.matrix()] {
            for x in m.transpose().iter() {
                let _ = write!(text, " {x}");
            }
        }
        let t = pose.translation;
        let _ = writeln!(text, " {} {} {}", t.x, t.y, t.z);
    }
    Ok(text)
}

/// How far distortion moves a corner of the photo at most. \[px\]
fn bent_px(lens: &Intrinsics) -> f64 {
    let straight = Intrinsics {
        radial: [0.0; 2],
        ..*lens
    };
    let (w, h) = (f64::from(lens.width), f64::from(lens.height));
    [(0.0, 0.0), (w, 0.0), (0.0, h), (w, h)]
        .map(|(x, y)| {
            let corner = Point2::new(x, y);
            (lens.distort(straight.undistort(corner)) - corner).norm()
        })
        .into_iter()
        .fold(0.0, f64::max)
}
