//! A square of a photo, turned: what a network looks at.

use serde::{Deserialize, Serialize};

/// A square of a photo, turned.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Crop {
    /// Its middle. \[px\]
    pub centre_px: [f32; 2],
    /// Its side. \[px\]
    pub side_px: f32,
    /// By how much its own right is turned from the photo's, x towards y. \[rad\]
    pub angle: f32,
}

impl Crop {
    /// The same on a photo that is larger by a factor.
    pub(crate) fn scaled(&self, by: f32) -> Crop {
        Crop {
            centre_px: self.centre_px.map(|px| (px + 0.5) * by - 0.5),
            side_px: self.side_px * by,
            ..*self
        }
    }

    /// Where a point of the square is on the photo; (0, 0) and (1, 1) are corners of the square. \[px\]
    pub fn on_photo(&self, [u, v]: [f32; 2]) -> [f32; 2] {
        let (sin, cos) = libm::sincosf(self.angle);
        let (x, y) = ((u - 0.5) * self.side_px, (v - 0.5) * self.side_px);
        let [cx, cy] = self.centre_px;
        [cx + cos * x - sin * y, cy + sin * x + cos * y]
    }

    /// Where a point of the photo is in the square.
    pub fn of_photo(&self, [x, y]: [f32; 2]) -> [f32; 2] {
        let (sin, cos) = libm::sincosf(self.angle);
        let (x, y) = (x - self.centre_px[0], y - self.centre_px[1]);
        let (u, v) = (cos * x + sin * y, cos * y - sin * x);
        [u / self.side_px + 0.5, v / self.side_px + 0.5]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_is_laid_on_its_photo_and_back() {
        let crop = Crop {
            centre_px: [300.0, 250.0],
            side_px: 512.0,
            angle: 0.7,
        };
        let at = crop.on_photo([0.25, 0.9]);
        let back = crop.of_photo(at);
        assert!((back[0] - 0.25).abs() < 1e-6 && (back[1] - 0.9).abs() < 1e-6);
        // Up in a square that is turned clockwise points to the right on the photo.
        assert!(crop.on_photo([0.5, 0.0])[0] > 300.0);
    }
}
