//! Several windows with the form of one capture: none undoes what another typed.

use super::server::{Answer, Server, photos};
use serde_json::{Value, json};

/// The fields of the form on a capture's page, as a browser sends them if nobody touches one.
fn form(page: &str) -> Vec<(String, String)> {
    let form = page.split("/facts\">").nth(1).unwrap();
    let form = form.split("</form>").next().unwrap();
    let of = |tag: &str, name: &str| {
        let (_, rest) = tag.split_once(&format!(" {name}=\""))?;
        Some(rest.split('"').next()?.to_owned())
    };
    let tags = || form.split('<').skip(1);
    let mut fields = vec![];
    for input in tags().filter(|tag| tag.starts_with("input")) {
        let ticked = !input.contains("checkbox") || input.contains(" checked");
        let (name, value) = (of(input, "name").unwrap(), of(input, "value"));
        fields.extend(ticked.then(|| (name, value.unwrap_or_default())));
    }
    for select in form.split("<select").skip(1) {
        let chosen = select
            .split("<option")
            .skip(1)
            .find(|o| o.contains(" selected"));
        let value = chosen.and_then(|o| of(o, "value"));
        fields.push((of(select, "name").unwrap(), value.unwrap_or_default()));
    }
    fields
}

/// A window with the form of a capture.
struct Window<'a> {
    server: &'a Server,
    id: &'a str,
    fields: Vec<(String, String)>,
}

impl<'a> Window<'a> {
    fn open(server: &'a Server, id: &'a str) -> Window<'a> {
        let page = server.ask("GET", &format!("/captures/{id}"), &Value::Null);
        let fields = form(&page.is(200).text());
        Window { server, id, fields }
    }

    fn typed(&mut self, name: &str, value: &str) -> &mut Self {
        self.fields.retain(|(n, _)| n != name);
        self.fields.push((name.into(), value.into()));
        self
    }

    fn kept(&self) -> Answer {
        let one =
            |(name, value): &(String, String)| format!("{name}={}", value.replace(',', "%2C"));
        let body: Vec<String> = self.fields.iter().map(one).collect();
        let bearer = format!("Bearer {}", self.server.token);
        let headers = [
            ("Authorization", bearer.as_str()),
            ("Content-Type", "application/x-www-form-urlencoded"),
        ];
        let path = format!("/captures/{}/facts", self.id);
        self.server
            .call("POST", &path, &headers, body.join("&").as_bytes())
    }
}

fn facts(server: &Server, id: &str) -> Value {
    let capture = server.ask("GET", &format!("/api/captures/{id}"), &Value::Null);
    capture.is(200).json()["facts"].clone()
}

#[test]
fn each_window_keeps_what_was_typed_in_it_and_nothing_else() {
    let server = Server::new();
    let id = server.capture("anna");
    let (mut one, mut two) = (Window::open(&server, &id), Window::open(&server, &id));
    one.typed("mat_tag_mm", "60")
        .typed("weight_kg", "64,5")
        .typed("quick", "yes");
    one.kept().is(303);
    two.typed("stature_cm", "171.5").typed("sex", "female");
    two.kept().is(303);
    let known = facts(&server, &id);
    for (name, value) in [
        ("mat_tag_mm", json!(60.0)),
        ("weight_kg", json!(64.5)),
        ("quick", json!(true)),
        ("stature_cm", json!(171.5)),
        ("sex", json!("female")),
    ] {
        assert_eq!(known[name], value, "{known}");
    }
}

#[test]
fn a_field_that_both_changed_is_refused_with_its_name_until_somebody_chooses() {
    let server = Server::new();
    let id = server.capture("anna");
    let (mut one, mut two) = (Window::open(&server, &id), Window::open(&server, &id));
    one.typed("weight_kg", "64")
        .typed("stature_cm", "170")
        .kept()
        .is(303);
    two.typed("weight_kg", "65")
        .typed("mat_tag_mm", "60")
        .typed("stature_cm", "170");
    let refused = two.kept().is(409).text();
    assert!(
        refused.contains("Not kept: another window changed Weight meanwhile"),
        "{refused}"
    );
    assert!(refused.contains("Meanwhile: 64"), "{refused}");
    let known = facts(&server, &id);
    assert_eq!(
        (&known["weight_kg"], &known["mat_tag_mm"]),
        (&json!(64.0), &Value::Null)
    );
    // What was typed is still there, and keeping it once more is a choice.
    two.fields = form(&refused);
    let typed = |name: &str| {
        two.fields
            .iter()
            .find(|(n, _)| n == name)
            .map(|(_, v)| v.as_str())
    };
    assert_eq!(
        (typed("weight_kg"), typed("mat_tag_mm")),
        (Some("65"), Some("60"))
    );
    two.kept().is(303);
    let known = facts(&server, &id);
    assert_eq!(
        (&known["weight_kg"], &known["mat_tag_mm"]),
        (&json!(65.0), &json!(60.0))
    );
}

