//! Results beside each other: sides compared, truth, repetitions, one person over time.

pub mod compare;
pub mod girth_file;
pub mod over_time;
pub mod repeat;
pub mod score;
mod sections;
