//! What each girth is: one table, read by all that find, measure, compare and report girths.
//!
//! Clauses of ISO 8559-1:2017 (anthropometric definitions for body measurement), of ANSUR II
//! (measurer's handbook, NATICK/TR-11/017) and of WHO 2008 (expert consultation on waist
//! circumference and waist–hip ratio). Limits of comparison are those of ISO 20685-1:2018.

use crate::girth_id::{GirthId, Side};
use crate::girth_rules::GirthSet::{self, Ansur, Iso8559, Paper, Who};
use crate::girth_rules::{LevelRule, Measured, PlaneRule, Region};
use std::fmt::Write;

/// One row.
#[derive(Debug, Clone, Copy)]
pub struct Definition {
    /// Which girth; of a pair, the left one.
    pub id: GirthId,
    /// Its name in files, of a pair without the side.
    pub name: &'static str,
    /// What people call it.
    pub label: &'static str,
    /// Where the tape is, in plain words.
    pub sentence: &'static str,
    /// Its clause of ISO 8559-1:2017.
    pub iso: Option<&'static str>,
    /// Other standards that define it so, with their clause where it has a number.
    pub more_standards: &'static [&'static str],
    /// The part of the body.
    pub region: Region,
    /// Its plane.
    pub plane: PlaneRule,
    /// Its level.
    pub level: LevelRule,
    /// Which length it means.
    pub measured: Measured,
    /// The sets that hold it.
    pub sets: &'static [GirthSet],
}

impl Definition {
    /// The standards behind it: `ISO 8559-1 5.3.10, WHO 2008`. Empty where there is none.
    pub fn standards(&self) -> String {
        let iso = self.iso.map(|clause| format!("ISO 8559-1 {clause}"));
        let more_standards = self.more_standards.iter().map(|s| (*s).to_owned());
        iso.into_iter()
            .chain(more_standards)
            .collect::<Vec<_>>()
            .join(", ")
    }

    /// Label, sentence and standards as one line.
    pub fn line(&self) -> String {
        let mut line = format!("{}: {}", self.label, self.sentence);
        let standards = self.standards();
        if !standards.is_empty() {
            let _ = write!(line, " ({standards})");
        }
        line
    }
}

/// A row that shares most of what rows of the trunk share.
const TRUNK: Definition = Definition {
    id: GirthId::Own,
    name: "",
    label: "",
    sentence: "",
    iso: None,
    more_standards: &[],
    region: Region::Waist,
    plane: PlaneRule::Horizontal,
    level: LevelRule::Given,
    measured: Measured::Tape,
    sets: &[],
};

