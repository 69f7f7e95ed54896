//! From photos to masks: where the body is.
//!
//! `photos`, `cameras` → [`GrabCut`] → `masks`
//! `files`, `photos` → [`Import`] → `masks`
//! `photos`, `cameras`, `tracks` → [`Walk`] → `masks`

mod agree;
mod around;
mod backdrop;
mod background;
mod border;
mod boxed;
mod choices;
mod coherence;
mod common_place;
mod disk_colors;
mod disk_top;
mod doubt;
mod empty;
mod exposure;
mod full_size;
mod gap_tops;
mod gmm;
mod grabcut;
mod grain;
mod grounds;
mod import;
mod least_cut;
mod level;
mod maxflow;
mod means;
mod modes;
mod nearby;
mod noise;
mod one_photo;
mod params;
mod parts;
mod photo_cut;
mod recur;
mod scene;
mod seams;
mod segment;
mod strays;
mod tiles;
mod tunnels;
mod turn;
mod unary;
mod walk;

pub use backdrop::{Backdrop, middle, still, thinned};
pub use background::{expected, on_disk, plate_turn, sample, turned};
pub use border::{coverage, soft_border};
pub use boxed::{Rectangle, RectangleError, by_colors};
pub use coherence::agreed;
pub use disk_top::{laid_out, lay_into, point};
pub use doubt::doubtful;
pub use exposure::{Levels, exposure, relit};
pub use full_size::fine;
pub use gmm::Gmm;
pub use grabcut::{GrabCut, GrabCutInput};
pub use import::{Body, Import, ImportError, ImportInput, ImportParams};
pub use least_cut::{Known, Window};
pub use maxflow::{Grid, STEPS};
pub use means::Means;
pub use nearby::Nearby;
pub use params::{CutError, GrabCutParams};
pub use parts::largest;
pub use photo_cut::{Disk, Prepared, coarse, prepare};
pub use recur::{Recurring, recurring};
pub use scene::{Scene, Shot};
pub use segment::{Settings, cut, cut_whole, reduced};
pub use tunnels::Depths;
pub use turn::{Cuts, without_plate};
pub use unary::{Ground, Noise, background_cost};
pub use walk::{Walk, WalkCutError, WalkInput, WalkParams};

/// Every stage of this room, in the order in which data flows through it.
pub const STAGES: &[&dyn stage::AnyStage] = &[
    &stage::erase::<GrabCut>(),
    &stage::erase::<Import>(),
    &stage::erase::<Walk>(),
];
