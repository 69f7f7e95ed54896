//! The calls as docs/serve.md prints them: files sent with `-T`, the empty scene known by its name, errors as JSON, and
//! what went wrong, with the names of the files that were sent.

use super::server::{Server, photos};
use crate::small;
use serde_json::{Value, json};

/// A capture sent as the documented calls do, its plate named `plate`.
fn sent(server: &Server, plate: &str) -> String {
    let id = server.capture("Anna");
    let place = tempfile::tempdir().unwrap();
    let photos = small::turn_in(place.path(), 2);
    for (at, photo) in photos.iter().enumerate() {
        let bytes = std::fs::read(photo).unwrap();
        let name = photo.file_name().unwrap().to_str().unwrap();
        let name = if name == "plate.jpg" { plate } else { name };
        server.send(&id, at as u32 + 1, name, &bytes).is(200);
    }
    id
}

/// What is seen of a capture: how many photos, and the plate.
fn seen(server: &Server, id: &str) -> (Value, Value) {
    let look = format!("/api/captures/{id}/look");
    let look = server.ask("POST", &look, &Value::Null).is(200).json();
    (look["photos"].clone(), look["plate"].clone())
}

#[test]
fn a_photo_called_plate_is_the_empty_scene_unless_another_is_named() {
    let server = Server::new();
    let id = sent(&server, "Plate.JPG");
    let (at, facts) = (
        format!("/api/captures/{id}"),
        format!("/api/captures/{id}/facts"),
    );
    let facts_sent = json!({ "mat_tag_mm": 60.0 });
    server.ask("PUT", &facts, &facts_sent).is(204);
    assert_eq!(seen(&server, &id), (json!(9), json!("0010.jpg")));
    let answer = server.ask("GET", &at, &Value::Null).is(200).json();
    assert_eq!(answer["plate"], 10, "{answer}");
    let page = server.ask("GET", &format!("/captures/{id}"), &Value::Null);
    let page = page.is(200).text();
    assert!(page.contains("<option value=\"10\" selected>10: Plate.JPG"));
    // What is given goes before the name; what is given no longer does not.
    for (plate, expected) in [
        (json!(5), (json!(9), json!("0005.jpg"))),
        (Value::Null, (json!(10), Value::Null)),
    ] {
        server
            .ask(
                "PUT",
                &facts,
                &json!({ "mat_tag_mm": 60.0, "plate": plate }),
            )
            .is(204);
        assert_eq!(seen(&server, &id), expected);
    }
    server.ask("PUT", &facts, &facts_sent).is(204);
    assert_eq!(seen(&server, &id), (json!(9), json!("0010.jpg")));
}

#[test]
fn errors_are_json_whatever_is_wrong() {
    let server = Server::new();
    let id = server.capture("anna");
    let bearer = format!("Bearer {}", server.token);
    let large = "a".repeat(100_000);
    for case in [
        "POST /api/captures application/json 400 wrong-json {\"name\":",
        "POST /api/captures application/json 400 wrong-json ",
        "POST /api/captures application/json 422 wrong-object []",
        "POST /api/captures application/json 422 wrong-object [\"a\"]",
        "POST /api/captures application/json 422 wrong-said {\"nam\":\"a\"}",
        "POST /api/captures application/json 413 wrong-request {\"name\":\"LARGE\"}",
        "POST /api/captures text/plain 415 wrong-media {\"name\":\"a\"}",
        "DELETE /api/captures application/json 405 wrong-method {}",
        "PUT /api/captures/ID/facts application/json 422 wrong-object []",
        "PUT /api/captures/ID/files/abc?name=a.jpg image/jpeg 400 wrong-request ",
        "GET /api/nothing application/json 404 wrong-missing ",
    ] {
        let case = case.replace("ID", &id);
        let [method, path, media, status, code, body] = case.splitn(6, ' ').collect::<Vec<_>>()[..]
            .try_into()
            .unwrap();
        let body = body.replace("LARGE", &large);
        let headers = [("Authorization", bearer.as_str()), ("Content-Type", media)];
        let answer = server.call(method, path, &headers, body.as_bytes());
        assert_eq!(
            answer.status.to_string(),
            status,
            "{case}: {}",
            answer.text()
        );
        assert_eq!(answer.header("content-type"), "application/json");
        let wrong = answer.json();
        assert_eq!(wrong["code"], code, "{wrong}");
        assert!(!wrong["error"].as_str().unwrap().is_empty());
    }
    let listed = server.ask("GET", "/api/captures", &Value::Null);
    let listed = listed.is(200).json();
    assert_eq!(listed["captures"].as_array().unwrap().len(), 1, "{listed}");
    // On a page the same is answered as a page.
    let form = format!("/captures/{id}/files/abc/remove");
    let page = server.call("POST", &form, &[("Authorization", &bearer)], b"");
    assert!(page.is(400).text().contains("<html"));
}

