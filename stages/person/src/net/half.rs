//! Halves (IEEE 754 binary16) as singles: exact.

/// The single of a half's bits.
pub(super) fn single(half: u16) -> f32 {
    let sign = u32::from(half >> 15) << 31;
    let (exponent, fraction) = (u32::from(half >> 10 & 0x1f), u32::from(half & 0x3ff));
    match exponent {
        // Below the normal numbers: so many 2⁻²⁴.
        0 => {
            let value = fraction as f32 / (1u32 << 24) as f32;
            if sign == 0 { value } else { -value }
        }
        0x1f => f32::from_bits(sign | 0x7f80_0000 | fraction << 13),
        _ => f32::from_bits(sign | (exponent + 127 - 15) << 23 | fraction << 13),
    }
}

#[cfg(test)]
mod tests {
    use super::single;

    #[test]
    fn halves_are_read_to_the_last_bit() {
        let known = [
            (0x0000, 0.0),
            (0x8000, -0.0),
            (0x3c00, 1.0),
            (0xc000, -2.0),
            (0x7bff, 65504.0),
            (0x0400, 6.103_515_6e-5),
            (0x0001, 5.960_464_5e-8),
            (0x83ff, -6.097_555e-5),
            (0x3555, 0.333_251_95),
        ];
        for (bits, value) in known {
            assert_eq!(single(bits).to_bits(), f32::to_bits(value), "{bits:04x}");
        }
        assert!(single(0x7c01).is_nan() && single(0xfc00) == f32::NEG_INFINITY);
    }
}
