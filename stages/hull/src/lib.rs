//! From masks and cameras to a first mesh: the visual hull.
//!
//! `masks`, `cameras` → [`Carve`] → `mesh`

mod carve;
mod cases;
mod contradicted;
mod field;
mod left_out;
mod silhouettes;
mod surface;

pub use carve::{Carve, CarveError, CarveInput, CarveParams};
pub use cases::{Case, EDGES, Place, cases};
pub use field::{BRICK, Bricks, Lattice, SIDE, evaluate};
pub use silhouettes::{bounds, consensus};
pub use surface::{largest, surface};

/// Every stage of this crate, in the order in which data flows through it.
pub const STAGES: &[&dyn stage::AnyStage] = &[&stage::erase::<Carve>().failing(CODED)];

/// Every kind of message of this crate.
pub const MESSAGES: &[&[stage::Template]] =
    &[carve::MESSAGES, left_out::MESSAGES, CarveError::MESSAGES];

/// The errors that have codes.
const CODED: &[stage::Recognise] = &[stage::recognise::<CarveError>];