#[test]
fn what_went_wrong_is_reported_with_the_files_that_were_sent_and_names_no_command() {
    let server = Server::new();
    let id = server.capture("torn");
    for (at, photo) in photos()[..9].iter().enumerate() {
        let mut bytes = std::fs::read(photo).unwrap();
        let last = at == 8;
        if last {
            bytes.truncate(bytes.len() / 2);
        }
        let name = if last { "trunc.jpg" } else { "0009.jpg" };
        server.send(&id, at as u32 + 1, name, &bytes).is(200);
    }
    let at = format!("/api/captures/{id}");
    server
        .ask(
            "PUT",
            &format!("{at}/facts"),
            &json!({ "mat_tag_mm": 60.0, "steps": 9 }),
        )
        .is(204);
    let look = server.ask("POST", &format!("{at}/look"), &Value::Null);
    let wrong = look.is(200).json()["wrong"].to_string();
    let good = |text: &str| {
        assert!(text.contains("trunc.jpg"), "{text}");
        for leak in [
            "tailor serve",
            "to repeat",
            "--",
            "photos failed",
            "0009.jpg",
        ] {
            assert!(!text.contains(leak), "{leak}: {text}");
        }
    };
    good(&wrong);
    server
        .ask("POST", &format!("{at}/measure"), &Value::Null)
        .is(202);
    let capture = server.until(&id, 60, |capture| capture["measuring"]["state"] == "failed");
    good(&capture["measuring"]["why"].to_string());
    let page = server.ask("GET", &format!("/captures/{id}"), &Value::Null);
    let page = page.is(200).text();
    let alerts: Vec<&str> = page.split("class=\"alert\"").skip(1).collect();
    assert!(alerts.len() > 1, "{page}");
    alerts
        .iter()
        .for_each(|text| good(text.split("</p>").next().unwrap()));
}

#[test]
fn a_mat_that_was_recognised_is_no_doubt_and_findings_name_no_flag() {
    let server = Server::new();
    let id = server.capture("mat");
    let photo = std::fs::read(&photos()[0]).unwrap();
    server.send(&id, 1, "IMG%201.jpg", &photo).is(200);
    let number = |value: f64, unit: &str| json!({ "value": value, "digits": 1, "unit": unit });
    let count = |value: u32| json!({ "value": value });
    let known = json!({
        "code": "warn-mat-known", "text": "the mat was recognised …",
        "fields": { "count": count(12), "first": count(0), "last": count(11), "radius": number(187.0, "mm") },
    });
    let layout = json!({
        "code": "warn-tags-mat", "text": "they are as on a mat of `tailor mat` …, such as --mat-tag 60",
        "fields": { "count": count(12), "ring": number(3.1, "") },
    });
    let strange = json!({
        "code": "warn-tags-unused", "text": "marker tags …; …, such as --mat-tag 60",
        "fields": { "first": count(0), "last": count(11), "seen": count(4), "photos": count(4), "layout": layout },
    });
    let late = json!({
        "code": "warn-order", "text": "0001.jpg was taken before 0002.jpg: names should be in turning order",
        "fields": { "early": "0001.jpg", "late": "0002.jpg" },
    });
    // As a page of an earlier version kept it.
    let old = "0001.jpg is odd; give --mat-tag";
    let look = json!({ "photos": 1, "width": 800, "height": 1200, "views": [], "findings": [], "can": {},
        "warnings": [known, strange, late, old] });
    let file = server.path(&format!("captures/captures/{id}/look.json"));
    std::fs::write(file, look.to_string()).unwrap();
    let page = server.ask("GET", &format!("/captures/{id}"), &Value::Null);
    let page = page.is(200).text();
    let class = |text: &str| {
        let (before, _) = page.split_once(text).unwrap();
        before
            .rsplit("<li class=\"")
            .next()
            .unwrap()
            .split('"')
            .next()
            .unwrap()
            .to_owned()
    };
    assert_eq!(class("the mat was recognised"), "hint");
    assert_eq!(class("laid out as on a mat of tailor"), "doubt");
    assert!(
        !page.contains("--mat") && page.contains("“Tag of the mat”"),
        "{page}"
    );
    assert!(page.contains("IMG 1.jpg was taken before"), "{page}");
    let answer = server.ask("GET", &format!("/api/captures/{id}"), &Value::Null);
    let look = answer.is(200).json()["look"].clone();
    let warnings = look["warnings"].to_string();
    assert!(
        !warnings.contains("--mat") && warnings.contains("IMG 1.jpg"),
        "{warnings}"
    );
    assert_eq!(look["warnings"][2]["code"], "warn-order");
}
