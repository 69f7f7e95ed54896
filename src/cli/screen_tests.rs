//! Lines fit, and have each thing once.

use super::*;
use crate::cli::columns::WIDTH;
use shape::{GirthId, Length, Refusal};

const EN: Words = Words {
    language: Language::En,
    inches: false,
};

fn shown(cameras: Option<&Cameras>, girths: &Girths) -> String {
    let (name, photos) = ("a", 3);
    screen(
        EN,
        &Of {
            name,
            photos,
            cameras,
            girths,
        },
        WIDTH,
    )
}

#[test]
fn long_lines_are_broken_between_words_and_lose_none() {
    let why = "arms and trunk are one on the surface there ".repeat(5);
    let text = broken(&format!("  CC     {why}"), 9, WIDTH);
    assert!(text.lines().count() > 2 && text.lines().all(|l| l.chars().count() <= WIDTH));
    assert!(
        text.lines()
            .skip(1)
            .all(|l| l.starts_with("         a") || !l.starts_with("          "))
    );
    let words = |t: &str| t.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
    assert_eq!(words(&text), words(&format!("CC {why}")));
}

#[test]
fn one_reason_is_printed_once_for_all_that_it_is_the_reason_of() {
    let missing = shape::Missing::because;
    let legs = "the surface shows no two legs";
    let girths = Girths {
        missing: vec![
            missing(GirthId::Hip, Refusal::NoLegs, legs),
            missing(GirthId::Neck, Refusal::NoNeck, "no neck"),
            missing(GirthId::Waist, Refusal::NoLegs, legs),
        ],
        ..Girths::default()
    };
    let text = shown(None, &girths);
    assert_eq!(
        text,
        format!("\nnot measured\n  hip, waist: {legs}\n  neck: no neck\n")
    );
}

#[test]
fn what_has_no_scale_is_marked() {
    let mut cameras = Cameras::of([], Scale::Nothing);
    let text = shown(Some(&cameras), &Girths::default());
    assert!(text.contains("LENGTHS ARE RELATIVE"), "{text}");
    cameras.scale = Scale::Disputed([Length::Mat, Length::Stature]);
    let text = shown(Some(&cameras), &Girths::default());
    assert!(
        text.contains("known lengths contradict each other"),
        "{text}"
    );
    cameras.scale = Scale::Mat;
    let text = shown(Some(&cameras), &Girths::default());
    assert!(
        text.contains("a: 0 of 3 photos") && text.contains("the marker mat (how sure: unknown)"),
        "{text}"
    );
    cameras.scale_sigma = Some(0.0012);
    assert!(shown(Some(&cameras), &Girths::default()).contains("(± 0.12 %)"));
}

#[test]
fn on_a_narrow_terminal_contours_and_names_of_files_make_way_and_every_line_fits() {
    let plane = shape::Plane {
        point_mm: [0.0; 3],
        normal: [0.0, 0.0, 1.0],
    };
    let girth = |id| {
        let mark = shape::Landmark::new(id, plane, shape::Part::Trunk);
        Girth {
            interval_mm: Some([800.0, 1000.0]),
            ..Girth::at(&mark, 900.0)
        }
    };
    let note = Message::from("experimental; includes air in the lungs".to_owned());
    let girths = Girths {
        girths: vec![girth(GirthId::WaistHipBone)],
        ratios: vec![("density_kg_l".into(), 0.968, note)],
        ..Girths::default()
    };
    let of = Of {
        name: "a",
        photos: 3,
        cameras: None,
        girths: &girths,
    };
    for (columns, names, contours) in [(80, true, true), (60, false, true), (55, false, false)] {
        let text = screen(EN, &of, columns);
        let fits = text.lines().all(|l| l.chars().count() <= columns);
        assert!(fits, "{columns}: {text}");
        assert!(text.contains("80.0 to 100.0"), "{text}");
        let shown = ["(WC_hip_bone)", "contour"].map(|part| text.contains(part));
        assert_eq!(shown, [names, contours], "{columns}: {text}");
    }
}