#[test]
fn a_form_is_read_in_the_unit_that_it_showed() {
    let server = Server::new();
    let id = server.capture("anna");
    let mut window = Window::open(&server, &id);
    // Another window changes the unit, which is the browser's.
    let bearer = format!("Bearer {}", server.token);
    window.typed("stature_cm", "171.5");
    let one = |(name, value): &(String, String)| format!("{name}={value}");
    let body: Vec<String> = window.fields.iter().map(one).collect();
    let headers = [
        ("Authorization", bearer.as_str()),
        ("Content-Type", "application/x-www-form-urlencoded"),
        ("Cookie", "unit=in"),
    ];
    let path = format!("/captures/{id}/facts");
    server
        .call("POST", &path, &headers, body.join("&").as_bytes())
        .is(303);
    assert_eq!(facts(&server, &id)["stature_cm"], 171.5);
}

#[test]
fn programs_send_some_facts_and_which_version_they_mean() {
    let server = Server::new();
    let id = server.capture("anna");
    let at = format!("/api/captures/{id}");
    let path = format!("{at}/facts");
    let read = server.ask("GET", &at, &Value::Null).is(200);
    let version = read.header("etag").to_owned();
    assert_eq!(version, format!("\"{}\"", read.json()["version"]));
    server
        .ask("PATCH", &path, &json!({ "weight_kg": 64.0, "walk": true }))
        .is(204);
    server
        .ask(
            "PATCH",
            &path,
            &json!({ "stature_cm": 171.5, "walk": null }),
        )
        .is(204);
    let known = facts(&server, &id);
    assert_eq!(
        (&known["weight_kg"], &known["stature_cm"], &known["walk"]),
        (&json!(64.0), &json!(171.5), &json!(false))
    );
    server
        .ask("PATCH", &path, &json!({ "weight_kg": 0.1 }))
        .is(422);
    let bearer = format!("Bearer {}", server.token);
    let put = |version: &str| {
        let headers = [
            ("Authorization", bearer.as_str()),
            ("Content-Type", "application/json"),
            ("If-Match", version),
        ];
        server.call("PUT", &path, &headers, b"{\"weight_kg\":70}")
    };
    assert_eq!(put(&version).is(412).json()["code"], "wrong-stale");
    assert_eq!(facts(&server, &id)["weight_kg"], 64.0);
    let now = server.ask("GET", &at, &Value::Null).is(200);
    put(now.header("etag")).is(204);
    put("*").is(204);
    assert_eq!(
        facts(&server, &id),
        json!({ "weight_kg": 70.0, "walk": false, "quick": false, "inches": false })
    );
}

#[test]
fn a_capture_of_which_nothing_was_measured_is_not_called_measured() {
    let server = Server::new();
    let id = server.capture("coat");
    let place = server.path(&format!("captures/captures/{id}"));
    std::fs::create_dir_all(place.join("out")).unwrap();
    let ended =
        json!({ "state": "done", "why": [], "warnings": [], "seconds": 3.0, "results": {} });
    std::fs::write(place.join("ended.json"), ended.to_string()).unwrap();
    let missing = json!([{ "name": "WC", "why": "no two legs were found: is the body cut off, or does a coat or a skirt hide them?" }]);
    let girths = json!({ "unit": "cm", "girths": [], "missing": missing, "ratios": {} });
    std::fs::write(place.join("out/girths.json"), girths.to_string()).unwrap();
    let page = |path: &str| server.ask("GET", path, &Value::Null).is(200).text();
    for path in ["/", "/rows", &format!("/captures/{id}")] {
        let page = page(path);
        assert!(page.contains("No girth could be measured"), "{page}");
        assert!(
            !page.contains(">Measured<") && !page.contains("Measured (3 s)"),
            "{page}"
        );
    }
    let listed = server
        .ask("GET", "/api/captures", &Value::Null)
        .is(200)
        .json();
    assert_eq!(listed["captures"][0]["girths"], 0, "{listed}");
}

#[test]
fn a_plate_that_is_no_photo_of_the_capture_is_refused() {
    let server = Server::new();
    let id = server.capture("anna");
    let photo = std::fs::read(&photos()[0]).unwrap();
    for number in [1, 2] {
        server.send(&id, number, "a.jpg", &photo).is(200);
    }
    let path = format!("/api/captures/{id}/facts");
    for method in ["PUT", "PATCH"] {
        let answer = server.ask(method, &path, &json!({ "plate": 77 }));
        let answer = answer.is(422).json();
        assert_eq!(answer["code"], "wrong-plate", "{answer}");
        let why = answer["error"].as_str().unwrap();
        assert!(why.contains("77") && why.contains("files: 2"), "{why}");
    }
    server.ask("PATCH", &path, &json!({ "plate": 2 })).is(204);
    // A plate that is taken out of the capture is chosen no longer.
    let file = format!("/api/captures/{id}/files/2");
    server.ask("DELETE", &file, &Value::Null).is(204);
    assert_eq!(facts(&server, &id)["plate"], Value::Null);
}
