//! What the user knows of the capture: `capture.toml`, in our units.

use serde::{Deserialize, Serialize};

/// What is known of the capture; all of it may be unknown.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Rig {
    /// The day of the capture by its photos, `YYYY-MM-DD`, where that is asked for.
    pub date: Option<String>,
    /// Nominal turn between photos, positive if the subject turns counter-clockwise seen from above. \[rad\]
    pub step: Option<f64>,
    /// Focal length as if the photo were taken on 36 × 24 mm film. \[mm\]
    pub focal_35mm: Option<f64>,
    /// Focal length as a calibration of this lens gave it. \[px\]
    pub focal_px: Option<f64>,
    /// Principal point as a calibration gave it, the top-left pixel's centre at (0, 0). \[px\]
    pub centre_px: Option<[f64; 2]>,
    /// The subject's stature. \[mm\]
    pub stature_mm: Option<f64>,
    /// The disk's diameter. \[mm\]
    pub disk_diameter_mm: Option<f64>,
    /// The marker mat on the disk.
    pub mat: Option<Mat>,
    /// Edge length of a tag's black square, where nothing else is given of the mat. \[mm\]
    pub tag_mm: Option<f64>,
    /// Tags on the disk's rim, beside the mat.
    pub rim: Option<Rim>,
    /// A length that is known.
    pub reference: Option<Reference>,
}

/// Standard deviation of a stature as people give it, as a share: the root mean square of reported over measured stature less one, of
/// the 182 people with both in Davis (1990, Appetite 15, 13–21; the data set `Davis` of the R package carData). Of that 1.2 % is how far
/// they are apart, 1.2 % that they report too little; surveys have people report 1.0 to 1.6 cm too much (Scholes et al. 2022).
pub const GIVEN_STATURE: f64 = 0.0173;

/// Two lengths that differ by more standard deviations than this cannot both be right: three, as control charts have it (Shewhart 1931).
pub const CONTRADICTION: f64 = 3.0;

impl Rig {
    /// Whether marker tags on the disk are given.
    pub fn tagged(&self) -> bool {
        self.mat.is_some() || self.tag_mm.is_some()
    }
}

/// A ring of AprilTags (family 36h11) on the disk, all of one size.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Mat {
    /// Edge length of a tag's black square. \[mm\]
    pub tag_mm: f64,
    /// First id of the ring.
    pub first_id: u32,
    /// How many tags.
    pub count: u32,
    /// Radius of the circle through the tags' centres. \[mm\] Tag i is centred at angle
    /// i · 360° / count, counter-clockwise from above, its top edge outward.
    pub ring_mm: f64,
}

/// A strip of upright AprilTags (family 36h11) around the disk's rim, all of one size.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Rim {
    /// Edge length of a tag's black square, measured along the strip. \[mm\]
    pub tag_mm: f64,
    /// First id of the strip.
    pub first_id: u32,
    /// How many tags.
    pub count: u32,
    /// Radius of the printed face. \[mm\] Tags follow each other counter-clockwise seen from above,
    /// their top edges up; where along the rim and how deep each sits is not asked.
    pub radius_mm: f64,
}

/// A length that is known.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Reference {
    /// What it is the length of: `tag_size`, `subject_height`, `disk_diameter`, `points`, …
    pub kind: String,
    /// Its length. \[mm\]
    pub length_mm: f64,
    /// Where its two ends are seen, of `points`.
    pub seen: Vec<SeenEnds>,
}

/// The two ends of a length as somebody pointed at them in a photo.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SeenEnds {
    /// The photo's name.
    pub photo: String,
    /// Both ends in the photo as it is shown upright, at full size, the top-left pixel's centre at (0, 0). \[px\]
    pub px: [[f64; 2]; 2],
}
