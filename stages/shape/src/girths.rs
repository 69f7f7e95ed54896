//! What was measured, with intervals, what they are made of, and curves.

use crate::{GirthId, Growth, Landmark, Missing, Note, Plane, Region, Sex, Sigmas, Split, Unit};
use serde::{Deserialize, Serialize};
use stage::{Artifact, Corrupt, Message, Packer, Unpacker};

/// One girth.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Girth {
    /// The girth's row of the table.
    pub id: GirthId,
    /// Whose definition it follows: `id`'s own, or that of the waist which the user chose.
    pub by: GirthId,
    /// The part of the body.
    pub region: Region,
    /// Short name: WC, HC, CC, NC, AC_L, AC_R, …, or the user's.
    pub name: String,
    /// What people call it: `waist`.
    pub label: String,
    /// Its definition, with the standards behind it.
    pub definition: String,
    /// Length of the section's contour. \[mm\]
    pub contour_mm: f64,
    /// Length of a tape around it: of the convex hull in the plane, less the declared compression. \[mm\]
    pub tape_mm: f64,
    /// Length of the paper's closed cubic spline. \[mm\]
    pub spline_mm: f64,
    /// From the silhouettes alone, where limbs are clear of the trunk. \[mm\]
    pub silhouette_mm: Option<f64>,
    /// The tape's interval that holds the truth nine times in ten; `None` where a part of it that
    /// matters is unknown. \[mm\]
    pub interval_mm: Option<[f64; 2]>,
    /// What the interval is made of.
    pub sigmas: Sigmas,
    /// Nine in ten measurements of the same person are within this of their mean. \[mm\]
    pub repeat_mm: Option<f64>,
    /// What was parted from the section.
    pub split: Option<Split>,
    /// What the user should know.
    pub notes: Vec<Note>,
    /// The plane that the tape lay in.
    pub plane: Plane,
    /// The contour, closed, without repeating the first point. \[mm\]
    pub contour: Vec<[f32; 3]>,
}

impl Girth {
    /// A tape at a landmark, its contour taken to be as long; nothing is known of how sure it is.
    pub fn at(mark: &Landmark, tape_mm: f64) -> Self {
        Girth {
            id: mark.id,
            by: mark.by,
            region: mark.region,
            name: mark.name.clone(),
            label: mark.label.clone(),
            definition: mark.definition.clone(),
            contour_mm: tape_mm,
            tape_mm,
            spline_mm: tape_mm,
            silhouette_mm: None,
            interval_mm: None,
            sigmas: Sigmas::default(),
            repeat_mm: None,
            split: None,
            notes: vec![],
            plane: mark.plane,
            contour: vec![],
        }
    }

    /// All remarks on it: what was split, what is unknown, what is odd.
    pub fn remarks(&self) -> Vec<String> {
        let split = self.split.map(|split| {
            let what = match self.region {
                Region::Thigh => "the thighs touch and were parted",
                _ => "the arm touches the trunk and was separated",
            };
            format!(
                "{what} by estimation: {:.0} % of the way around is seen, on the outline beside it or on a clear section",
                100.0 * split.share
            )
        });
        let unknown = self.sigmas.unknown();
        let unknown = (!unknown.is_empty()).then(|| {
            let parts = unknown.join(" and ");
            format!("no interval: it is unknown how sure the {parts} is")
        });
        let notes = self.notes.iter().map(|note| note.message().to_string());
        split.into_iter().chain(unknown).chain(notes).collect()
    }
}

/// Girth of the trunk over height.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Profile {
    /// Height above the ground. \[mm\]
    pub height_mm: Vec<f64>,
    /// Tape around the trunk there. \[mm\]
    pub tape_mm: Vec<f64>,
}

