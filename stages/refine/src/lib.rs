//! From a hull to the body's surface: inter-image consistency.

/// Every stage of this room, in the order in which data flows through it.
pub const STAGES: &[&dyn stage::AnyStage] = &[];
