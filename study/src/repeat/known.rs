//! What other studies report of repeatability, and what a survey allows its measurers.

use shape::{GirthId, Region};

/// Most that two measurements of the same person may be apart between the trained measurers of ANSUR II: the survey's
/// allowable observer error (Measurer's Handbook, NATICK/TR-11/017, appendix G). `None` for girths that it does not have so:
/// its arm is bent and flexed. \[mm\]
pub fn allowed_mm(name: &str, part: Option<&str>) -> Option<f64> {
    let by_table = || GirthId::named(name).map(|id| id.definition().region);
    match part.and_then(Region::named).or_else(by_table)? {
        Region::Waist | Region::Hip => Some(12.0),
        Region::Chest => Some(14.0),
        Region::Neck | Region::Thigh => Some(6.0),
        Region::Calf => Some(4.0),
        Region::UpperArm | Region::Forearm | Region::Anywhere => None,
    }
}

/// What a study reports.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Known {
    /// Who, when, where.
    pub study: &'static str,
    /// With what, and on how many people.
    pub with: &'static str,
    /// What was found.
    pub found: &'static str,
}

/// Studies, as their abstracts give them.
pub const KNOWN: [Known; 5] = [
    Known {
        study: "Medina-Inojosa 2016 (abstract)",
        with: "tape, two observers; 83 people",
        found: "waist 39 ± 24 mm, hip 27 ± 24 mm apart; one observer 31 ± 19, 18 ± 22",
    },
    Known {
        study: "Medina-Inojosa 2016 (abstract)",
        with: "white-light scanner; 83 people",
        found: "waist 13 ± 9 mm, hip 8 ± 1 mm apart",
    },
    Known {
        study: "Jaeschke 2015, PLoS ONE e0119430 (abstract)",
        with: "laser scanner; 60 people",
        found: "ICC > 0.98",
    },
    Known {
        study: "Graybeal 2023, Br J Nutr (abstract)",
        with: "photos of phones; 115 people",
        found: "ICC ≥ 0.93; RMS-CV 0.5 to 2.5 %",
    },
    Known {
        study: "doi 10.1177/15280837261431379, 2026 (abstract)",
        with: "scanner; 24 men",
        found: "ICC > 0.9",
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_survey_allows_by_the_part_of_the_body() {
        assert_eq!(allowed_mm("WC_navel", None), Some(12.0));
        assert_eq!(allowed_mm("mine", Some("calf")), Some(4.0));
        assert_eq!(allowed_mm("AC_L", None), None);
        assert_eq!(allowed_mm("mine", None), None);
    }
}
