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

    /// How far nine in ten grown people of one sex are from the middle one, as a share of that one's tape: half of the range
    /// from the 5th to the 95th in 100 of ANSUR II, mean of women and men (`models/tables/ansur2.csv`; upper arms and forearms
    /// as they are flexed). An interval that reaches as far tells no more of a body than that it is one. What is measured
    /// anywhere counts as the waist, which differs most.
    pub fn spread(self) -> f64 {
        match self {
            Region::Neck => 0.099,
            Region::Chest => 0.139,
            Region::Waist | Region::Anywhere => 0.194,
            Region::Hip => 0.124,
            Region::UpperArm => 0.163,
            Region::Forearm => 0.117,
            Region::Thigh => 0.151,
            Region::Calf => 0.126,
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

#[cfg(test)]
mod tests {
    use super::Region;

    #[test]
    fn the_spread_of_a_region_is_that_of_the_survey() {
        let file = concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../../models/tables/ansur2.csv"
        );
        let mut table = csv::Reader::from_path(file).unwrap();
        let head = table.headers().unwrap().clone();
        let rows: Vec<csv::StringRecord> = table.records().map(Result::unwrap).collect();
        let spread = |column: &str, sex: &str| {
            let at = head.iter().position(|name| name == column).unwrap();
            let own = rows.iter().filter(|row| &row[0] == sex);
            let mut all: Vec<f64> = own.map(|row| row[at].parse().unwrap()).collect();
            all.sort_by(f64::total_cmp);
            let share = |p: f64| all[(p * (all.len() - 1) as f64).round() as usize];
            (share(0.95) - share(0.05)) / share(0.5) / 2.0
        };
        for (region, column) in [
            (Region::Neck, "neckcircumference"),
            (Region::Chest, "chestcircumference"),
            (Region::Waist, "waistcircumference"),
            (Region::Hip, "buttockcircumference"),
            (Region::UpperArm, "bicepscircumferenceflexed"),
            (Region::Forearm, "forearmcircumferenceflexed"),
            (Region::Thigh, "thighcircumference"),
            (Region::Calf, "calfcircumference"),
        ] {
            let mean = (spread(column, "f") + spread(column, "m")) / 2.0;
            proof::near(region.spread(), mean, 0.001);
        }
    }
}
