//! Linear light of the levels of an sRGB file.

/// In proportion to light, 0 to 1, of a level of 0..=255 (IEC 61966-2-1).
pub(crate) fn light_of(level: u8) -> f32 {
    let v = f32::from(level) / 255.0;
    if v <= 0.040_45 {
        v / 12.92
    } else {
        libm::powf((v + 0.055) / 1.055, 2.4)
    }
}

#[cfg(test)]
mod tests {
    use super::light_of;

    #[test]
    fn half_the_light_is_level_188() {
        assert_eq!(light_of(0), 0.0);
        assert!((light_of(188) - 0.5029).abs() < 1e-3);
        assert_eq!(light_of(255), 1.0);
    }
}
