//! Where the girths are that the user declared: a share of the way along a part of the body.

use crate::features::body::Body;
use crate::features::limb::{Limbs, Segment};
use crate::planes::limbs::share;
use crate::planes::trunk::{Trunk, unlike};
use shape::{GirthId, Landmark, Landmarks, Missing, Part, Plane, PlaneSigma, Refusal};
use shape::{Region, Side};
use stage::Mistake;
use std::collections::BTreeMap;

stage::choice! {
    /// The part of the body that a girth goes around.
    pub enum OwnPart {
        /// Horizontal; from the hip's level to the neck's narrowest.
        Trunk = "trunk",
        /// Across the arm; from shoulder to elbow.
        UpperArm = "upper_arm",
        /// Across the arm; from elbow to wrist.
        Forearm = "forearm",
        /// Across the leg; from hip to knee.
        Thigh = "thigh",
        /// Across the leg; from knee to ankle.
        Calf = "calf",
    }
}

stage::params! {
    /// A girth that the user declares: `[girth.mid_thigh]` with `part = "thigh"` and `at = 0.5` gives
    /// mid_thigh_L and mid_thigh_R.
    pub struct OwnGirth {
        /// What it goes around.
        #[must(give)]
        part: OwnPart = OwnPart::Trunk,
        /// Where: the share of the way from the part's upper joint to its lower one; of the trunk
        /// from the hip's level up to the neck's.
        #[range(0.0..=1.0)]
        #[must(give)]
        #[source(structural)]
        at: f64 = 0.5,
        /// What people call it; its name if nothing is given.
        label: String = String::new(),
    }
}

/// Names that cannot be given.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum BadName {
    /// A name of the table.
    #[error("`[girth.{0}]`: the girth {0} is there already; choose another name")]
    SectionMeasurement(String),
    /// Two of the user's that meet once sides are added.
    #[error("`[girth.{0}]`: another girth's left or right is called so; choose another name")]
    Twice(String),
}

/// A declared girth on one side of the body, or in its middle.
struct Wanted<'a> {
    full: String,
    name: &'a str,
    girth: &'a OwnGirth,
    side: Option<Side>,
}

/// Every declared girth, left and right apart.
fn wanted(declared: &BTreeMap<String, OwnGirth>) -> Result<Vec<Wanted<'_>>, BadName> {
    let mut all: Vec<Wanted<'_>> = Vec::new();
    for (name, girth) in declared {
        if GirthId::named(name).is_some() {
            return Err(BadName::SectionMeasurement(name.clone()));
        }
        let sides: &[Option<Side>] = match girth.part {
            OwnPart::Trunk => &[None],
            _ => &[Some(Side::Left), Some(Side::Right)],
        };
        for side in sides.iter().copied() {
            let full = format!("{name}{}", side.map_or("", Side::suffix));
            if all.iter().any(|w| w.full == full) || GirthId::named(&full).is_some() {
                return Err(BadName::Twice(name.clone()));
            }
            all.push(Wanted {
                full,
                name,
                girth,
                side,
            });
        }
    }
    Ok(all)
}

/// What is wrong with the names of declared girths: all that are taken.
pub(crate) fn taken_names(declared: &BTreeMap<String, OwnGirth>) -> Vec<Mistake> {
    let sides = |name: &str, girth: &OwnGirth| match girth.part {
        OwnPart::Trunk => vec![name.to_owned()],
        _ => Side::BOTH
            .map(|side| format!("{name}{}", side.suffix()))
            .to_vec(),
    };
    let mut mistakes = Vec::new();
    for (name, girth) in declared {
        let own = sides(name, girth);
        let given = own
            .iter()
            .chain([name])
            .find(|n| GirthId::named(n).is_some());
        let beside = declared.iter().filter(|(other, _)| *other != name);
        let met = |(other, girth): &(&String, &OwnGirth)| {
            sides(other, girth).iter().any(|n| own.contains(n))
        };
        let why = match (given, beside.clone().find(met)) {
            (Some(taken), _) => format!("is taken: {taken} is a girth that is always measured"),
            (None, Some((other, _))) => {
                format!("is taken: a side of `[girth.{other}]` is called the same")
            }
            (None, None) => continue,
        };
        mistakes.push(Mistake {
            name: format!("girth.{name}"),
            what: format!("{why}; choose another name").into(),
        });
    }
    mistakes
}

