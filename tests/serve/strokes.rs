//! Strokes of the brush while photos are changed, and long names in the table, in a real browser.

use super::server::{Server, photos};
use super::whole::{complaints, tab, whole};
use serde_json::{Value, json};

/// A capture of two photos with outlines, as a measuring leaves them.
fn outlined(server: &Server) -> String {
    let id = server.capture("anna");
    let masks = server.path(&format!("captures/captures/{id}/out/masks"));
    std::fs::create_dir_all(&masks).unwrap();
    for number in 1..=2 {
        let photo = std::fs::read(&photos()[number as usize]).unwrap();
        let name = format!("IMG_{number}.jpg");
        server.send(&id, number, &name, &photo).is(200);
        let middle = |x: u32| if (200..600).contains(&x) { 255 } else { 0 };
        let mask = image::GrayImage::from_fn(800, 1200, |x, _| image::Luma([middle(x)]));
        mask.save(masks.join(format!("{number:04}.png"))).unwrap();
    }
    id
}

#[test]
fn strokes_stay_when_another_photo_is_chosen_until_they_are_kept() {
    let server = Server::new();
    let id = outlined(&server);
    let mut tab = tab("en");
    tab.go(&server.url());
    tab.go(&format!("{}/captures/{id}/masks", server.origin()));
    let strokes = |count: u32, photo: u32| {
        format!(
            "(() => {{ const d = document.querySelector('#brush canvas').dataset; return d.strokes === '{count}' && d.photo === '{photo}'; }})()"
        )
    };
    let choose = |photo: u32| {
        format!(
            "(() => {{ const s = document.querySelector('[name=photo]'); s.value = '{photo}'; s.dispatchEvent(new Event('change')); }})()"
        )
    };
    let leaves = "(() => { const e = new Event('beforeunload', { cancelable: true }); dispatchEvent(e); return !e.defaultPrevented; })()";
    tab.until(&strokes(0, 1));
    assert_eq!(tab.value(leaves), true);
    tab.click("input[value=room]");
    tab.click("#brush canvas");
    tab.until(&strokes(1, 1));
    tab.value(&choose(2));
    tab.until(&strokes(0, 2));
    let status = tab.value("document.querySelector('#brush [role=status]').textContent");
    assert_eq!(status, "Not kept yet: 1: IMG_1.jpg");
    assert_eq!(tab.value(leaves), false, "strokes would be lost");
    whole(&mut tab, "strokes");
    // Back at the first, its stroke is there, can be undone, and is kept alone.
    tab.click("#brush canvas");
    tab.until(&strokes(1, 2));
    tab.value(&choose(1));
    tab.until(&strokes(1, 1));
    tab.click("#brush canvas");
    tab.until(&strokes(2, 1));
    tab.click("button[name=undo]");
    tab.until(&strokes(1, 1));
    let mask = |number: u32| {
        let path = format!("/api/captures/{id}/masks/{number}");
        let png = server.ask("GET", &path, &Value::Null).is(200).body;
        let mask = image::load_from_memory(&png).unwrap().to_luma8();
        mask.pixels().filter(|p| p[0] > 127).count()
    };
    let before = [mask(1), mask(2)];
    tab.click("button[name=save]");
    tab.until(&strokes(0, 1));
    assert!(mask(1) < before[0] && mask(2) == before[1]);
    tab.until("document.querySelector('#brush [role=status]').textContent.endsWith('Not kept yet: 2: IMG_2.jpg')");
    tab.value(&choose(2));
    tab.until(&strokes(1, 2));
    tab.click("button[name=save]");
    tab.until(&strokes(0, 2));
    assert!(mask(2) < before[1]);
    assert_eq!(tab.value(leaves), true);
    assert_eq!(complaints(&mut tab, &server), Vec::<String>::new());
}

#[test]
fn a_long_name_breaks_no_button_of_the_table() {
    let server = Server::new();
    server.capture(&"Wilhelmine-Friederike".repeat(5));
    let mut tab = tab("de");
    tab.go(&server.url());
    whole(&mut tab, "long-name");
    // So many lines has what is in each cell but the name's, and in each button.
    let lines = "[...document.querySelectorAll('#captures td, #captures thead th:not(:first-child)')].map((e) => {
        const range = document.createRange(); range.selectNodeContents(e);
        return [e.textContent.trim(), new Set([...range.getClientRects()].filter((r) => r.width > 1).map((r) => Math.round(r.top))).size]; })
        .filter(([, lines]) => lines > 1)";
    for width in [1280, 800, 390] {
        tab.emulate([width, 900], width < 500, false);
        tab.drawn();
        assert_eq!(tab.value(lines), json!([]), "at {width} px");
    }
}
