//! The page in a real browser, as hands use it: dropped, looked at, typed, measured, reported, deleted; in both
//! languages, light and dark, from a phone's width to 4K.

use super::chromium::Tab;
use super::live::live_girths;
use super::server::{Server, photos};
use super::whole::{complaints, tab, whole};
use crate::small;
use serde_json::{Value, json};

#[test]
fn photos_are_dropped_looked_at_begun_to_measure_stopped_and_deleted() {
    let server = Server::new();
    let mut tab = tab("de");
    tab.go(&server.url());
    assert_eq!(
        tab.value("location.search"),
        "",
        "the token left the address line"
    );
    assert_eq!(
        tab.value("document.cookie"),
        "",
        "no script reads the cookie"
    );
    whole(&mut tab, "start");
    tab.value("document.querySelector('[name=name]').value = 'Anna <b>'");
    let place = tempfile::tempdir().unwrap();
    tab.choose("input[name=files]", &small::turn_in(place.path(), 2));
    tab.until("location.pathname.startsWith('/captures/') && document.readyState === 'complete'");
    tab.until("document.querySelector('.can')");
    whole(&mut tab, "seen");
    let heading = tab.value("document.querySelector('h1').textContent");
    assert_eq!(heading, "Anna <b>");
    assert_eq!(
        tab.value("document.querySelectorAll('.photos img').length"),
        10
    );
    tab.until("[...document.querySelectorAll('.photos img')].slice(0, 4).every((i) => i.complete && i.naturalWidth > 0)");
    // The plate was known by its name, and what is typed is read as it is written here.
    assert_eq!(
        tab.value("document.querySelector('[name=plate]').value"),
        "10"
    );
    tab.value("document.querySelector('[name=weight_kg]').value = 'viel'");
    tab.value("document.querySelector('[name=mat_tag_mm]').value = '60,0'");
    tab.click("[name=quick]");
    tab.click("form[action$='/facts'] button");
    tab.until("document.querySelector('[name=weight_kg][aria-invalid]')");
    assert_eq!(
        tab.value("document.querySelector('[name=mat_tag_mm]').value"),
        "60,0",
        "nothing has to be typed again"
    );
    whole(&mut tab, "slip");
    tab.value("document.querySelector('[name=weight_kg]').value = '8,8'");
    tab.click("form[action$='/facts'] button");
    tab.until("document.readyState === 'complete' && document.querySelector('.can') && !document.querySelector('[aria-invalid]')");
    tab.click("form[action$='/measure'] button");
    tab.until("document.querySelector('#steps li')");
    whole(&mut tab, "measuring");
    // Stopped; the same capture measured to its end is in `measuring.rs`.
    tab.click("form[action$='/stop'] button");
    tab.until_within(300, "document.readyState === 'complete' && !document.querySelector('[data-events]') && document.querySelector('form[action$=\"/measure\"]')");
    whole(&mut tab, "stopped");
    assert_eq!(
        complaints(&mut tab, &server),
        [
            "\"Failed to load resource: the server responded with a status of 422 (Unprocessable Entity)\""
        ]
    );
    tab.click("a.danger");
    tab.until("document.querySelector('form[action$=\"/delete\"]')");
    whole(&mut tab, "delete");
    tab.click("form button.danger");
    tab.until("document.querySelector('h1')?.textContent.endsWith('ist gelöscht')");
    whole(&mut tab, "gone");
    tab.click("main a");
    tab.until("location.pathname === '/' && document.querySelector('#drop')");
    assert_eq!(tab.value("document.querySelectorAll('tbody tr').length"), 0);
}

/// The page of a measured capture: its result, its report, its outlines corrected and measured anew.
pub(crate) fn result_report_and_brush(server: &Server, id: &str) {
    let mut tab = tab("de");
    tab.go(&server.url());
    tab.go(&format!("{}/captures/{id}", server.origin()));
    measured(&mut tab);
    tab.until("[...document.querySelectorAll('#pictures img')].length === 4 && [...document.querySelectorAll('#pictures img')].every((i) => i.complete && i.naturalWidth > 0)");
    whole(&mut tab, "result");
    let waist = tab.value("document.querySelector('#result-title + div td').textContent");
    let waist = waist.as_str().unwrap();
    assert!(waist.contains(',') && waist.ends_with(" cm"), "{waist}");
    // Every girth that was measured is there.
    let answer = server.ask("GET", &format!("/api/captures/{id}"), &Value::Null);
    let girths = answer.is(200).json()["girths"]["girths"]
        .as_array()
        .map(Vec::len);
    let rows = tab.value("document.querySelectorAll('.girths td[data-of]').length");
    assert_eq!(rows.as_u64().map(|n| n as usize), girths);
    // What is warned of, and why girths are missing, is in German.
    let english =
        tab.value("[...document.querySelectorAll('main [lang=en]')].map((e) => e.textContent)");
    assert_eq!(english, json!([]), "nothing is left in English");
    assert_eq!(complaints(&mut tab, server), Vec::<String>::new());
    report(&mut tab, server);
    brush(&mut tab, server);
}

/// Waits until a capture is measured, and its page is there.
#[track_caller]
fn measured(tab: &mut Tab) {
    let there = "document.readyState === 'complete' && !document.querySelector('[data-events]') && document.querySelector('#result-title')";
    tab.until_within(900, there);
}

