//! How large each fault of a made phone is.

stage::params! {
    /// The faults of a phone's camera; each is off at 0.
    pub struct PhoneParams {
        /// Greatest change of the exposure over the turn, in stops: half a slow drift, half steps.
        #[range(0.0..=3.0)]
        #[source(structural)]
        exposure_ev: f64 = 0.0,
        /// Greatest change of red and blue against green over the turn, as a share.
        #[range(0.0..=0.5)]
        #[source(structural)]
        white: f64 = 0.0,
        /// How much brighter everything is than it came, in stops: what is beyond white is lost.
        #[range(0.0..=3.0)]
        #[source(structural)]
        over_ev: f64 = 0.0,
        /// Standard deviation of the stabiliser's shift of a photo, right and down.
        #[range(0.0..=50.0)]
        #[source(structural)]
        shift_px: f64 = 0.0,
        /// Share of light that the corners lose, growing as the square of the way from the middle.
        #[range(0.0..=0.9)]
        #[source(structural)]
        vignetting: f64 = 0.0,
        /// Mean standard deviation of the blur; each photo has its own, a quarter more or less.
        #[range(0.0..=10.0)]
        #[source(structural)]
        blur_px: f64 = 0.0,
        /// Photos that the hand or the subject blurred along a line.
        #[range(0..=1000)]
        #[source(structural)]
        shaken: u32 = 0,
        /// Length of that line.
        #[range(0.0..=100.0)]
        #[source(structural)]
        shake_px: f64 = 4.0,
        /// How far red is outside of green at the corners, and blue inside.
        #[range(0.0..=20.0)]
        #[source(structural)]
        lateral_px: f64 = 0.0,
        /// Most of what the surroundings of a pixel differ by from the whole picture, in levels as a ratio, that a phone takes
        /// back, as a share; each photo has its own, from half of it on.
        #[range(0.0..=1.0)]
        #[source(structural)]
        local_tone: f64 = 0.0,
        /// How far those surroundings reach, one standard deviation, as a share of the longer side.
        #[range(0.01..=0.5)]
        #[source(structural)]
        local_reach: f64 = 0.06,
        /// Standard deviation of the sensor's noise, in levels of 0..=255.
        #[range(0.0..=50.0)]
        #[source(structural)]
        noise_levels: f64 = 0.0,
        /// Neighbours whose levels differ by less than about this are smoothed together.
        #[range(0.0..=100.0)]
        #[source(structural)]
        denoise_levels: f64 = 0.0,
        /// Strength of the sharpening that lays halos along edges.
        #[range(0.0..=5.0)]
        #[source(structural)]
        sharpen: f64 = 0.0,
        /// Quality of the JPEG files, 1 to 100; 0 writes PNG.
        #[range(0..=100)]
        #[source(structural)]
        jpeg_quality: u32 = 0,
        /// Whether the plate is kept.
        plate: bool = true,
        /// Whether what the user knows of a mat and of tags on the rim is kept.
        mat: bool = true,
        /// Seed of all that is by chance.
        #[range(0..=1000000)]
        #[chance(seed)]
        #[source(structural)]
        seed: u32 = 1,
    }
}
