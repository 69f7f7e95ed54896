//! The published schema is the program's, and tables of girths name their capture.

use io::{girths_schema, girths_to_csv, girths_to_fhir, girths_to_json};
use serde_json::{Value, json};
use shape::{Girth, GirthId, Girths, Growth, Landmark, Missing, Part, Plane, Refusal, Score, Sex};

#[test]
fn the_published_schema_is_the_programs() {
    let published = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/girths.schema.json");
    assert_eq!(std::fs::read_to_string(published).unwrap(), girths_schema());
}

#[test]
fn a_table_names_its_capture_on_every_row() {
    let plane = Plane {
        point_mm: [0.0, 0.0, 1000.0],
        normal: [0.0, 0.0, 1.0],
    };
    let hip = Girth::at(&Landmark::new(GirthId::Hip, plane, Part::Trunk), 950.0);
    let table = Girths {
        girths: vec![hip],
        missing: vec![Missing::new(GirthId::Neck, Refusal::NoNeck)],
        capture: Some("anna \"May\"".into()),
        date: Some("2026-05-01".into()),
        scale_sigma: Some(0.0012),
        stature_mm: Some(1720.0),
        stature_sigma_mm: Some(3.5),
        weight_kg: Some(64.2),
        ratios: vec![("WHR".into(), 0.9, "".into())],
        ..Girths::default()
    };
    let csv = girths_to_csv(&table);
    let mut lines = csv.lines();
    let head = lines.next().unwrap();
    let columns = "capture,date,scale_sigma_pct,stature_cm,stature_sigma_cm,weight_kg,bmi,volume_l,WHR,WHR_tape,WHtR,density_kg_l,note";
    assert!(head.ends_with(columns), "{head}");
    let cells = "\"anna \"\"May\"\"\",2026-05-01,0.1200,172.00,0.35,64.2000,,,0.9000,,,";
    let rows: Vec<&str> = lines.collect();
    assert_eq!(rows.len(), 2);
    for row in rows {
        assert!(row.contains(cells), "{row}");
    }
    let file: Value = serde_json::from_str(&girths_to_json(&table)).unwrap();
    assert_eq!(
        (&file["date"], &file["scale_sigma_pct"]),
        (&json!("2026-05-01"), &json!(0.12))
    );
}

#[test]
fn a_childs_growth_is_in_the_json_alone_and_sex_and_age_in_no_file() {
    let score = |z: f64, centile: f64| Some(Score { z, centile });
    let child = Girths {
        sex: Some(Sex::Female),
        age_months: Some(113.71),
        stature_mm: Some(1400.0),
        weight_kg: Some(35.0),
        bmi: Some(17.86),
        growth: Some(Growth {
            bmi: score(0.5678, 71.4911),
            height: None,
        }),
        ..Girths::default()
    };
    let json = girths_to_json(&child);
    let file: Value = serde_json::from_str(&json).unwrap();
    assert_eq!(
        file["growth"],
        json!({ "reference": "WHO 2007", "bmi_for_age": { "z": 0.57, "centile": 71.5 }, "height_for_age": null })
    );
    let (csv, fhir) = (girths_to_csv(&child), girths_to_fhir(&child).unwrap());
    for text in [&csv, &fhir] {
        assert!(!text.contains("growth") && !text.contains("71.4"), "{text}");
    }
    for text in [&json, &csv, &fhir] {
        let text = text.to_lowercase();
        assert!(
            !text.contains("female") && !text.contains("113.7") && !text.contains("9.4"),
            "{text}"
        );
    }
    let adult = girths_to_json(&Girths {
        growth: None,
        ..child
    });
    assert!(!adult.contains("growth"), "{adult}");
}