/// Body is painted where there was none; only what comes after the outlines is made again.
fn brush(tab: &mut Tab, server: &Server) {
    let id = tab.value("location.pathname.split('/')[2]");
    let id = id.as_str().unwrap().to_owned();
    tab.click("a[href$='/masks']");
    tab.until("document.querySelector('#brush canvas')?.dataset.strokes === '0'");
    whole(tab, "brush");
    let mask = format!("/api/captures/{id}/masks/1");
    let before = server.ask("GET", &mask, &Value::Null).is(200).body;
    tab.click("#brush canvas");
    tab.until("document.querySelector('#brush canvas').dataset.strokes === '1'");
    // Undone, and once more by keys.
    tab.click("button[name=undo]");
    tab.until("document.querySelector('#brush canvas').dataset.strokes === '0'");
    tab.click("input[value=room]");
    tab.value("document.querySelector('#brush canvas').focus()");
    tab.key("ArrowLeft");
    tab.key(" ");
    tab.until("document.querySelector('#brush canvas').dataset.strokes === '1'");
    tab.click("button[name=save]");
    tab.until("document.querySelector('#brush [role=status]').textContent.startsWith('Behalten')");
    let after = server.ask("GET", &mask, &Value::Null).is(200).body;
    let body = |png: &[u8]| {
        let mask = image::load_from_memory(png).unwrap().to_luma8();
        mask.pixels().filter(|p| p[0] > 127).count()
    };
    assert!(
        body(&after) < body(&before),
        "background was painted in the middle of the body"
    );
    tab.click("form[action$='/measure'] button");
    tab.until("document.querySelector('#measuring')");
    let state = |capture: &Value, node: &str| {
        let steps = capture["measuring"]["steps"].as_array();
        let step = steps.and_then(|all| all.iter().find(|s| s["node"] == node));
        step.map(|s| s["state"].clone())
    };
    let made = Some(json!("made"));
    let capture = server.until(&id, 900, |capture| state(capture, "hull") == made);
    for before in ["photos", "tags", "calibrated", "placed"] {
        assert_eq!(state(&capture, before), Some(json!("found")), "{before}");
    }
    assert_eq!(state(&capture, "masks"), made);
    // The way to its end is the same as before.
    let stop = format!("/api/captures/{id}/stop");
    server.ask("POST", &stop, &Value::Null).is(204);
    server.until(&id, 900, |capture| {
        capture["measuring"]["state"] == "stopped"
    });
}

/// The report draws in its sandbox, and reaches nothing of the page.
fn report(tab: &mut Tab, server: &Server) {
    let at = tab.value("location.pathname");
    tab.click("a[href$='/report']");
    tab.until("Number(document.getElementById('view')?.dataset.drawn) > 0");
    let reached = tab.value("fetch('/api/captures').then(() => 'reached', () => 'refused')");
    assert_eq!(reached, "refused");
    let origin = tab.value("self.origin");
    assert_eq!(origin, "null");
    let id = at.as_str().unwrap().rsplit('/').next().unwrap();
    live_girths(tab, server, id);
    tab.go(&format!("{}{}", server.origin(), at.as_str().unwrap()));
}

#[test]
fn keys_alone_reach_all_and_language_and_unit_are_chosen() {
    let server = Server::new();
    server.capture("A body");
    let mut tab = tab("en");
    tab.go(&server.url());
    let mut reached = vec![];
    for _ in 0..20 {
        tab.ask(
            "Input.dispatchKeyEvent",
            json!({ "type": "keyDown", "key": "Tab", "code": "Tab", "windowsVirtualKeyCode": 9 }),
        );
        tab.ask(
            "Input.dispatchKeyEvent",
            json!({ "type": "keyUp", "key": "Tab", "code": "Tab", "windowsVirtualKeyCode": 9 }),
        );
        let at = tab.value("(() => { const e = document.activeElement; return e.name || e.textContent.trim().slice(0, 20) || e.tagName; })()");
        reached.push(at.as_str().unwrap().to_owned());
    }
    for wanted in [
        "Skip to the content",
        "set",
        "name",
        "files",
        "folder",
        "A body",
        "Measure all that are",
    ] {
        assert!(
            reached.iter().any(|r| r.starts_with(wanted)),
            "{wanted}: {reached:?}"
        );
    }
    tab.click("button[value=de]");
    tab.until("document.documentElement.lang === 'de'");
    tab.click("button[value=in]");
    tab.until(
        "document.querySelector('button[value=in]')?.getAttribute('aria-pressed') === 'true'",
    );
    tab.until("document.documentElement.lang === 'de' && document.readyState === 'complete'");
    assert_eq!(complaints(&mut tab, &server), Vec::<String>::new());
}

#[test]
fn each_folder_becomes_a_capture_and_the_table_fills() {
    let server = Server::new();
    let mut tab = tab("en");
    tab.go(&server.url());
    // As a browser hands a folder over: files with their paths.
    let files = tempfile::tempdir().unwrap();
    for (folder, photos_of) in [("anna", 1..4), ("berta/images", 4..7)] {
        let at = files.path().join("all").join(folder);
        std::fs::create_dir_all(&at).unwrap();
        for photo in &photos()[photos_of] {
            std::fs::copy(photo, at.join(photo.file_name().unwrap())).unwrap();
        }
    }
    std::fs::write(files.path().join("all/notes.txt"), "no photo").unwrap();
    tab.choose("input[name=folder]", &[files.path().join("all")]);
    tab.until("document.querySelectorAll('tbody tr').length === 2");
    let names = tab.value(
        "[...document.querySelectorAll('tbody th')].map((e) => e.textContent.trim()).sort()",
    );
    assert_eq!(names, json!(["all/anna", "all/berta"]));
    tab.click("form[action='/measure'] button");
    tab.until("[...document.querySelectorAll('tbody tr')].every((e) => e.textContent.includes('Nothing came of it'))");
    whole(&mut tab, "table");
    let csv = server
        .ask("GET", "/girths.csv", &Value::Null)
        .is(200)
        .text();
    assert_eq!(csv.lines().count(), 1, "{csv}");
}
