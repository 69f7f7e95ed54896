//! Photos as a lens without distortion shows them, at a level of the pyramid.

use crate::pictures::resample::resampled;
use nalgebra::Vector2;
use shape::{Gray, Image, Intrinsics};

/// Width and height after so many halvings. \[px\]
pub(crate) fn halved_size(lens: &Intrinsics, halvings: u32) -> [usize; 2] {
    let half = |n: u32| (0..halvings).fold(n as usize, |n, _| (n / 2).max(1));
    [half(lens.width), half(lens.height)]
}

/// A lens without distortion for the photo at this size.
pub(crate) fn pinhole(lens: &Intrinsics, [width, height]: [usize; 2]) -> Intrinsics {
    Intrinsics {
        radial: [0.0; 2],
        ..lens.resized(width as u32, height as u32)
    }
}

/// An image as a lens `to` without distortion shows it, each pixel by `write`; `from` is the image's own lens.
pub(super) fn straightened<U: Copy>(
    image: &Gray,
    from: &Intrinsics,
    to: &Intrinsics,
    write: impl Fn(f32) -> U,
) -> Image<U> {
    let size = (to.width as usize, to.height as usize);
    resampled(
        image,
        size,
        write,
        #[inline(always)]
        |y, columns, rows| {
            let down = (y as f64 - to.centre[1]) / to.focal[1];
            for x in 0..size.0 {
                let across = (x as f64 - to.centre[0]) / to.focal[0];
                let at = from.distort(Vector2::new(across, down));
                (columns[x], rows[x]) = (at.x as f32, at.y as f32);
            }
        },
    )
}
