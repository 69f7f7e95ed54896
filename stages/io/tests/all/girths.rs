//! The files that leave the house are what other programs expect: a schema that holds, a table that opens.

use io::{girths_schema, girths_to_csv, girths_to_json};
use serde_json::{Value, json};
use shape::{
    Girth, GirthId, Girths, Landmark, Missing, Note, Part, Plane, Refusal, Side, Sigmas, Split,
    Unit,
};

fn girth(id: GirthId, silhouette_mm: Option<f64>) -> Girth {
    let plane = Plane {
        point_mm: [1.0, 2.0, 1100.0],
        normal: [0.0, 0.0, 1.0],
    };
    Girth {
        contour_mm: 300.5,
        spline_mm: 301.25,
        silhouette_mm,
        interval_mm: Some([296.0, 304.0]),
        sigmas: Sigmas {
            level_mm: Some(2.0),
            surface_mm: Some(1.04),
            scale_mm: None,
            split_mm: Some(0.0),
            cover_mm: Some(0.0),
        },
        repeat_mm: Some(3.1),
        ..Girth::at(&Landmark::new(id, plane, Part::Trunk), 299.96)
    }
}

fn girths() -> Girths {
    let why = "arms and trunk are one, \"fused\": hold the arms farther away, please";
    let missing = Missing::because(GirthId::Chest, Refusal::Fused, why);
    // A neck whose level nobody knows, and that a hand was parted from.
    let mut neck = girth(GirthId::Neck, None);
    neck.interval_mm = None;
    neck.sigmas.level_mm = None;
    neck.split = Some(Split { share: 0.25 });
    neck.notes = vec![Note::Open { share: 0.02 }];
    Girths {
        girths: vec![
            neck,
            girth(GirthId::UpperArm(Side::Left), Some(298.0)),
            girth(GirthId::UpperArm(Side::Right), None),
        ],
        missing: vec![missing],
        ratios: vec![("WHR".into(), 0.9, "".into())],
        stature_mm: Some(1720.0),
        ..Girths::default()
    }
}

/// The faults of a value by a JSON schema: as much of it as ours uses.
fn faults(root: &Value, schema: &Value, value: &Value, at: &str) -> Vec<String> {
    let mut found = Vec::new();
    for (rule, wanted) in schema.as_object().unwrap() {
        let fits = |kind: &str| match kind {
            "object" => value.is_object(),
            "array" => value.is_array(),
            "string" => value.is_string(),
            "number" => value.is_number(),
            "null" => value.is_null(),
            other => panic!("{other} is no type"),
        };
        let length = value.as_array().map(Vec::len);
        let holds = match rule.as_str() {
            "$schema" | "title" | "description" => true,
            "type" => match wanted {
                Value::Array(kinds) => kinds.iter().any(|k| fits(k.as_str().unwrap())),
                kind => fits(kind.as_str().unwrap()),
            },
            "$defs" => true,
            "const" => value == wanted,
            "enum" => wanted.as_array().unwrap().contains(value),
            "$ref" => {
                let pointer = wanted.as_str().unwrap().trim_start_matches('#');
                found.extend(faults(root, root.pointer(pointer).unwrap(), value, at));
                true
            }
            // The faults of the alternative that has fewest.
            "anyOf" => {
                let each = wanted.as_array().unwrap().iter();
                let each = each.map(|one| faults(root, one, value, at));
                found.extend(each.min_by_key(Vec::len).unwrap());
                true
            }
            "minItems" => length.is_none_or(|n| n as u64 >= wanted.as_u64().unwrap()),
            "maxItems" => length.is_none_or(|n| n as u64 <= wanted.as_u64().unwrap()),
            "required" => {
                let names = wanted.as_array().unwrap();
                names
                    .iter()
                    .all(|name| value.get(name.as_str().unwrap()).is_some())
            }
            "items" => {
                for (i, item) in value.as_array().into_iter().flatten().enumerate() {
                    found.extend(faults(root, wanted, item, &format!("{at}/{i}")));
                }
                true
            }
            "properties" => {
                for (name, schema) in wanted.as_object().unwrap() {
                    if let Some(value) = value.get(name) {
                        found.extend(faults(root, schema, value, &format!("{at}/{name}")));
                    }
                }
                true
            }
            "additionalProperties" => {
                let known = |name: &String| schema["properties"].get(name).is_some();
                let more = value.as_object().into_iter().flatten();
                let more: Vec<_> = more.filter(|(name, _)| !known(name)).collect();
                if wanted.is_object() {
                    for (name, other) in &more {
                        found.extend(faults(root, wanted, other, &format!("{at}/{name}")));
                    }
                }
                wanted.is_object() || more.is_empty()
            }
            other => panic!("this test does not know `{other}`"),
        };
        if !holds {
            found.push(format!("{at}: {rule}"));
        }
    }
    found
}

#[test]
fn girths_json_keeps_to_its_schema() {
    let schema: Value = serde_json::from_str(girths_schema()).unwrap();
    let relative = Girths {
        unit: Unit::Relative,
        ..girths()
    };
    for girths in [girths(), relative, Girths::default()] {
        let value = serde_json::from_str(&girths_to_json(&girths)).unwrap();
        assert_eq!(faults(&schema, &schema, &value, ""), Vec::<String>::new());
    }
}

