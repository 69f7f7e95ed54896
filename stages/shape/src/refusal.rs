//! Why a girth is not given: a reason that code can compare and a sentence that people can read.

use serde::{Deserialize, Serialize};
use std::fmt;

/// Why a girth, or a height, is not given.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Refusal {
    /// No two legs: cut off, or under a skirt or coat.
    NoLegs,
    /// No neck between head and shoulders.
    NoNeck,
    /// Trunk and legs are not those of an upright body.
    NotUpright,
    /// The limb could not be followed from its tip to the trunk.
    NoLimb,
    /// The limb is one with the trunk, or with another limb, where the girth is taken.
    Fused,
    /// A hand or forearm is part of the section.
    Hand,
    /// The plane has no closed section there.
    NoSection,
    /// The body lies outside of what the level model was fitted on.
    OutOfRange,
    /// The interval is wider than ± 25 %, or reaches zero.
    TooUncertain,
}

impl Refusal {
    /// A sentence: what is wrong and what would help.
    pub fn why(self) -> &'static str {
        match self {
            Refusal::NoLegs => {
                "no two legs were found: is the body cut off, or does a coat or a skirt hide them?"
            }
            Refusal::NoNeck => {
                "no neck was found between head and shoulders: does hair or a collar hide it, or do the photos cut the head off?"
            }
            Refusal::NotUpright => "trunk and legs are not those of an upright body",
            Refusal::NoLimb => {
                "this limb could not be followed from its end to the trunk: hold it away from the body"
            }
            Refusal::Fused => {
                "limb and trunk are one on the surface there: hold the limb farther away"
            }
            Refusal::Hand => {
                "a hand or forearm is one with the body on the surface there: hold the hands farther away"
            }
            Refusal::NoSection => "the surface has no closed section there",
            Refusal::OutOfRange => {
                "the body lies outside of what the level model was fitted on, so the level is not known well enough"
            }
            Refusal::TooUncertain => {
                "the interval would be wider than 25 % to either side, so no number is given"
            }
        }
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.why())
    }
}

impl std::error::Error for Refusal {}
