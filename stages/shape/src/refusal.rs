//! Why a girth is not given: a reason that code can compare and a sentence that people can read.

use serde::{Deserialize, Serialize};
use stage::{Message, Template};
use std::fmt;

stage::messages! {
    NO_LEGS = "warn-no-legs": "the surface shows no two legs: is the body cut off, or do masks lack a leg? Place the feet apart, without coat or skirt";
    MANY_LEGS = "warn-many-legs": "the surface has more than two legs: is it a chair, an animal, or two people who touch? One person alone is wanted";
    CUT_THROUGH = "warn-cut-through": "a large part of the surface is one plane: is the body cut through, so that only a part of it is here?";
    NO_NECK = "warn-no-neck": "no neck was found between head and shoulders: does hair or a collar hide it, or do the photos cut the head off?";
    NECK_GROOVE = "warn-neck-groove": "the neck is too short on this surface for a tape: lift the chin";
    NO_HEAD = "warn-no-head": "the top of the surface is flat, not a crown: the head is missing or cut off by the photos' border";
    NOT_UPRIGHT = "warn-not-upright": "trunk and legs are not those of an upright body: is it lying, sitting, bent over, or upside down?";
    NO_GROUND = "warn-no-ground": "no feet end on the ground, so heights are not known: is the body cut off, do trousers or a coat hide the feet, or is the ground of the cameras wrong?";
    NO_LIMB = "warn-no-limb": "this limb could not be followed from its end to the trunk: hold it away from the body";
    FUSED = "warn-fused": "limb and trunk are one on the surface there: hold the limb farther away";
    NO_ARMS = "warn-no-arms": "no arm is clear of the trunk anywhere, so it is not known whether arms are in this section: keep them away from the body";
    HAND = "warn-hand": "a hand or forearm is one with the body on the surface there: hold the hands farther away";
    THIGHS_ONE = "warn-thighs-one": "the thighs are one on the surface well below the crotch, so where they are fullest does not show: place the feet farther apart";
    NO_PEAK = "warn-no-peak": "nothing between the joints is fullest there: does a hem, a boot or a bandage hide it?";
    NO_SECTION = "warn-no-section": "the surface has no closed section there";
    NO_EXTREME = "warn-no-extreme": "this body is nowhere narrowest or fullest between the marks of this definition: choose another";
    OUT_OF_RANGE = "warn-out-of-range": "the body is outside of what the level model was fitted on, so the level is not known well enough";
    TOO_UNCERTAIN = "warn-too-uncertain": "the interval would be too wide to be of use, so no number is given: more and larger photos, tight clothes, arms away from the body and a photo of the empty scene make it narrower";
    EMPTY_PHOTO = "warn-empty-photo": "a photo shows no subject: leave it out, or correct its mask";
    OUTLINES = "warn-outlines": "the outlines of some photos contradict those of all other photos: look at these masks";
    INCOMPLETE = "warn-incomplete": "a large part of the body is missing on the surface: look at the masks";
    DISPUTED = "warn-lengths": "known lengths contradict each other: correct one of them, or leave one out";
}

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
    /// The interval is wider than asked for, or reaches zero.
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
        self.template().english
    }

    /// The same as a message.
    pub fn message(self) -> Message {
        Message::new(&self.template(), [])
    }

    /// The message's kind.
    fn template(self) -> Template {
        match self {
            Refusal::NoLegs => NO_LEGS,
            Refusal::ManyLegs => MANY_LEGS,
            Refusal::CutThrough => CUT_THROUGH,
            Refusal::NoNeck => NO_NECK,
            Refusal::NeckGroove => NECK_GROOVE,
            Refusal::NoHead => NO_HEAD,
            Refusal::NotUpright => NOT_UPRIGHT,
            Refusal::NoGround => NO_GROUND,
            Refusal::NoLimb => NO_LIMB,
            Refusal::Fused => FUSED,
            Refusal::NoArms => NO_ARMS,
            Refusal::Hand => HAND,
            Refusal::ThighsOne => THIGHS_ONE,
            Refusal::NoPeak => NO_PEAK,
            Refusal::NoSection => NO_SECTION,
            Refusal::NoExtreme => NO_EXTREME,
            Refusal::OutOfRange => OUT_OF_RANGE,
            Refusal::TooUncertain => TOO_UNCERTAIN,
            Refusal::EmptyPhoto => EMPTY_PHOTO,
            Refusal::Outlines => OUTLINES,
            Refusal::Incomplete => INCOMPLETE,
            Refusal::Disputed => DISPUTED,
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
