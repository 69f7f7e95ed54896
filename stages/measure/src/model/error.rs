//! What is wrong with a model file.

/// What is wrong with a model file.
#[derive(Debug, thiserror::Error)]
pub enum ModelError {
    /// Not TOML, cut short, or of another layout.
    #[error("{name} is no level model: {why}")]
    Syntax {
        /// The file.
        name: String,
        /// What the reader reports, with the line.
        why: String,
    },
    /// Another format or other readings.
    #[error(
        "{name} has {what} {got}, but this program knows {want}: refit it with pipelines/fit-levels.toml"
    )]
    Version {
        /// The file.
        name: String,
        /// `format` or `readings_version`.
        what: &'static str,
        /// What the file has.
        got: u32,
        /// What would fit.
        want: u32,
    },
    /// A variable that nobody knows.
    #[error("{name}: `{variable}` is neither a reading nor a level; known: {known}")]
    Variable {
        /// The file.
        name: String,
        /// The variable.
        variable: String,
        /// What there is.
        known: String,
    },
    /// A distribution that is none.
    #[error("{name}: the distribution of `{population}` {why}")]
    Distribution {
        /// The file.
        name: String,
        /// The population.
        population: String,
        /// What is wrong.
        why: &'static str,
    },
    /// A law that nobody asks for, or without one that is.
    #[error("{name}: {why}; known laws: {known}")]
    Law {
        /// The file.
        name: String,
        /// What is wrong.
        why: String,
        /// What there is.
        known: String,
    },
    /// Not one file.
    #[error("one model file is wanted, but {0} are there")]
    Count(usize),
}
