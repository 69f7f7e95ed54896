//! Why a girth is not given: a reason that code can compare and a sentence that people can read.

use serde::{Deserialize, Serialize};
use std::fmt;

/// Why a girth, or a height, is not given.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Refusal {
    /// No two legs: cut off, or under a skirt or coat.
    NoLegs,
    /// More than two legs: a chair, an animal, two people.
    ManyLegs,
    /// A large part of the surface is one plane: a body that is cut through.
    CutThrough,
    /// No neck between head and shoulders.
    NoNeck,
    /// The neck is a groove between head and shoulders, not a tube.
    NeckGroove,
    /// The top of the surface is no crown, so that its height is no stature.
    NoHead,
    /// Trunk and legs are not those of an upright body.
    NotUpright,
    /// No feet on the ground, and no ground that the cameras give.
    NoGround,
    /// The limb could not be followed from its tip to the trunk.
    NoLimb,
    /// The limb is one with the trunk, or with another limb, where the girth is taken.
    Fused,
    /// No arm is clear of the trunk, so nothing shows whether arms are in the section.
    NoArms,
    /// A hand or forearm is part of the section.
    Hand,
    /// Thighs are one on the surface far below the crotch.
    ThighsOne,
    /// No greatest girth of its own between the joints: a hem or bandage hides it.
    NoPeak,
    /// The plane has no closed section there.
    NoSection,
    /// The extreme that the definition asks for is not on this body.
    NoExtreme,
    /// The body is outside of what the level model was fitted on.
    OutOfRange,
    /// The interval is wider than ± 25 %, or reaches zero.
    TooUncertain,
    /// Some photos show no subject.
    EmptyPhoto,
    /// The outlines of some photos contradict those of all other photos.
    Outlines,
    /// A large part of the body is missing on the surface.
    Incomplete,
    /// Known lengths contradict each other.
    Disputed,
}

impl Refusal {
    /// All of them, in the order of the declaration.
    pub const ALL: [Refusal; 22] = [
        Refusal::NoLegs,
        Refusal::ManyLegs,
        Refusal::CutThrough,
        Refusal::NoNeck,
        Refusal::NeckGroove,
        Refusal::NoHead,
        Refusal::NotUpright,
        Refusal::NoGround,
        Refusal::NoLimb,
        Refusal::Fused,
        Refusal::NoArms,
        Refusal::Hand,
        Refusal::ThighsOne,
        Refusal::NoPeak,
        Refusal::NoSection,
        Refusal::NoExtreme,
        Refusal::OutOfRange,
        Refusal::TooUncertain,
        Refusal::EmptyPhoto,
        Refusal::Outlines,
        Refusal::Incomplete,
        Refusal::Disputed,
    ];

    /// A sentence: what is wrong and what would help.
    pub fn why(self) -> &'static str {
        match self {
            Refusal::NoLegs => {
                "the surface shows no two legs: is the body cut off, or do masks lack a leg? Stand with the feet apart, without coat or skirt"
            }
            Refusal::ManyLegs => {
                "the surface has more than two legs: is it a chair, an animal, or two people who touch? One person alone is wanted"
            }
            Refusal::CutThrough => {
                "a large part of the surface is one plane: is the body cut through, so that only a part of it is here?"
            }
            Refusal::NoNeck => {
                "no neck was found between head and shoulders: does hair or a collar hide it, or do the photos cut the head off?"
            }
            Refusal::NeckGroove => {
                "the neck is too short on this surface for a tape: lift the chin"
            }
            Refusal::NoHead => {
                "the top of the surface is flat, not a crown: the head is missing or cut off by the photos' border"
            }
            Refusal::NotUpright => {
                "trunk and legs are not those of an upright body: does it lie, sit, bend over, or stand on its head?"
            }
            Refusal::NoGround => {
                "no feet end on the ground, so nothing tells heights: is the body cut off, do trousers or a coat hide the feet, \
                 or is the ground of the cameras wrong?"
            }
            Refusal::NoLimb => {
                "this limb could not be followed from its end to the trunk: hold it away from the body"
            }
            Refusal::Fused => {
                "limb and trunk are one on the surface there: hold the limb farther away"
            }
            Refusal::NoArms => {
                "no arm stands clear of the trunk anywhere, so nothing tells whether arms are in this section: hold them away from the body"
            }
            Refusal::Hand => {
                "a hand or forearm is one with the body on the surface there: hold the hands farther away"
            }
            Refusal::ThighsOne => {
                "the thighs are one on the surface well below the crotch, so where they are fullest does not show: stand with the feet farther apart"
            }
            Refusal::NoPeak => {
                "nothing between the joints is fullest there: does a hem, a boot or a bandage hide it?"
            }
            Refusal::NoSection => "the surface has no closed section there",
            Refusal::NoExtreme => {
                "this body is nowhere narrowest or fullest between the marks of this definition: choose another"
            }
            Refusal::OutOfRange => {
                "the body lies outside of what the level model was fitted on, so the level is not known well enough"
            }
            Refusal::TooUncertain => {
                "the interval would be wider than 25 % to either side, so no number is given"
            }
            Refusal::EmptyPhoto => "a photo shows no subject: leave it out, or correct its mask",
            Refusal::Outlines => {
                "the outlines of some photos contradict those of all others: look at these masks"
            }
            Refusal::Incomplete => {
                "a large part of the body is missing on the surface: look at the masks"
            }
            Refusal::Disputed => {
                "known lengths contradict each other: correct one of them, or leave one out"
            }
        }
    }
}

impl Refusal {
    /// Its word in files: `no_legs`.
    pub fn code(self) -> &'static str {
        match self {
            Refusal::NoLegs => "no_legs",
            Refusal::ManyLegs => "many_legs",
            Refusal::CutThrough => "cut_through",
            Refusal::NoNeck => "no_neck",
            Refusal::NeckGroove => "neck_groove",
            Refusal::NoHead => "no_head",
            Refusal::NoGround => "no_ground",
            Refusal::NotUpright => "not_upright",
            Refusal::NoLimb => "no_limb",
            Refusal::ThighsOne => "thighs_one",
            Refusal::NoPeak => "no_peak",
            Refusal::Fused => "fused",
            Refusal::NoArms => "no_arms",
            Refusal::Hand => "hand",
            Refusal::NoSection => "no_section",
            Refusal::NoExtreme => "no_extreme",
            Refusal::OutOfRange => "out_of_range",
            Refusal::TooUncertain => "too_uncertain",
            Refusal::EmptyPhoto => "empty_photo",
            Refusal::Outlines => "outlines",
            Refusal::Incomplete => "incomplete",
            Refusal::Disputed => "disputed",
        }
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.why())
    }
}

impl std::error::Error for Refusal {}

#[cfg(test)]
mod tests {
    use super::Refusal;

    #[test]
    fn all_are_all_in_order_each_with_a_word_of_its_own() {
        let last = Refusal::Disputed as usize;
        assert_eq!(
            Refusal::ALL.map(|r| r as usize).to_vec(),
            (0..=last).collect::<Vec<_>>()
        );
        let words: std::collections::BTreeSet<_> = Refusal::ALL.iter().map(|r| r.code()).collect();
        assert_eq!(words.len(), Refusal::ALL.len());
    }
}
