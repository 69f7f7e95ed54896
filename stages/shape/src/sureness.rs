//! How sure a girth is, part by part, and what is odd about it.

use serde::{Deserialize, Serialize};
use stage::{Message, message};

stage::messages! {
    OPEN = "note-open": "no photo shows the outline along part of this section (hands in front, or too few photos): up to {share:.1 %} of the tape may not be body; take more photos, or hold the hands farther away";
    WORN = "warn-worn": "what is worn hangs away from the legs at its hem, so up to {share:.0 %} of this girth may be clothes: wear tight shorts";
    SPLINE_LEFT = "warn-spline-left": "the smooth curve through the surface's points (the spline) is {off:+.0 %} off the exact section: the surface is too coarse there; take the tape or the contour";
    FOLDS = "warn-folds": "the skin is {share:.0 %} longer than a tape, which points to a hole in the surface or to an arm that touches it: look at the section";
}

/// Standard deviations to either side of the middle that hold nine in ten of a normal distribution (derived: its 95th
/// percentile).
pub const NINE_IN_TEN: f64 = 1.645;

/// What a girth's uncertainty is made of: standard deviations of the tape; `None` is unknown,
/// 0 is "none". \[mm\]
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Sigmas {
    /// Where the tape is: how sure the plane is, by how the tape changes beside it.
    pub level_mm: Option<f64>,
    /// The surface's error along its normal.
    pub surface_mm: Option<f64>,
    /// The unit of length.
    pub scale_mm: Option<f64>,
    /// What another limb hides and was parted from it.
    pub split_mm: Option<f64>,
    /// Corners that no photo's outline confirms, and clothes that hang away from the body; shortens, never lengthens.
    pub cover_mm: Option<f64>,
}

impl Sigmas {
    /// Nothing is uncertain: of a formula.
    pub const EXACT: Sigmas = Sigmas {
        level_mm: Some(0.0),
        surface_mm: Some(0.0),
        scale_mm: Some(0.0),
        split_mm: Some(0.0),
        cover_mm: Some(0.0),
    };

    /// The variance of a tape by all that moves it to either side; what is not known counts nothing. \[mm²\]
    pub fn variance(&self) -> f64 {
        let all = [self.level_mm, self.surface_mm, self.scale_mm, self.split_mm];
        all.iter().flatten().map(|mm| mm * mm).sum()
    }

    /// The parts with their names, in order.
    pub fn named(&self) -> [(&'static str, Option<f64>); 5] {
        [
            ("level", self.level_mm),
            ("surface", self.surface_mm),
            ("scale", self.scale_mm),
            ("split", self.split_mm),
            ("cover", self.cover_mm),
        ]
    }

    /// The same parts times a number.
    #[must_use]
    pub fn scaled(&self, by: f64) -> Sigmas {
        let times = |mm: Option<f64>| mm.map(|mm| mm * by);
        Sigmas {
            level_mm: times(self.level_mm),
            surface_mm: times(self.surface_mm),
            scale_mm: times(self.scale_mm),
            split_mm: times(self.split_mm),
            cover_mm: times(self.cover_mm),
        }
    }

    /// The parts without which no interval is given, and that nobody knows. A scale that nobody
    /// vouches for is not among them: lengths are then in the unit that was given. Nor are corners
    /// that nobody looked for.
    pub fn unknown(&self) -> Vec<&'static str> {
        let needed = [
            ("level", self.level_mm),
            ("surface", self.surface_mm),
            ("split", self.split_mm),
        ];
        let open = needed.into_iter().filter(|(_, mm)| mm.is_none());
        open.map(|(name, _)| name).collect()
    }
}

/// A section of which a limb was parted.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Split {
    /// Share of the way around that is given by the outline beside it or by a clear section.
    pub share: f64,
}

/// What the user should know of one girth.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Note {
    /// A stretch that no photo's outline confirms, as a share of the tape.
    Open {
        /// Share of the tape that may not be body.
        share: f64,
    },
    /// The paper's spline left the ring of the section.
    SplineLeft {
        /// How much longer it is than the contour, as a share.
        share: f64,
    },
    /// The skin is much longer than a tape.
    Folds {
        /// How much, as a share.
        share: f64,
    },
    /// What is worn hangs away from the legs at its hem.
    Worn {
        /// Share of the tape that may be clothes.
        share: f64,
    },
}

impl Note {
    /// As people read it.
    pub fn message(&self) -> Message {
        match self {
            Note::Open { share } => message!(OPEN, share = 100.0 * share),
            Note::Worn { share } => message!(WORN, share = 100.0 * share),
            Note::SplineLeft { share } => message!(SPLINE_LEFT, off = 100.0 * share),
            Note::Folds { share } => message!(FOLDS, share = 100.0 * share),
        }
    }
}