/// Every girth, from the neck to the calf.
pub const TABLE: [Definition; 15] = [
    Definition {
        id: GirthId::Neck,
        name: "NC",
        label: "neck",
        sentence: "across the neck's axis, just below the larynx",
        iso: Some("5.3.2"),
        more_standards: &["ANSUR II 6.4.63"],
        region: Region::Neck,
        plane: PlaneRule::AcrossNeck,
        level: LevelRule::Model("below the larynx"),
        sets: &[Iso8559, Ansur, Paper],
        ..TRUNK
    },
    Definition {
        id: GirthId::Chest,
        name: "CC",
        label: "chest",
        sentence: "horizontal at the nipples' height, the trunk alone",
        iso: Some("5.3.4"),
        more_standards: &["ANSUR II 6.4.25"],
        region: Region::Chest,
        level: LevelRule::Model("nipples"),
        sets: &[Iso8559, Ansur, Paper],
        ..TRUNK
    },
    Definition {
        id: GirthId::Waist,
        name: "WC",
        label: "waist",
        sentence: "horizontal, midway between the lowest rib and the top of the hip bone, unless another waist was chosen",
        iso: Some("5.3.10"),
        more_standards: &["WHO 2008"],
        level: LevelRule::Model("midway between lowest rib and hip bone"),
        sets: &[Iso8559, Who, Paper],
        ..TRUNK
    },
    Definition {
        id: GirthId::WaistNatural,
        name: "WC_natural",
        label: "waist, natural",
        sentence: "horizontal, midway between the lowest rib and the top of the hip bone",
        iso: Some("5.3.10"),
        more_standards: &["WHO 2008"],
        level: LevelRule::Model("midway between lowest rib and hip bone"),
        sets: &[Iso8559, Who, Paper],
        ..TRUNK
    },
    Definition {
        id: GirthId::WaistNarrowest,
        name: "WC_narrowest",
        label: "waist, narrowest",
        sentence: "horizontal, the narrowest of the trunk",
        more_standards: &["ISAK"],
        level: LevelRule::Least("hip", "bust"),
        ..TRUNK
    },
    Definition {
        id: GirthId::WaistNavel,
        name: "WC_navel",
        label: "waist at the navel",
        sentence: "horizontal, at the navel",
        more_standards: &["ANSUR II waist at omphalion", "MESA"],
        level: LevelRule::Model("navel"),
        sets: &[Ansur],
        ..TRUNK
    },
    Definition {
        id: GirthId::WaistHipBone,
        name: "WC_hip_bone",
        label: "waist at the hip bone",
        sentence: "horizontal, at the top of the hip bone (iliac crest)",
        more_standards: &["NIH"],
        level: LevelRule::Model("top of the hip bone"),
        ..TRUNK
    },
    Definition {
        id: GirthId::Hip,
        name: "HC",
        label: "hip",
        sentence: "horizontal, at the greatest prominence of the buttocks",
        iso: Some("5.3.13"),
        more_standards: &["ANSUR II"],
        region: Region::Hip,
        level: LevelRule::Mark("greatest prominence of the buttocks"),
        sets: &[Iso8559, Who, Ansur, Paper],
        ..TRUNK
    },
    Definition {
        id: GirthId::HipGreatest,
        name: "HC_max",
        label: "hip, greatest",
        sentence: "horizontal, the longest tape near the hip's level",
        more_standards: &["WHO 2008"],
        region: Region::Hip,
        level: LevelRule::Greatest("3 % of stature below the hip", "3 % above it"),
        sets: &[Who],
        ..TRUNK
    },
    Definition {
        id: GirthId::UpperArm(Side::Left),
        name: "AC",
        label: "upper arm",
        sentence: "across the arm, midway between shoulder (acromion) and elbow",
        iso: Some("5.3.16"),
        region: Region::UpperArm,
        plane: PlaneRule::AcrossLimb,
        level: LevelRule::Share {
            from: "acromion",
            to: "elbow",
            at: 0.5,
        },
        sets: &[Iso8559, Paper],
        ..TRUNK
    },
    Definition {
        id: GirthId::UpperArmMean,
        name: "AC",
        label: "upper arm",
        sentence: "mean of AC_L and AC_R",
        iso: Some("5.3.16"),
        region: Region::UpperArm,
        plane: PlaneRule::AcrossLimb,
        level: LevelRule::Share {
            from: "acromion",
            to: "elbow",
            at: 0.5,
        },
        sets: &[Iso8559, Paper],
        ..TRUNK
    },
    Definition {
        id: GirthId::Thigh(Side::Left),
        name: "TC",
        label: "thigh",
        sentence: "horizontal, fullest below the crotch",
        iso: Some("5.3.20"),
        region: Region::Thigh,
        level: LevelRule::Greatest("knee", "crotch"),
        sets: &[Iso8559],
        ..TRUNK
    },
    Definition {
        id: GirthId::Calf(Side::Left),
        name: "CFC",
        label: "calf",
        sentence: "horizontal, greatest between ankle and knee",
        iso: Some("5.3.24"),
        more_standards: &["ANSUR II 6.4.22"],
        region: Region::Calf,
        level: LevelRule::Greatest("ankle", "knee"),
        sets: &[Iso8559, Ansur],
        ..TRUNK
    },
    Definition {
        id: GirthId::Picked,
        name: "PICKED",
        label: "through picked points",
        sentence: "through points picked by hand: least-squares plane, points within the mean edge length added until it no longer moves, one closed cubic spline",
        more_standards: &["the paper's §III-E, eq. 8"],
        region: Region::Anywhere,
        plane: PlaneRule::ThroughPoints,
        measured: Measured::Contour,
        ..TRUNK
    },
    Definition {
        id: GirthId::Own,
        name: "",
        label: "declared in the pipeline",
        sentence: "as the pipeline's table [girth.NAME] has it",
        region: Region::Anywhere,
        plane: PlaneRule::AcrossLimb,
        ..TRUNK
    },
];
