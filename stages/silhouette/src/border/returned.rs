//! Masks of photos that were brought to a common place, back where the photos are.

use shape::{Alignment, Gray, Mask};

/// A mask of what was brought there, back on the photo.
pub(crate) fn returned(alignment: &Alignment, mask: Mask) -> Mask {
    if alignment.placed.is_identity() {
        return mask;
    }
    let back = alignment.placed.inverse();
    let gray: Gray = mask.map(|v| f32::from(*v));
    back.brought_gray(&gray).map(|v| v.round() as u8)
}

#[cfg(test)]
mod tests {
    use super::*;
    use shape::Placed;

    #[test]
    fn a_mask_comes_back_to_where_the_photo_was() {
        let level = Alignment {
            placed: Placed {
                shift: [3.0, -2.0],
                ..Placed::SAME
            },
            tones: None,
        };
        let mut mask = Mask::filled(60, 50, 0);
        *mask.at_mut(20, 20) = 255;
        let back = returned(&level, mask);
        assert_eq!((back.at(23, 18), back.at(20, 20)), (255, 0));
    }
}
