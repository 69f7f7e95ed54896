//! Repairs of a mesh that crosses itself or hangs on threads: `pinch` → `repair` → `crossing`.

pub mod crossing;
pub mod pinch;
pub mod repair;
