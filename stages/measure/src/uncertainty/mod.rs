//! How sure a girth is, part by part.

pub(crate) mod clothes;
pub(crate) mod contradicted;
pub(crate) mod covered;
pub(crate) mod edges;
pub(crate) mod interval;
pub(crate) mod outlines;
pub(crate) mod periodic;
pub(crate) mod places;
pub(crate) mod reported;
pub(crate) mod silhouette;
pub(crate) mod unobserved;
