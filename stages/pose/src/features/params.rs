//! How features are followed over photos.

stage::params! {
    /// Which features are one point.
    pub struct TracksParams {
        /// Photos within so many steps of each other are compared.
        #[range(1..=20)]
        #[source(structural)]
        neighbours: u32 = 3,
        /// Whether photos are in turning order: one that is elsewhere is an error.
        #[source(structural)]
        in_order: bool = true,
        /// How far a feature may rise or sink from photo to photo, as a share of the photo's height.
        #[range(0.01..=1.0)]
        #[source(by_hand = "two captures: halved, size +0.16 % for one; doubled, rotations −0.02° for one (docs/lab/numbers.md)")]
        rise: f64 = 0.16,
        /// The nearest description must be nearer than this share of the next one.
        #[range(0.3..=1.0)]
        #[source(by_hand = "two captures: halved, centres −2.90 to +300.89 mm (docs/lab/numbers.md)")]
        ratio: f64 = 0.85,
        /// Features that move less belong to what does not turn: the background.
        #[range(0.0..=50.0)]
        #[source(by_hand = "two captures: halved, size +0.17 % for one; doubled, size +0.07 % for one (docs/lab/numbers.md)")]
        still_px: f64 = 3.0,
        /// How far a match may be off its epipolar line.
        #[range(0.1..=50.0)]
        #[source(by_hand = "two captures: halved, ground −1.3 mm for one; doubled, ground −1.1 mm for one (docs/lab/numbers.md)")]
        epipolar_px: f64 = 2.5,
        /// Photos of which no such share of the matches agrees have nothing in common: by chance, a
        /// quarter does.
        #[range(0.0..=1.0)]
        #[source(derived = "by chance a quarter of the matches agrees with some epipolar geometry")]
        least_share: f64 = 0.3,
        /// Most samples of a pair's RANSAC.
        #[range(10..=100000)]
        #[source(structural)]
        rounds: u32 = 3000,
        /// Seed of RANSAC.
        #[source(structural)]
        seed: i64 = 1,
    }
}
