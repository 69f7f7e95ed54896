//! Features of photos: `sift` (a stage) → `detect`, `describe` → `pyramid`, `gradients`; followed from
//! photo to photo by `tracks` (a stage) → `pair` → `matching` (`best`) and `two_view`; `order`: whether the photos
//! are in that of the turn.

pub(crate) mod best;
pub(crate) mod describe;
pub(crate) mod detect;
pub(crate) mod gradients;
pub(crate) mod matching;
pub(crate) mod moving;
pub(crate) mod order;
pub(crate) mod pair;
pub(crate) mod params;
pub(crate) mod pyramid;
pub(crate) mod quota;
pub(crate) mod sift;
pub(crate) mod tracks;
