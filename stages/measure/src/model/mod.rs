//! Levels as a model in a file: joint normal distributions over what a surface shows and the levels
//! that it does not show.

pub(crate) mod crotch;
pub(crate) mod cut;
pub(crate) mod error;
pub(crate) mod families;
pub(crate) mod file;
pub(crate) mod fit;
pub(crate) mod fit_error;
pub(crate) mod fit_stage;
pub(crate) mod held_out;
pub(crate) mod larynx;
pub(crate) mod law;
pub(crate) mod law_fit;
pub(crate) mod level;
pub(crate) mod line_up;
pub(crate) mod necks;
pub(crate) mod normal;
pub(crate) mod predict;
pub(crate) mod samples;
pub(crate) mod table;
pub(crate) mod tails;
pub(crate) mod tapes;
pub(crate) mod write;
