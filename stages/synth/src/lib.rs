//! From nothing to a capture whose truth is known by formula.
//!
//! ```text
//! solid ─┬─ girths ─────────┬─ score, against what a pipeline found
//!        └─ body ─┬─ masks ─┘ (jitter: their borders moved by chance)
//! ring ─┬─────────┤
//!       └─ sway ─┬┴─ turn ─ photos, as capture.load gives them ─ phone ─ photos, as a phone takes them
//!                └─ moved, the cameras as the body saw them
//! ```

mod anatomy;
mod background;
mod body;
mod bounds;
mod contour;
mod depths;
mod dice;
mod disk;
mod drawn;
mod errors;
mod field;
mod film;
mod frame;
mod girths;
mod jitter;
mod masks;
mod moved;
mod noise;
mod paced;
mod phone;
mod photograph;
mod raster;
mod restless;
mod ring;
mod score;
mod shaded;
mod shadow;
mod skin;
mod solid;
mod surface;
mod sway;
mod turn;
mod turn_params;

pub use anatomy::{Build, body as body_solid};
pub use body::{BodyInput, BodyParams, MakeBody};
pub use bounds::bounds;
pub use contour::{contour, length, taut};
pub use field::Field;
pub use frame::turn_between;
pub use girths::{FormulaGirths, FormulaInput};
pub use jitter::{JitterInput, JitterMasks, JitterParams};
pub use masks::{MaskInput, MaskParams, TrueMasks};
pub use moved::{MovedCameras, MovedInput};
pub use phone::masks::{PhoneMaskInput, PhoneMaskParams, PhoneMasks};
pub use phone::params::PhoneParams;
pub use phone::stage::{Phone, PhoneInput};
pub use raster::{Seen, cast};
pub use ring::{MakeRing, RingInput, RingParams, looking};
pub use score::{Score, ScoreInput};
pub use solid::{Figure, MakeSolid, SolidInput, SolidParams};
pub use surface::surface;
pub use sway::{MakeSway, SwayInput, SwayParams};
pub use turn::{TakePhotos, TurnInput};
pub use turn_params::TurnParams;

/// Every stage of this crate, in the order in which data flows through it.
pub const STAGES: &[&dyn stage::AnyStage] = &[
    &stage::erase::<MakeSolid>(),
    &stage::erase::<MakeBody>(),
    &stage::erase::<MakeRing>(),
    &stage::erase::<MakeSway>(),
    &stage::erase::<MovedCameras>(),
    &stage::erase::<TakePhotos>(),
    &stage::erase::<Phone>(),
    &stage::erase::<TrueMasks>(),
    &stage::erase::<JitterMasks>(),
    &stage::erase::<PhoneMasks>(),
    &stage::erase::<FormulaGirths>(),
    &stage::erase::<Score>(),
];
