//! Where the number that a param has by default comes from.

/// Where a default comes from, and the evidence.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NumberSource {
    /// What is to be made, a seed, how much work is done at the most: nothing is claimed by it.
    Structural,
    /// It follows from other numbers by a formula.
    Derived(&'static str),
    /// A paper or a standard has it.
    Cited(&'static str),
    /// A program fitted it to data: which, and how it did on data that were left out.
    Fitted(&'static str),
    /// Set by hand, after looking at this.
    ByHand(&'static str),
    /// Set by hand; what was looked at is not on record.
    Unrecorded,
}

impl NumberSource {
    /// In a word or two.
    pub fn word(self) -> &'static str {
        match self {
            Self::Structural => "structural",
            Self::Derived(_) => "derived",
            Self::Cited(_) => "cited",
            Self::Fitted(_) => "fitted",
            Self::ByHand(_) | Self::Unrecorded => "by hand",
        }
    }

    /// The formula, the source, the program and its data, or what was looked at.
    pub fn what(self) -> &'static str {
        match self {
            Self::Structural => "",
            Self::Derived(what) | Self::Cited(what) | Self::Fitted(what) | Self::ByHand(what) => {
                what
            }
            Self::Unrecorded => "not on record",
        }
    }

    /// Whether a person chose the number.
    pub fn is_by_hand(self) -> bool {
        matches!(self, Self::ByHand(_) | Self::Unrecorded)
    }
}
