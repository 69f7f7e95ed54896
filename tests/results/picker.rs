//! The girth through picked points: the report's page computes what the program computes, where arm and trunk are one, too.
//! Without a Chromium this is ignored (touch `build.rs` once one is installed).

use super::chromium;
use super::tube;

use chromium::Tab;
use measure::picked;
use report::{Html, HtmlParams};
use serde_json::Value;
use shape::Mesh;
use stage::{Ctx, Stage};
use std::f32::consts::TAU;
use std::sync::Arc;

/// Numbers from 0 to 1 that look random and are the same each time (a linear congruential generator).
struct Dice(u32);

impl Dice {
    fn throw(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(self.0 >> 8) / f64::from(1u32 << 24)
    }
}

/// How far the outline of a trunk with an arm in it is from the trunk's middle. \[mm\]
fn outline(turn: f32, up: f32) -> f32 {
    let (s, c) = libm::sincosf(turn);
    let trunk = 120.0 + 0.06 * up;
    let trunk = trunk / libm::hypotf(c, s * 1.4);
    // A circle beside it: the far crossing of the ray.
    let (beside, thick) = (125.0, 42.0);
    let (along, off) = (beside * c, beside * s);
    let inside = thick * thick - off * off;
    match inside > 0.0 && along > 0.0 {
        true => trunk.max(along + inside.sqrt()),
        false => trunk,
    }
}

/// A trunk and an arm that are one, each vertex a little beside its place, as surfaces from photos have them.
fn fused(dice: &mut Dice) -> Mesh {
    let mut mesh = tube::tube(1.0, 500.0, 150, 90);
    for (i, p) in mesh.positions.iter_mut().enumerate() {
        let turn = (i % 150) as f32 / 150.0 * TAU;
        let radius = outline(turn, p[2]) + 1.5 * (dice.throw() as f32 - 0.5);
        *p = [
            p[0] * radius,
            p[1] * radius,
            p[2] + 2.0 * (dice.throw() as f32 - 0.5),
        ];
    }
    mesh
}

/// Seven points picked around the body by an unsteady hand, to a tenth of a millimetre as the page has them.
fn around(dice: &mut Dice) -> Vec<Vec<f64>> {
    let level = 120.0 + 260.0 * dice.throw();
    let tilt = [0.4 * (dice.throw() - 0.5), 0.4 * (dice.throw() - 0.5)];
    let point = |i: usize| {
        let turn = (i as f64 + 0.5 * dice.throw()) / 7.0 * f64::from(TAU);
        let radius = f64::from(outline(turn as f32, level as f32));
        let (s, c) = libm::sincos(turn);
        let [x, y] = [radius * c, radius * s];
        let z = level + tilt[0] * x + tilt[1] * y + 2.0 * (dice.throw() - 0.5);
        [x, y, z].map(|x| (10.0 * x).round() / 10.0).to_vec()
    };
    (0..7).map(point).collect()
}

#[test]
#[cfg_attr(not(chromium), ignore = "no Chromium is installed")]
fn the_page_computes_the_programs_girth_where_arm_and_trunk_are_one() {
    let mut dice = Dice(7);
    let mesh = fused(&mut dice);
    let mut input = tube::input();
    input.body = Arc::new(mesh.clone());
    let html = Html::run(&HtmlParams::default(), input, &Ctx::alone()).unwrap();
    let html = String::from_utf8(html.bytes).unwrap();
    let mut tab = Tab::open(&html, [1280, 900], false, false);
    tab.click("#pick");
    let mut rounded = mesh.clone();
    let round = |x: &mut f32| *x = (*x * 10.0).round() / 10.0;
    rounded
        .positions
        .as_flattened_mut()
        .iter_mut()
        .for_each(round);
    let mut moved = 0.0_f64;
    for _ in 0..12 {
        let points = around(&mut dice);
        let own = picked(&mesh, &points).unwrap();
        moved = moved.max((picked(&rounded, &points).unwrap().tape_mm - own.tape_mm).abs());
        let text = serde_json::to_string(&points).unwrap();
        tab.value(&format!(
            "(() => {{ const e = document.getElementById('points'); e.value = {text:?}; e.dispatchEvent(new Event('input')); }})()"
        ));
        let dataset = tab.value("({ ...document.getElementById('picked').dataset })");
        let on_page_mm = |key: &str| dataset[key].as_str().and_then(|t| t.parse::<f64>().ok());
        for (key, mm) in [
            ("tape", own.tape_mm),
            ("contour", own.contour_mm),
            ("spline", own.spline_mm),
        ] {
            let on_page = on_page_mm(key).unwrap_or(f64::NAN);
            assert!(
                (on_page - mm).abs() < 0.01,
                "{key} {on_page}, not {mm}: {text}"
            );
        }
    }
    assert!(
        moved > 0.1,
        "a body whose rounding to 0.1 mm moves no girth shows nothing: {moved}"
    );
}

#[test]
#[cfg_attr(not(chromium), ignore = "no Chromium is installed")]
fn a_page_with_a_coarser_surface_computes_no_girth_of_it() {
    let params = HtmlParams {
        most_faces: 2000,
        ..HtmlParams::default()
    };
    let mut input = tube::input();
    input.body = Arc::new(fused(&mut Dice(7)));
    let html = Html::run(&params, input, &Ctx::alone()).unwrap();
    let html = String::from_utf8(html.bytes).unwrap();
    let mut tab = Tab::open(&html, [1280, 900], false, false);
    tab.click("#pick");
    tab.value(
        "(() => { const e = document.getElementById('points'); e.value = '[[120, 0, 200], [0, 85, 200], [-120, 0, 200]]'; \
         e.dispatchEvent(new Event('input')); })()",
    );
    let picked: Value = tab.value("document.getElementById('picked').textContent");
    assert!(
        picked.as_str().unwrap().contains("coarser surface"),
        "{picked}"
    );
}
