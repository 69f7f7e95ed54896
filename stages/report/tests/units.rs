//! What numbers of the report are in, and how sure they are called.

#[allow(dead_code)]
mod tube;

use report::{Html, HtmlInput, HtmlParams};
use shape::Scale;
use stage::{Ctx, Stage};
use std::sync::Arc;
use tube::input;

fn page_of(params: &HtmlParams, input: HtmlInput) -> String {
    String::from_utf8(Html::run(params, input, &Ctx::alone()).unwrap().bytes).unwrap()
}

fn page(params: &HtmlParams) -> String {
    page_of(params, input())
}

#[test]
fn lengths_of_unknown_scale_are_called_relative() {
    let mut input = input();
    let mut cameras = (*input.cameras).clone();
    (cameras.scale, cameras.scale_sigma) = (Scale::Nothing, None);
    input.cameras = Arc::new(cameras);
    Arc::make_mut(&mut input.girths).unit = shape::Unit::Relative;
    let wanted = ["Lengths are relative", "tape [relative]", "0.5025"];
    let (told, plain) = (
        page_of(&HtmlParams::default(), input),
        page(&HtmlParams::default()),
    );
    for text in wanted {
        assert!(told.contains(text) && !plain.contains(text), "{text}");
    }
    for text in ["[cm]", " cm<", "± 0.00 %", "centimetres"] {
        assert!(!told.contains(text), "{text}");
    }
}

#[test]
fn what_an_interval_is_made_of_is_told_and_what_is_unknown_is_not_called_zero() {
    let known = page(&HtmlParams::default());
    let parts =
        "standard deviations [cm]: level 0.12, surface 0.08, scale unknown, split 0.00, cover 0.00";
    assert_eq!(
        known.matches(parts).count(),
        2,
        "on the row and on its interval"
    );
    let mut input = input();
    let girths = Arc::make_mut(&mut input.girths);
    girths.girths[0].interval_mm = None;
    girths.girths[0].sigmas.level_mm = None;
    girths.compression_pct = 1.5;
    let cameras = Arc::make_mut(&mut input.cameras);
    (cameras.scale, cameras.scale_sigma) = (Scale::Given, None);
    let told = page_of(&HtmlParams::default(), input);
    for text in [
        "unknown: level",
        "shortened by 1.5 %",
        "taken at their word; how sure they are: unknown",
    ] {
        assert!(told.contains(text) && !known.contains(text), "{text}");
    }
}

#[test]
fn inches_are_shown_where_they_are_wanted_and_relative_lengths_stay_relative() {
    let inches = HtmlParams {
        unit: report::ShownIn::Inch,
        ..HtmlParams::default()
    };
    let (told, plain) = (page(&inches), page(&HtmlParams::default()));
    for text in [
        "tape [in]",
        "All in inches",
        "standard deviations [in]",
        "height [in]",
    ] {
        assert!(told.contains(text) && !plain.contains(text), "{text}");
    }
    assert!(!told.contains("[cm]"), "one unit on a page");
    // The WHO's thresholds are in what the reader reads.
    assert!(told.contains("above 37.0 (men), 31.5 (women), substantially above 40.2, 34.6"));
    assert!(plain.contains("above 94.0 (men), 80.0 (women), substantially above 102.0, 88.0"));
    let tape = input().girths.girths[0].tape_mm;
    assert!(told.contains(&format!("{:.1} in", tape / 25.4)));
    let mut input = input();
    Arc::make_mut(&mut input.girths).unit = shape::Unit::Relative;
    let relative = page_of(&inches, input);
    assert!(relative.contains("tape [relative]") && !relative.contains("[in]"));
    assert!(!relative.contains("WHO 2008, adults: risk increased above"));
}
