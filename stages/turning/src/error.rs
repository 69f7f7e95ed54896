//! Why a motion cannot be found.

stage::failures! {
    /// Why no motion was found.
    #[derive(Clone, PartialEq)]
    pub enum MotionError {
        /// Nobody, or not the same one.
        NoPerson {
            /// Photos that show the person.
            seen: usize,
            /// All photos.
            of: usize,
            /// So many are needed.
            least: usize,
        } = "fail-turning-nobody": "only {seen} of {of} photos show the one who turns (at least {least} must): is it a person, whole and alone in the picture, and is it light enough?",
        /// Head below the hips.
        UpsideDown = "fail-turning-upside-down": "the person is upside down on the photos: turn them the right way up, and hand them in again",
        /// Shoulders or hips are not in the picture.
        NoTrunk(names: String) = "fail-turning-no-trunk": "on {names} shoulders, hips or head are not in the picture, so the way that the body faces is not known: keep the whole person in view, or leave these photos out",
        /// A part of the turn is missing.
        Open {
            /// The photo before the gap.
            before: String,
            /// The photo after it.
            after: String,
            /// How wide it is. \[°\]
            degrees: f64,
            /// How wide it may be. \[°\]
            most: f64,
        } = "fail-turning-open": "between {before} and {after} the body turned by {degrees:.0 °} without a photo (at most {most:.0 °} may be): turn once all the way round, slowly, and take a photo at every 15°",
        /// Outlines that belong to no one motion.
        Loose {
            /// How far they are apart. \[%\]
            percent: f64,
            /// How far they may be. \[%\]
            most: f64,
        } = "fail-turning-loose": "the outlines contradict each other by {percent:.1 %} of the body's height (at most {most:.1 %} may be): put the camera on something firm, keep arms and head still while turning, wear nothing loose, and let nobody else into the picture",
    }
}
