//! What the program reads on the necks of made bodies, as a table that `pipelines/fit-levels.toml` fits on.
//!
//! ```sh
//! cargo run --release -p measure --features tables --example neck_features -- MADE > models/tables/neck.csv
//! ```
//!
//! `MADE` is the folder that `models/made/make_bodies.py` wrote. Offsets are along the neck's axis from its
//! tightest section, as shares of its diameter `unit_mm`; `notch` and `larynx` are carried template vertices, `rig_lean`
//! \[rad\] the forward lean of the line of the rig's joints; `t00`… are tapes square to the axis, as shares of
//! the tightest; `refused` is 1 where the neck is a groove, of which no level is estimated.

mod made_bodies;

use made_bodies::{Fault, read, written};
use measure::{NeckFeatures, is_groove, neck_features};
use nalgebra::{Point3, Vector3};
use serde_json::Value;
use std::path::Path;

/// Offsets of tapes: from, step, how many; shares of the diameter.
const PROFILE: (f64, f64, usize) = (-0.6, 0.05, 25);

fn main() -> Result<(), Fault> {
    let mut header: Vec<String> = [
        "family", "id", "repeats", "stature", "unit_mm", "refused", "notch", "larynx", "rig_lean",
    ]
    .map(str::to_owned)
    .to_vec();
    header.extend(NeckFeatures::NAMES.map(|n| format!("f.{n}")));
    header.extend((0..PROFILE.2).map(|k| format!("t{k:02}")));
    written(header, row)
}

/// One body's row; `None` where the program finds no neck on it, which is printed.
fn row(path: &Path) -> Result<Option<Vec<String>>, Fault> {
    let made = read(path)?;
    let neck = made.standing().and_then(|b| neck_features(&made.mesh, &b));
    let Some(neck) = neck else {
        eprintln!("{}: no neck", made.id);
        return Ok(None);
    };
    let d = neck.diameter_mm();
    let offset = |mark: &str| {
        let place: [f64; 3] =
            std::array::from_fn(|k| made.truth["marks"][mark][k].as_f64().unwrap_or(f64::NAN));
        let way = Point3::from(place) - Point3::from(neck.origin_mm());
        way.dot(&Vector3::from(neck.axis())) / d
    };
    let (low, step, steps) = PROFILE;
    let tape = |k: usize| neck.tape_mm((low + step * k as f64) * d);
    let mut row = vec![made.text("family"), made.id.clone(), made.text("repeats")];
    let number = |v: Option<f64>| {
        v.filter(|v| v.is_finite())
            .map_or(String::new(), |v| format!("{v:.4}"))
    };
    let stature = made.truth["stature"]
        .as_f64()
        .ok_or("a truth without stature")?;
    row.extend([format!("{stature:.0}"), format!("{d:.2}")]);
    row.push(u8::from(is_groove(&neck)).to_string());
    row.extend(["suprasternale", "larynx"].map(|mark| number(Some(offset(mark)))));
    row.push(number(rig_lean(&made.truth, &neck)));
    row.extend(neck.values().map(|v| format!("{v:.4}")));
    row.extend((0..steps).map(|k| number(tape(k).map(|t| t / neck.girth_mm()))));
    Ok(Some(row))
}

/// How far forward the line of the rig's joints leans. \[rad\]
fn rig_lean(truth: &Value, neck: &NeckFeatures) -> Option<f64> {
    let normal = truth["planes"]["neck"]["normal"].as_array()?;
    let n: Vec<f64> = normal.iter().filter_map(Value::as_f64).collect();
    let [x, y, z] = n.as_slice() else { return None };
    let ahead = neck.front();
    Some(libm::atan2(x * ahead[0] + y * ahead[1], *z))
}
