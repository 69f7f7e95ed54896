//! What repeated captures show of each girth.

use super::captures::Capture;
use super::known::allowed_mm;
use super::statistics::{Agreement, Repeats};

/// From so many degrees of freedom on a precision error is known to +30 % (Glüer 1995, Osteoporos Int 5:262).
const ENOUGH: usize = 27;
/// Files hold lengths to 0.1 mm: such rounding alone errs by so much, and captures that come out equal show no less. \[mm\]
const ROUNDED_MM: f64 = 0.1 / 3.464_101_615_137_754_6;

/// One girth, all lengths of its tape. \[mm\]
#[derive(Debug, Clone, PartialEq)]
pub struct GirthStudy {
    /// Short name.
    pub name: String,
    /// What people call it.
    pub label: String,
    /// People in the order in which they are met, with their measurements in the order of captures.
    pub people: Vec<(String, Vec<f64>)>,
    /// Mean of all repeated measurements.
    pub mean: f64,
    /// Degrees of freedom of the technical error.
    pub freedom: usize,
    /// Technical error of measurement.
    pub tem: f64,
    /// What it is between nineteen times in twenty.
    pub tem_interval: [f64; 2],
    /// Root mean square of the coefficients of variation, as a share.
    pub rms_cv: f64,
    /// Coefficient of reliability; of two people or more.
    pub reliability: Option<f64>,
    /// ICC(2,1); of two people or more, all measured equally often.
    pub icc: Option<f64>,
    /// Each later measurement against the first.
    pub agreement: Agreement,
    /// Most that a survey allows two measurers.
    pub allowed: Option<f64>,
}

impl GirthStudy {
    /// The least change of one capture against another that repetition gives one time in twenty: 1.96 √2 TEM. \[mm\]
    pub fn least_change(&self) -> f64 {
        super::LEAST_CHANGE * self.tem
    }
}

/// All girths, and the warnings about the captures.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Study {
    /// Those that somebody has twice, in the order in which they are met.
    pub girths: Vec<GirthStudy>,
    /// People with their captures.
    pub people: Vec<(String, Vec<String>)>,
    /// What is odd, in sentences.
    pub warnings: Vec<String>,
}

/// Nobody was captured twice.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error(
    "nobody was measured twice among {0}: captures of one person are recognised by their folders' names (`anna-1`, `anna-2`), \
     or give --by folder or --by one"
)]
pub struct NotRepeated(String);

/// What captures show, with one tape a girth from each.
///
/// # Errors
///
/// No girth that one person has twice.
pub fn study(captures: &[Capture]) -> Result<Study, NotRepeated> {
    let named = |c: &Capture| {
        let tapes = c.girths.girths.iter();
        let tapes = tapes.map(|g| {
            (
                g.name.clone(),
                g.label.clone(),
                g.part.clone(),
                10.0 * g.tape,
            )
        });
        (c.person.clone(), c.name.clone(), tapes.collect())
    };
    studied(&captures.iter().map(named).collect::<Vec<_>>(), ROUNDED_MM)
}

/// A capture as numbers: whose, what it is called, and each girth's name, label, part and tape. \[mm\]
pub type Tapes = (String, String, Vec<(String, String, Option<String>, f64)>);

/// The same from tapes that were taken otherwise, and not rounded. \[mm\]
///
/// # Errors
///
/// No girth that one person has twice.
pub fn study_of(captures: &[Tapes]) -> Result<Study, NotRepeated> {
    studied(captures, 0.0)
}

