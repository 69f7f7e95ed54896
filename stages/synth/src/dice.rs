//! Chance that is the same for the same seed.

/// Equidistributed numbers (SplitMix64, Steele 2014).
pub(crate) struct Dice(u64);

impl Dice {
    /// One stream of a seed.
    pub(crate) fn new(seed: u32, stream: u32) -> Self {
        let mut dice = Dice(u64::from(seed) << 32 | u64::from(stream));
        dice.bits();
        dice
    }

    /// The next 64 bits.
    pub(crate) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        mixed(self.0)
    }

    /// A number from 0 to below 1.
    pub(crate) fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A normally distributed number (Box and Muller 1958).
    pub(crate) fn normal(&mut self) -> f64 {
        let r = (-2.0 * libm::log(1.0 - self.unit())).sqrt();
        r * libm::cos(std::f64::consts::TAU * self.unit())
    }
}

/// The first normally distributed numbers of a stream.
pub(crate) fn normals<const N: usize>(seed: u32, stream: u32) -> [f64; N] {
    let mut dice = Dice::new(seed, stream);
    [(); N].map(|()| dice.normal())
}

/// Bits that depend on all bits of the argument.
pub(crate) fn mixed(bits: u64) -> u64 {
    let mut z = bits;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}
