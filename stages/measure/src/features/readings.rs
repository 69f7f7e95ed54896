//! What a surface tells a level model: heights and lengths by name, as shares of stature.
//!
//! The crotch is no reading: thighs that touch, and underwear, join legs on a surface centimetres below
//! where a survey's measurers find it.

use super::body::Body;
use super::marks::{Marks, between_slices};
use super::whole::no_stature;

/// Raise it whenever a reading may come out otherwise on the same surface: model files name it (structural: a version).
pub const READINGS_VERSION: u32 = 2;

/// One thing that is read off a surface. Heights are above the ground; all are shares of stature
/// unless noted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Reading {
    /// Logarithm of stature against 1700 mm; unknown where lengths are relative.
    LnStature,
    /// Where the buttocks reach farthest back.
    Buttock,
    /// The narrowest level section of the neck.
    Neck,
    /// Tape around the narrowest level section of the neck.
    NeckTape,
    /// Tape around the hip at the buttocks.
    HipTape,
    /// Tape around the trunk a quarter of the way from buttocks to neck.
    BellyTape,
    /// Tape around the trunk at two fifths of the way.
    WaistTape,
    /// Depth of the trunk from front to back at two thirds of the way.
    ChestDepth,
    /// Bust or pectorals: farthest before the line from belly to throat.
    Bust,
    /// Where the outline from the side comes to a point at the bust, if it does.
    Apex,
}

impl Reading {
    /// All of them, in the order of a model file.
    pub const ALL: [Reading; 10] = [
        Reading::LnStature,
        Reading::Buttock,
        Reading::Neck,
        Reading::NeckTape,
        Reading::HipTape,
        Reading::BellyTape,
        Reading::WaistTape,
        Reading::ChestDepth,
        Reading::Bust,
        Reading::Apex,
    ];

    /// What a model file calls it.
    pub fn name(self) -> &'static str {
        match self {
            Reading::LnStature => "ln_stature",
            Reading::Buttock => "buttock",
            Reading::Neck => "neck",
            Reading::NeckTape => "neck_tape",
            Reading::HipTape => "hip_tape",
            Reading::BellyTape => "belly_tape",
            Reading::WaistTape => "waist_tape",
            Reading::ChestDepth => "chest_depth",
            Reading::Bust => "bust",
            Reading::Apex => "apex",
        }
    }
}

/// A body's readings; what does not show is not there.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Readings {
    values: [Option<f64>; Reading::ALL.len()],
    spread: [f64; Reading::ALL.len()],
}

impl Readings {
    /// One of them.
    pub fn get(&self, reading: Reading) -> Option<f64> {
        self.values[reading as usize]
    }

    /// How far a reading may be elsewhere on this very surface: a standard deviation, nought where it is sharp.
    pub fn spread(&self, reading: Reading) -> f64 {
        self.spread[reading as usize]
    }

    /// With one of them set, or taken away.
    #[must_use]
    pub fn with(mut self, reading: Reading, value: Option<f64>) -> Self {
        self.values[reading as usize] = value.filter(|v| v.is_finite());
        self
    }

    /// With one of them so far spread.
    #[must_use]
    pub fn spread_by(mut self, reading: Reading, spread: f64) -> Self {
        self.spread[reading as usize] = spread;
        self
    }
}

/// The stature that [`Reading::LnStature`] is against (structural: where the logarithm is zero). \[mm\]
const USUAL_MM: f64 = 1700.0;
/// A bust's apex counts from this sharpness on. By hand: looked at two made bodies, at 0.7 and 1.4 of it: no tape
/// changes.
const LEAST_SHARPNESS: f64 = 0.25;

/// Reads a body whose marks were found. `absolute` is whether its lengths are millimetres, not
/// relative. `None` where its height is no stature.
pub fn readings(body: &Body, marks: &Marks, absolute: bool) -> Option<Readings> {
    if no_stature(body).is_some() {
        return None;
    }
    let s = body.stature;
    let long = marks.neck - marks.hip;
    let at = |share: f64| body.ground + marks.hip + share * long;
    // Where no arm is clear, arms may be before the trunk or on it.
    let clear = marks.arm_is_clear;
    let tape = |share: f64| Some(trunk_tape(body, at(share)).filter(|_| clear)? / s);
    let apex = marks
        .apex
        .filter(|(_, sharp)| clear && *sharp >= LEAST_SHARPNESS);
    let read = by_neck(body, absolute)?
        .with(Reading::Buttock, marks.hip_shows.then_some(marks.hip / s))
        .spread_by(Reading::Buttock, marks.hip_spread / s)
        .with(Reading::HipTape, tape(0.0).filter(|_| marks.hip_shows))
        .with(Reading::BellyTape, tape(0.25))
        .with(Reading::WaistTape, tape(0.4))
        .with(Reading::ChestDepth, clear.then_some(marks.chest_depth / s))
        .with(Reading::Bust, clear.then_some(marks.bust / s))
        .with(Reading::Apex, apex.map(|(z, _)| z / s));
    Some(read)
}

/// The stature, where lengths are millimetres.
pub(crate) fn size(body: &Body, absolute: bool) -> Readings {
    let ln = absolute.then(|| libm::log(body.stature / USUAL_MM));
    Readings::default().with(Reading::LnStature, ln)
}

/// What stature and neck tell, of whatever has a neck.
pub(crate) fn by_neck(body: &Body, absolute: bool) -> Option<Readings> {
    let (s, neck) = (body.stature, body.neck?);
    let read = size(body, absolute)
        .with(Reading::Neck, Some((neck - body.ground) / s))
        .with(Reading::NeckTape, body.trunk(neck).map(|r| r.tape / s));
    Some(read)
}

/// Tape around the trunk at a height, where no arm is part of it. \[mm\]
fn trunk_tape(body: &Body, z: f64) -> Option<f64> {
    let free = |side: f64| !super::arms::merged(body, z, side);
    let tape = between_slices(body, z, |s| Some(s.rings.first()?.tape));
    tape.filter(|_| free(1.0) && free(-1.0))
}
