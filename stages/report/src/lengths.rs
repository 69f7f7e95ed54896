//! What lengths on the page are in.

use shape::Unit;

stage::choice! {
    /// What lengths are shown in; files stay as they are.
    pub enum ShownIn {
        /// Centimetres.
        Cm = "cm",
        /// Inches.
        Inch = "in",
    }
}

/// What lengths on the page are in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Lengths {
    /// Centimetres.
    Cm,
    /// Inches.
    Inch,
    /// Shares of the camera ring's radius.
    Relative,
}

impl Lengths {
    /// As the user wants them; relative where nothing is known in millimetres.
    pub(crate) fn of(unit: Unit, wanted: ShownIn) -> Self {
        match (unit, wanted) {
            (Unit::Relative, _) => Lengths::Relative,
            (Unit::Metric, ShownIn::Cm) => Lengths::Cm,
            (Unit::Metric, ShownIn::Inch) => Lengths::Inch,
        }
    }

    /// Millimetres in one of them, and digits behind the point.
    pub(crate) fn scale(self) -> (f64, usize) {
        match self {
            Lengths::Cm => (10.0, 1),
            Lengths::Inch => (25.4, 1),
            Lengths::Relative => (1000.0, 4),
        }
    }

    /// A length for people, without its unit.
    pub(crate) fn text(self, mm: f64) -> String {
        let (one, digits) = self.scale();
        format!("{:.digits$}", mm / one)
    }

    /// The same for what is small, such as a standard deviation.
    pub(crate) fn fine(self, mm: f64) -> String {
        match self {
            Lengths::Cm => format!("{:.2}", mm / 10.0),
            Lengths::Inch => format!("{:.2}", mm / 25.4),
            Lengths::Relative => self.text(mm),
        }
    }

    /// What they are in.
    pub(crate) fn word(self) -> &'static str {
        match self {
            Lengths::Cm => "cm",
            Lengths::Inch => "in",
            Lengths::Relative => "relative",
        }
    }
}
