//! Where the joints of arms are, as the model's laws tell them from what the arms show.

use crate::features::limb::{ArmSeen, Joint, Kind, Limb, Limbs};
use crate::model::file::LevelModel;
use crate::model::law::Place;
use shape::Refusal;
use stage::{Message, message};

stage::messages! {
    ARM_UNLIKE = "warn-arm-unlike": "an arm is unlike those that its joints' places were fitted on, so its intervals are wider: is it bare, does it hang or reach aside, and is the stature right?";
}

/// How sure the wrist is, against the wrist's joint of made bodies: `wrist` in `models/tables/arms.csv`; a
/// share of stature.
const WRIST_SD: f64 = 0.0033;

/// Finds the joints of both arms; an arm without them is refused. Warns if an arm is a
/// stranger to the laws.
pub fn arm_joints(limbs: &mut Limbs<'_>, model: &LevelModel) -> Option<Message> {
    let mut strange = false;
    for arm in limbs.arms_mut() {
        let Ok(limb) = arm.as_mut() else { continue };
        match reported(limb, model) {
            Ok(inside) => strange |= !inside,
            Err(why) => *arm = Err(why),
        }
    }
    strange.then(|| message!(ARM_UNLIKE))
}

/// Fills in an arm's joints; whether it is like those that the laws were fitted on.
fn reported(limb: &mut Limb, model: &LevelModel) -> Result<bool, Refusal> {
    let Some(seen) = limb.seen.filter(|_| limb.kind == Kind::Arm) else {
        return Err(Refusal::NoLimb);
    };
    if seen.get("neck_up").is_none() {
        return Err(Refusal::NoNeck);
    }
    let bent = limb.bent > 0.0;
    // Of a straight arm that joins the trunk near its elbow too little shows.
    let first = |places: &[Place]| by_laws(&seen, model, places).ok_or(Refusal::Fused);
    let (root, _) = first(&[Place::AcromionByShoulder, Place::Acromion])?;
    let (middle, _) = first(match bent {
        true => &[Place::ElbowBent],
        false => &[Place::Elbow],
    })?;
    let (mid_upper_arm, inside) = first(match bent {
        true => &[Place::UpperArmBentByShoulder, Place::UpperArmBent],
        false => &[Place::UpperArmByShoulder, Place::UpperArm],
    })?;
    limb.end = Joint {
        s: seen.wrist,
        sigma: WRIST_SD * seen.stature,
        again: None,
    };
    limb.root = root;
    limb.middle = middle;
    // Both are estimated by the same line and err alike (0.7 to 0.85 of made bodies); as one is the safe side.
    limb.shared = root.sigma * middle.sigma;
    limb.mid_upper_arm = Some(mid_upper_arm);
    Ok(inside)
}

/// The first of places whose law's features all show, as a joint, and whether the law knows such arms.
fn by_laws(seen: &ArmSeen, model: &LevelModel, places: &[Place]) -> Option<(Joint, bool)> {
    let one = |place: &Place| {
        let reported = model.law(*place).estimate(&seen.all(&place.features())?)?;
        let joint = Joint {
            s: seen.wrist + reported.value * seen.stature,
            sigma: reported.sigma * seen.stature,
            again: reported.repeat.map(|r| r * seen.stature),
        };
        Some((joint, reported.inside))
    };
    places.iter().find_map(one)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::samples::fitted;
    use crate::model::table::Table;

    #[test]
    fn the_wrists_deviation_is_that_of_made_bodies() {
        let table = Table::checked_in("arms.csv");
        let (family, off) = (
            table.text("family").unwrap(),
            table.optional("wrist").unwrap(),
        );
        let off: Vec<f64> = (0..table.len())
            .filter(|i| fitted(family[*i]))
            .filter_map(|i| off[i])
            .collect();
        let square = off.iter().map(|d| d * d).sum::<f64>() / off.len() as f64;
        assert!(off.len() > 1300);
        proof::near(WRIST_SD, square.sqrt(), 0.0003);
    }
}