#[test]
fn the_schema_notices_what_is_wrong() {
    let schema: Value = serde_json::from_str(girths_schema()).unwrap();
    let good: Value = serde_json::from_str(&girths_to_json(&girths())).unwrap();
    for (place, wrong, fault) in [
        ("/unit", json!("mm"), "/unit: enum"),
        ("/girths/0/cm", json!("30"), "/girths/0/cm: type"),
        (
            "/girths/1/interval_cm",
            json!([1.0]),
            "/girths/1/interval_cm: minItems",
        ),
        ("/girths/1", json!({}), "/girths/1: required"),
        ("/ratios", json!({ "WHR": null }), "/ratios/WHR: type"),
        (
            "/missing/0",
            json!({ "name": "", "reason": "hand", "why": "", "x": 1 }),
            "/missing/0: additionalProperties",
        ),
        (
            "/missing/0/reason",
            json!("just so"),
            "/missing/0/reason: enum",
        ),
        (
            "/girths/2/sigma_cm/level",
            json!("0"),
            "/girths/2/sigma_cm/level: type",
        ),
    ] {
        let mut bad = good.clone();
        *bad.pointer_mut(place).unwrap() = wrong;
        assert_eq!(faults(&schema, &schema, &bad, ""), [fault]);
    }
}

/// Rows and fields by RFC 4180.
fn cells(csv: &str) -> Vec<Vec<String>> {
    let mut rows = vec![vec![String::new()]];
    let (mut quoted, mut letters) = (false, csv.chars().peekable());
    while let Some(letter) = letters.next() {
        let row = rows.last_mut().unwrap();
        match letter {
            '"' if quoted && letters.peek() == Some(&'"') => {
                row.last_mut().unwrap().push(letters.next().unwrap());
            }
            '"' => quoted = !quoted,
            ',' if !quoted => row.push(String::new()),
            '\n' if !quoted => rows.push(vec![String::new()]),
            other => row.last_mut().unwrap().push(other),
        }
    }
    assert_eq!(rows.pop(), Some(vec![String::new()]), "ends with a line");
    rows
}

#[test]
fn girths_csv_is_a_table_whose_numbers_are_numbers() {
    let rows = cells(&girths_to_csv(&girths()));
    let head = &rows[0];
    let column = |name: &str| head.iter().position(|h| h == name).unwrap();
    assert!(rows.iter().all(|row| row.len() == head.len()));
    let names: Vec<_> = rows[1..].iter().map(|row| row[0].as_str()).collect();
    assert_eq!(names, ["NC", "AC_L", "AC_R", "AC", "CC"]);
    for (row, name, cell) in [
        (1, "tape_cm", "30.00"),
        (1, "silhouette_cm", ""),
        (1, "height_cm", "110.00"),
        (2, "label", "upper arm, left"),
        (2, "silhouette_cm", "29.80"),
        (4, "spline_cm", "30.13"),
        (4, "note", "mean of AC_L and AC_R"),
        (4, "repeat_cm", "0.31"),
        (1, "interval_low_cm", ""),
        (1, "sigma_level_cm", ""),
        (2, "sigma_level_cm", "0.20"),
        (2, "sigma_scale_cm", ""),
        (2, "sigma_split_cm", "0.00"),
        (5, "tape_cm", ""),
        (
            5,
            "note",
            "arms and trunk are one, \"fused\": hold the arms farther away, please",
        ),
    ] {
        assert_eq!(rows[row][column(name)], cell, "{name} of row {row}");
    }
    for row in &rows[1..] {
        let numbers = (0..row.len()).filter(|i| head[*i].ends_with("_cm") || head[*i] == "cm");
        let number = |i: usize| row[i].is_empty() || row[i].parse::<f64>().is_ok();
        assert!(numbers.into_iter().all(number), "{row:?}");
    }
}

#[test]
fn what_is_unknown_is_null_and_what_is_none_is_zero() {
    let file: Value = serde_json::from_str(&girths_to_json(&girths())).unwrap();
    let at = |place: &str| file.pointer(place).unwrap().clone();
    assert_eq!(at("/girths/0/interval_cm"), Value::Null);
    assert_eq!(
        at("/girths/1/sigma_cm"),
        json!({ "level": 0.2, "surface": 0.1, "scale": null, "split": 0.0, "cover": 0.0 })
    );
    assert_eq!(at("/girths/1/iso8559"), json!("5.3.16"));
    assert_eq!(at("/missing/0/reason"), json!("fused"));
    let notes = at("/girths/0/notes").to_string();
    for note in ["25 %", "unknown how sure the level is", "2.0 % of the tape"] {
        assert!(notes.contains(note), "{notes}");
    }
}

#[test]
fn relative_lengths_name_no_centimetres() {
    let relative = Girths {
        unit: Unit::Relative,
        ..girths()
    };
    for text in [girths_to_json(&relative), girths_to_csv(&relative)] {
        assert!(
            !text.contains("_cm") && !text.contains("\"cm\"") && !text.contains("_mm"),
            "{text}"
        );
    }
    let file: Value = serde_json::from_str(&girths_to_json(&relative)).unwrap();
    assert_eq!(file["unit"], "relative");
    // 1 is the camera ring's radius, called 1000 mm inside.
    assert_eq!(file["girths"][1]["tape_rel"], 0.29996);
    let rows = cells(&girths_to_csv(&relative));
    assert_eq!(
        (rows[0][2].as_str(), rows[1][2].as_str()),
        ("tape_rel", "0.29996")
    );
}
