//! Why a motion cannot be found.

/// Why somebody's turn on the spot tells nothing.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MotionError {
    /// Nobody, or not the same one.
    #[error(
        "only {seen} of {of} photos show the one who turns (at least {least} must): is it a person, whole and alone in the picture, and is it light enough?"
    )]
    NoPerson {
        /// Photos that show the person.
        seen: usize,
        /// All photos.
        of: usize,
        /// So many are needed.
        least: usize,
    },
    /// Head below the hips.
    #[error(
        "the person is upside down on the photos: turn them the right way up, and hand them in again"
    )]
    UpsideDown,
    /// Shoulders or hips are not in the picture.
    #[error(
        "on {0} shoulders, hips or head are not in the picture, so nothing tells which way the body faces: keep the whole person in view, or leave these photos out"
    )]
    NoTrunk(String),
    /// A part of the turn is missing.
    #[error(
        "between {before} and {after} the body turned by {degrees:.0}° without a photo (at most {most:.0}° may be): turn once all the way round, slowly, and take a photo at every 15°"
    )]
    Open {
        /// The photo before the gap.
        before: String,
        /// The photo after it.
        after: String,
        /// How wide it is. \[°\]
        degrees: f64,
        /// How wide it may be. \[°\]
        most: f64,
    },
    /// Outlines that belong to no one motion.
    #[error(
        "the outlines contradict each other by {percent:.1} % of the body's height (at most {most:.1} % may be): hold arms and head still while turning, wear nothing loose, and let nobody else into the picture"
    )]
    Loose {
        /// How far they are apart. \[%\]
        percent: f64,
        /// How far they may be. \[%\]
        most: f64,
    },
}
