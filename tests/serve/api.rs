//! The calls are those that `docs/api/openapi.json` names, and do what it documents of captures and files.

use super::server::{Server, photos};
use serde_json::{Value, json};
use std::collections::BTreeSet;

/// The calls of the document, by path.
fn document() -> Value {
    serde_json::from_str(tailor::serve::OPENAPI).unwrap()
}

#[test]
fn the_document_names_every_call_and_no_other() {
    let document = document();
    let named: BTreeSet<&str> = document["paths"]
        .as_object()
        .unwrap()
        .keys()
        .map(String::as_str)
        .collect();
    let there: BTreeSet<&str> = tailor::serve::paths().into_iter().collect();
    assert_eq!(named, there);
    let server = Server::new();
    let mut ids = BTreeSet::new();
    for (path, calls) in document["paths"].as_object().unwrap() {
        for method in ["get", "post", "put", "patch", "delete"] {
            // Nothing is there: what is known as a method is answered with something else than 405.
            let at = path
                .replace("{id}", "0123456789abcdef")
                .replace("{number}", "1")
                .replace("{side}", "320");
            let status = server
                .ask(
                    &method.to_uppercase(),
                    &at.replace(['{', '}'], ""),
                    &Value::Null,
                )
                .status;
            assert_eq!(
                calls[method].is_null(),
                status == 405,
                "{method} {path}: {status}"
            );
            if let Some(id) = calls[method]["operationId"].as_str() {
                assert!(ids.insert(id.to_owned()), "{id} is there twice");
                assert!(calls[method]["responses"]["403"].is_object(), "{id}");
            }
        }
    }
    let answer = server
        .ask("GET", "/api/openapi.json", &Value::Null)
        .is(200)
        .json();
    assert_eq!(answer, document);
}

/// Whether a value has the properties of a schema, and no other ones.
fn fits(document: &Value, schema: &str, value: &Value) {
    let known = document["components"]["schemas"][schema]["properties"]
        .as_object()
        .unwrap();
    let known: BTreeSet<&String> = known.keys().collect();
    let there: BTreeSet<&String> = value.as_object().unwrap().keys().collect();
    assert_eq!(known, there, "{schema}");
}

#[test]
fn files_come_in_and_go_and_facts_are_checked() {
    let (server, document) = (Server::new(), document());
    let id = server.capture(" Anna \u{7}");
    let at = format!("/api/captures/{id}");
    let photo = std::fs::read(&photos()[0]).unwrap();
    let file = server.send(&id, 3, "IMG_3.JPG", &photo).is(200).json();
    fits(&document, "File", &file);
    assert_eq!(
        (&file["file"], &file["size"]),
        (&json!("0003.jpg"), &json!([800, 1200]))
    );
    let small = server
        .ask("GET", &format!("{at}/files/3/small/320"), &Value::Null)
        .is(200);
    assert_eq!(
        (small.header("content-type"), &small.body[..2]),
        ("image/jpeg", &b"\xff\xd8"[..])
    );
    server
        .ask("GET", &format!("{at}/files/3/small/321"), &Value::Null)
        .is(404);
    let answer = server.ask("GET", &at, &Value::Null).is(200).json();
    fits(&document, "Capture", &answer);
    fits(&document, "Measuring", &answer["measuring"]);
    assert_eq!(
        (&answer["name"], &answer["measuring"]["state"]),
        (&json!("Anna"), &json!("none"))
    );
    let facts = format!("{at}/facts");
    server
        .ask(
            "PUT",
            &facts,
            &json!({ "stature_cm": 171.5, "steps": -18, "plate": 3, "sex": "female", "age_years": 9.5 }),
        )
        .is(204);
    for bad in [
        json!({ "stature_cm": 1.71 }),
        json!({ "weight_kg": -1 }),
        json!({ "sex": "f" }),
        json!({ "age_years": 131 }),
        json!({ "set": "x" }),
    ] {
        server.ask("PUT", &facts, &bad).is(422);
    }
    let answer = server.ask("GET", &at, &Value::Null).json();
    assert_eq!(
        answer["facts"]["stature_cm"], 171.5,
        "what was refused changed nothing"
    );
    server
        .ask("DELETE", &format!("{at}/files/3"), &Value::Null)
        .is(204);
    server
        .ask("DELETE", &format!("{at}/files/3"), &Value::Null)
        .is(404);
    let listed = server.ask("GET", "/api/captures", &Value::Null).json();
    fits(&document, "Line", &listed["captures"][0]);
}

