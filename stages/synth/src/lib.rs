//! From nothing to a capture whose truth is known by formula.

/// Every stage of this room, in the order in which data flows through it.
pub const STAGES: &[&dyn stage::AnyStage] = &[];
