//! The report without its scripts: on paper (PDF), and in browsers that have none or no 3D.

use crate::chromium;
use crate::tube;

use chromium::Tab;
use report::{Html, HtmlInput, HtmlParams};
use serde_json::json;
use stage::{Ctx, Stage};
use std::sync::Arc;

const DESK: [u32; 2] = [1280, 900];

fn page(input: HtmlInput) -> String {
    let document = Html::run(&HtmlParams::default(), input, &Ctx::alone()).unwrap();
    String::from_utf8(document.bytes).unwrap()
}

/// Whether something is seen.
fn shown(tab: &mut Tab, selector: &str) -> bool {
    let visible = format!("document.querySelector({selector:?}).checkVisibility()");
    tab.value(&visible) == true
}

/// Pixels of body and of tape on the pictures that the page brings along.
fn drawn(tab: &mut Tab) -> [u64; 2] {
    let counts = tab.value(
        "(async () => { let body = 0; for (const i of document.querySelectorAll('.sides image')) {
           const p = new Image(); p.src = i.getAttribute('href'); await p.decode();
           const c = document.createElement('canvas'); c.width = p.width; c.height = p.height;
           const x = c.getContext('2d'); x.drawImage(p, 0, 0); const d = x.getImageData(0, 0, c.width, c.height).data;
           for (let k = 0; k < d.length; k += 4) if (d[k] < 230) body++; }
         const tapes = [...document.querySelectorAll('.sides .band')].filter((e) => e.getTotalLength() > 50).length;
         return [body, tapes]; })()",
    );
    [0, 1].map(|i| counts[i].as_u64().unwrap())
}

#[test]
#[cfg_attr(not(chromium), ignore = "no Chromium is installed")]
fn on_paper_the_body_is_a_picture_with_its_tapes_in_black_on_white() {
    let mut tab = Tab::open(&page(tube::input()), DESK, false, true);
    assert!(!shown(&mut tab, ".sides") && shown(&mut tab, "#view"));
    let media = json!({ "media": "print", "features": [{ "name": "prefers-color-scheme", "value": "dark" }] });
    tab.ask("Emulation.setEmulatedMedia", media);
    assert!(shown(&mut tab, ".sides") && shown(&mut tab, "#girths"));
    for hidden in ["#view", "#pick", ".bar", "#big"] {
        assert!(!shown(&mut tab, hidden), "{hidden}");
    }
    let [body, tapes] = drawn(&mut tab);
    // Three sides of a tube of 160 by 400 mm at 1.8 px a millimetre.
    assert!((500_000..700_000).contains(&body), "{body}");
    assert_eq!(tapes, 3, "one tape on three sides");
    let ink = tab.value("getComputedStyle(document.body).color");
    assert_eq!(ink, "rgb(0, 0, 0)");
    let name = tab.value("document.querySelector('.sides text').textContent");
    assert_eq!(name, "WC 50.2");
    let pdf = tab.ask(
        "Page.printToPDF",
        json!({ "printBackground": false, "preferCSSPageSize": true }),
    );
    let pdf = {
        use base64::Engine;
        let engine = base64::engine::general_purpose::STANDARD;
        engine.decode(pdf["data"].as_str().unwrap()).unwrap()
    };
    let count = |word: &[u8]| pdf.windows(word.len()).filter(|w| *w == word).count();
    let pages = count(b"/Type /Page\n");
    assert!((1..=3).contains(&pages), "{pages} pages");
    // Three sides, and three photos that are one picture each.
    assert!(count(b"/Subtype /Image") >= 4, "pictures are in it");
    if let Ok(folder) = std::env::var("TAILOR_KEEP_SHOTS") {
        std::fs::write(format!("{folder}/report.pdf"), &pdf).unwrap();
    }
}

