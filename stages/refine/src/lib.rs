//! From a hull to the body's surface: inter-image consistency.
//!
//! ```text
//! mesh, photos, cameras, masks ─┬─ CompensateMotion    → cameras    the body kept still
//!                               ├─ EstimateDeformation → warps      arms, head and chest kept still
//!                               ├─ OptimizeSurface     → mesh       consistency, silhouettes, a bending term; level by level
//!                               ├─ Evolve              → mesh       the paper's eq. 3 and 5–7
//!                               └─ Texture             → textured   colours from the photos
//! ```
//!
//! Folders, each knowing only those below it:
//!
//! | folder | what |
//! |---|---|
//! | `motion`, `surface`, `texture` | the stages and what is their own; none knows another |
//! | `mend` | repairs of a mesh |
//! | `evidence` | what photos and silhouettes show at a vertex |
//! | `pictures` | photos made ready to be compared |
//! | `geometry` | curvature, remeshing, large systems |

pub mod evidence;
pub mod geometry;
pub mod mend;
pub mod motion;
pub mod pictures;
pub mod surface;
pub mod texture;

pub use motion::compensate::{CompensateMotion, CompensateMotionInput, CompensateMotionParams};
pub use motion::deformation::{
    EstimateDeformation, EstimateDeformationInput, EstimateDeformationParams,
};
pub use pictures::prepare::RefineError;
pub use surface::evolve::{Evolve, EvolveInput};
pub use surface::optimize::{OptimizeSurface, OptimizeSurfaceInput};
pub use surface::params::{EvolveParams, Flow, OptimizeSurfaceParams};
pub use texture::stage::{Texture, TextureInput, TextureParams};

/// Every stage of this crate, in the order in which data flows through it.
pub const STAGES: &[&dyn stage::AnyStage] = &[
    &stage::erase::<CompensateMotion>().failing(CODED),
    &stage::erase::<EstimateDeformation>().failing(CODED),
    &stage::erase::<OptimizeSurface>().failing(CODED),
    &stage::erase::<Evolve>().failing(CODED),
    &stage::erase::<Texture>().failing(CODED),
];

/// Every kind of message of this crate.
pub const MESSAGES: &[&[stage::Template]] = &[
    surface::evolve::MESSAGES,
    surface::optimize::MESSAGES,
    RefineError::MESSAGES,
];

/// The errors that have codes.
const CODED: &[stage::Recognise] = &[
    stage::recognise::<RefineError>,
    stage::recognise::<shape::PhotoError>,
];
