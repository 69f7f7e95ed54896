//! Which girths are measured: sets, the user's own, and what is declared of tapes.

use crate::made;

use made::Given;
use measure::{GirthParams, LandmarkParams, OwnGirth, OwnPart, Waist, Wanted};
use shape::{GirthId, Girths, Landmarks, Person, Photos, Refusal, Rig, Scale, Sex, Unit};
use stage::Named;
use std::sync::Arc;

fn body() -> Given {
    Given::of(&made::meshed(&made::built(1700.0, 1.0, 30.0), 12.0))
}

fn names(landmarks: &Landmarks) -> Vec<&str> {
    landmarks.found.iter().map(|l| l.name.as_str()).collect()
}

#[test]
fn a_set_holds_its_own_girths_and_no_other() {
    let body = body();
    let of = |set, waist| {
        let params = LandmarkParams {
            set,
            waist,
            ..Default::default()
        };
        body.marked(&params).unwrap()
    };
    let iso = of(Wanted::Iso8559, Waist::Natural);
    assert_eq!(
        names(&iso),
        [
            "HC", "WC", "CC", "NC", "AC_L", "AC_R", "TC_L", "CFC_L", "TC_R", "CFC_R"
        ]
    );
    assert!(iso.found.iter().all(|l| l.by.definition().iso.is_some()));
    let paper = of(Wanted::Paper, Waist::Natural);
    assert_eq!(names(&paper), ["HC", "WC", "CC", "NC", "AC_L", "AC_R"]);
    let who = of(Wanted::Who, Waist::Natural);
    assert_eq!(names(&who), ["HC", "HC_max", "WC"]);
    // The survey's waist is the navel's, and bears its own name unless it is the chosen one.
    let survey = of(Wanted::Ansur, Waist::Natural);
    assert_eq!(
        names(&survey),
        ["HC", "WC_navel", "CC", "NC", "CFC_L", "CFC_R"]
    );
    let survey = of(Wanted::Ansur, Waist::Navel);
    let waist = survey.found.iter().find(|l| l.name == "WC").unwrap();
    assert_eq!((waist.id, waist.by), (GirthId::Waist, GirthId::WaistNavel));
    assert!(waist.definition.contains("navel"), "{}", waist.definition);
}

#[test]
fn a_girth_of_the_users_own_is_where_it_was_put_or_is_refused() {
    let body = body();
    let own = |part, at| OwnGirth {
        part,
        at,
        label: String::new(),
    };
    let declared = [
        ("low", own(OwnPart::Trunk, 0.0)),
        ("mid_trunk", own(OwnPart::Trunk, 0.35)),
        ("mid_thigh", own(OwnPart::Thigh, 0.5)),
    ];
    let params = LandmarkParams {
        set: Wanted::Paper,
        girth: Named(declared.map(|(n, g)| (n.to_owned(), g)).into()),
        ..Default::default()
    };
    let found = body.marked(&params).unwrap();
    let measured = body.girths(&found, &GirthParams::default());
    let [hip, low, mid, neck] = ["HC", "low", "mid_trunk", "NC"].map(|n| measured.get(n).unwrap());
    // At 0 it is the hip, within a slice.
    assert!((low.tape_mm / hip.tape_mm - 1.0).abs() < 0.01);
    let z = |g: &shape::Girth| g.plane.point_mm[2];
    assert!(z(hip) < z(mid) && z(mid) < z(neck));
    assert_eq!((mid.id, mid.name.as_str()), (GirthId::Own, "mid_trunk"));
    assert!(
        mid.definition.contains("0.35 of the way"),
        "{}",
        mid.definition
    );
    assert!(mid.interval_mm.is_some());
    // On a limb: the left and the right one, found, or refused with a reason.
    for name in ["mid_thigh_L", "mid_thigh_R"] {
        let refused = found
            .missing
            .iter()
            .any(|m| m.name == name && !m.why.is_empty());
        assert!(refused != (measured.get(name).is_some()), "{name}");
    }
}

#[test]
fn a_name_that_is_taken_is_named() {
    let params = LandmarkParams {
        girth: Named([("WC".to_owned(), OwnGirth::default())].into()),
        ..Default::default()
    };
    let Err(stage::Stop::Failed(why)) = body().marked(&params) else {
        panic!("it was taken")
    };
    assert!(why.to_string().contains("WC is there already"), "{why}");
}

#[test]
fn a_declared_compression_shortens_tapes_and_their_intervals_and_nothing_else() {
    let body = body();
    let found = body.landmarks();
    let plain = body.girths(&found, &GirthParams::default());
    let params = GirthParams {
        compression_pct: 2.0,
        ..Default::default()
    };
    let pressed = body.girths(&found, &params);
    assert_eq!((plain.compression_pct, pressed.compression_pct), (0.0, 2.0));
    assert_eq!(plain.girths.len(), pressed.girths.len());
    for (a, b) in plain.girths.iter().zip(&pressed.girths) {
        assert_eq!((a.contour_mm, a.spline_mm), (b.contour_mm, b.spline_mm));
        proof::near(b.tape_mm / a.tape_mm, 0.98, 1e-12);
        let ([low, _], [pressed, _]) = (a.interval_mm.unwrap(), b.interval_mm.unwrap());
        proof::near(pressed / low, 0.98, 1e-12);
    }
    let ratio = |girths: &Girths, name: &str| {
        let found = girths.ratios.iter().find(|r| r.0 == name);
        found.unwrap().1
    };
    proof::near(ratio(&pressed, "WHtR") / ratio(&plain, "WHtR"), 0.98, 1e-12);
    proof::near(ratio(&pressed, "WHR"), ratio(&plain, "WHR"), 1e-12);
}