/// What tapes show that are known no better than to a standard deviation `least`. \[mm\]
fn studied(captures: &[Tapes], least: f64) -> Result<Study, NotRepeated> {
    let mut study = Study::default();
    for (person, capture, _) in captures {
        match study.people.iter_mut().find(|(p, _)| p == person) {
            Some((_, of)) => of.push(capture.clone()),
            None => study.people.push((person.clone(), vec![capture.clone()])),
        }
    }
    let mut names: Vec<&(String, String, Option<String>, f64)> = Vec::new();
    for girth in captures.iter().flat_map(|c| &c.2) {
        if !names.iter().any(|known| known.0 == girth.0) {
            names.push(girth);
        }
    }
    for (name, label, part, _) in names {
        let tapes = |person: &String| -> Vec<f64> {
            let own = captures.iter().filter(|c| c.0 == *person);
            own.filter_map(|c| Some(c.2.iter().find(|g| g.0 == *name)?.3))
                .collect()
        };
        let people = study.people.iter().map(|(p, _)| (p.clone(), tapes(p)));
        let people: Vec<(String, Vec<f64>)> = people.filter(|(_, t)| !t.is_empty()).collect();
        let allowed = allowed_mm(name, part.as_deref());
        match one(name, label, people, allowed, least) {
            Some(girth) => study.girths.push(girth),
            None => study.warnings.push(format!("{name}: nobody has it twice")),
        }
    }
    if study.girths.is_empty() {
        let all: Vec<&str> = captures.iter().map(|c| c.1.as_str()).collect();
        return Err(NotRepeated(all.join(", ")));
    }
    let words = warnings(&study);
    study.warnings.extend(words);
    Ok(study)
}

fn one(
    name: &str,
    label: &str,
    people: Vec<(String, Vec<f64>)>,
    allowed: Option<f64>,
    least: f64,
) -> Option<GirthStudy> {
    let repeats = Repeats(people.iter().map(|(_, t)| t.clone()).collect());
    // Correlation is of those who were repeated.
    let again = Repeats(repeats.0.iter().filter(|p| p.len() > 1).cloned().collect());
    let (tem, [low, high]) = (again.technical_error()?, again.technical_error_interval()?);
    Some(GirthStudy {
        name: name.into(),
        label: label.into(),
        tem: tem.max(least),
        // The upper end is as far above the error as it would be above one that was measured.
        tem_interval: [low, high.max(least * again.upper_factor())],
        rms_cv: again.rms_cv()?.max(least / again.mean()),
        agreement: again.agreement()?,
        mean: again.mean(),
        freedom: again.freedom(),
        reliability: again.reliability(),
        icc: again.icc_2_1(),
        allowed,
        people,
    })
}

fn warnings(study: &Study) -> Vec<String> {
    let mut warnings = Vec::new();
    let single = study.people.iter().filter(|(_, of)| of.len() < 2);
    let single: Vec<&str> = single.map(|(p, _)| p.as_str()).collect();
    if !single.is_empty() {
        warnings.push(format!(
            "{}: one capture only, which shows nothing of repetition",
            single.join(", ")
        ));
    }
    let most = study.girths.iter().map(|g| g.freedom).max().unwrap_or(0);
    if most < ENOUGH {
        warnings.push(format!(
            "{most} degrees of freedom: errors are known to within their intervals only; {ENOUGH} (30 people twice, 15 three times) bound one to +30 %"
        ));
    }
    if study.people.iter().filter(|(_, of)| of.len() > 1).count() < 2 {
        warnings.push("one person: no correlation (ICC) and no reliability, which compare people with each other".into());
    }
    warnings
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tapes(person: &str, n: usize, waist: f64) -> Tapes {
        let girth = ("WC".to_owned(), "waist".to_owned(), None, waist);
        (person.into(), format!("{person}-{n}"), vec![girth])
    }

    #[test]
    fn two_people_twice_and_one_once() {
        let all = [
            tapes("a", 1, 800.0),
            tapes("a", 2, 804.0),
            tapes("b", 1, 900.0),
            tapes("b", 2, 903.0),
            tapes("c", 1, 700.0),
        ];
        let study = study_of(&all).unwrap();
        let waist = &study.girths[0];
        proof::near(waist.tem, ((16.0 + 9.0) / 4.0f64).sqrt(), 1e-12);
        proof::near(waist.least_change(), 2.77 * waist.tem, 0.01);
        assert_eq!((waist.freedom, waist.allowed), (2, Some(12.0)));
        assert!(waist.icc.unwrap() > 0.99);
        assert_eq!(waist.people.len(), 3);
        assert!(
            study.warnings[0].starts_with("c: one capture only"),
            "{:?}",
            study.warnings
        );
    }

    #[test]
    fn nobody_twice_is_refused() {
        let why = study_of(&[tapes("a", 1, 800.0), tapes("b", 1, 900.0)]).unwrap_err();
        assert!(why.to_string().contains("a-1, b-1"), "{why}");
    }
}
