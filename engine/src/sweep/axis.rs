//! Params that vary together, and why what varies cannot be read.

use stage::Value;

/// Params that vary together, and the values that they take: one row a step.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Node and param.
    pub params: Vec<(String, String)>,
    /// One value a param in each row.
    pub rows: Vec<Vec<Value>>,
}

/// What varies cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum AxisError {
    /// Of unequal length.
    #[error("{0} go side by side, but take {1} values: give each the same number")]
    Unequal(String, String),
    /// A table of points.
    #[error("{file}: {why}")]
    Table {
        /// The file.
        file: String,
        /// What is wrong.
        why: String,
    },
    /// On the command line.
    #[error(
        "`--sweep {0}`: give NODE.PARAM=2,3,4 or NODE.PARAM=2..8/4 (4 values from 2 to 8), with `log` behind it for equal ratios"
    )]
    Given(String),
    /// A range without the number of its values.
    #[error("`--sweep {0}`: give how many values: {0}/5 is five, with both ends")]
    HowMany(String),
    /// Replicates of what has no seed.
    #[error("{0}")]
    NoSeed(String),
    /// A seed in an axis of its own.
    #[error("`{0}` varies by itself and by `replicate`: leave one of them out")]
    SeedVaries(String),
    /// More replicates than numbers.
    #[error("`{0}` is {1} and may be {2} at most: give it a smaller number, or fewer replicates")]
    SeedEnds(String, i64, f64),
    /// A sample of what is no range.
    #[error(
        "a sample takes values from `over`; `zip` and `csv` name those that go together, so leave one of them out"
    )]
    SampleOfTable,
}
