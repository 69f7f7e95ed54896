//! What numbers of the report are in, and how sure they are called.

use crate::tube;

use report::{Html, HtmlInput, HtmlParams};
use shape::{Girths, Growth, Length, Scale, Score, Sex};
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
    let mut cameras = (**input.cameras.as_ref().unwrap()).clone();
    (cameras.scale, cameras.scale_sigma) = (Scale::Nothing, None);
    input.cameras = Some(Arc::new(cameras));
    Arc::make_mut(&mut input.girths).unit = shape::Unit::Relative;
    let wanted = ["Lengths are relative", "tape [relative]", "0.5025"];
    let (changed, plain) = (
        page_of(&HtmlParams::default(), input),
        page(&HtmlParams::default()),
    );
    for text in wanted {
        assert!(changed.contains(text) && !plain.contains(text), "{text}");
    }
    for text in ["[cm]", " cm<", "± 0.00 %", "centimetres"] {
        assert!(!changed.contains(text), "{text}");
    }
}

#[test]
fn lengths_that_contradict_each_other_are_relative_and_named() {
    let mut input = input();
    Arc::make_mut(input.cameras.as_mut().unwrap()).scale =
        Scale::Disputed([Length::Mat, Length::Stature]);
    Arc::make_mut(&mut input.girths).unit = shape::Unit::Relative;
    let page = page_of(&HtmlParams::default(), input);
    for text in [
        "Known lengths contradict each other (the mat, the stature)",
        "tape [relative]",
    ] {
        assert!(page.contains(text), "{text}");
    }
    assert!(!page.contains("[cm]") && !page.contains("sets the scale</b>"));
}

#[test]
fn what_an_interval_is_made_of_is_shown_and_what_is_unknown_is_not_called_zero() {
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
    let cameras = Arc::make_mut(input.cameras.as_mut().unwrap());
    (cameras.scale, cameras.scale_sigma) = (Scale::Given, None);
    let changed = page_of(&HtmlParams::default(), input);
    for text in [
        "unknown: level",
        "shortened by 1.5 %",
        "taken at their word; how sure they are: unknown",
    ] {
        assert!(changed.contains(text) && !known.contains(text), "{text}");
    }
}

#[test]
fn inches_are_shown_where_they_are_wanted_and_relative_lengths_stay_relative() {
    let inches = HtmlParams {
        unit: report::ShownIn::Inch,
        ..HtmlParams::default()
    };
    let (in_inches, plain) = (page(&inches), page(&HtmlParams::default()));
    for text in [
        "tape [in]",
        "All in inches",
        "standard deviations [in]",
        "height [in]",
    ] {
        assert!(in_inches.contains(text) && !plain.contains(text), "{text}");
    }
    assert!(!in_inches.contains("[cm]"), "one unit on a page");
    // The WHO's thresholds are in what the reader reads.
    let grown = |params: &HtmlParams| {
        let mut input = input();
        Arc::make_mut(&mut input.girths).stature_mm = Some(1700.0);
        page_of(params, input)
    };
    let (in_inches, plain) = (grown(&inches), grown(&HtmlParams::default()));
    assert!(in_inches.contains("above 37.0 (men), 31.5 (women), substantially above 40.2, 34.6"));
    assert!(plain.contains("above 94.0 (men), 80.0 (women), substantially above 102.0, 88.0"));
    let tape = input().girths.girths[0].tape_mm;
    assert!(in_inches.contains(&format!("{:.1} in", tape / 25.4)));
    let mut input = input();
    Arc::make_mut(&mut input.girths).unit = shape::Unit::Relative;
    let relative = page_of(&inches, input);
    assert!(relative.contains("tape [relative]") && !relative.contains("[in]"));
    assert!(!relative.contains("WHO 2008, adults: risk increased above"));
}

/// What follows each mark in a text, up to what ends it, as a number.
fn numbers(text: &str, mark: &str) -> Vec<f64> {
    let ends = |rest: &str| rest.split(['"', '<', ',']).next()?.parse().ok();
    text.split(mark).skip(1).filter_map(ends).collect()
}

/// Places of an axis' ticks with what is written at them. \[px\]
fn axis(svg: &str, anchor: &str, place: &str) -> Vec<(f64, f64)> {
    let texts = svg.split("<text ").skip(1).filter(|t| t.contains(anchor));
    let one = |text: &str| {
        let label = text.split_once('>')?.1.split('<').next()?;
        Some((*numbers(text, place).first()?, label.parse().ok()?))
    };
    texts.filter_map(one).collect()
}

