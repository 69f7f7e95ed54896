//! What can be measured with a capture as it is; how what is odd about it is reported.

use crate::glance::{Glance, Together};
use shape::{Photos, Rig, Tags};

/// How bad something is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Grade {
    /// Nothing will come of it.
    #[serde(rename = "stop")]
    Hopeless,
    /// Results will be worse, or wrong.
    Doubt,
    /// More could be had.
    Hint,
}

/// One thing that is odd.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Finding {
    /// How bad it is.
    pub grade: Grade,
    /// What was seen.
    pub what: String,
    /// What would mend it.
    pub mend: String,
    /// The photos that it is about; empty for all.
    pub photos: Vec<String>,
}

impl Finding {
    /// As a sentence: which photos, what, and what would mend it.
    pub(crate) fn sentence(&self) -> String {
        let names = match self.photos.len() {
            0 => String::new(),
            1..=5 => format!("{}: ", self.photos.join(", ")),
            more => format!("{}, … ({more} photos): ", self.photos[..3].join(", ")),
        };
        format!("{names}{}; {}", self.what, self.mend)
    }
}

/// What was found so far.
pub(crate) struct Findings<'a> {
    pub(crate) photos: &'a Photos,
    pub(crate) all: Vec<Finding>,
}

impl Findings<'_> {
    /// One more.
    pub(crate) fn put(&mut self, grade: Grade, what: impl Into<String>, mend: &str, of: &[usize]) {
        let names = of.iter().map(|i| self.photos.photos[*i].name.clone());
        self.all.push(Finding {
            grade,
            what: what.into(),
            mend: mend.into(),
            photos: names.collect(),
        });
    }
}

/// How sharp photos are against the middle one.
pub(crate) fn against_the_middle(sharp: &[f64]) -> Vec<f64> {
    let mut sorted = sharp.to_vec();
    sorted.sort_by(f64::total_cmp);
    let middle = sorted.get(sorted.len() / 2).map_or(1.0, |m| m.max(1e-12));
    sharp.iter().map(|s| s / middle).collect()
}

/// What was seen of the photos.
pub(crate) struct Seen<'a> {
    pub(crate) photos: &'a Photos,
    pub(crate) glances: &'a [Glance],
    pub(crate) together: &'a Together,
    /// Against the middle of all.
    pub(crate) sharpness: &'a [f64],
    /// Tags on those photos that were searched.
    pub(crate) tags: Option<&'a Tags>,
}

/// Less than this of the picture does not move: the camera was moved.
const STILL: f64 = 0.12;

/// Whether the camera did not move.
pub(crate) fn camera_is_fixed(together: &Together) -> bool {
    together.still >= STILL
}

/// Where centimetres will come from.
pub(crate) fn lengths(rig: &Rig) -> Option<&'static str> {
    match rig {
        Rig { mat: Some(_), .. }
        | Rig {
            tag_mm: Some(_), ..
        } => Some("the marker mat"),
        Rig {
            reference: Some(_), ..
        } => Some("the reference length"),
        Rig {
            disk_diameter_mm: Some(_),
            ..
        } => Some("the disk's diameter, if its edge is seen"),
        Rig {
            stature_mm: Some(_),
            ..
        } => Some("the stature"),
        _ => None,
    }
}

/// What can be measured: a name and how.
pub(crate) fn can(seen: &Seen<'_>, findings: &[Finding]) -> Vec<(&'static str, String)> {
    let rig = &seen.photos.rig;
    let stopped = findings.iter().any(|f| f.grade == Grade::Hopeless);
    let cameras = match (stopped, rig.tagged() && seen.tags.is_some_and(|t| t.views.values().any(|v| !v.is_empty())), camera_is_fixed(seen.together)) {
        (true, ..) => "no, as it is: see above".to_owned(),
        (_, true, _) => "from the mat, photo by photo".into(),
        (_, _, true) => "from what turns with the subject: clothes with a pattern, a patterned cloth on the disk".into(),
        (_, _, false) => "not as a turn".into(),
    };
    let lengths = match lengths(rig) {
        Some(from) => format!("in centimetres, from {from}"),
        None => "relative: ratios hold, no centimetres".into(),
    };
    let girths = match (
        stopped || !camera_is_fixed(seen.together),
        rig.stature_mm.zip(rig.weight_kg),
    ) {
        (true, _) => "no".to_owned(),
        (_, Some(_)) => "yes, with ratios and the body mass index".into(),
        (_, None) => "yes, with ratios; the body mass index wants --weight and --stature".into(),
    };
    vec![
        ("cameras", cameras),
        ("lengths", lengths),
        ("girths", girths),
    ]
}
