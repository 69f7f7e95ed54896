//! Why a model cannot be fitted.

/// Why there is no fit.
#[derive(Debug, thiserror::Error)]
pub enum FitError {
    /// Too few bodies show a reading.
    #[error("only {rows} bodies show `{reading}`, but {least} are needed to line it up")]
    Few {
        /// The reading.
        reading: &'static str,
        /// How many.
        rows: usize,
        /// How many are needed.
        least: usize,
    },
    /// Columns that are the same.
    #[error("`{0}` cannot be lined up: its measures depend on each other")]
    Singular(&'static str),
}
