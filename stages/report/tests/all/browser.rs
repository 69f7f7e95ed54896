//! The report in a real browser: clicks, drags, keys, fingers, sizes, schemes, and no request.
//! Without a Chromium these tests are ignored (touch `build.rs` once one is installed); what the page holds is tested in `page.rs`.

use crate::chromium;
use crate::tube;

use chromium::Tab;
use report::{Html, HtmlInput, HtmlParams};
use serde_json::Value;
use stage::{Ctx, Stage};
use std::sync::Arc;

const DESK: [u32; 2] = [1280, 900];
const PHONE: [u32; 2] = [390, 844];

fn page() -> String {
    page_of(tube::input())
}

fn page_of(input: HtmlInput) -> String {
    let document = Html::run(&HtmlParams::default(), input, &Ctx::alone()).unwrap();
    String::from_utf8(document.bytes).unwrap()
}

/// How many pixels of the 3D view are not background, are yellow tape, are red tape; and a sum of all.
fn seen(tab: &mut Tab) -> [u64; 4] {
    let counts = tab.value(
        "(() => { const c = document.getElementById('view'), gl = c.getContext('webgl2');
         const p = new Uint8Array(4 * c.width * c.height);
         gl.readPixels(0, 0, c.width, c.height, gl.RGBA, gl.UNSIGNED_BYTE, p);
         let body = 0, yellow = 0, red = 0, sum = 0;
         for (let i = 0; i < p.length; i += 4) {
           const [r, g, b] = [p[i], p[i + 1], p[i + 2]];
           if (r !== p[0] || g !== p[1] || b !== p[2]) { body++; sum = (sum + r * i) % 1000003; }
           if (r > 1.8 * b && g > 1.4 * b) yellow++;
           if (r > 2 * g && r > 2 * b) red++;
         }
         return [body, yellow, red, sum]; })()",
    );
    [0, 1, 2, 3].map(|i| counts[i].as_u64().unwrap())
}

#[test]
#[cfg_attr(not(chromium), ignore = "no Chromium is installed")]
fn a_click_marks_a_tape_and_hands_turn_and_zoom_the_body() {
    let mut tab = Tab::open(&page(), DESK, false, false);
    let [body, yellow, red, first] = seen(&mut tab);
    assert!(body > 10_000, "a body is drawn: {body}");
    assert!(
        yellow > 300 && red == 0,
        "a tape is drawn, unmarked: {yellow}, {red}"
    );

    tab.click("#girths tbody tr");
    let [_, _, red, _] = seen(&mut tab);
    assert!(red > 300, "the marked tape is red: {red}");
    let shown = tab.value("document.getElementById('said').textContent");
    assert_eq!(shown, "waist <natural> 50.2 cm");
    let place = tab.value("document.getElementById('where').textContent");
    assert_eq!(place, "horizontal, at the \"natural\" waist");
    let marked = tab.value("document.querySelectorAll('figure .tape.on').length");
    assert_eq!(marked, 6, "on three photos, before and behind");
    tab.click("#girths tbody tr");
    assert_eq!(seen(&mut tab), [body, yellow, 0, first], "as before");

    tab.drag("#view", [0.0, 120.0]);
    let [_, _, _, tilted] = seen(&mut tab);
    assert_ne!(tilted, first, "a drag turns the body");
    tab.click("#front");
    assert_eq!(seen(&mut tab)[3], first, "front is front again");

    tab.wheel("#view", -400.0);
    let [nearer, ..] = seen(&mut tab);
    assert!(
        nearer > body + body / 4,
        "the wheel brings it closer: {body} {nearer}"
    );
    tab.value("document.getElementById('view').focus()");
    tab.key("0");
    assert_eq!(seen(&mut tab)[3], first, "0 is home");
    tab.key("ArrowUp");
    assert_ne!(seen(&mut tab)[3], first, "keys turn");
    tab.key("0");
    tab.key("t");
    assert_eq!(seen(&mut tab)[1], 0, "t takes the tapes off");
    tab.key("t");

    tab.click("#meshes button:nth-child(3)");
    let label =
        tab.value("document.querySelector('#meshes button[aria-pressed=true]').textContent");
    assert_eq!(label, "visual hull");
    let [wider, ..] = seen(&mut tab);
    assert!(wider > body, "the hull is wider: {body} {wider}");
    tab.value("document.getElementById('view').focus()");
    tab.key("1");
    assert_eq!(seen(&mut tab)[3], first, "1 is the first surface");
}

