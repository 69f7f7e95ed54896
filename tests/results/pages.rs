//! The pages of `sweep` and `compare` in a real browser: what is drawn, what hands do, no request.
//! Without a Chromium these tests are ignored (touch `build.rs` once one is installed); what the pages hold is tested beside the verbs.

use super::chromium::Tab;
use nalgebra::{Rotation3, Vector3};
use shape::{Camera, Intrinsics, Mask, Mesh, Pose};
use stage::{Metric, Value};
use tables::Behind;
use tailor::compare::{Side, TechnicalErrors, View, Views, compare};
use tailor::sweep::{End, Point, Row};

const DESK: [u32; 2] = [1280, 900];

/// A box, finely divided, with its middle in the origin. \[mm\]
fn block(half: [f32; 3]) -> Mesh {
    let n = 12u32;
    let mut mesh = Mesh::default();
    for side in 0..6u32 {
        let (axis, sign) = ((side / 2) as usize, if side % 2 == 0 { -1.0 } else { 1.0 });
        let first = mesh.positions.len() as u32;
        for (i, j) in (0..=n).flat_map(|i| (0..=n).map(move |j| (i, j))) {
            let mut p = [0.0; 3];
            p[axis] = sign * half[axis];
            for (k, at) in [(1, i), (2, j)] {
                let other = (axis + k) % 3;
                p[other] = half[other] * (2.0 * at as f32 / n as f32 - 1.0);
            }
            mesh.positions.push(p);
        }
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let at = |i: u32, j: u32| first + i * (n + 1) + j;
            let (a, b, c, d) = (at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
            let faces = [[a, b, c], [a, c, d]];
            let turned = |[a, b, c]: [u32; 3]| if sign > 0.0 { [a, b, c] } else { [a, c, b] };
            mesh.faces.extend(faces.map(turned));
        }
    }
    mesh
}

fn side(name: &str, half: [f32; 3]) -> Side {
    Side {
        name: name.into(),
        nodes: vec![],
        unit: None,
        girths: vec![],
        mesh: Some(block(half)),
        views: Default::default(),
    }
}

/// How many pixels of the view are not background, orange, blue; and a sum of all.
fn seen(tab: &mut Tab) -> [u64; 4] {
    tab.drawn();
    let counts = tab.value(
        "(() => { const c = document.getElementById('view'), gl = c.getContext('webgl2');
         const p = new Uint8Array(4 * c.width * c.height);
         gl.readPixels(0, 0, c.width, c.height, gl.RGBA, gl.UNSIGNED_BYTE, p);
         let body = 0, orange = 0, blue = 0, sum = 0;
         for (let i = 0; i < p.length; i += 4) {
           const [r, g, b] = [p[i], p[i + 1], p[i + 2]];
           if (r !== p[0] || g !== p[1] || b !== p[2]) { body++; sum = (sum + r * i) % 1000003; }
           if (r > 2 * b) orange++; if (b > 2 * r) blue++;
         }
         return [body, orange, blue, sum]; })()",
    );
    [0, 1, 2, 3].map(|i| counts[i].as_u64().unwrap())
}

fn set(tab: &mut Tab, id: &str, value: &str) {
    tab.value(&format!(
        "(() => {{ const e = document.getElementById('{id}'); e.value = '{value}'; e.dispatchEvent(new Event('input')); }})()"
    ));
    tab.drawn();
}

/// Nothing was asked of the network, and nothing was thrown.
fn kept_to_itself(tab: &Tab) {
    for event in &tab.events {
        let (method, params) = (event["method"].as_str().unwrap_or(""), &event["params"]);
        let url = params["request"]["url"].as_str().unwrap_or("file:");
        assert!(
            url.starts_with("file:") || url.starts_with("data:"),
            "{url}"
        );
        assert_ne!(method, "Runtime.exceptionThrown", "{event}");
    }
}

