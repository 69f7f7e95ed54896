//! Photos as a phone would have taken them: a fault each, all off unless asked for.

pub(crate) mod draw;
pub(crate) mod finish;
pub(crate) mod lens;
pub(crate) mod masks;
pub(crate) mod params;
pub(crate) mod stage;
pub(crate) mod tone;