#[test]
fn errors_are_in_the_readers_language() {
    let server = Server::new();
    let bearer = format!("Bearer {}", server.token);
    let ask = |language: &str| {
        let headers = [
            ("Authorization", bearer.as_str()),
            ("Accept-Language", language),
        ];
        server
            .call("GET", "/api/captures/0123456789abcdef", &headers, b"")
            .is(404)
            .json()
    };
    assert_eq!(ask("de-AT, en")["error"], "Das ist hier nicht (mehr).");
    assert_eq!(ask("fr")["code"], "wrong-missing");
    // What is chosen goes before what the browser asks for.
    let headers = [
        ("Authorization", bearer.as_str()),
        ("Accept-Language", "en"),
        ("Cookie", "lang=de; unit=in"),
    ];
    let page = server.call("GET", "/", &headers, b"").is(200).text();
    assert!(page.contains("<html lang=\"de\">") && page.contains("Eine neue Aufnahme"));
}

#[test]
fn too_few_photos_are_reported_when_they_are_looked_at_and_when_they_are_measured() {
    let server = Server::new();
    let id = server.capture("few");
    for number in 1..=4 {
        let photo = std::fs::read(&photos()[number as usize]).unwrap();
        server.send(&id, number, "a.jpg", &photo).is(200);
    }
    let look = server
        .ask("POST", &format!("/api/captures/{id}/look"), &Value::Null)
        .is(200)
        .json();
    assert_eq!(look["photos"], 4, "{look}");
    let wrong = server
        .ask("POST", &format!("/api/captures/{id}/measure"), &Value::Null)
        .is(422)
        .json();
    assert!(
        wrong["error"].as_str().unwrap().contains("4 photos"),
        "{wrong}"
    );
    let page = server
        .ask("GET", &format!("/captures/{id}"), &Value::Null)
        .is(200)
        .text();
    assert!(
        page.contains("Nothing came of it") && page.contains("take 18 to 36 photos"),
        "{page}"
    );
}

#[test]
fn a_full_disk_is_reported_and_nothing_half_written_is_kept() {
    let server = Server::limited(64);
    let id = server.capture("full");
    let photo = std::fs::read(&photos()[0]).unwrap();
    assert!(photo.len() > 64 << 10);
    let answer = server.send(&id, 1, "a.jpg", &photo).is(507).json();
    assert_eq!(answer["code"], "wrong-full");
    let answer = server.ask("GET", &format!("/api/captures/{id}"), &Value::Null);
    assert_eq!(answer.is(200).json()["files"], json!({}));
    let incoming = server.path(&format!("captures/captures/{id}/incoming"));
    assert_eq!(std::fs::read_dir(incoming).unwrap().count(), 0);
}

#[test]
fn with_lan_the_machine_answers_under_its_address_in_the_network_or_reports_that_there_is_none() {
    let mut server = match Server::lan() {
        Ok(server) => server,
        Err(why) => return assert!(why.contains("--lan: "), "{why}"),
    };
    let url = server.lan.take().expect("an address for a phone");
    let host = url
        .strip_prefix("http://")
        .unwrap()
        .split('/')
        .next()
        .unwrap()
        .to_owned();
    let bearer = format!("Bearer {}", server.token);
    let ask = |host: &str| {
        let headers = [("Authorization", bearer.as_str()), ("Host", host)];
        server.call("GET", "/", &headers, b"")
    };
    let page = ask(&host).is(200).text();
    assert!(
        page.contains("class=\"qr\"") && page.contains(&url),
        "{page}"
    );
    ask("evil.example").is(403);
}

#[test]
fn what_cannot_be_read_when_a_capture_is_deleted_is_named() {
    let server = Server::new();
    // A record as a newer version of the program writes it.
    let body = "{ \"version\": 99 }\n";
    let record = format!("{}\n{body}", blake3::hash(body.as_bytes()).to_hex());
    let name = format!("ab{}", "0".repeat(62));
    std::fs::create_dir_all(server.path("cache/ac/ab")).unwrap();
    let newer = server.path("cache/ac/ab").join(&name);
    std::fs::write(&newer, record).unwrap();
    let id = server.capture("Anna");
    let gone = server.ask("DELETE", &format!("/api/captures/{id}"), &Value::Null);
    let gone = gone.is(200).json();
    assert!(
        gone["unread"][0].as_str().unwrap().contains(&name),
        "{gone}"
    );
    assert!(newer.exists() && !server.path(&format!("captures/captures/{id}")).exists());
    fits(&document(), "Gone", &gone);
}
