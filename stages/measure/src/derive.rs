//! What follows from girths: ratios, body mass index, volume, and the curve of girth over height.

use crate::features::arms::arm_ring;
use crate::features::body::Body;
use shape::{GirthId, Girths, Mesh, Missing, Profile, Refusal, Sex, Unit};
use stage::{Message, Template, message};

stage::messages! {
    WHO_MEN = "note-who-men": "WHO 2008: raised risk from 0.90 (men); no diagnosis";
    WHO_WOMEN = "note-who-women": "WHO 2008: raised risk from 0.85 (women); no diagnosis";
    WHO_ALL = "note-who": "WHO 2008: raised risk from 0.90 (men), 0.85 (women); no diagnosis";
    NICE = "note-nice": "waist to height: NICE 2022 names 0.5 as a boundary to keep below; no diagnosis";
    DENSITY = "note-density": "experimental; includes air in the lungs; 1 % error in volume means 1 % error in density";
    WITHHELD = "warn-withheld": "{one} and {other} contradict each other, so what depends on them is not given: correct one of them, or leave one out";
    NO_BODY = "warn-density": "weight / volume = {density:.2 kg/l}, but bodies have 0.93 to 1.1: unless this is a dummy, scale, weight or surface is wrong (is the body cut off?); look at the masks";
}

/// What is known of a body besides its girths.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Known {
    /// Crown above the ground, as the surface shows it. \[mm\]
    pub(crate) measured_mm: Option<f64>,
    /// The stature that was given. \[mm\]
    pub(crate) given_mm: Option<f64>,
    /// The weight that was given. \[kg\]
    pub(crate) kg: Option<f64>,
}

/// Adds ratios, body mass index and volume. Stature and weight are the user's where he gave them; where
/// lengths are relative, nothing is given that needs centimetres.
pub(crate) fn derive(girths: &mut Girths, mesh: &Mesh, known: &Known) {
    let Known {
        measured_mm,
        given_mm,
        kg,
    } = *known;
    let metric = girths.unit == Unit::Metric;
    let (waist, hip) = (girths.of(GirthId::Waist), girths.of(GirthId::Hip));
    let [waist_tape, hip_tape] = [waist, hip].map(|g| g.map(|g| g.tape_mm));
    let [waist_skin, hip_skin] = [waist, hip].map(|g| g.map(|g| g.contour_mm));
    let stature = given_mm.filter(|_| metric).or(measured_mm);
    let mut ratios = Vec::new();
    let mut add = |name: &str, value: Option<f64>, note: Option<Template>| {
        if let Some(value) = value.filter(|v| v.is_finite()) {
            let note = note.map_or(Message::default(), |kind| Message::new(&kind, []));
            ratios.push((name.to_owned(), value, note));
        }
    };
    let over = |a: Option<f64>, b: Option<f64>| a.zip(b).map(|(a, b)| a / b);
    // Whose thresholds are meant hangs on how tall the body is.
    girths.stature_mm = measured_mm;
    let who = match (girths.is_adult(), girths.sex) {
        (false, _) => None,
        (_, Some(Sex::Male)) => Some(WHO_MEN),
        (_, Some(Sex::Female)) => Some(WHO_WOMEN),
        (_, None) => Some(WHO_ALL),
    };
    add("WHR", over(waist_skin, hip_skin), who);
    add("WHR_tape", over(waist_tape, hip_tape), who);
    // NICE names it for adults, and for children from 5 years on.
    let from_five = girths.age_months.is_some_and(|months| months >= 60.0);
    let half = match girths.is_adult() || from_five {
        true => Some(NICE),
        false => None,
    };
    add("WHtR", over(waist_tape, stature), half);
    let volume_l = Some(mesh.volume() * 1e-6).filter(|_| metric);
    let density = kg.zip(volume_l).map(|(kg, litres)| kg / litres);
    add("density_kg_l", density.filter(|d| *d > 0.0), Some(DENSITY));
    girths.ratios = ratios;
    girths.weight_kg = kg;
    let metres = stature.filter(|_| metric).map(|mm| mm / 1000.0);
    girths.bmi = kg.zip(metres).map(|(kg, m)| kg / m.powi(2));
    girths.volume_l = volume_l;
}

/// Shortens tapes, their intervals and what these are made of by a share: what a tape presses in.
pub(crate) fn compress(girths: &mut Girths, percent: f64) {
    let by = 1.0 - percent / 100.0;
    girths.compression_pct = percent;
    for girth in &mut girths.girths {
        girth.tape_mm *= by;
        girth.interval_mm = girth.interval_mm.map(|ends| ends.map(|mm| mm * by));
        girth.sigmas = girth.sigmas.scaled(by);
        girth.repeat_mm = girth.repeat_mm.map(|mm| mm * by);
    }
    girths.profile.tape_mm.iter_mut().for_each(|mm| *mm *= by);
}

