//! The table of a cohort: units, intervals, reasons, odd letters.

use super::*;
use shape::{Girth, GirthId, Landmark, Missing, Part, Plane, Refusal};

fn girth(id: GirthId, tape_mm: f64, interval_mm: Option<[f64; 2]>) -> Girth {
    let mark = Landmark::new(
        id,
        Plane {
            point_mm: [0.0; 3],
            normal: [0.0, 0.0, 1.0],
        },
        Part::Trunk,
    );
    Girth {
        interval_mm,
        ..Girth::at(&mark, tape_mm)
    }
}

fn row(capture: &str, scale: Scale, girths: Vec<Girth>, warnings: &[&str]) -> Row {
    let missing = vec![Missing::because(GirthId::Neck, Refusal::NoNeck, "no neck")];
    let girths = Girths {
        unit: scale.unit(),
        girths,
        missing,
        stature_mm: Some(1780.0),
        ..Girths::default()
    };
    Row {
        capture: capture.into(),
        out: format!("{capture}-out"),
        came: Ok(Came {
            girths: girths.into(),
            scale,
            warnings: warnings.iter().map(|w| (*w).into()).collect(),
        }),
    }
}

fn rows() -> Vec<Row> {
    let waist = |mm: f64| girth(GirthId::Waist, mm, Some([mm - 4.0, mm + 6.0]));
    let hip = girth(GirthId::Hip, 990.0, None);
    vec![
        row(
            "a",
            Scale::Mat,
            vec![waist(801.2), hip],
            &["blurred, \"much\"", "dark"],
        ),
        row("b", Scale::Nothing, vec![waist(801.2)], &[]),
        Row {
            capture: "c".into(),
            out: "c-out".into(),
            came: Err("c holds no photo".into()),
        },
    ]
}

#[test]
fn a_row_tells_tapes_intervals_scale_warnings_or_why_there_is_nothing() {
    let csv = String::from_utf8(csv(&rows())).unwrap();
    let lines: Vec<&str> = csv.lines().collect();
    let head = "capture,unit,scale,stature,WC,WC_lo,WC_hi,HC,HC_lo,HC_hi,missing,warnings,trouble";
    assert_eq!(lines[0], head);
    let first = "a,cm,mat,178.00,80.12,79.72,80.72,99.00,,,NC,\"blurred, \"\"much\"\"; dark\",";
    assert_eq!(lines[1], first);
    assert_eq!(
        lines[2],
        "b,relative,none,1.78000,0.80120,0.79720,0.80720,,,,NC,,"
    );
    assert_eq!(lines[3], "c,,,,,,,,,,,,c holds no photo");
}

#[test]
fn the_screen_and_json_have_the_same() {
    let rows = rows();
    let screen = text(&rows);
    let lines: Vec<&str> = screen.lines().collect();
    assert!(
        lines[1].contains("80.12 ± 0.50") && lines[1].ends_with("2"),
        "{screen}"
    );
    assert!(lines[2].contains("0.80120 ± 0.00500"), "{screen}");
    assert!(lines[3].contains("c holds no photo"), "{screen}");
    let reported = json(&rows[0]);
    assert_eq!(reported["girths"][0]["tape"], 80.12);
    assert_eq!(reported["girths"][0]["interval"], json!([79.72, 80.72]));
    assert_eq!(
        (&reported["scale"], &reported["unit"]),
        (&json!("mat"), &json!("cm"))
    );
    assert_eq!(
        json(&rows[2]),
        json!({ "capture": "c", "done": false, "why": "c holds no photo" })
    );
}