#[test]
#[cfg_attr(not(chromium), ignore = "no Chromium is installed")]
fn surfaces_are_coloured_by_distance_split_by_the_slider_and_turned_together() {
    let sides = vec![
        side("small", [40.0, 40.0, 90.0]),
        side("large", [44.0, 44.0, 94.0]),
    ];
    let page = tailor::compare::page(&compare(sides, None, &TechnicalErrors::new()), true);
    let mut tab = Tab::open(&page, DESK, false, false);
    let [body, orange, blue, first] = seen(&mut tab);
    assert!(body > 10_000, "two halves are drawn: {body}");
    assert!(
        orange > 3000 && blue > 3000,
        "large outside, small inside: {orange}, {blue}"
    );
    set(&mut tab, "split", "0");
    let [_, all, none, _] = seen(&mut tab);
    assert!(
        all > orange * 3 / 2 && none == 0,
        "only the right one: {all}, {none}"
    );
    set(&mut tab, "split", "1");
    let [_, none, all, _] = seen(&mut tab);
    assert!(
        all > blue * 3 / 2 && none == 0,
        "only the left one: {none}, {all}"
    );
    tab.click("[data-mode=beside]");
    let [_, orange, blue, _] = seen(&mut tab);
    assert!(orange > 3000 && blue > 3000, "both: {orange}, {blue}");
    tab.click("[data-mode=wipe]");
    set(&mut tab, "split", "0.5");
    assert_eq!(seen(&mut tab)[3], first, "as before");
    tab.click("#colored");
    let [_, orange, blue, _] = seen(&mut tab);
    assert_eq!([orange, blue], [0, 0], "plain");
    tab.click("#colored");
    tab.drag("#view", [150.0, 0.0]);
    assert_ne!(seen(&mut tab)[3], first, "turned");
    tab.click("#front");
    assert_eq!(seen(&mut tab)[3], first, "back in front");
    set(&mut tab, "full", "20");
    let [_, orange, blue, _] = seen(&mut tab);
    assert_eq!([orange, blue], [0, 0], "4 of 20 mm is pale");
    kept_to_itself(&tab);
}

/// What a camera before the block saw of it: a silhouette so many pixels wide, on no photo.
fn seen_by(names: &[&str], wide: usize) -> Views {
    let mut mask = Mask::filled(200, 300, 0);
    for y in 100..200 {
        (60..60 + wide).for_each(|x| *mask.at_mut(x, y) = 255);
    }
    let down = Rotation3::from_euler_angles(-std::f64::consts::FRAC_PI_2, 0.0, 0.0);
    let camera = Camera {
        lens: Intrinsics::simple(200, 300, 400.0),
        pose: Pose {
            rotation: down,
            translation: Vector3::new(0.0, 0.0, 500.0),
        },
    };
    let view = |name: &&str| {
        let (mask, camera) = (Some(mask.clone()), Some(camera));
        let photo = None;
        (
            name.to_string(),
            View {
                photo,
                mask,
                camera,
            },
        )
    };
    names.iter().map(view).collect()
}

#[test]
#[cfg_attr(not(chromium), ignore = "no Chromium is installed")]
fn silhouettes_and_surfaces_are_side_by_side_photo_by_photo() {
    let mut sides = vec![
        side("small", [40.0, 40.0, 90.0]),
        side("large", [44.0, 44.0, 94.0]),
    ];
    sides[0].views = seen_by(&["0000", "0001"], 60);
    sides[1].views = seen_by(&["0000"], 80);
    let page = tailor::compare::page(&compare(sides, None, &TechnicalErrors::new()), true);
    let mut tab = Tab::open(&page, DESK, false, false);
    let words = |tab: &mut Tab| {
        let all = "[...document.querySelectorAll('#pictures figcaption')].map((c) => c.textContent).join('; ')";
        tab.value(all).as_str().unwrap().to_owned()
    };
    let images = "[...document.querySelectorAll('#pictures img')].filter((i) => i.complete && i.naturalWidth === 300).length";
    assert_eq!(
        words(&mut tab),
        "small: silhouette; large: silhouette; large against small: 75.000 % shared; \
         small: surface; large: surface; large against small: distance"
    );
    tab.value(
        "Promise.all([...document.querySelectorAll('#pictures img')].map((i) => i.decode()))",
    );
    assert_eq!(tab.value(images), 6);
    // Orange where the larger block is seen, on the last picture.
    let orange = tab.value(
        "(() => { const i = [...document.querySelectorAll('#pictures img')].pop(), c = document.createElement('canvas');
         c.width = i.naturalWidth; c.height = i.naturalHeight; const x = c.getContext('2d'); x.drawImage(i, 0, 0);
         const p = x.getImageData(0, 0, c.width, c.height).data; let n = 0;
         for (let k = 0; k < p.length; k += 4) if (p[k] > 2 * p[k + 2]) n++; return n; })()",
    );
    assert!(orange.as_u64().unwrap() > 3000, "{orange}");
    tab.click("#after");
    assert!(
        words(&mut tab).contains("large: silhouette: none"),
        "the large one has no second photo"
    );
    tab.click("#after");
    assert!(words(&mut tab).contains("75.000 % shared"), "round again");
    kept_to_itself(&tab);
}

