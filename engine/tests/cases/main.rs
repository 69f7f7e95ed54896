//! The engine on toys: what runs and what does not, kills, faults, many processes, laws.

mod cutoff;
mod document;
mod extends;
mod faults;
mod laws;
mod place;
mod power;
mod processes;
mod strands;
mod sweeping;
pub mod toys;
mod unlocked;
