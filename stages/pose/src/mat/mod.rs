//! A marker mat, printed (`print`, a stage, → `pages` → `layout`, `rim_layout`) and seen (`solve` →
//! `rim`, `bloom`, `planar` → `adjust`); both know `corners`. `recognise` finds the layout of a mat from its
//! tags in photos.

pub(crate) mod bloom;
pub(crate) mod corners;
pub(crate) mod layout;
pub(crate) mod pages;
pub(crate) mod planar;
pub(crate) mod print;
pub(crate) mod recognise;
pub(crate) mod rim;
pub(crate) mod rim_layout;
pub(crate) mod solve;