fn row(voxel: f64, method: &str, waist: Option<f64>) -> Row {
    let metric = |value| Metric {
        name: "WC".into(),
        value,
        unit: "cm".into(),
    };
    Row {
        point: Point {
            variant: Some(method.into()),
            values: vec![("hull".into(), "voxel_mm".into(), Value::Float(voxel))],
            ..Point::default()
        },
        end: match waist {
            Some(_) => End::Done,
            None => End::Failed("hull".into(), "<too> fine".into()),
        },
        metrics: [("girths.WC", waist), ("girths.count", waist.map(|_| 17.0))]
            .map(|(name, x)| (name.to_owned(), x.map(metric)))
            .into(),
        within: vec![],
        known: vec![],
        results: vec![],
        made: 1,
        found: 0,
        seconds: 1.0,
        alone: 2.0,
        work: 1.0,
        engine: 0.1,
    }
}

#[test]
#[cfg_attr(not(chromium), ignore = "no Chromium is installed")]
fn a_sweep_is_plotted_lights_up_and_sorts() {
    let rows = [
        row(2.0, "rigid", Some(80.0)),
        row(3.0, "rigid", Some(79.5)),
        row(2.0, "median", Some(80.4)),
        row(3.0, "median", Some(81.0)),
        row(1.0, "median", None),
    ];
    let page = tables::page("s", "Fine?", &rows, &|_, _| vec![], &|_| Behind::default());
    let page = page.page;
    let mut tab = Tab::open(&page, DESK, false, false);
    let count = |tab: &mut Tab, selector: &str| {
        let count = tab.value(&format!("document.querySelectorAll({selector:?}).length"));
        count.as_u64().unwrap()
    };
    assert_eq!(
        count(&mut tab, "figure"),
        2,
        "over the variant and over the cells"
    );
    assert_eq!(count(&mut tab, "figure circle"), 8, "four points in each");
    assert_eq!(count(&mut tab, "#parallel polyline"), 4);
    tab.value("document.querySelector('tr[data-row=\"2\"]').dispatchEvent(new MouseEvent('mouseover', { bubbles: true }))");
    assert_eq!(count(&mut tab, "tr.on"), 1);
    assert_eq!(count(&mut tab, "circle[r=\"6\"]"), 2);
    let first = "document.querySelector('#points tbody tr').dataset.row";
    assert_eq!(tab.value(first), "0");
    tab.click("#points th:nth-child(3)");
    tab.click("#points th:nth-child(3)");
    assert_eq!(tab.value(first), "3", "the widest waist on top");
    let words = |tab: &mut Tab, selector: &str| {
        let text = tab.value(&format!("document.querySelector({selector:?}).textContent"));
        text.as_str().unwrap().to_owned()
    };
    let figure = words(&mut tab, "figure:nth-child(2)");
    for label in ["girths.WC [cm]", "over hull.voxel_mm", "variant = rigid"] {
        assert!(figure.contains(label), "{label}: {figure}");
    }
    let still = words(&mut tab, "#legend");
    assert!(
        still.contains("not drawn: girths.count [cm] 17."),
        "{still}"
    );
    let cut = tab.value(
        "[...document.querySelectorAll('figure svg')].flatMap((svg) => { const s = svg.getBoundingClientRect();
         return [...svg.querySelectorAll('text')].filter((t) => { const r = t.getBoundingClientRect();
           return r.left < s.left - 1 || r.right > s.right + 1 || r.bottom > s.bottom + 1; }).map((t) => t.textContent); })",
    );
    assert_eq!(cut, serde_json::json!([]), "no tick is cut off");
    let trouble = tab.value("document.querySelector('tr[data-row=\"4\"]').textContent");
    assert!(
        trouble
            .as_str()
            .unwrap()
            .contains("hull failed: <too> fine"),
        "{trouble}"
    );
    kept_to_itself(&tab);
}
