//! Laws: one place estimated by features that must all be there, as a joint normal distribution of features and
//! place, so that the place comes with a standard deviation and a body that is unlike all known ones is noticed.

use super::error::ModelError;
use super::normal::{Normal, symmetric};
use crate::features::limb::ArmSeen;
use nalgebra::{DMatrix, DVector};
use serde::Deserialize;

/// What a law tells, and by what. Places of an arm are ways along it from the wrist, shares of stature:
/// `ByShoulder` where the line of a hanging arm shows the shoulder's outline, `Bent` where the elbow shows
/// as a bend.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// Where the notch of the breastbone (suprasternale) is: along the neck's axis from its tightest section,
    /// upward, in diameters of the neck.
    Notch,
    /// The acromion.
    Acromion,
    /// The acromion.
    AcromionByShoulder,
    /// The elbow's joint.
    Elbow,
    /// The elbow's joint.
    ElbowBent,
    /// Midway between acromion and the tip of the elbow.
    UpperArm,
    /// Midway between acromion and the tip of the elbow.
    UpperArmByShoulder,
    /// Midway between acromion and the tip of the elbow.
    UpperArmBent,
    /// Midway between acromion and the tip of the elbow.
    UpperArmBentByShoulder,
}

impl Place {
    /// All of them, in the order of a model file.
    pub const ALL: [Place; 9] = [
        Place::Notch,
        Place::Acromion,
        Place::AcromionByShoulder,
        Place::Elbow,
        Place::ElbowBent,
        Place::UpperArm,
        Place::UpperArmByShoulder,
        Place::UpperArmBent,
        Place::UpperArmBentByShoulder,
    ];

    /// What a model file calls it.
    pub fn name(self) -> &'static str {
        match self {
            Place::Notch => "notch",
            Place::Acromion => "acromion",
            Place::AcromionByShoulder => "acromion_by_shoulder",
            Place::Elbow => "elbow",
            Place::ElbowBent => "elbow_bent",
            Place::UpperArm => "upper_arm",
            Place::UpperArmByShoulder => "upper_arm_by_shoulder",
            Place::UpperArmBent => "upper_arm_bent",
            Place::UpperArmBentByShoulder => "upper_arm_bent_by_shoulder",
        }
    }

    /// The features that tell it, in the order in which [`Law::estimate`] takes them.
    pub fn features(self) -> Vec<&'static str> {
        const LINE: &[&str] = ArmSeen::LINE;
        const TAPES: &[&str] = ArmSeen::TAPES;
        const SHOULDER: &[&str] = ArmSeen::SHOULDER;
        const BEND: &[&str] = ArmSeen::BEND;
        match self {
            Place::Notch => vec!["up", "low", "lean", "head"],
            Place::Acromion => LINE.to_vec(),
            Place::AcromionByShoulder => [LINE, SHOULDER].concat(),
            Place::Elbow | Place::UpperArm => [LINE, TAPES].concat(),
            Place::ElbowBent | Place::UpperArmBent => [LINE, BEND].concat(),
            Place::UpperArmByShoulder => [LINE, TAPES, SHOULDER].concat(),
            Place::UpperArmBentByShoulder => [LINE, BEND, SHOULDER].concat(),
        }
    }

    /// The table that it is fitted on.
    pub(crate) fn table(self) -> &'static str {
        match self {
            Place::Notch => "neck.csv",
            _ => "arms.csv",
        }
    }

    /// The table's column of the true place.
    pub(crate) fn column(self) -> &'static str {
        match self {
            Place::Notch => "notch",
            Place::Acromion | Place::AcromionByShoulder => "acromion",
            Place::Elbow | Place::ElbowBent => "elbow",
            Place::UpperArm
            | Place::UpperArmByShoulder
            | Place::UpperArmBent
            | Place::UpperArmBentByShoulder => "upper_arm",
        }
    }

    /// Where the table's tapes begin, and their step, in the law's unit; `None` of a place where no tape is
    /// taken.
    pub(crate) fn tapes(self) -> Option<(f64, f64)> {
        (self.column() == "upper_arm").then_some((0.17, 0.01))
    }
}

/// How one place follows from features.
#[derive(Debug, Clone, PartialEq)]
pub struct Law {
    pub(crate) place: Place,
    /// Over the features and then the place.
    pub(crate) normal: Normal,
    /// Standard deviation of the place on a body of a family that was not fitted on, in the law's unit.
    pub(crate) sigma: f64,
    /// Squared Mahalanobis distance of the features within which 99 in 100 of the fitted bodies are.
    pub(crate) limit: f64,
    /// Covariance of the features between two captures of one body.
    pub(crate) repeat: Option<DMatrix<f64>>,
}