/// Landmarks of the declared girths, or why they are not there.
pub(crate) fn own(
    body: &Body,
    trunk: Option<&Trunk<'_>>,
    limbs: &Limbs<'_>,
    declared: &BTreeMap<String, OwnGirth>,
    found: &mut Landmarks,
) -> Result<(), BadName> {
    for one in wanted(declared)? {
        let at = one.girth.at;
        let placed = match one.side {
            None => trunk
                .ok_or_else(|| unlike(body))
                .map(|t| t.between_hip_and_neck(at)),
            Some(side) => across_limb(limbs, one.girth.part, side, at),
        };
        match placed {
            Ok((plane, sigma)) => found.found.push(landmark(one, plane, sigma)),
            Err(reason) => found.missing.push(Missing {
                name: one.full,
                ..Missing::new(GirthId::Own, reason)
            }),
        }
    }
    Ok(())
}

/// The plane across a limb, so far along from its upper joint to its lower one.
fn across_limb(
    limbs: &Limbs<'_>,
    part: OwnPart,
    side: Side,
    at: f64,
) -> Result<(Plane, PlaneSigma), Refusal> {
    let (limb, segment) = match part {
        OwnPart::UpperArm => (limbs.arm(side.sign())?, Segment::UpperArm),
        OwnPart::Forearm => (limbs.arm(side.sign())?, Segment::Forearm),
        OwnPart::Thigh => (limbs.leg(side.sign())?, Segment::Thigh),
        OwnPart::Calf => (limbs.leg(side.sign())?, Segment::Shank),
        OwnPart::Trunk => return Err(Refusal::NoLimb),
    };
    share(limb, segment, at)
}

fn landmark(wanted: Wanted<'_>, plane: Plane, sigma: PlaneSigma) -> Landmark {
    let Wanted {
        full,
        name,
        girth,
        side,
    } = wanted;
    let (region, part, how, way) = match (girth.part, side) {
        (OwnPart::UpperArm, Some(s)) => (
            Region::UpperArm,
            Part::arm(s),
            "across the arm",
            "shoulder to elbow",
        ),
        (OwnPart::Forearm, Some(s)) => (
            Region::Forearm,
            Part::arm(s),
            "across the arm",
            "elbow to wrist",
        ),
        (OwnPart::Thigh, Some(s)) => (Region::Thigh, Part::leg(s), "across the leg", "hip to knee"),
        (OwnPart::Calf, Some(s)) => (
            Region::Calf,
            Part::leg(s),
            "across the leg",
            "knee to ankle",
        ),
        _ => (
            region_of_trunk(girth.at),
            Part::Trunk,
            "horizontal",
            "the hip's level to the neck's",
        ),
    };
    let stated = match girth.label.is_empty() {
        true => name.replace('_', " "),
        false => girth.label.clone(),
    };
    let label = match side {
        Some(side) => format!("{stated}, {}", side.word()),
        None => stated.clone(),
    };
    Landmark {
        region,
        name: full,
        label,
        definition: format!(
            "{stated}: {how}, {} of the way from {way} (declared in the pipeline)",
            girth.at
        ),
        sigma,
        ..Landmark::new(GirthId::Own, plane, part)
    }
}

/// What is beside a level of the trunk: hands, nothing, arms.
fn region_of_trunk(at: f64) -> Region {
    match at {
        at if at < 0.15 => Region::Hip,
        at if at < 0.55 => Region::Waist,
        _ => Region::Chest,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_are_there_already_are_refused() {
        let girth = OwnGirth {
            part: OwnPart::Thigh,
            ..OwnGirth::default()
        };
        let reported = |names: &[&str]| {
            let declared = names.iter().map(|n| ((*n).to_owned(), girth.clone()));
            let all = declared.collect();
            wanted(&all).map(|w| w.into_iter().map(|w| w.full).collect::<Vec<_>>())
        };
        assert_eq!(
            reported(&["WC"]),
            Err(BadName::SectionMeasurement("WC".into()))
        );
        assert_eq!(reported(&["TC"]), Err(BadName::Twice("TC".into())));
        assert_eq!(reported(&["a", "b"]).unwrap(), ["a_L", "a_R", "b_L", "b_R"]);
        let taken = |names: &[(&str, OwnPart)]| {
            let declared = names.iter().map(|(name, part)| {
                let girth = OwnGirth {
                    part: *part,
                    ..girth.clone()
                };
                ((*name).to_owned(), girth)
            });
            let wrong = taken_names(&declared.collect());
            wrong.into_iter().map(|m| m.name).collect::<Vec<_>>()
        };
        use OwnPart::{Thigh, Trunk};
        assert_eq!(
            taken(&[("WC", Trunk), ("TC", Thigh)]),
            ["girth.TC", "girth.WC"]
        );
        assert_eq!(
            taken(&[("a", Thigh), ("a_L", Trunk)]),
            ["girth.a", "girth.a_L"]
        );
        assert!(taken(&[("a", Trunk), ("a_L", Trunk), ("b", Thigh)]).is_empty());
    }
}
