//! Lengths that contradict each other: what depends on either is not given, with why.

use crate::made;

use made::Given;
use measure::GirthParams;
use shape::{Girths, Length, Person, Photos, Refusal, Scale, Unit};
use std::sync::Arc;

#[test]
fn a_stature_that_contradicts_the_surface_takes_all_that_depends_on_either_with_it() {
    let mesh = made::meshed(&made::built(1700.0, 1.0, 30.0), 12.0);
    let found = Given::of(&mesh).landmarks();
    let of = |scale, stature_mm: f64| {
        let person = Person {
            weight_kg: Some(70.0),
            ..Person::default()
        };
        let mut photos = Photos::default();
        photos.rig.stature_mm = Some(stature_mm);
        let given = Given {
            cameras: Some(Arc::new(made::cameras(scale, None, 0.0))),
            photos: Some(Arc::new(photos)),
            person: Some(Arc::new(person)),
            ..Given::of(&mesh)
        };
        given.girths(&found, &GirthParams::default())
    };
    let ratios = |girths: &Girths| {
        girths
            .ratios
            .iter()
            .map(|r| r.0.clone())
            .collect::<Vec<_>>()
    };
    let tall = found.stature_mm.unwrap();
    let near = of(Scale::Mat, 1.03 * tall);
    assert_eq!(ratios(&near), ["WHR", "WHR_tape", "WHtR", "density_kg_l"]);
    assert!(near.bmi.is_some() && near.get("WC").is_some());
    let refused = |girths: &Girths, name: &str, one: &str| {
        let why = format!("{one} and the stature contradict each other");
        let missing = girths.missing.iter().find(|m| m.name == name);
        missing.is_some_and(|m| m.reason == Refusal::Disputed && m.why.starts_with(&why))
    };
    let off = of(Scale::Disputed([Length::Mat, Length::Stature]), 2.19 * tall);
    assert_eq!(
        (off.unit, off.bmi, off.volume_l),
        (Unit::Relative, None, None)
    );
    assert_eq!(ratios(&off), ["WHR", "WHR_tape"]);
    assert!(
        refused(&off, "BMI", "the mat") && refused(&off, "WHtR", "the mat"),
        "{:?}",
        off.missing
    );
    assert!(off.get("WC").is_some(), "relative");
    // Where cameras of elsewhere claim that they are in millimetres, no girth is left.
    let given = of(Scale::Given, 2.19 * tall);
    assert_eq!(
        (given.bmi, given.volume_l, given.stature_mm),
        (None, None, None)
    );
    assert!(given.girths.is_empty() && given.profile.tape_mm.is_empty());
    assert!(
        ["HC", "WC", "AC_L", "stature", "BMI"]
            .iter()
            .all(|name| refused(&given, name, "the unit of the surface"))
    );
    assert_eq!(ratios(&given), ["WHR", "WHR_tape"]);
}