/// A place as a law tells it, in the law's unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LawEstimate {
    /// The place.
    pub value: f64,
    /// Standard deviation on a body of a family that was not fitted on; wider beyond the limit.
    pub sigma: f64,
    /// Standard deviation when the same body is captured again.
    pub repeat: Option<f64>,
    /// Whether the features are like those that the law was fitted on.
    pub inside: bool,
}

impl Law {
    /// The place that features, in the order of [`Place::features`], tell. `None` if one is not finite.
    pub fn estimate(&self, features: &[f64]) -> Option<LawEstimate> {
        let observed: Vec<(usize, f64)> = features.iter().copied().enumerate().collect();
        let given = self.normal.given(&observed, features.len())?;
        let wider = (given.distance / self.limit).max(1.0).sqrt();
        let again = self.repeat.as_ref().map(|repeat| {
            let w = DVector::from_column_slice(&given.weights);
            (w.transpose() * repeat * &w)[(0, 0)].max(0.0).sqrt()
        });
        Some(LawEstimate {
            value: given.mean,
            sigma: self.sigma * wider,
            repeat: again,
            inside: given.distance <= self.limit,
        })
    }
}

/// A law as a file has it.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawLaw {
    place: String,
    features: Vec<String>,
    mean: Vec<f64>,
    covariance: Vec<Vec<f64>>,
    sigma: f64,
    limit: f64,
    repeat: Option<Vec<Vec<f64>>>,
}

impl RawLaw {
    /// The law, if its numbers make one; `file` is what errors call the file.
    pub(crate) fn sound(self, file: &str) -> Result<Law, ModelError> {
        let wrong = |why: String| ModelError::Law {
            name: file.into(),
            why,
            known: Place::ALL.map(Place::name).join(", "),
        };
        let place = Place::ALL.into_iter().find(|p| p.name() == self.place);
        let place = place.ok_or_else(|| wrong(format!("there is no law of `{}`", self.place)))?;
        let not = |what: &str| wrong(format!("the law of `{}` {what}", self.place));
        let features = place.features();
        if self.features != features {
            return Err(not(&format!("needs the features {}", features.join(", "))));
        }
        let width = features.len() + 1;
        if self.mean.len() != width || !self.mean.iter().all(|x| x.is_finite()) {
            return Err(not(
                "has not one finite mean for each feature and its place",
            ));
        }
        let covariance = symmetric(&self.covariance, width)
            .filter(|c| c.clone().cholesky().is_some())
            .ok_or_else(|| not("has covariances that are not positive definite"))?;
        let positive = |x: f64| x.is_finite() && x > 0.0;
        if !positive(self.limit) || !positive(self.sigma) {
            return Err(not("needs a positive `sigma` and `limit`"));
        }
        let repeat = match self.repeat {
            None => None,
            Some(rows) => Some(symmetric(&rows, features.len()).ok_or_else(|| {
                not("has a `repeat` that is no lower triangle, a row for each feature")
            })?),
        };
        Ok(Law {
            place,
            normal: Normal {
                mean: DVector::from_vec(self.mean),
                covariance,
            },
            sigma: self.sigma,
            limit: self.limit,
            repeat,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_law_is_the_regression_and_widens_beyond_what_it_knows() {
        // y = 1 + 2 x, give or take 0.1, of x ~ N(0, 1).
        let covariance = DMatrix::from_row_slice(2, 2, &[1.0, 2.0, 2.0, 4.01]);
        let law = Law {
            place: Place::Notch,
            normal: Normal {
                mean: DVector::from_vec(vec![0.0, 1.0]),
                covariance,
            },
            sigma: 0.2,
            limit: 4.0,
            repeat: Some(DMatrix::from_element(1, 1, 0.0025)),
        };
        let near = law.estimate(&[0.5]).unwrap();
        proof::near(near.value, 2.0, 1e-9);
        proof::near(near.sigma, 0.2, 1e-9);
        proof::near(near.repeat.unwrap(), 0.1, 1e-9);
        let far = law.estimate(&[6.0]).unwrap();
        proof::near(far.value, 13.0, 1e-9);
        proof::near(far.sigma, 0.6, 1e-9);
        assert!(near.inside && !far.inside);
        assert_eq!(law.estimate(&[f64::NAN]), None);
    }
}