#[test]
#[cfg_attr(not(chromium), ignore = "no Chromium is installed")]
fn clicks_pick_points_on_the_body_for_a_line_to_paste() {
    let mut tab = Tab::open(&page(), DESK, false, false);
    let line = "document.getElementById('points').value";
    tab.click("#view");
    tab.click("#pick");
    assert_eq!(tab.value(line), "", "nothing is picked unless asked for");
    for _ in 0..4 {
        tab.click("#view");
        tab.value("document.getElementById('view').focus()");
        (0..15).for_each(|_| tab.key("ArrowRight"));
    }
    tab.drag("#view", [60.0, 0.0]);
    let text = tab.value(line);
    let text = text.as_str().unwrap();
    let points = text.strip_prefix("--set 'girths.points=").unwrap();
    let points_text = text;
    let points: Vec<[f64; 3]> = serde_json::from_str(points.strip_suffix('\'').unwrap()).unwrap();
    assert_eq!(points.len(), 4, "a drag turns and picks nothing: {text}");
    for p in &points {
        let radius = libm::hypot(p[0], p[1]);
        assert!((79.0..=80.2).contains(&radius), "on the tube: {p:?}");
        assert!((p[2] - points[0][2]).abs() < 1.0, "at one height: {text}");
    }
    let apart = libm::hypot(points[0][0] - points[2][0], points[0][1] - points[2][1]);
    assert!(apart > 60.0, "from different sides: {text}");
    // The girth of a tube with 48 corners, by tape, contour and spline, as it is picked.
    let line_picked = "document.getElementById('picked').textContent";
    let all = tab.value(line_picked);
    assert_eq!(all, "4 points: tape 50.2, contour 50.2, spline 50.2 cm");
    let [_, _, _, with] = seen(&mut tab);
    tab.click("#unpick");
    let three = tab.value(line_picked);
    assert_eq!(three, "3 points: tape 50.2, contour 50.2, spline 50.2 cm");
    tab.click("#unpick");
    assert_ne!(seen(&mut tab)[3], with, "the tape through them was drawn");
    assert_eq!(tab.value(line_picked), "2 of at least 3 points");
    assert_eq!(tab.value(line), "");
    // A line of before is put in; points on a line, or far away, are refused.
    let put = |tab: &mut Tab, text: &str| {
        tab.value(&format!(
            "(() => {{ const e = document.getElementById('points'); e.value = {text:?}; e.dispatchEvent(new Event('input')); }})()"
        ));
        tab.value(line_picked)
    };
    assert_eq!(put(&mut tab, points_text), all);
    let straight = put(&mut tab, "[[0, 0, 1], [0, 0, 2], [0, 0, 3]]");
    assert_eq!(
        straight,
        "these points lie on one line: pick around the body"
    );
    let away = put(&mut tab, "[[900, 0, 1], [900, 90, 2], [990, 0, 3]]");
    assert!(
        away.as_str()
            .unwrap()
            .contains("meets no closed section near them"),
        "{away}"
    );
}

#[test]
#[cfg_attr(not(chromium), ignore = "no Chromium is installed")]
fn without_webgl_the_rest_of_the_page_works() {
    let mut tab = Tab::open(&page().replace("webgl2", "webgl9"), DESK, false, false);
    let shown = tab.value("document.getElementById('no3d').checkVisibility()");
    assert_eq!(shown, true);
    tab.click("#girths tbody tr");
    let marked = "document.querySelectorAll('figure .tape.on').length";
    assert_eq!(tab.value(marked), 6);
    tab.click("figure[data-photo='1']");
    assert_eq!(tab.value("document.getElementById('big').open"), true);
}

#[test]
#[cfg_attr(not(chromium), ignore = "no Chromium is installed")]
fn a_photo_enlarges_and_turns_the_view_to_its_camera() {
    let mut tab = Tab::open(&page(), DESK, false, false);
    let first = seen(&mut tab)[3];
    tab.click("figure[data-photo='1']");
    let shown =
        "document.getElementById('big').open && document.getElementById('which').textContent";
    assert_eq!(tab.value(shown), "0001.jpg");
    let tall = tab.value("document.querySelector('#bigger svg').getBoundingClientRect().height");
    assert!(tall.as_f64().unwrap() > 400.0, "{tall}");
    let camera = tab.value("document.querySelector('.cam.on').dataset.photo");
    assert_eq!(camera, "1");
    assert_ne!(seen(&mut tab)[3], first);
    tab.click("#after");
    assert_eq!(tab.value(shown), "0002.jpg");
    tab.key("ArrowRight");
    assert_eq!(tab.value(shown), "0000.jpg");
    tab.click("#close");
    assert_eq!(tab.value("document.getElementById('big').open"), false);
    let drawn = "getComputedStyle(document.querySelector('figure .outline')).display";
    assert_eq!(tab.value(drawn), "inline");
    tab.click("#outlines");
    assert_eq!(tab.value(drawn), "none");
}

