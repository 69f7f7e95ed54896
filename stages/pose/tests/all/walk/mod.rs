//! Cameras of a walk: a made scene, photos in no order, upright and sideways, from near and far.

mod adjustment;
mod cameras;
mod links;
mod scene;
