//! From a surface to girths.

/// Every stage of this room, in the order in which data flows through it.
pub const STAGES: &[&dyn stage::AnyStage] = &[];
