//! Which girth: the names of the table, and those that users declare.

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

    /// What people call it.
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

/// A girth of the table, or one that the user declared. What it means is defined by its
/// [`definition`](GirthId::definition).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum GirthId {
    /// WC: the waist, by the definition that the user chose among the four below.
    Waist,
    /// The waist midway between lowest rib and hip bone.
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
    /// Declared by the user: its name, part and share are with the girth itself.
    Own,
}

impl GirthId {
    /// The left one of a pair, anything else as it is: what the table's rows are found by.
    pub(crate) fn sideless(self) -> GirthId {
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
}