#[test]
#[cfg_attr(not(chromium), ignore = "no Chromium is installed")]
fn it_fits_a_phone_and_a_desk_light_and_dark_and_asks_for_nothing() {
    let mut input = tube::input();
    let girths = &mut Arc::make_mut(&mut input.girths).girths;
    let mut long = girths[0].clone();
    long.name = "WC_hip_bone".into();
    long.label = "waist at the hip bone".into();
    long.definition = "at the hip bone (ISO 8559-1 5.3.16)".into();
    for mm in [&mut long.tape_mm, &mut long.contour_mm, &mut long.spline_mm] {
        *mm = 1119.0;
    }
    (long.silhouette_mm, long.interval_mm) = (Some(1116.6), Some([1108.2, 1125.2]));
    girths.push(long);
    let mut tab = Tab::open(&page_of(input), DESK, false, true);
    for (name, size, phone, dark) in [
        ("small-phone", [360, 740], true, false),
        ("narrow", [900, 900], false, false),
        ("tablet", [1024, 768], false, false),
        ("notebook", [1200, 800], false, true),
        ("phone", PHONE, true, false),
        ("phone-dark", PHONE, true, true),
        ("desk", DESK, false, false),
        ("desk-dark", DESK, false, true),
    ] {
        tab.window(size, phone, dark);
        let wide = tab.value("[document.documentElement.scrollWidth, innerWidth]");
        assert_eq!(
            wide[0], size[0],
            "{name} needs no scrolling sideways: {wide}"
        );
        assert_eq!(wide[1], size[0]);
        let cut = tab.value(
            "[...document.querySelectorAll('section')].filter((e) => e.scrollWidth > e.clientWidth)
             .map((e) => e.textContent.slice(0, 20)).join()",
        );
        assert_eq!(cut, "", "{name}: no card needs scrolling sideways");
        let shot = tab.screenshot();
        if let Ok(folder) = std::env::var("TAILOR_KEEP_SHOTS") {
            std::fs::write(format!("{folder}/{name}.png.base64"), &shot).unwrap();
        }
        let bright = brightness(&mut tab, &shot);
        assert_eq!(bright < 0.3, dark, "{name}: {bright}");
        assert_eq!(bright > 0.7, !dark, "{name}: {bright}");
        if phone {
            let [body, ..] = seen(&mut tab);
            tab.pinch("#view", 60.0, 160.0);
            let [nearer, ..] = seen(&mut tab);
            assert!(nearer > body + body / 4, "fingers zoom: {body} {nearer}");
            tab.click("#front");
        }
    }
    tab.value("fetch('https://example.org/').catch(() => 0)");
    quiet(&tab.events);
}

/// Mean brightness of a screenshot, 0..=1, computed by the browser itself.
fn brightness(tab: &mut Tab, shot: &str) -> f64 {
    let mean = tab.value(&format!(
        "(async () => {{ const i = new Image(); i.src = 'data:image/png;base64,{shot}'; await i.decode();
         const c = document.createElement('canvas'); c.width = i.width; c.height = i.height;
         const x = c.getContext('2d'); x.drawImage(i, 0, 0);
         const p = x.getImageData(0, 0, c.width, c.height).data;
         let s = 0; for (let k = 0; k < p.length; k += 4) s += p[k] + p[k + 1] + p[k + 2];
         return s / (p.length / 4) / 765; }})()"
    ));
    mean.as_f64().unwrap()
}

/// Nothing was asked for but the page itself, and nothing went wrong in it. The test's own request
/// must be refused by the page's policy.
fn quiet(events: &[Value]) {
    let refused = |e: &&Value| e.to_string().contains("https://example.org/");
    assert!(
        events.iter().any(|e| refused(&e)),
        "the policy refuses requests"
    );
    for event in events.iter().filter(|e| !refused(e)) {
        let (method, params) = (event["method"].as_str().unwrap_or(""), &event["params"]);
        let url = params["request"]["url"].as_str().unwrap_or("");
        if method == "Network.requestWillBeSent" {
            assert!(
                url.starts_with("file:") || url.starts_with("data:"),
                "{url}"
            );
        }
        assert_ne!(method, "Runtime.exceptionThrown", "{event}");
        assert_ne!(params["entry"]["level"], "error", "{event}");
    }
}
