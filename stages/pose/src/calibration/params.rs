//! What is believed before anything is seen: the params of a calibration.

stage::choice! {
    /// How cameras without a mat are tied together.
    pub enum Motion {
        /// To one ring where the turn's step is known, else free.
        Auto = "auto",
        /// To one ring: a fixed camera, a turning disk.
        Ring = "ring",
        /// Not at all: each camera follows what it sees.
        Free = "free",
        /// Nor are the photos in turning order: from two photos on, one more at a time.
        Any = "any",
    }
}

stage::params! {
    /// What is believed before anything is seen, and how sure observations are.
    pub struct CalibrateParams {
        /// How sure the focal length of EXIF or capture.toml is, as a share of it.
        #[range(0.0005..=0.5)]
        #[source(by_hand = "five captures: halved, size −0.05 % for one; doubled, no more than chance (docs/lab/numbers.md)")]
        focal_sigma: f64 = 0.01,
        /// How far the principal point may be from the photo's middle, as a share of its longer side.
        #[range(0.0001..=0.2)]
        #[source(by_hand = "five captures: halved, rotations −0.03 to +0.05° for three; doubled, rotations −0.01 to +0.12° for two (docs/lab/numbers.md)")]
        centre_sigma: f64 = 0.004,
        /// How sure a focal length in pixels of capture.toml is, as a share of it.
        #[range(0.00001..=0.1)]
        #[source(by_hand = "one capture, halved and doubled: no more than chance (docs/lab/numbers.md)")]
        given_focal: f64 = 0.0005,
        /// How sure a principal point of capture.toml is.
        #[range(0.01..=100.0)]
        #[source(by_hand = "one capture, halved and doubled: no more than chance (docs/lab/numbers.md)")]
        given_centre_px: f64 = 0.5,
        /// How far radial distortion may move what is at a corner of the photo, as a share of its way from the middle (k1; k2
        /// half of that): photos that a camera saves are corrected, raw ones are not.
        #[range(0.0001..=0.5)]
        #[source(by_hand = "28 captures without a mat: sizes by a disk 0.82 % off (root mean square) where 0.03 of k1 was believed, 0.57 % by 0.5 % at the corners; this is 0.03 of k1 at 50 mm (docs/lab/disks.md)")]
        corner_sigma: f64 = 0.0056,
        /// Least standard deviation of a tag's corner; what corners scatter by where that is more.
        #[range(0.01..=5.0)]
        #[source(by_hand = "corners of the mannequin and the man: median error 0.03 to 0.08 px")]
        tag_px: f64 = 0.03,
        /// How far the sides of a tag may look too far out or in: ink that spread, paper that bloomed. 0 for not at all.
        #[range(0.0..=5.0)]
        #[source(by_hand = "three captures, halved and doubled: no more than chance (docs/lab/numbers.md)")]
        bloom_px: f64 = 0.2,
        /// How far radius and middle of the disk's rim may be from `[rim]`.
        #[range(0.001..=50.0)]
        #[source(by_hand = "one capture, halved and doubled: no more than chance (docs/lab/numbers.md)")]
        rim_round_mm: f64 = 1.0,
        /// How much taller or less tall than wide a printer may make the tags on the rim, as a share.
        #[range(0.000001..=0.1)]
        #[source(by_hand = "one capture: halved, size +0.07 %; doubled, rotations +0.10° (docs/lab/numbers.md)")]
        rim_stretch: f64 = 0.001,
        /// Standard deviation of a feature.
        #[range(0.05..=5.0)]
        #[source(by_hand = "two captures: halved, centres +1.47 mm for one; doubled, centres −2.08 mm for one (docs/lab/numbers.md)")]
        feature_px: f64 = 0.6,
        /// Residuals beyond this many standard deviations lose weight.
        #[range(0.5..=20.0)]
        #[source(derived = "three standard deviations: 0.3 % of a normal distribution is beyond")]
        loss: f64 = 3.0,
        /// Most steps of an adjustment.
        #[range(1..=1000)]
        #[source(structural)]
        steps: u32 = 60,
        /// How cameras without a mat are tied together.
        motion: Motion = Motion::Auto,
        /// How evenly the disk turns, where its step is known.
        #[range(0.001..=10.0)]
        #[source(by_hand = "two captures: halved, centres −2.14 mm for one; doubled, centres +1.41 mm for one (docs/lab/numbers.md)")]
        step_sigma_deg: f64 = 0.1,
        /// A subject sways where features fit one ring worse than free cameras by this factor.
        #[range(1.0..=50.0)]
        #[source(by_hand = "five captures without tags, at 1.1: centres of four 4.3 to 11.3 mm nearer, of one as before (docs/lab/numbers.md)")]
        sway_ratio: f64 = 1.25,
        /// Free cameras further off a ring than this share of its radius are refused.
        #[range(0.001..=10.0)]
        #[source(by_hand = "two captures, halved and doubled: nothing changes, for none is refused (docs/lab/numbers.md)")]
        off_ring: f64 = 0.02,
        /// Without a mat, features that are further from where they should (root mean square) are
        /// not believed; in proportion more on photos of more than 2400 pixels.
        #[range(0.1..=100.0)]
        #[source(by_hand = "two captures, halved and doubled: nothing changes, for none is refused (docs/lab/numbers.md)")]
        most_px: f64 = 2.0,
        /// Most features that are adjusted.
        #[range(100..=100000)]
        #[source(structural)]
        most_tracks: u32 = 3000,
    }
}

impl CalibrateParams {
    /// What is further away than this is not off by how features scatter. \[px\]
    pub(crate) fn far_px(&self) -> f64 {
        self.loss * self.feature_px
    }
}
