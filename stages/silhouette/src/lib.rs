//! From photos to masks: where the body is.
//!
//! `photos`, `cameras` → [`GrabCut`] → `masks`
//! `files`, `photos` → [`Import`] → `masks`
//! `photos`, `cameras`, `tracks` → [`Walk`] → `masks`

mod align;
mod border;
mod cut;
mod empty;
mod grabcut;
mod import;
mod label;
mod likelihood;
mod one_photo;
mod params;
mod plate;
mod room;
mod scene;
mod walk;

pub use align::exposure::{Levels, exposure, relit};
pub use align::rectangle::{Rectangle, RectangleError};
pub use align::reduced::reduced;
pub use border::by_colors::by_colors;
pub use border::full_size::fine;
pub use border::soft_border::{coverage, soft_border};
pub use cut::least_cut::{Known, Window};
pub use cut::maxflow::{Grid, STEPS};
pub use grabcut::{GrabCut, GrabCutInput};
pub use import::{Body, Import, ImportError, ImportInput, ImportParams};
pub use label::color_cut::{Settings, coarse, cut, cut_whole};
pub use label::consensus::agreed;
pub use label::parts::largest;
pub use label::see_through_holes::Depths;
pub use likelihood::background::{Ground, Noise, background_cost};
pub use likelihood::colors_beside::Nearby;
pub use likelihood::gmm::Gmm;
pub use likelihood::prepared::{Disk, Prepared, prepare};
pub use params::{CutError, GrabCutParams};
pub use plate::expected::{expected, plate_turn, turned};
pub use room::doubtful_patches::doubtful;
pub use room::means::Means;
pub use room::recurring::{Recurring, recurring};
pub use room::rounds::{Cuts, without_plate};
pub use scene::backdrop::{Backdrop, middle, still, thinned};
pub use scene::disk_map::{laid_out, lay_into, point};
pub use scene::disk_plane::{on_disk, sample};
pub use scene::still_and_disk::{Scene, Shot};
pub use walk::{Walk, WalkCutError, WalkInput, WalkParams};

/// Every stage of this room, in the order in which data flows through it.
pub const STAGES: &[&dyn stage::AnyStage] = &[
    &stage::erase::<GrabCut>(),
    &stage::erase::<Import>(),
    &stage::erase::<Walk>(),
];
