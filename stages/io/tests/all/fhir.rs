//! FHIR observations: codes by where a girth was taken, intervals, days, and no relative lengths.

use io::girths_to_fhir;
use serde_json::{Value, json};
use shape::{Girth, GirthId, Girths, Landmark, Part, Plane, Side, Unit};

fn girth(id: GirthId, by: GirthId, tape_mm: f64) -> Girth {
    let plane = Plane {
        point_mm: [0.0, 0.0, 1000.0],
        normal: [0.0, 0.0, 1.0],
    };
    let mark = Landmark::new(id, plane, Part::Trunk).by(by);
    Girth {
        interval_mm: Some([tape_mm - 5.0, tape_mm + 7.0]),
        ..Girth::at(&mark, tape_mm)
    }
}

fn girths() -> Girths {
    let arm = GirthId::UpperArm(Side::Left);
    Girths {
        girths: vec![
            girth(GirthId::Waist, GirthId::WaistNatural, 801.23),
            girth(GirthId::WaistNavel, GirthId::WaistNavel, 830.0),
            girth(GirthId::Hip, GirthId::Hip, 950.0),
            girth(arm, arm, 280.0),
        ],
        capture: Some("anna <1>".into()),
        date: Some("2026-05-01".into()),
        stature_mm: Some(1702.0),
        weight_kg: Some(64.2),
        bmi: Some(22.16),
        ratios: vec![
            ("WHR".into(), 0.8434, "no diagnosis".into()),
            ("density_kg_l".into(), 1.01, "".into()),
        ],
        ..Girths::default()
    }
}

fn bundle(girths: &Girths) -> Value {
    serde_json::from_str(&girths_to_fhir(girths).unwrap()).unwrap()
}

/// The codes of each observation, as `system|code`.
fn codes(bundle: &Value) -> Vec<Vec<String>> {
    let one = |entry: &Value| {
        let list = entry["resource"]["code"]["coding"].as_array().unwrap();
        let text = |c: &Value| {
            format!(
                "{}|{}",
                c["system"].as_str().unwrap(),
                c["code"].as_str().unwrap()
            )
        };
        list.iter().map(text).collect()
    };
    bundle["entry"]
        .as_array()
        .unwrap()
        .iter()
        .map(one)
        .collect()
}

#[test]
fn a_waist_has_the_code_of_where_it_was_taken() {
    let bundle = bundle(&girths());
    assert_eq!(
        (&bundle["resourceType"], &bundle["type"]),
        (&json!("Bundle"), &json!("collection"))
    );
    let codes = codes(&bundle);
    assert_eq!(
        codes[0],
        [
            "http://loinc.org|56115-9",
            "urn:x-tailor:iso-8559-1-2017|5.3.10",
            "urn:x-tailor:girth|WC"
        ]
    );
    // The navel's waist is no waist of ISO 8559-1.
    assert_eq!(
        codes[1],
        ["http://loinc.org|8280-0", "urn:x-tailor:girth|WC_navel"]
    );
    assert_eq!(codes[2][0], "urn:x-tailor:iso-8559-1-2017|5.3.13");
    assert_eq!(
        codes[3],
        [
            "urn:x-tailor:iso-8559-1-2017|5.3.16",
            "urn:x-tailor:girth|AC_L"
        ]
    );
    let rest: Vec<&str> = codes[4..].iter().map(|c| c[0].as_str()).collect();
    assert_eq!(
        rest,
        [
            "http://loinc.org|8302-2",
            "http://loinc.org|29463-7",
            "http://loinc.org|39156-5",
            "urn:x-tailor:girth|WHR"
        ]
    );
}

#[test]
fn values_intervals_days_and_names_are_where_fhir_has_them() {
    let bundle = bundle(&girths());
    let waist = &bundle["entry"][0]["resource"];
    assert_eq!(
        waist["valueQuantity"],
        json!({ "value": 80.12, "unit": "cm", "system": "http://unitsofmeasure.org", "code": "cm" })
    );
    assert_eq!(waist["component"][0]["valueQuantity"]["value"], 79.62);
    assert_eq!(waist["component"][1]["valueQuantity"]["value"], 80.82);
    for entry in bundle["entry"].as_array().unwrap() {
        let one = &entry["resource"];
        assert_eq!(
            (
                &one["resourceType"],
                &one["status"],
                &one["effectiveDateTime"]
            ),
            (&json!("Observation"), &json!("final"), &json!("2026-05-01"))
        );
        assert_eq!(one["subject"]["display"], "anna <1>");
    }
    let nameless = Girths {
        capture: None,
        date: None,
        ..girths()
    };
    let one = &self::bundle(&nameless)["entry"][0]["resource"];
    assert!(one.get("subject").is_none() && one.get("effectiveDateTime").is_none());
}

#[test]
fn names_of_entries_are_theirs_alone_and_the_same_again() {
    let text = girths_to_fhir(&girths()).unwrap();
    assert_eq!(text, girths_to_fhir(&girths()).unwrap());
    let bundle: Value = serde_json::from_str(&text).unwrap();
    let mut names: Vec<&str> = bundle["entry"]
        .as_array()
        .unwrap()
        .iter()
        .map(|e| e["fullUrl"].as_str().unwrap())
        .collect();
    let uuid = names[0].strip_prefix("urn:uuid:").unwrap();
    assert_eq!((uuid.len(), &uuid[14..15]), (36, "8"));
    let count = names.len();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), count);
}

#[test]
fn relative_lengths_are_no_observation() {
    let relative = Girths {
        unit: Unit::Relative,
        ..girths()
    };
    assert!(
        girths_to_fhir(&relative)
            .unwrap_err()
            .to_string()
            .contains("relative")
    );
}
