//! A rectangle that the user drew around the subject.

use crate::cut::least_cut::Known;

/// A rectangle of the photo, beyond which nothing is body. \[px\]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rectangle {
    left: usize,
    top: usize,
    right: usize,
    bottom: usize,
}

/// A rectangle that is none.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RectangleError {
    /// Not four numbers.
    #[error("`box_px` has {0} numbers, but wants four: [left, top, right, bottom]")]
    Count(usize),
    /// Empty, or off the photo.
    #[error(
        "`box_px` {stated:?} is no part of a photo of {width}×{height} pixels: left must be less than right, top less than bottom, and some of the photo must be left over around it"
    )]
    Place {
        /// The numbers as given.
        stated: Vec<f64>,
        /// The photo's width.
        width: u32,
        /// The photo's height.
        height: u32,
    },
}

impl Rectangle {
    /// From `[left, top, right, bottom]`, on a photo of a size; `None` if nothing was given.
    ///
    /// # Errors
    ///
    /// Other than four numbers; a rectangle that is empty, off the photo, or all of it.
    pub fn read(stated: &[f64], width: u32, height: u32) -> Result<Option<Self>, RectangleError> {
        let [left, top, right, bottom] = match stated {
            [] => return Ok(None),
            [a, b, c, d] => [*a, *b, *c, *d],
            other => return Err(RectangleError::Count(other.len())),
        };
        let wrong = || RectangleError::Place {
            stated: stated.to_vec(),
            width,
            height,
        };
        let clipped = |v: f64, most: u32| v.clamp(0.0, f64::from(most)).round() as usize;
        let rectangle = Rectangle {
            left: clipped(left, width),
            top: clipped(top, height),
            right: clipped(right, width),
            bottom: clipped(bottom, height),
        };
        let (wide, tall) = (
            rectangle.right.saturating_sub(rectangle.left),
            rectangle.bottom.saturating_sub(rectangle.top),
        );
        let whole = width as usize * height as usize;
        let some = wide > 0 && tall > 0 && wide * tall < whole;
        some.then_some(rectangle).map(Some).ok_or_else(wrong)
    }

    /// Whether a pixel of the photo, reduced by a factor, is in it.
    pub fn holds(&self, x: usize, y: usize, factor: usize) -> bool {
        let middle = |v: usize| v * factor + factor / 2;
        (self.left..self.right).contains(&middle(x)) && (self.top..self.bottom).contains(&middle(y))
    }

    /// Nothing beyond it is body. `width` is that of the reduced photo.
    pub fn close(&self, known: &mut [Known], width: usize, factor: usize) {
        for (i, known) in known.iter_mut().enumerate() {
            if !self.holds(i % width, i / width, factor) {
                *known = Known::Background;
            }
        }
    }
}
