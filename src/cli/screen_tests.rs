//! Lines fit, and have each thing once.

use super::*;
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
    )
}

#[test]
fn long_lines_are_broken_between_words_and_lose_none() {
    let why = "arms and trunk are one on the surface there ".repeat(5);
    let text = broken(&format!("  CC     {why}"), 9);
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
    let mut cameras = Cameras {
        views: [].into_iter().collect(),
        scale: Scale::Nothing,
        scale_sigma: None,
        disk_radius_mm: None,
        ground_mm: 0.0,
        points: vec![],
    };
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