/// Takes back what depends on lengths that contradict each other, with why it is not there: all that takes stature or a
/// volume; and all centimetres, where lengths are not relative already. Ratios of girths stay, for they have no unit.
pub(crate) fn withhold(girths: &mut Girths, between: [Template; 2]) {
    let [one, other] = between.map(|kind| Message::new(&kind, []));
    let why = message!(WITHHELD, one = one, other = other);
    let number = |name: &str| Missing::number(name, Refusal::Disputed, &why);
    let mut missing = Vec::new();
    if girths.unit == Unit::Metric {
        missing.extend(
            std::mem::take(&mut girths.girths)
                .into_iter()
                .map(|girth| Missing {
                    id: Some(girth.id),
                    ..number(&girth.name)
                }),
        );
        missing.extend(girths.stature_mm.take().map(|_| number("stature")));
        (girths.stature_sigma_mm, girths.profile) = (None, Profile::default());
    }
    missing.extend(girths.weight_kg.map(|_| number("BMI")));
    let waist = girths.ratios.iter().any(|(name, ..)| name == "WHtR");
    missing.extend(waist.then(|| number("WHtR")));
    girths.ratios.retain(|(name, ..)| name.starts_with("WHR"));
    (girths.bmi, girths.volume_l, girths.growth) = (None, None, None);
    girths.missing.extend(missing);
}

/// Densities of living bodies, with air in their lungs and what a surface errs.
/// By hand: looked at three scans and five captures, at 0.7 and 1.4 of it: nothing changes, for no weight was given. \[kg/l\]
const DENSITIES_KG_L: std::ops::RangeInclusive<f64> = 0.8..=1.2;

/// What is reported where volume and the weight that was given do not make a living body.
pub(crate) fn no_density(girths: &Girths) -> Option<Message> {
    let mut ratios = girths.ratios.iter();
    let (_, density, _) = ratios.find(|(name, ..)| name == "density_kg_l")?;
    (!DENSITIES_KG_L.contains(density)).then(|| message!(NO_BODY, density = density))
}

/// The trunk's tape over height above the ground, from the hip to the chest, while the arms are
/// apart from it (or the chest was measured without them).
pub(crate) fn profile(body: &Body, girths: &Girths) -> Profile {
    let level = |id: GirthId| {
        girths
            .of(id)
            .filter(|g| g.plane.normal[2] > 0.99)
            .map(|g| g.plane.point_mm[2])
    };
    let low = level(GirthId::Hip).or(body.crotch).unwrap_or(body.ground) - 0.03 * body.stature;
    let high =
        level(GirthId::Chest).unwrap_or(body.ground + 0.7 * body.stature) + 0.01 * body.stature;
    let mut profile = Profile::default();
    for slice in body.between(low, high) {
        let apart = [1.0, -1.0]
            .iter()
            .all(|side| arm_ring(body, &slice.rings, *side).is_some());
        if let Some(ring) = slice.rings.first().filter(|_| apart) {
            profile.height_mm.push(slice.z - body.ground);
            profile.tape_mm.push(ring.tape);
        }
    }
    profile
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of a body of half a metre.
    fn known(given_mm: Option<f64>, kg: Option<f64>) -> Known {
        Known {
            measured_mm: Some(500.0),
            given_mm,
            kg,
        }
    }

    #[test]
    fn thresholds_of_adults_are_beside_no_figure_of_a_childs_size() {
        let (positions, faces) = proof::block([500.0; 3]);
        let cube = Mesh {
            positions,
            faces,
            ..Mesh::default()
        };
        let notes = |stature: Option<f64>, age_months: Option<f64>| {
            let plane = shape::Plane {
                point_mm: [0.0; 3],
                normal: [0.0, 0.0, 1.0],
            };
            let at = |id| {
                let mark = shape::Landmark::new(id, plane, shape::Part::Trunk);
                shape::Girth::at(&mark, 430.0)
            };
            let mut girths = Girths {
                girths: vec![at(GirthId::Waist), at(GirthId::Hip)],
                age_months,
                ..Girths::default()
            };
            let known = Known {
                measured_mm: stature,
                ..known(None, None)
            };
            derive(&mut girths, &cube, &known);
            let notes: Vec<String> = girths.ratios.iter().map(|r| r.2.to_string()).collect();
            notes.join("; ")
        };
        let figure = notes(Some(812.0), None);
        assert!(
            !figure.contains("WHO") && !figure.contains("NICE"),
            "{figure}"
        );
        for adult in [notes(Some(1700.0), None), notes(Some(1300.0), Some(300.0))] {
            assert!(
                adult.contains("WHO 2008: raised risk") && adult.contains("NICE"),
                "{adult}"
            );
        }
        let child = notes(Some(1300.0), Some(100.0));
        assert!(!child.contains("WHO") && child.contains("NICE"), "{child}");
    }

    #[test]
    fn a_weight_that_does_not_fit_the_volume_is_reported() {
        // A cube of half a metre: 125 l.
        let (positions, faces) = proof::block([500.0; 3]);
        let cube = Mesh {
            positions,
            faces,
            ..Mesh::default()
        };
        let stated = |kg: Option<f64>| {
            let mut girths = Girths::default();
            derive(&mut girths, &cube, &known(None, kg));
            let known =
                |(name, ..): &(String, f64, Message)| Girths::RATIOS.contains(&name.as_str());
            assert!(girths.ratios.iter().all(known));
            assert_eq!(girths.ratios.is_empty(), kg.is_none());
            no_density(&girths)
        };
        assert_eq!(stated(Some(120.0)), None);
        assert_eq!(stated(None), None);
        assert!(stated(Some(52.0)).unwrap().contains("0.42 kg/l"));
        let mut relative = Girths {
            unit: Unit::Relative,
            ..Girths::default()
        };
        derive(&mut relative, &cube, &known(Some(1700.0), Some(52.0)));
        assert_eq!((relative.bmi, relative.volume_l), (None, None));
        assert_eq!(
            (relative.ratios, relative.stature_mm),
            (vec![], Some(500.0))
        );
    }
}
