//! Why photos of a walk give no cameras.

stage::failures! {
    /// Why no cameras follow from a walk.
    pub enum WalkError {
        /// Photos fall into parts that share nothing.
        Apart {
            /// Photos of the largest part.
            most: usize,
            /// All photos.
            of: usize,
            /// Photos of the other parts.
            rest: usize,
            /// Some of them.
            names: String,
        } = "fail-walk-apart": "the photos do not hang together: {most} of {of} share features with each other, {rest} share too few with them ({names}): remove photos of other things, or photograph at smaller steps, so that each photo shows most of what the one before it shows",
        /// What photos have in common does not move.
        StoodStill {
            /// Matches that did not move.
            still: usize,
            /// Matches that moved.
            moved: usize,
        } = "fail-walk-still": "the camera did not walk: of what the photos have in common, {still} features do not move in the picture and only {moved} move; if the subject turned before a camera on a tripod, `tailor measure` without `--walk` is for that",
        /// No two photos give a beginning.
        NoBeginning = "fail-walk-depth": "no two photos show the same things from places well apart, so depth is not known: walk around the subject, a step of 10° to 20° from photo to photo (turning the camera on the spot does not help)",
        /// Too few photos could be added.
        Few {
            /// Photos with a camera.
            found: usize,
            /// All photos.
            of: usize,
            /// Some without.
            names: String,
        } = "fail-walk-few": "only {found} of {of} photos fit one arrangement of cameras; {names} and other photos do not: photograph at smaller steps, with light enough for sharp photos, and nothing large that moves in the picture",
        /// Features that fit no better than by chance.
        Loose {
            /// Root mean square, outliers left out. \[px\]
            rms: f64,
            /// What is borne. \[px\]
            most: f64,
        } = "fail-walk-loose": "features are {rms:.1 px} from where they should be (at most {most:.1 px} is to be trusted), so the cameras are not: did the subject move while the camera walked, or is most of what is seen water, glass or people?",
    }
}
