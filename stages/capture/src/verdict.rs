//! What can be measured with a capture as it is; how what is odd about it is reported.

use crate::glance::{Glance, Together};
use crate::sharpness::Sharpness;
use shape::{People, Photos, Rig, Tags, some_photos};
use stage::{Message, Template, message};

stage::messages! {
    BY_MAT = "find-from-mat": "the marker mat";
    BY_REFERENCE = "find-from-reference": "the reference length";
    BY_DISK = "find-from-disk": "the disk's diameter, if its edge is seen";
    BY_STATURE = "find-from-stature": "the stature";
    STOPPED = "find-can-stopped": "no, as it is: see above";
    MAT_CAMERAS = "find-can-mat": "from the mat, photo by photo";
    FEATURE_CAMERAS = "find-can-features": "from what turns with the subject: clothes with a pattern, a patterned cloth on the disk";
    WALKED = "find-can-walked": "not as a turn";
    IN_CM = "find-can-cm": "in centimetres, from {source}";
    RELATIVE = "find-can-relative": "relative: ratios hold, no centimetres";
    NO_GIRTHS = "find-can-no": "no";
    WITH_BMI = "find-can-bmi": "yes, with ratios and the body mass index";
    WITH_RATIOS = "find-can-ratios": "yes, with ratios; the body mass index wants --weight and --stature";
}

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
    pub what: Message,
    /// What would mend it.
    pub mend: Message,
    /// The photos that it is about; empty for all.
    pub photos: Vec<String>,
}

impl Finding {
    /// As one message: which photos, what, and what would mend it.
    pub(crate) fn message(&self) -> Message {
        let message = self.what.clone().with_remedy(&self.mend);
        match some_photos(&self.photos) {
            Some(names) => message.of_what(names),
            None => message,
        }
    }
}

/// What was found so far.
pub(crate) struct Findings<'a> {
    pub(crate) photos: &'a Photos,
    pub(crate) all: Vec<Finding>,
}

impl Findings<'_> {
    /// One more.
    pub(crate) fn put(&mut self, grade: Grade, what: Message, mend: Message, of: &[usize]) {
        let names = of.iter().map(|i| self.photos.photos[*i].name.clone());
        self.all.push(Finding {
            grade,
            what,
            mend,
            photos: names.collect(),
        });
    }
}

/// What was seen of the photos.
pub(crate) struct Seen<'a> {
    pub(crate) photos: &'a Photos,
    pub(crate) glances: &'a [Glance],
    pub(crate) together: &'a Together,
    pub(crate) sharpness: &'a [Sharpness],
    /// Tags on those photos that were searched.
    pub(crate) tags: Option<&'a Tags>,
    /// Who is seen on the photos, where that was looked for.
    pub(crate) people: Option<&'a People>,
}

/// Less than this of the picture does not move: the camera was moved. By hand: not on record.
const STILL_SHARE: f64 = 0.12;

/// Whether the camera did not move.
pub(crate) fn camera_is_fixed(together: &Together) -> bool {
    together.still >= STILL_SHARE
}

/// Where centimetres will come from.
pub(crate) fn lengths(rig: &Rig) -> Option<&'static Template> {
    match rig {
        Rig { mat: Some(_), .. }
        | Rig {
            tag_mm: Some(_), ..
        } => Some(&BY_MAT),
        Rig {
            reference: Some(_), ..
        } => Some(&BY_REFERENCE),
        Rig {
            disk_diameter_mm: Some(_),
            ..
        } => Some(&BY_DISK),
        Rig {
            stature_mm: Some(_),
            ..
        } => Some(&BY_STATURE),
        _ => None,
    }
}

/// What can be measured, of somebody who was weighed or not: a name and how.
pub(crate) fn can(
    seen: &Seen<'_>,
    weighed: bool,
    findings: &[Finding],
) -> Vec<(&'static str, Message)> {
    let rig = &seen.photos.rig;
    let stopped = findings.iter().any(|f| f.grade == Grade::Hopeless);
    let tags = seen
        .tags
        .is_some_and(|t| t.views.values().any(|v| !v.is_empty()));
    let cameras = match (
        stopped,
        rig.tagged() && tags,
        camera_is_fixed(seen.together),
    ) {
        (true, ..) => message!(STOPPED),
        (_, true, _) => message!(MAT_CAMERAS),
        (_, _, true) => message!(FEATURE_CAMERAS),
        (_, _, false) => message!(WALKED),
    };
    let lengths = match lengths(rig) {
        Some(from) => message!(IN_CM, source = Message::new(from, [])),
        None => message!(RELATIVE),
    };
    let girths = match (
        stopped || !camera_is_fixed(seen.together),
        rig.stature_mm.is_some() && weighed,
    ) {
        (true, _) => message!(NO_GIRTHS),
        (_, true) => message!(WITH_BMI),
        (_, false) => message!(WITH_RATIOS),
    };
    vec![
        ("cameras", cameras),
        ("lengths", lengths),
        ("girths", girths),
    ]
}