/// All that was measured.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Girths {
    /// What the numbers mean.
    pub unit: Unit,
    /// What the capture is called, where that is given.
    pub capture: Option<String>,
    /// The day of the capture, `YYYY-MM-DD`, where it may be shown.
    pub date: Option<String>,
    /// Relative standard deviation of the unit of length, if known.
    pub scale_sigma: Option<f64>,
    /// Standard deviation of the stature, if known. \[mm\]
    pub stature_sigma_mm: Option<f64>,
    /// By how much tapes were shortened for the flesh that a tape presses in, as the user declared. \[%\]
    pub compression_pct: f64,
    /// The girths.
    pub girths: Vec<Girth>,
    /// What could not be measured.
    pub missing: Vec<Missing>,
    /// Ratios and other derived numbers: WHR, WHtR, … with a note each (empty, or `experimental`).
    pub ratios: Vec<(String, f64, Message)>,
    /// Crown above the ground. \[mm\]
    pub stature_mm: Option<f64>,
    /// Weight, as the user gave it. \[kg\]
    pub weight_kg: Option<f64>,
    /// Body mass index. \[kg/m²\]
    pub bmi: Option<f64>,
    /// Volume of the body. \[l\]
    pub volume_l: Option<f64>,
    /// The sex whose references are meant. Personal: no file has it.
    pub sex: Option<Sex>,
    /// The age on the day of the capture. Personal: no file but the report of a child has it. \[months\]
    pub age_months: Option<f64>,
    /// A child beside the growth reference.
    pub growth: Option<Growth>,
    /// Girth of the trunk over height.
    pub profile: Profile,
}

/// 18 years (derived: 12 · 18). \[months\]
const ADULT_MONTHS: f64 = 216.0;

/// Three standard deviations below the median of women of 19 years, 163.15 · (1 − 3 · 0.04009) cm, the least of the
/// WHO's growth reference of 2007 (de Onis et al., Bull World Health Organ 2007;85:660–667): one grown woman in 740 is
/// shorter, and girls reach it at 11 in the median, so it parts figures and small children from adults, not youths. \[mm\]
const ADULT_MM: f64 = 1435.0;

impl Girths {
    /// The names of [`ratios`](Girths::ratios) that are reported where they can be.
    pub const RATIOS: [&'static str; 4] = ["WHR", "WHR_tape", "WHtR", "density_kg_l"];

    /// Whether thresholds of adults may be shown beside the numbers: of somebody whose age is an adult's; where no age
    /// was given, of a body as tall as adults are, as far as lengths are known. A short adult (dwarfism) whose age
    /// was not given is left without them, as figures and small children are.
    pub fn is_adult(&self) -> bool {
        let tall = |mm: f64| self.unit == Unit::Metric && mm >= ADULT_MM;
        match self.age_months {
            Some(months) => months >= ADULT_MONTHS,
            None => self.stature_mm.is_some_and(tall),
        }
    }

    /// The girth of a name.
    pub fn get(&self, name: &str) -> Option<&Girth> {
        self.girths.iter().find(|g| g.name == name)
    }

    /// The girth of the table.
    pub fn of(&self, id: GirthId) -> Option<&Girth> {
        self.girths.iter().find(|g| g.id == id)
    }
}

impl Artifact for Girths {
    const KIND: &'static str = "girths";
    const FORMAT: u32 = 5;

    fn pack(&self, to: &mut Packer) {
        to.meta(self);
    }

    fn unpack(from: &Unpacker<'_>) -> Result<Self, Corrupt> {
        from.meta()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thresholds_are_for_adults_by_age_or_else_by_stature() {
        let of = |age_months: Option<f64>, stature_mm: Option<f64>, unit: Unit| {
            let girths = Girths {
                age_months,
                stature_mm,
                unit,
                ..Girths::default()
            };
            girths.is_adult()
        };
        let metric = |age, stature| of(age, stature, Unit::Metric);
        assert!(metric(None, Some(1700.0)) && metric(None, Some(1435.0)));
        assert!(!metric(None, Some(812.0)) && !metric(None, Some(1434.0)) && !metric(None, None));
        assert!(metric(Some(216.0), Some(1300.0)) && metric(Some(600.0), None));
        assert!(!metric(Some(215.9), Some(1800.0)));
        assert!(!of(None, Some(1700.0), Unit::Relative));
    }
}
