//! Which girth: the names of the table, and those that users declare.

use crate::girth_table::{Definition, TABLE};
use serde::{Deserialize, Serialize};

/// The subject's own left or right.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Side {
    /// The subject's left.
    Left,
    /// The subject's right.
    Right,
}

impl Side {
    /// Both, the left first.
    pub const BOTH: [Side; 2] = [Side::Left, Side::Right];

    /// What is added to a name: `_L`.
    pub fn suffix(self) -> &'static str {
        match self {
            Side::Left => "_L",
            Side::Right => "_R",
        }
    }

    /// What people say.
    pub fn word(self) -> &'static str {
        match self {
            Side::Left => "left",
            Side::Right => "right",
        }
    }

    /// Along the body's left: 1, or against it: −1.
    pub fn sign(self) -> f64 {
        match self {
            Side::Left => 1.0,
            Side::Right => -1.0,
        }
    }
}

/// A girth of the table, or one that the user declared. What it means is told by its
/// [`definition`](GirthId::definition).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum GirthId {
    /// WC: the waist, by the definition that the user chose among the four below.
    Waist,
    /// The waist amid lowest rib and hip bone.
    WaistNatural,
    /// The narrowest of the trunk.
    WaistNarrowest,
    /// The waist at the navel.
    WaistNavel,
    /// The waist at the top of the hip bone.
    WaistHipBone,
    /// HC: the hip.
    Hip,
    /// The longest tape near the hip.
    HipGreatest,
    /// CC: chest or bust.
    Chest,
    /// NC: the neck.
    Neck,
    /// AC: an upper arm.
    UpperArm(Side),
    /// The mean of both upper arms.
    UpperArmMean,
    /// TC: a thigh.
    Thigh(Side),
    /// CFC: a calf.
    Calf(Side),
    /// Through points picked by hand.
    Picked,
    /// Declared by the user: its name, part and share stand with the girth itself.
    Own,
}

impl GirthId {
    /// Its row of the table.
    pub fn definition(self) -> &'static Definition {
        let row = TABLE.iter().find(|row| row.id == self.sideless());
        row.expect("bug: a girth without a row in the table")
    }

    /// The left one of a pair, anything else as it is: what the table's rows are found by.
    fn sideless(self) -> GirthId {
        match self {
            GirthId::UpperArm(_) => GirthId::UpperArm(Side::Left),
            GirthId::Thigh(_) => GirthId::Thigh(Side::Left),
            GirthId::Calf(_) => GirthId::Calf(Side::Left),
            other => other,
        }
    }

    /// Which side of the body, where there are two.
    pub fn side(self) -> Option<Side> {
        match self {
            GirthId::UpperArm(side) | GirthId::Thigh(side) | GirthId::Calf(side) => Some(side),
            _ => None,
        }
    }

    /// Its name in files: `WC`, `AC_L`.
    pub fn name(self) -> String {
        let suffix = self.side().map_or("", Side::suffix);
        format!("{}{suffix}", self.definition().name)
    }

    /// What people call it: `upper arm, left`.
    pub fn label(self) -> String {
        let label = self.definition().label;
        match self.side() {
            Some(side) => format!("{label}, {}", side.word()),
            None => label.to_owned(),
        }
    }

    /// The girth of a name in a file; `None` for one that a user declared.
    pub fn named(name: &str) -> Option<GirthId> {
        GirthId::all().find(|id| id.name() == name)
    }

    /// Every girth of the table but [`Own`](GirthId::Own), left and right apart.
    pub fn all() -> impl Iterator<Item = GirthId> {
        let sides = |row: &'static Definition| match row.id {
            GirthId::UpperArm(_) => Side::BOTH.map(GirthId::UpperArm).to_vec(),
            GirthId::Thigh(_) => Side::BOTH.map(GirthId::Thigh).to_vec(),
            GirthId::Calf(_) => Side::BOTH.map(GirthId::Calf).to_vec(),
            GirthId::Own => vec![],
            other => vec![other],
        };
        TABLE.iter().flat_map(sides)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_girth_has_a_row_and_a_name_of_its_own() {
        let mut names: Vec<String> = GirthId::all().map(GirthId::name).collect();
        for (id, name) in GirthId::all().zip(&names) {
            assert_eq!(GirthId::named(name), Some(id), "{name}");
            assert!(!id.definition().sentence.is_empty());
        }
        assert_eq!(GirthId::named("mid_thigh_L"), None);
        assert_eq!(GirthId::UpperArm(Side::Right).name(), "AC_R");
        assert_eq!(GirthId::Calf(Side::Left).label(), "calf, left");
        let count = names.len();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), count);
    }
}
