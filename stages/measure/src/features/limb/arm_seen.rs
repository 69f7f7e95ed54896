//! What a surface shows of an arm, by name: the features that laws of its joints read.

/// What a surface shows of an arm. Ways are along its line, from its middle joint on along the straight
/// line of the upper arm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArmSeen {
    /// Stature that shares are of. \[mm\]
    pub stature: f64,
    /// Way of the wrist. \[mm\]
    pub wrist: f64,
    /// Way of the last section that is the arm's alone, where the upper arm's line has its point. \[mm\]
    pub last: f64,
    /// [`ArmSeen::NAMES`], as far as the arm shows them.
    pub(crate) values: [Option<f64>; ArmSeen::NAMES.len()],
}

impl ArmSeen {
    /// Names of features; shares of stature, ways from the wrist.
    ///
    /// - `clear`: way of the last section that is the arm's alone.
    /// - `rise`, `inward`: components of the upper arm's unit direction toward the trunk, up and toward the
    ///   body's middle.
    /// - `neck_up`, `neck_in`: from that section to the middle of the neck's narrowest, up and toward the
    ///   body's middle, each times the direction's component.
    /// - `tape_1` to `tape_5`: girths 0.04, 0.08, 0.12, 0.16, 0.18 above the wrist.
    /// - `armpit`: way of the armpit's fold; `shoulder`: from there to where the line leaves the surface;
    ///   `shoulder_rise`: that times `rise`. All three for hanging arms only.
    /// - `bend`: way of the bend; for bent arms only.
    pub const NAMES: [&'static str; 14] = [
        "clear",
        "rise",
        "inward",
        "neck_up",
        "neck_in",
        "tape_1",
        "tape_2",
        "tape_3",
        "tape_4",
        "tape_5",
        "armpit",
        "shoulder",
        "shoulder_rise",
        "bend",
    ];

    /// Groups of features that laws read: the upper arm's line,
    pub const LINE: &'static [&'static str] = &["clear", "rise", "inward", "neck_up", "neck_in"];
    /// girths,
    pub const TAPES: &'static [&'static str] = &["tape_1", "tape_2", "tape_3", "tape_4", "tape_5"];
    /// a hanging arm's shoulder,
    pub const SHOULDER: &'static [&'static str] = &["armpit", "shoulder", "shoulder_rise"];
    /// a bent arm's elbow.
    pub const BEND: &'static [&'static str] = &["bend"];

    /// A feature by its name. `None` where the arm does not show it, and for a name that there is not.
    pub fn get(&self, name: &str) -> Option<f64> {
        let at = Self::NAMES.iter().position(|n| *n == name)?;
        self.values[at]
    }

    /// Features by their names; `None` if one is not shown.
    pub fn all(&self, names: &[&str]) -> Option<Vec<f64>> {
        names.iter().map(|name| self.get(name)).collect()
    }
}