#[test]
#[cfg_attr(not(chromium), ignore = "no Chromium is installed")]
fn without_scripts_or_without_3d_pictures_and_tables_are_there() {
    let mut tab = Tab::empty(DESK, false, false);
    tab.ask(
        "Emulation.setScriptExecutionDisabled",
        json!({ "value": true }),
    );
    let place = tempfile::tempdir().unwrap();
    let file = place.path().join("report.html");
    std::fs::write(&file, page(tube::input())).unwrap();
    tab.go(&format!("file://{}", file.display()));
    for there in [".sides", "noscript p", "#girths", "figure svg"] {
        assert!(shown(&mut tab, there), "{there}");
    }
    for hidden in ["#view", "#pick", "#meshes"] {
        assert!(!shown(&mut tab, hidden), "{hidden}");
    }
    let wide = tab.value("document.documentElement.scrollWidth");
    assert_eq!(wide, DESK[0]);
    // A browser whose 3D went away shows the same pictures.
    let mut tab = Tab::open(
        &page(tube::input()).replace("webgl2", "webgl9"),
        DESK,
        false,
        false,
    );
    assert!(shown(&mut tab, ".sides") && shown(&mut tab, "#no3d") && !shown(&mut tab, "#view"));
    assert!(shown(&mut tab, "#outlines"), "scripts still run");
}

#[test]
#[cfg_attr(not(chromium), ignore = "no Chromium is installed")]
fn names_are_beside_curve_and_body_and_not_on_one_another() {
    let mut input = tube::input();
    let girths = &mut Arc::make_mut(&mut input.girths).girths;
    for k in 1..8 {
        let mut other = girths[0].clone();
        other.name = format!("G{k}");
        other.label = format!("girth {k}");
        other.plane.point_mm[2] += 2.0 * f64::from(k);
        other
            .contour
            .iter_mut()
            .for_each(|p| p[2] += 2.0 * k as f32);
        girths.push(other);
    }
    let mut tab = Tab::open(&page(input).replace("webgl2", "webgl9"), DESK, false, false);
    for (drawing, names) in [(".profile", "text.mark"), (".sides", "text")] {
        let wrong = tab.value(&format!(
            "(() => {{ const boxes = [...document.querySelectorAll('{drawing} {names}')].map((e) => [e.textContent, e.getBoundingClientRect()]);
             const curve = [...document.querySelectorAll('{drawing} .curve')].map((e) => e.getBoundingClientRect());
             const on = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom - 1 && b.top < a.bottom - 1;
             const wrong = boxes.filter(([, b]) => curve.some((c) => on(b, c))).map(([t]) => t + ' on the curve');
             boxes.forEach(([t, a], i) => boxes.slice(i + 1).forEach(([u, b]) => {{ if (on(a, b)) wrong.push(`${{t}} on ${{u}}`); }}));
             return [boxes.length, ...wrong]; }})()"
        ));
        assert_eq!(wrong, json!([8]), "{drawing}");
    }
}

#[test]
#[cfg_attr(not(chromium), ignore = "no Chromium is installed")]
fn a_scan_has_a_page_without_photos_and_cameras() {
    let scan = || HtmlInput {
        photos: None,
        masks: None,
        cameras: None,
        ..tube::input()
    };
    let mut tab = Tab::open(&page(scan()), DESK, false, true);
    let heads = tab.value("[...document.querySelectorAll('h2')].map((h) => h.textContent)");
    let heads = heads.to_string();
    assert!(
        heads.contains("Girths") && heads.contains("Girth over height"),
        "{heads}"
    );
    assert!(
        !heads.contains("Cameras") && !heads.contains("photos"),
        "{heads}"
    );
    // The viewer came to its end: its surfaces can be chosen.
    let count = tab.value("document.querySelectorAll('#meshes button').length");
    assert!(count.as_u64().unwrap() > 0);
    let half = HtmlInput {
        masks: None,
        ..tube::input()
    };
    assert!(Html::run(&HtmlParams::default(), half, &Ctx::alone()).is_err());
}
