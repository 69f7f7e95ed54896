//! A surface as its file has it.

use shape::Mesh;

/// More faces need gigabytes for what a tenth of them shows as well (structural: a limit of memory).
pub(crate) const MOST_FACES: usize = 4_000_000;

stage::choice! {
    /// The unit that a file's numbers are in.
    pub enum Unit {
        /// Millimetres.
        Mm = "mm",
        /// Centimetres.
        Cm = "cm",
        /// Metres.
        M = "m",
        /// Inches.
        Inch = "in",
        /// That in which the surface is nearest to a grown person's height.
        Auto = "auto",
    }
}

/// A surface as its file has it.
pub(crate) struct Read {
    /// In the file's numbers.
    pub(crate) mesh: Mesh,
    /// Their unit, where the format names one.
    pub(crate) unit: Option<Unit>,
}
