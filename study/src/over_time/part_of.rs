//! The part of the body that a girth of a file goes around.

use crate::girth_file::ReadGirth;
use shape::{GirthId, Landmark, Part, Plane, Region, Side};

/// A place to measure at on another surface: the girth's definition with another plane. `None` for girths that no table
/// and no word of the file places, such as one through picked points.
pub(super) fn landmark(girth: &ReadGirth, plane: Plane) -> Option<Landmark> {
    let id = GirthId::named(&girth.name).unwrap_or(GirthId::Own);
    let region = girth
        .part
        .as_deref()
        .and_then(Region::named)
        .unwrap_or(id.definition().region);
    let by_name = || {
        Side::BOTH
            .into_iter()
            .find(|s| girth.name.ends_with(s.suffix()))
    };
    let side = id.side().or_else(by_name);
    let part = match (region, side) {
        (Region::Neck, _) => Part::Head,
        (Region::Chest | Region::Waist | Region::Hip, _) => Part::Trunk,
        (Region::UpperArm | Region::Forearm, Some(side)) => Part::arm(side),
        (Region::Thigh | Region::Calf, Some(side)) => Part::leg(side),
        _ => return None,
    };
    Some(Landmark {
        region,
        name: girth.name.clone(),
        label: girth.label.clone(),
        ..Landmark::new(id, plane, part)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::girth_file::GirthFile;

    #[test]
    fn girths_of_the_table_and_of_ones_own_have_their_parts() {
        let part = |name: &str, part: &str| {
            let text = format!(
                r#"{{"girths":[{{"name":"{name}","label":"x","part":{part},"cm":1,"tape_cm":1}}]}}"#
            );
            let girth = GirthFile::read(&text).unwrap().girths.remove(0);
            let plane = Plane {
                point_mm: [0.0; 3],
                normal: [0.0, 0.0, 1.0],
            };
            landmark(&girth, plane).map(|l| l.part)
        };
        assert_eq!(part("WC", "null"), Some(Part::Trunk));
        assert_eq!(part("NC", "\"neck\""), Some(Part::Head));
        assert_eq!(part("AC_R", "null"), Some(Part::ArmRight));
        assert_eq!(part("mid_thigh_L", "\"thigh\""), Some(Part::LegLeft));
        assert_eq!(part("below_bust", "\"chest\""), Some(Part::Trunk));
        assert_eq!(part("PICKED", "\"anywhere\""), None);
    }
}
