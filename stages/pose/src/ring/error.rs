//! Why features give no cameras.

stage::failures! {
    /// Why no cameras follow from features.
    pub enum TracksError {
        /// Photos have too little in common.
        Apart {
            /// How many neighbours share enough.
            pairs: usize,
            /// How many neighbours there are.
            of: usize,
        } = "fail-apart": "the photos share too few features that turn with the disk ({pairs} of {of} neighbouring photos do): put a patterned cloth or a marker mat (`tailor mat`) on the disk, or photograph at smaller steps",
        /// What was found explains too little.
        Unexplained {
            /// How much it explains. \[%\]
            share: f64,
        } = "fail-unexplained": "no turn about one axis explains the features: only {share:.0 %} of them fit; did the camera move (is this a walk around? --walk), are the photos out of order, or does the background fill them? A marker mat (`tailor mat`) on the disk helps",
        /// Features that fit no better than by chance.
        Loose {
            /// Root mean square, outliers left out. \[px\]
            rms: f64,
            /// What is borne. \[px\]
            most: f64,
        } = "fail-loose": "features are {rms:.1 px} from where they should be (at most {most:.1 px} is to be trusted), so the cameras are not: too little texture, a subject that moved, photos out of order or cropped, or a walk around (then --walk); put a patterned cloth or a marker mat (`tailor mat`) on the disk",
        /// Photos with next to no features.
        Adrift {
            /// How many do.
            few: usize,
            /// How many photos there are.
            of: usize,
            /// Features that fix a camera.
            least: u32,
            /// Some of them.
            names: String,
        } = "fail-adrift": "{few} of {of} photos have fewer than {least} features in common with the rest ({names}), so the cameras' places are not known: are they in turning order, at steps below 30°? Is this a walk around somebody who does not move (--walk), or did somebody turn on the spot, without a disk (--turning)? A patterned cloth or a marker mat (`tailor mat`) on the disk helps",
        /// No two photos give a beginning.
        NoBeginning = "fail-no-beginning": "no two photos have enough in common to begin with: photograph at smaller steps, with more texture, or with a marker mat (`tailor mat`) on the disk",
        /// Cameras that are on no ring.
        NoRing {
            /// Root mean square, of the ring's radius. \[%\]
            off: f64,
        } = "fail-no-ring": "the cameras came out {off:.1 %} off a ring, so they are not to be trusted: is this a walk around somebody who does not move (then --walk)? Did the subject turn on the spot, without a disk (then --turning)? Are the photos in turning order and the steps below 25°? `focal_35mm` and `step_deg` in capture.toml or a marker mat (`tailor mat`) on the disk help",
        /// Cameras near each other that do not see the same.
        Folded {
            /// Pairs of cameras near each other that share too little.
            pairs: usize,
            /// Pairs of cameras near each other.
            of: usize,
            /// How far those are apart, at most. \[°\]
            apart: f64,
            /// Features that fix a camera.
            least: u32,
        } = "fail-folded": "{pairs} of {of} pairs of photos that came out within {apart:.0 °} of each other have fewer than {least} features in common, so different sides of the subject were laid on each other: put the photos into turning order, or a marker mat (`tailor mat`) on the disk; did the subject turn on the spot, without a disk (then --turning)?",
    }
}
