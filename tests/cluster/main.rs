//! Past one machine: strands of a plan worked on by processes that know nothing of each other.

mod place;
mod workers;
