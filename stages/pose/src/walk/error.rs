//! Why photos of a walk give no cameras.

/// Why photos of a walk give no cameras.
#[derive(Debug, thiserror::Error)]
pub enum WalkError {
    /// Photos fall into parts that share nothing.
    #[error(
        "the photos do not hang together: {most} of {of} share features with each other, {others} share too few with them ({names}): \
         remove photos of other things, or photograph at smaller steps, so that each photo shows most of what the one before it shows"
    )]
    Apart {
        /// Photos of the largest part.
        most: usize,
        /// All photos.
        of: usize,
        /// Photos of the other parts.
        others: usize,
        /// Some of them.
        names: String,
    },
    /// What photos have in common does not move.
    #[error(
        "the camera did not walk: of what the photos have in common, {still} features stand still in the picture and only {moved} move; \
         if the subject turned before a camera on a tripod, `tailor measure` without `--walk` is for that"
    )]
    StoodStill {
        /// Matches that stood still.
        still: usize,
        /// Matches that moved.
        moved: usize,
    },
    /// No two photos give a beginning.
    #[error(
        "no two photos show the same things from places well apart, so nothing tells of depth: walk around the subject, a step of 10° to 20° \
         from photo to photo (turning the camera on the spot does not help)"
    )]
    NoBeginning,
    /// Too few photos could be added.
    #[error(
        "only {found} of {of} photos fit one arrangement of cameras; {names} and others do not: photograph at smaller steps, with light \
         enough for sharp photos, and nothing large that moves in the picture"
    )]
    Few {
        /// Photos with a camera.
        found: usize,
        /// All photos.
        of: usize,
        /// Some without.
        names: String,
    },
    /// Features that fit no better than by chance.
    #[error(
        "features lie {rms:.1} px from where they should (at most {most:.1} px is to be trusted), so the cameras are not: did the subject \
         move while the camera walked, or is most of what is seen water, glass or people?"
    )]
    Loose {
        /// Root mean square, outliers left out. \[px\]
        rms: f64,
        /// What is borne. \[px\]
        most: f64,
    },
}
