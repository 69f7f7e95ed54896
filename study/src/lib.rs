//! Results beside each other: sides compared, truth, repetitions, one person over time.

pub mod compare;
pub mod girth_file;
mod messages;
pub mod over_time;
pub mod reader;
pub mod repeat;
pub mod score;
mod sections;
mod table;

pub use messages::MESSAGES;
