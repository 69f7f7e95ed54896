//! What the program reads on made bodies, as the table that `pipelines/fit-levels.toml` fits on.
//!
//! ```sh
//! cargo run --release -p measure --features tables --example feature_table -- MADE > models/tables/made-bodies.csv
//! ```
//!
//! `MADE` is the folder that `models/made/make_bodies.py` wrote.

mod made_bodies;

use made_bodies::{Fault, read, written};
use measure::{Reading, marks, readings};
use nalgebra::Point3;
use std::path::Path;

/// Heights of the tape's profile: from 0.45 of stature on, 71 steps of 0.005.
const PROFILE: (f64, f64, usize) = (0.45, 0.005, 71);
/// True measures, and where the truth has them.
const MARKS: [(&str, &str); 5] = [
    ("a.crotch", "crotch"),
    ("a.buttock", "buttock"),
    ("a.navel", "navel"),
    ("a.cervicale", "cervicale"),
    ("a.chest", "nipple_l"),
];

fn main() -> Result<(), Fault> {
    let mut header: Vec<String> = ["family", "id", "repeats", "person", "grown", "stature"]
        .map(str::to_owned)
        .to_vec();
    header.extend(Reading::ALL.iter().map(|r| format!("r.{}", r.name())));
    header.push("a.ln_stature".into());
    header.extend(MARKS.iter().map(|m| m.0.to_owned()));
    header.extend(
        [
            "a.neck_girth",
            "a.hip_girth",
            "a.navel_girth",
            "a.chest_girth",
        ]
        .map(str::to_owned),
    );
    header.extend(["l.waist", "l.navel", "l.hip_bone", "l.chest"].map(str::to_owned));
    let (_, _, steps) = PROFILE;
    header.extend((0..steps).map(|k| format!("t{k:02}")));
    written(header, row)
}

/// One body's row; `None` where the program finds no marks on it, which is printed.
fn row(path: &Path) -> Result<Option<Vec<String>>, Fault> {
    let made = read(path)?;
    let (truth, mesh, id) = (&made.truth, &made.mesh, made.id.clone());
    let Some(body) = made.standing() else {
        eprintln!("{id}: no body");
        return Ok(None);
    };
    let Some(read) = marks(&body).and_then(|m| readings(&body, &m, true)) else {
        eprintln!("{id}: no marks");
        return Ok(None);
    };
    let s = truth["stature"].as_f64().ok_or("a truth without stature")?;
    let share = |v: Option<f64>| v.map_or(String::new(), |v| format!("{:.5}", v / s));
    let height = |mark: &str| truth["marks"][mark][2].as_f64();
    let tape = |plane: &str| truth["planes"][plane]["tape_clean"].as_f64();
    let grown = truth["phenotype"]["age"]
        .as_f64()
        .is_none_or(|age| age >= GROWN_UP);
    let person = truth["person"]
        .as_u64()
        .map_or(String::new(), |p| p.to_string());
    let mut row = vec![made.text("family"), id, made.text("repeats"), person];
    row.push(u8::from(grown).to_string());
    row.push(format!("{s:.1}"));
    let number = |v: Option<f64>| v.map_or(String::new(), |v| format!("{v:.5}"));
    row.extend(Reading::ALL.iter().map(|r| number(read.get(*r))));
    row.push(number(Some(libm::log(s / 1700.0))));
    row.extend(MARKS.iter().map(|m| share(height(m.1))));
    row.extend(["neck", "hip", "navel", "chest"].map(|p| share(tape(p))));
    // Waist and hip bone are known only where a body was driven to a measured person.
    let level = |key: &str| share(truth["planes"][key]["point"][2].as_f64());
    row.push(level("waist"));
    row.push(share(height("navel")));
    row.push(level("crest"));
    row.push(share(height("nipple_l")));
    let (low, step, steps) = PROFILE;
    let at = |k: usize| {
        let z = body.ground + (low + step * k as f64) * s;
        let merged = [1.0, -1.0]
            .iter()
            .any(|side| measure::merged(&body, z, *side));
        let plane = measure::level(z);
        let middle = body.trunk(z)?.centre;
        let far = |p: &Point3<f64>| (p - middle).norm();
        let rings = measure::rings(mesh, &plane);
        let ring = rings
            .iter()
            .min_by(|a, b| far(&a.centre).total_cmp(&far(&b.centre)))?;
        (!merged).then_some(ring.tape)
    };
    row.extend((0..steps).map(|k| share(at(k))));
    Ok(Some(row))
}

/// Age from which a made body is grown up, as its phenotype has it: 0 newborn, 1/3 baby, 2/3 young, 1 old.
const GROWN_UP: f64 = 0.6;
