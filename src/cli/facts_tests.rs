//! Every key of capture.toml has its flag, in its unit.

use super::*;
use clap::Parser;
use stage::Value;
use std::collections::BTreeMap;

#[derive(Parser)]
struct Line {
    #[command(flatten)]
    facts: Facts,
}

fn stated(flags: &str) -> Vec<Stated> {
    let words = std::iter::once("x").chain(flags.split_whitespace());
    let line = Line::try_parse_from(words).unwrap_or_else(|e| panic!("{e}"));
    line.facts
        .stated()
        .unwrap_or_else(|fault| panic!("{}", fault.text()))
}

/// The keys that capture.toml knows in a table, as its reader names them beside one that it does not know.
fn known(table: &str) -> Vec<String> {
    let mat = "mat = { tag_size_mm = 60, count = 12, ring_radius_mm = 187 }\n";
    let text = match table {
        "" => "nobody = 1".to_owned(),
        "rim" => format!(
            "{mat}rim = {{ tag_size_mm = 24, ids = [12, 20], radius_mm = 200, nobody = 1 }}"
        ),
        "reference" => "reference = { length_mm = 1, nobody = 1 }".into(),
        "mat" => "mat = { tag_size_mm = 60, nobody = 1 }".into(),
        table => format!("{table} = {{ nobody = 1 }}"),
    };
    let facts = text.parse::<toml::Table>().unwrap();
    let sets = facts
        .iter()
        .map(|(k, v)| (k.clone(), crate::recipe::parse_value(&v.to_string())));
    let stated = BTreeMap::from([("facts".to_owned(), Value::Table(sets.collect()))]);
    let stage = crate::catalog::find("capture.load").unwrap();
    let Err(mistakes) = stage.check(&stated) else {
        panic!("{text} passes")
    };
    let (_, known) = mistakes[0]
        .what
        .split_once("known: ")
        .expect(&mistakes[0].what);
    known.split(", ").map(str::to_owned).collect()
}

#[test]
fn every_key_of_capture_toml_has_its_flag() {
    let all = stated(
        "--stature 178 --weight 80 --sex male --born 2016-05-01 --focal 26 --focal-px 3000 --centre-px 4,5 --step 20 --views 18 --images a.jpg \
         --plate p.jpg --name me --date 2026-05-01 --disk-diameter 70 --mat-tag 60 --mat-ids 0-11 --mat-ring 187 --rim-tag 24 \
         --rim-ids 12-47 --rim-radius 225 --reference tag_size=60 --seen a.jpg=1,2,3,4",
    )
    .into_iter()
    .chain(stated("--age 9.5"));
    let all: Vec<Stated> = all.collect();
    let places: Vec<&str> = all
        .iter()
        .map(|s| s.set.split('=').next().unwrap())
        .collect();
    let tables = ["camera", "subject", "disk", "mat", "rim", "reference"];
    // What nobody reads needs no flag: names of cameras, what is on the disk, the one family.
    let silent = ["make", "model", "top", "family"];
    for table in [""].iter().chain(&tables) {
        let keys = known(table);
        assert!(keys.len() > 1, "{table}: {keys:?}");
        for key in keys
            .iter()
            .filter(|k| !silent.contains(&k.as_str()) && !tables.contains(&k.as_str()))
        {
            let place = match *table {
                "" => place(key),
                table => place(&format!("{table}.{key}")),
            };
            assert!(places.contains(&place.as_str()), "{place} has no flag");
        }
    }
}

#[test]
fn flags_become_keys_in_their_units() {
    let sets = |flags: &str| -> Vec<String> { stated(flags).into_iter().map(|s| s.set).collect() };
    assert_eq!(
        sets("--stature 5ft10in"),
        ["photos.facts.subject.height_cm=177.8"]
    );
    // What is personal is no fact of the photos.
    assert_eq!(sets("--age 9y6mo"), ["person.facts.subject.age_years=9.5"]);
    assert_eq!(
        sets("--fact subject.sex=male"),
        ["person.facts.subject.sex=male"]
    );
    assert_eq!(sets("--steps 18"), ["photos.facts.step_deg=20.0"]);
    assert_eq!(sets("--mat-tag 6cm"), ["photos.facts.mat.tag_size_mm=60.0"]);
    assert_eq!(
        sets("--seen a.jpg=1,2,3,4 --seen b.jpg=5,6,7,8.5"),
        [
            "photos.facts.reference.seen={ \"a.jpg\" = [1.0, 2.0, 3.0, 4.0], \"b.jpg\" = [5.0, 6.0, 7.0, 8.5] }"
        ]
    );
    let two = sets("--mat-ids 4-15");
    assert_eq!(
        two,
        ["photos.facts.mat.ids=[4, 15]", "photos.facts.mat.count=12"]
    );
    assert_eq!(
        sets("--fact camera.make=\"x\""),
        ["photos.facts.camera.make=\"x\""]
    );
}

#[test]
fn a_photo_is_pointed_at_once() {
    let words = "x --seen a.jpg=1,2,3,4 --seen b.jpg=5,6,7,8 --seen a.jpg=1,2,3,5";
    let line = Line::try_parse_from(words.split_whitespace()).unwrap_or_else(|e| panic!("{e}"));
    let fault = line.facts.stated().err().expect("named twice");
    let text = fault.text();
    assert!(text.contains("a.jpg was named before"), "{text}");
}
