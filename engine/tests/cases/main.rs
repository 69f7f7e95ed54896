//! The engine on toys: what runs and what does not, kills, faults, many processes, laws.

mod asked;
mod bucket;
mod cutoff;
mod document;
mod extends;
mod faults;
mod laws;
mod place;
mod points;
mod points_refused;
mod processes;
mod replicates;
mod shared;
mod shared_faults;
mod signed;
mod strands;
mod sweeping;
pub mod toys;
mod unlocked;
