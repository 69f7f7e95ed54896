//! The levels that a model tells.

/// A level that the model tells.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// Midway between lowest rib and iliac crest (ISO 8559-1 5.3.10).
    Waist,
    /// The navel (omphalion).
    Navel,
    /// The side of the iliac crest (NIH).
    HipBone,
    /// The nipples, or the bust point (ISO 8559-1 5.3.4).
    Chest,
}

impl Level {
    /// All of them, in the order of a model file.
    pub const ALL: [Level; 4] = [Level::Waist, Level::Navel, Level::HipBone, Level::Chest];

    /// What a model file calls it.
    pub fn name(self) -> &'static str {
        match self {
            Level::Waist => "waist",
            Level::Navel => "navel",
            Level::HipBone => "hip_bone",
            Level::Chest => "chest",
        }
    }
}
