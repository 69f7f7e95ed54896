//! From a hull to the body's surface: inter-image consistency.
//!
//! ```text
//! mesh, photos, cameras, masks ─┬─ Steady → cameras   the body held still
//!                               ├─ Bend   → warps     arms, head and chest held still
//!                               ├─ Settle → mesh      consistency, silhouettes, plate; level by level
//!                               ├─ Evolve → mesh      the paper's eq. 3 and 5–7
//!                               └─ Texture → textured colours from the photos
//! ```

pub mod atlas;
pub mod bend;
mod bend_stage;
pub mod crossing;
pub mod curvature;
pub mod depth;
pub mod energy;
mod evolve_stage;
pub mod labels;
pub mod look;
pub mod median;
pub mod mend;
mod need;
pub mod outside;
pub mod patch;
pub mod picture;
pub mod pinch;
pub mod remesh;
pub mod rims;
mod round;
pub mod scene;
pub mod settle;
mod settle_stage;
pub mod sights;
pub mod smooth;
#[cfg(test)]
mod solids;
mod steady;
pub mod sway;
pub mod sweep;
mod texture;
pub mod tugs;

pub use bend_stage::{Bend, BendInput, BendParams};
pub use evolve_stage::{Evolve, EvolveInput, EvolveParams, Flow};
pub use scene::RefineError;
pub use settle_stage::{Settle, SettleInput, SettleParams};
pub use steady::{Steady, SteadyInput, SteadyParams};
pub use texture::{Texture, TextureInput, TextureParams};

/// Every stage of this room, in the order in which data flows through it.
pub const STAGES: &[&dyn stage::AnyStage] = &[
    &stage::erase::<Steady>(),
    &stage::erase::<Bend>(),
    &stage::erase::<Settle>(),
    &stage::erase::<Evolve>(),
    &stage::erase::<Texture>(),
];
