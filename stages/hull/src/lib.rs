//! From masks and cameras to a first mesh: the visual hull.

/// Every stage of this room, in the order in which data flows through it.
pub const STAGES: &[&dyn stage::AnyStage] = &[];