#[test]
fn a_level_that_nobody_knows_gives_no_interval_and_one_far_too_uncertain_no_number() {
    let body = body();
    let mut found = body.landmarks();
    let mark = |found: &mut Landmarks, name: &str, mm: Option<f64>| {
        let mark = found.found.iter_mut().find(|l| l.name == name).unwrap();
        mark.sigma.level_mm = mm;
        mark.sigma.repeat_mm = Some(2.0);
    };
    mark(&mut found, "WC", None);
    mark(&mut found, "CFC_L", Some(250.0));
    mark(&mut found, "HC", Some(0.0));
    let reported = body.girths(&found, &GirthParams::default());
    let waist = reported.get("WC").unwrap();
    assert_eq!((waist.interval_mm, waist.sigmas.level_mm), (None, None));
    assert!(waist.remarks()[0].contains("how sure the level is"));
    let missing = reported.missing.iter().find(|m| m.name == "CFC_L").unwrap();
    assert_eq!(
        (missing.reason, missing.id.is_some()),
        (Refusal::TooUncertain, true)
    );
    assert!(reported.get("CFC_L").is_none());
    // A level without doubt is a part of zero, and repeats are narrower than no interval.
    let hip = reported.get("HC").unwrap();
    assert_eq!(hip.sigmas.level_mm, Some(0.0));
    let (low, high) = hip.interval_mm.map(|[low, high]| (low, high)).unwrap();
    assert!(hip.repeat_mm.unwrap() > 0.0 && hip.repeat_mm.unwrap() < high - low);
}

#[test]
fn without_a_scale_lengths_are_relative_and_nothing_needs_centimetres() {
    let body = body();
    let found = body.landmarks();
    let of = |scale, sigma| {
        let given = Given {
            cameras: Some(Arc::new(made::cameras(scale, sigma, 0.0))),
            ..Given::of(&body.mesh)
        };
        given.girths(&found, &GirthParams::default())
    };
    let relative = of(Scale::Nothing, None);
    assert_eq!(relative.unit, Unit::Relative);
    assert_eq!((relative.bmi, relative.volume_l), (None, None));
    assert!(relative.ratios.iter().any(|r| r.0 == "WHR"));
    // Cameras that were given vouch for no scale: unknown, not zero, and the interval stays.
    let given = of(Scale::Given, None);
    let waist = given.get("WC").unwrap();
    assert_eq!((given.unit, waist.sigmas.scale_mm), (Unit::Metric, None));
    let known = of(Scale::Mat, Some(0.01));
    let known = known.get("WC").unwrap();
    proof::near(known.sigmas.scale_mm.unwrap(), 0.01 * known.tape_mm, 1e-9);
    let width = |g: &shape::Girth| g.interval_mm.map(|[low, high]| high - low).unwrap();
    assert!(width(known) > width(waist));
}

#[test]
fn a_child_is_put_beside_the_growth_reference_and_what_lacks_is_warned_of() {
    let mesh = made::meshed(&made::built(1400.0, 1.0, 30.0), 12.0);
    let reported = |person: Person, day: Option<&str>| {
        let person = Person {
            weight_kg: Some(35.0),
            date: day.map(str::to_owned),
            ..person
        };
        let rig = Rig {
            stature_mm: Some(1400.0),
            ..Rig::default()
        };
        let photos = Photos {
            rig,
            ..Photos::default()
        };
        let given = Given {
            photos: Some(Arc::new(photos)),
            person: Some(Arc::new(person)),
            ..Given::of(&mesh)
        };
        let (_, girths) = given.measured();
        (girths, given.warned.0.into_inner().unwrap().join("; "))
    };
    let born = |day: &str| Person {
        sex: Some(Sex::Female),
        born: Some(day.into()),
        ..Person::default()
    };
    let (child, warned) = reported(born("2016-05-01"), Some("2026-05-01"));
    let growth = child.growth.unwrap();
    let (bmi, height) = (growth.bmi.unwrap(), growth.height.unwrap());
    // Girls of ten: median 138.6 cm, 4.61 % spread; 17.9 kg/m² is between the median and one standard deviation.
    proof::near(height.z, (140.0 - 138.6) / (138.6 * 0.0461), 0.03);
    assert!((0.4..0.8).contains(&bmi.z) && (65.0..80.0).contains(&bmi.centile));
    assert!(!warned.contains("day of birth"), "{warned}");
    let whr = child.ratios.iter().find(|r| r.0 == "WHR").unwrap();
    assert_eq!(whr.2, "", "no threshold of adults");
    let (unknown, warned) = reported(born("2016-05-01"), None);
    assert!(unknown.growth.is_none() && warned.contains("not that of the capture"));
    let (later, warned) = reported(born("2026-05-02"), Some("2026-05-01"));
    assert!(later.age_months.is_none() && warned.contains("before the day of birth"));
}
