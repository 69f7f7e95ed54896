//! Sections and limbs of surfaces, as `measure` takes them.

pub(crate) use measure::{Body, body, flat, limbs, parts, section, taken as section_at, tape};