#[test]
fn axes_of_the_curve_name_what_is_at_them() {
    for (unit, one) in [(report::ShownIn::Cm, 10.0), (report::ShownIn::Inch, 25.4)] {
        for (girth, swing, height) in [
            (437.1, 22.9, 361.0),
            (502.5, 3.1, 40.0),
            (930.0, 160.0, 1120.5),
        ] {
            let mut input = input();
            let girths = Arc::make_mut(&mut input.girths);
            let rows = 0..40;
            girths.profile.height_mm = rows.clone().map(|i| height + 4.6 * f64::from(i)).collect();
            let tape = |i: i32| girth + swing * libm::sin(f64::from(i) / 6.0);
            girths.profile.tape_mm = rows.map(tape).collect();
            girths.girths[0].tape_mm = girth;
            girths.girths[0].plane.point_mm[2] = height + 50.0;
            let params = HtmlParams {
                unit,
                ..HtmlParams::default()
            };
            let page = page_of(&params, input);
            let (_, svg) = page.split_once("<svg class=\"profile\"").unwrap();
            let svg = svg.split("</svg>").next().unwrap();
            for (anchor, place, mark, moved, truth) in [
                ("text-anchor=\"middle\"", "x=\"", "cx=\"", 0.0, girth),
                // A label's line is that much below its tick.
                ("text-anchor=\"end\"", " y=\"", "cy=\"", 4.0, height + 50.0),
            ] {
                let ticks = axis(svg, anchor, place);
                assert!((3..=7).contains(&ticks.len()), "{ticks:?}");
                let (first, last) = (ticks[0], ticks[ticks.len() - 1]);
                let per_px = (last.1 - first.1) / (last.0 - first.0);
                let read = |px: f64| first.1 + (px - first.0) * per_px;
                for (px, label) in &ticks {
                    assert!((read(*px) - label).abs() < 0.1 * per_px.abs(), "{ticks:?}");
                }
                let at = numbers(svg, mark)[0] + moved;
                let off = read(at) - truth / one;
                assert!(
                    off.abs() < 0.2 * per_px.abs(),
                    "{off} of {}: {ticks:?}",
                    truth / one
                );
            }
        }
    }
}

/// The page of somebody.
fn page_for(of: impl Fn(&mut Girths)) -> String {
    let mut input = input();
    let girths = Arc::make_mut(&mut input.girths);
    (girths.stature_mm, girths.bmi) = (Some(1440.0), Some(17.9));
    of(girths);
    page_of(&HtmlParams::default(), input)
}

#[test]
fn a_child_is_compared_with_the_growth_reference_and_no_threshold_of_adults() {
    let score = |z, centile| Some(Score { z, centile });
    let shown = page_for(|g| {
        (g.sex, g.age_months) = (Some(Sex::Male), Some(114.6));
        g.growth = Some(Growth {
            bmi: score(0.784, 78.34),
            height: score(-3.5, 0.02),
        });
    });
    let bmi = "WHO 2007, boys of 9 years 6 months: centile 78.3; z is";
    let height =
        "WHO 2007, boys of 9 years 6 months: below the centile 0.1, by the stature that was given";
    for text in ["z +0.78", "z -3.50", bmi, height, "Numbers, no diagnosis."] {
        assert!(shown.contains(text), "{text}");
    }
    for adult in ["overweight", "risk increased", "obese"] {
        assert!(!shown.contains(adult), "{adult}");
    }
    // A child of whom nothing else is known is no adult either.
    let young = page_for(|g| g.age_months = Some(40.0));
    assert!(!young.contains("overweight") && !young.contains("risk increased"));
    let unknown = page_for(|_| ());
    assert!(unknown.contains("overweight") && !unknown.contains("WHO 2007"));
    // Nor is a figure, or whoever is as short as small children, unless the age is a grown person's.
    let figure = |age_months| {
        page_for(|g| {
            (g.stature_mm, g.age_months) = (Some(812.0), age_months);
            g.ratios = vec![("WHtR".into(), 0.537, "".into())];
        })
    };
    let unsaid = figure(None);
    for adult in ["overweight", "risk increased", "obese", "bound: 0.5"] {
        assert!(!unsaid.contains(adult), "{adult}");
    }
    assert!(unsaid.contains("Give the age to see them"));
    let short = figure(Some(400.0));
    assert!(short.contains("overweight") && short.contains("risk increased"));
    assert!(!short.contains("Give the age"));
}

#[test]
fn an_adult_of_known_sex_has_the_pair_of_thresholds_that_is_meant() {
    let man = page_for(|g| g.sex = Some(Sex::Male));
    assert!(man.contains("WHO 2008, men: risk increased above 94.0, substantially above 102.0"));
    let woman = page_for(|g| (g.sex, g.age_months) = (Some(Sex::Female), Some(400.0)));
    assert!(woman.contains("WHO 2008, women: risk increased above 80.0, substantially above 88.0"));
    assert!(!woman.contains("(men)") && !man.contains("(women)"));
}
