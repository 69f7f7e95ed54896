//! The words of the table of girths: regions of the body, rules of planes and levels, sets.

use serde::{Deserialize, Serialize};

/// Where on the body a girth is: what is beside it there, and how well two methods may agree.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Region {
    /// Between head and shoulders.
    Neck,
    /// The trunk where arms begin.
    Chest,
    /// The trunk between chest and hip.
    Waist,
    /// The trunk where hands hang.
    Hip,
    /// Shoulder to elbow.
    UpperArm,
    /// Elbow to wrist.
    Forearm,
    /// Hip to knee.
    Thigh,
    /// Knee to ankle.
    Calf,
    /// Wherever somebody picked.
    Anywhere,
}

impl Region {
    /// All of them.
    pub const ALL: [Region; 9] = [
        Region::Neck,
        Region::Chest,
        Region::Waist,
        Region::Hip,
        Region::UpperArm,
        Region::Forearm,
        Region::Thigh,
        Region::Calf,
        Region::Anywhere,
    ];

    /// Its word in files.
    pub fn word(self) -> &'static str {
        match self {
            Region::Neck => "neck",
            Region::Chest => "chest",
            Region::Waist => "waist",
            Region::Hip => "hip",
            Region::UpperArm => "upper_arm",
            Region::Forearm => "forearm",
            Region::Thigh => "thigh",
            Region::Calf => "calf",
            Region::Anywhere => "anywhere",
        }
    }

    /// The region of a word.
    pub fn named(word: &str) -> Option<Region> {
        Region::ALL.into_iter().find(|r| r.word() == word)
    }

    /// How far two tapes may be apart by ISO 20685-1: large girths, small girths. \[mm\]
    pub fn limit_mm(self) -> f64 {
        match self {
            Region::Chest | Region::Waist | Region::Hip => 9.0,
            _ => 4.0,
        }
    }
}

/// The plane of a girth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PlaneRule {
    /// Horizontal.
    Horizontal,
    /// Square to the limb's own axis.
    AcrossLimb,
    /// Square to the neck's axis.
    AcrossNeck,
    /// Through points picked by hand.
    ThroughPoints,
}

/// The level of a girth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LevelRule {
    /// Where the tape is longest between two marks.
    Greatest(&'static str, &'static str),
    /// Where the tape is shortest between two marks.
    Least(&'static str, &'static str),
    /// A share of the way from one mark to another.
    Share {
        /// Where the way begins.
        from: &'static str,
        /// Its far end.
        to: &'static str,
        /// How far along.
        at: f64,
    },
    /// At a mark that the surface shows.
    Mark(&'static str),
    /// Under the skin: a model's estimate of this place.
    Model(&'static str),
    /// As the user gives it.
    Given,
}

/// Which length a definition means.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measured {
    /// A tape: convex, in the plane.
    Tape,
    /// Along the skin.
    Contour,
}

/// Definitions that belong together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GirthSet {
    /// ISO 8559-1.
    Iso8559,
    /// What the WHO's waist–hip ratio is made of.
    Who,
    /// Those of ANSUR II that a standing body shows.
    Ansur,
    /// The paper's five.
    Paper,
}
