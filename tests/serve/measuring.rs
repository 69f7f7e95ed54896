//! A capture measured: joined, watched, stopped, killed, gone on with, reported, deleted.

use super::calls::events;
use super::server::Server;
use serde_json::{Value, json};

/// Pictures for the book, where there is a browser and somebody wants them.
#[cfg(chromium)]
use super::whole::picture;
#[cfg(not(chromium))]
fn picture(_: &Server, _: &str, _: &str) {}

/// What a browser does with the result, where there is one.
#[cfg(chromium)]
use super::flows::result_report_and_brush as browsed;
#[cfg(not(chromium))]
fn browsed(_: &Server, _: &str) {}

/// So long a capture of the sample may take on a busy machine. \[s\]
const LONG: u64 = 900;

fn state(capture: &Value) -> &str {
    capture["measuring"]["state"].as_str().unwrap()
}

/// How many nodes became this.
fn count(capture: &Value, became: &str) -> usize {
    let steps = capture["measuring"]["steps"].as_array().unwrap();
    steps.iter().filter(|step| step["state"] == became).count()
}

#[test]
fn a_capture_is_measured_once_by_all_who_ask_and_goes_on_after_a_stop_and_a_kill() {
    let mut server = Server::new();
    let id = server.sample("mannequin");
    let at = format!("/api/captures/{id}");
    let ask =
        |server: &Server, what: &str| server.ask("POST", &format!("{at}/{what}"), &Value::Null);
    let look = ask(&server, "look").is(200).json();
    assert_eq!(
        (&look["photos"], &look["motion"]),
        (&json!(9), &json!("turn")),
        "{look}"
    );
    let page = format!("/captures/{id}");
    picture(&server, &format!("{page}#seen"), "serve-seen");
    // Two tabs: the second joins.
    assert_eq!(ask(&server, "measure").is(202).json()["joined"], false);
    assert_eq!(ask(&server, "measure").is(200).json()["joined"], true);
    // What is being measured keeps its photos and its facts, and is not deleted.
    server
        .ask("PUT", &format!("{at}/facts"), &json!({}))
        .is(409);
    server
        .ask("DELETE", &format!("{at}/files/1"), &Value::Null)
        .is(409);
    server.ask("DELETE", &at, &Value::Null).is(409);
    // Stopped, as by Ctrl-C.
    server.until(&id, LONG, |capture| count(capture, "made") >= 2);
    ask(&server, "stop").is(204);
    let capture = server.until(&id, LONG, |capture| state(capture) != "running");
    assert_eq!(state(&capture), "stopped");
    // On, and killed.
    ask(&server, "measure").is(202);
    server.until(&id, LONG, |capture| {
        count(capture, "made") + count(capture, "found") >= 5
    });
    picture(&server, &page, "serve-measuring");
    server.kill_and_start();
    let capture = server.ask("GET", &at, &Value::Null).is(200).json();
    assert_eq!(state(&capture), "interrupted");
    // On to the end: what was done is found.
    ask(&server, "measure").is(202);
    let all = events(&server, &id);
    let last = all.last().unwrap();
    assert_eq!(last["state"], "done", "{}", last["measuring"]["why"]);
    assert!(count(last, "found") >= 4, "{}", last["measuring"]["steps"]);
    assert!(
        all.len() > 3
            && all
                .iter()
                .any(|e| e["sentence"].as_str().unwrap().contains("Surface"))
    );
    done(&server, &id);
    picture(&server, "/", "serve-start");
    picture(&server, &page, "serve-result");
    picture(&server, &format!("{page}/masks"), "serve-brush");
    browsed(&server, &id);
    deleted(&server, &id);
}

/// Results are there, as `tailor measure` writes them.
fn done(server: &Server, id: &str) {
    let get = |path: String| server.ask("GET", &path, &Value::Null);
    let capture = get(format!("/api/captures/{id}")).is(200).json();
    let waist = capture["girths"]["girths"]
        .as_array()
        .unwrap()
        .iter()
        .find(|g| g["name"] == "WC");
    let waist = waist.unwrap_or_else(|| panic!("{}", capture["girths"]["missing"]))["tape_cm"]
        .as_f64()
        .unwrap();
    assert!((40.0..50.0).contains(&waist), "{waist}");
    for node in ["placed", "masks", "hull", "body"] {
        let picture = get(format!("/api/captures/{id}/pictures/{node}")).is(200);
        assert!(
            picture.body.len() > 1000 && picture.header("content-type").starts_with("image/"),
            "{node}"
        );
    }
    get(format!("/api/captures/{id}/pictures/photos")).is(404);
    let csv = get("/girths.csv".into()).is(200).text();
    assert!(
        csv.contains(&format!("mannequin,{id},")) && csv.contains(",WC,waist,cm,"),
        "{csv}"
    );
    let report = get(format!("/captures/{id}/report")).is(200);
    assert!(
        report
            .header("content-security-policy")
            .starts_with("sandbox allow-scripts")
    );
    assert!(report.text().contains("<title>tailor: mannequin</title>"));
    let glb = get(format!("/captures/{id}/out/body.glb")).is(200);
    assert_eq!(
        (&glb.body[..4], glb.header("content-disposition")),
        (&b"glTF"[..], "attachment; filename=\"body.glb\"")
    );
    // The page costs little without its photos.
    let page = get(format!("/captures/{id}")).is(200).body.len();
    let assets =
        ["page.css", "live.js"].map(|name| get(format!("/assets/{name}")).is(200).body.len());
    assert!(
        page + assets.iter().sum::<usize>() < 300_000,
        "{page} {assets:?}"
    );
}

/// Nothing of it is left, neither in the folder nor in the cache.
fn deleted(server: &Server, id: &str) {
    let gone = server
        .ask("DELETE", &format!("/api/captures/{id}"), &Value::Null)
        .is(200)
        .json();
    assert_eq!(gone["files"], 10);
    assert!(
        gone["results"].as_u64().unwrap() > 15
            && gone["results_bytes"].as_u64().unwrap() > 1_000_000,
        "{gone}"
    );
    server
        .ask("GET", &format!("/api/captures/{id}"), &Value::Null)
        .is(404);
    assert!(!server.path(&format!("captures/captures/{id}")).exists());
    let (mut open, mut left) = (
        vec![server.path("cache/cas"), server.path("cache/ac")],
        vec![],
    );
    while let Some(folder) = open.pop() {
        for entry in std::fs::read_dir(folder).into_iter().flatten() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.push(path)
            } else {
                left.push(path)
            }
        }
    }
    assert!(left.is_empty(), "{left:?}");
}
