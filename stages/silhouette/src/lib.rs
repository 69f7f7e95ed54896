//! From photos to masks: where the body is.
//!
//! `photos`, `cameras` → [`GrabCut`] → `masks`

mod background;
mod border;
mod coherence;
mod gmm;
mod grabcut;
mod maxflow;
mod photo_cut;
mod segment;
mod unary;

pub use background::{expected, on_disk, plate_turn, sample, turned};
pub use border::{coverage, soft_border};
pub use coherence::agreed;
pub use gmm::Gmm;
pub use grabcut::{CutError, GrabCut, GrabCutInput, GrabCutParams};
pub use maxflow::{Grid, STEPS};
pub use photo_cut::{Disk, Prepared, coarse, fine, prepare};
pub use segment::{Known, Settings, Window, cut, cut_whole, largest, reduced};
pub use unary::{Ground, Noise, background_cost};

/// Every stage of this room, in the order in which data flows through it.
pub const STAGES: &[&dyn stage::AnyStage] = &[&stage::erase::<GrabCut>()];
