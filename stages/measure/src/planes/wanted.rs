//! Which definitions the user wants: a set, and which waist is called WC.

use shape::{GirthId, GirthSet};

stage::choice! {
    /// Where the waist is; four definitions are in use.
    pub enum Waist {
        /// The natural waist, between lowest rib and hip bone (ISO 8559-1 5.3.10).
        Natural = "natural",
        /// The narrowest of the trunk (ISAK).
        Narrowest = "narrowest",
        /// The navel (MESA).
        Navel = "navel",
        /// The top of the hip bone (NIH).
        HipBone = "hip_bone",
    }
}

impl Waist {
    /// Its definition in the table.
    pub(crate) fn id(self) -> GirthId {
        match self {
            Waist::Natural => GirthId::WaistNatural,
            Waist::Narrowest => GirthId::WaistNarrowest,
            Waist::Navel => GirthId::WaistNavel,
            Waist::HipBone => GirthId::WaistHipBone,
        }
    }
}

stage::choice! {
    /// Which girths are wanted.
    pub enum Wanted {
        /// All that are known.
        All = "all",
        /// Those of ISO 8559-1.
        Iso8559 = "iso8559",
        /// Those of the WHO's waist–hip ratio.
        Who = "who",
        /// Those of ANSUR II that a standing body shows.
        Ansur = "ansur",
        /// The paper's five.
        Paper = "paper",
    }
}

impl Wanted {
    /// Whether a definition is wanted. What the user declared is.
    pub(crate) fn holds(self, by: GirthId) -> bool {
        let sets = by.definition().sets;
        by == GirthId::Own
            || match self {
                Wanted::All => true,
                Wanted::Iso8559 => sets.contains(&GirthSet::Iso8559),
                Wanted::Who => sets.contains(&GirthSet::Who),
                Wanted::Ansur => sets.contains(&GirthSet::Ansur),
                Wanted::Paper => sets.contains(&GirthSet::Paper),
            }
    }
}
