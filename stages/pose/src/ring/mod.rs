//! Cameras without a mat, from features: `solve` → `any_order` (nobody knows the order: `walk`), `cameras`
//! (what was adjusted becomes cameras, or a refusal: `folded`) → `trial`, `places`, `pairs` → `start`.

pub(crate) mod any_order;
pub(crate) mod cameras;
pub(crate) mod error;
pub(crate) mod folded;
pub(crate) mod pairs;
pub(crate) mod places;
pub(crate) mod solve;
pub(crate) mod stabiliser;
pub(crate) mod start;
pub(crate) mod trial;
pub(crate) mod trusted;
