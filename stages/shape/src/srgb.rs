//! Light of the levels of an sRGB file, and levels of light (IEC 61966-2-1). Light mixes in a pixel; levels do not.

/// In proportion to light, 0 to 1, of a level of 0 to 255.
pub fn light_of_level(level: f32) -> f32 {
    let v = level / 255.0;
    if v <= 0.040_45 {
        v / 12.92
    } else {
        libm::powf((v + 0.055) / 1.055, 2.4)
    }
}

/// The same of each level.
pub fn light_of_levels() -> [f32; 256] {
    std::array::from_fn(|level| light_of_level(level as f32))
}

/// The level, 0 to 255, of light of 0 to 1.
pub fn level_of_light(light: f32) -> f32 {
    255.0
        * if light <= 0.003_130_8 {
            12.92 * light
        } else {
            1.055 * libm::powf(light, 1.0 / 2.4) - 0.055
        }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_the_light_is_level_188_and_each_level_is_that_of_its_light() {
        assert_eq!([0.0, 255.0].map(light_of_level), [0.0, 1.0]);
        assert!((light_of_level(188.0) - 0.5029).abs() < 1e-3);
        for level in 0..=255 {
            let light = light_of_levels()[level];
            assert!((level_of_light(light) - level as f32).abs() < 1e-3);
        }
    }
}
