//! Focal lengths as if on 36 × 24 mm film, and in pixels.

/// Diagonal of 36 × 24 mm film (derived: √(36² + 24²)). \[mm\]
const FILM_DIAGONAL_MM: f64 = 43.266_615_305_567_87;

/// The focal length in pixels of a photo of this size that equals `mm` on film: the angle across
/// the *diagonal* is the same (CIPA DCG-001), whatever the photo's proportions. \[px\]
pub fn film_to_px(mm: f64, width: u32, height: u32) -> f64 {
    mm / FILM_DIAGONAL_MM * libm::hypot(f64::from(width), f64::from(height))
}

/// The other way round. \[mm\]
pub fn px_to_film(px: f64, width: u32, height: u32) -> f64 {
    px / libm::hypot(f64::from(width), f64::from(height)) * FILM_DIAGONAL_MM
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_longer_side_of_three_by_two_is_36_mm() {
        assert!((film_to_px(36.0, 1600, 2400) - 2400.0).abs() < 1e-9);
    }

    #[test]
    fn a_phone_of_four_by_three_is_longer_than_its_side_would_be() {
        let px = film_to_px(26.0, 3024, 4032);
        assert!((px - 26.0 / 43.27 * 5040.0).abs() < 1.0);
        assert!((px / (26.0 / 36.0 * 4032.0) - 1.0401).abs() < 1e-3);
    }

    #[test]
    fn there_and_back() {
        assert!((px_to_film(film_to_px(31.5, 1080, 1920), 1080, 1920) - 31.5).abs() < 1e-12);
    }
}
