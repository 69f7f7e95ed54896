//! The calls as docs/serve.md prints them: files sent with `-T`, the empty scene known by its name, errors as JSON, and
//! what went wrong said of the files that were sent.

use crate::server::{Server, photos};
use serde_json::{Value, json};

/// A capture sent as the documented calls do, its plate named `plate`.
fn sent(server: &Server, plate: &str) -> String {
    let id = server.capture("Anna");
    for (at, photo) in photos().iter().enumerate() {
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
fn a_photo_called_plate_is_the_empty_scene_unless_another_is_said() {
    let server = Server::new();
    let id = sent(&server, "Plate.JPG");
    let (at, facts) = (
        format!("/api/captures/{id}"),
        format!("/api/captures/{id}/facts"),
    );
    let said = json!({ "mat_tag_mm": 60.0 });
    server.ask("PUT", &facts, &said).is(204);
    assert_eq!(seen(&server, &id), (json!(18), json!("0019.jpg")));
    let told = server.ask("GET", &at, &Value::Null).is(200).json();
    assert_eq!(told["plate"], 19, "{told}");
    let page = server.ask("GET", &format!("/captures/{id}"), &Value::Null);
    let page = page.is(200).text();
    assert!(page.contains("<option value=\"19\" selected>19: Plate.JPG"));
    // What is said goes before the name; what is said no more does not.
    for (plate, expected) in [
        (json!(5), (json!(18), json!("0005.jpg"))),
        (Value::Null, (json!(19), Value::Null)),
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
    server.ask("PUT", &facts, &said).is(204);
    assert_eq!(seen(&server, &id), (json!(18), json!("0019.jpg")));
}
