//! What the program reads on the arms of made bodies, as a table that `pipelines/fit-levels.toml` fits on.
//!
//! ```sh
//! cargo run --release -p measure --features tables --example arm_features -- MADE > models/tables/arms.csv
//! ```
//!
//! `MADE` is the folder that `models/made/make_bodies.py` wrote. A row an arm. Ways are along the straight line
//! of the upper arm from the estimated wrist, as shares of the given stature `unit_mm`: `acromion`, `elbow`
//! (joint), `upper_arm` (midway between acromion and elbow tip) and `wrist` (joint) are true; `t00`… are tapes
//! across that line \[mm\] where the arm is alone; `refused` is 1 where the arm was not followed.

mod made_bodies;

use made_bodies::{Fault, MadeBody, read, written};
use measure::{ArmSeen, Limb, Limbs, Line, limbs, rings};
use nalgebra::Point3;
use shape::{Mesh, Plane};
use std::path::Path;

/// Ways of tapes: from, step, how many; shares of stature.
const PROFILE: (f64, f64, usize) = (0.17, 0.01, 13);
/// How far a ring's middle may be from the line, as a share of stature.
const OFF: f64 = 0.03;

fn main() -> Result<(), Fault> {
    let mut header: Vec<String> = [
        "family",
        "id",
        "repeats",
        "unit_mm",
        "refused",
        "acromion",
        "elbow",
        "upper_arm",
        "wrist",
    ]
    .map(str::to_owned)
    .to_vec();
    header.extend(ArmSeen::NAMES.map(|n| format!("f.{n}")));
    header.extend((0..PROFILE.2).map(|k| format!("t{k:02}")));
    written(header, rows)
}

/// Both arms of a body; none where the program finds no body, which is printed.
fn rows(path: &Path) -> Result<Vec<Vec<String>>, Fault> {
    let made = read(path)?;
    let Some(body) = made.standing() else {
        eprintln!("{}: no body", made.id);
        return Ok(Vec::new());
    };
    let limbs = limbs(&made.mesh, &body);
    let sides = [("l", 1.0), ("r", -1.0)];
    Ok(sides
        .map(|(name, side)| row(&made, &limbs, body.stature, name, side))
        .to_vec())
}

fn number(v: Option<f64>) -> String {
    v.filter(|v| v.is_finite())
        .map_or(String::new(), |v| format!("{v:.4}"))
}

fn row(made: &MadeBody, limbs: &Limbs<'_>, stature: f64, name: &str, side: f64) -> Vec<String> {
    let repeats = Some(made.text("repeats")).filter(|r| !r.is_empty());
    let own = |id: &str| format!("{id}_{name}");
    let mut row = vec![made.text("family"), own(&made.id)];
    row.push(repeats.map_or(String::new(), |r| own(&r)));
    row.push(format!("{stature:.1}"));
    let shown = limbs
        .arm(side)
        .ok()
        .and_then(|arm| Some((arm, arm.seen?, arm.root_line?)));
    row.push(u8::from(shown.is_none()).to_string());
    let Some((arm, seen, line)) = shown else {
        row.resize(9 + ArmSeen::NAMES.len() + PROFILE.2, String::new());
        return row;
    };
    let way = |p: Point3<f64>| seen.last - seen.wrist + line.along.dot(&(p - line.point));
    let mark = |mark: &str| point(made, &["marks", &format!("{mark}_{name}")]);
    row.push(number(mark("acromion").map(|p| way(p) / stature)));
    row.push(number(mark("joint_elbow").map(|p| way(p) / stature)));
    let plane = point(made, &["planes", &format!("upper_arm_{name}"), "point"]);
    row.push(number(plane.map(|p| way(p) / stature)));
    let wrist = mark("joint_wrist").and_then(|p| nearest(arm, p));
    row.push(number(wrist.map(|s| (s - seen.wrist) / stature)));
    row.extend(ArmSeen::NAMES.map(|n| number(seen.get(n))));
    let (low, step, steps) = PROFILE;
    let tape = |k: usize| {
        let s = (low + step * k as f64) * stature + seen.wrist - seen.last;
        tape(&made.mesh, &line, s, stature)
    };
    row.extend((0..steps).map(|k| tape(k).map_or(String::new(), |t| format!("{t:.1}"))));
    row
}

/// A place of the truth. \[mm\]
fn point(made: &MadeBody, keys: &[&str]) -> Option<Point3<f64>> {
    let at = keys.iter().fold(&made.truth, |value, key| &value[key]);
    Some(Point3::new(
        at[0].as_f64()?,
        at[1].as_f64()?,
        at[2].as_f64()?,
    ))
}

/// The way of an arm's line nearest to a place. \[mm\]
fn nearest(arm: &Limb, p: Point3<f64>) -> Option<f64> {
    let far = |s: &f64| (arm.point(*s) - p).norm();
    (0..=(arm.clear_to() as usize))
        .map(|mm| mm as f64)
        .min_by(|a, b| far(a).total_cmp(&far(b)))
}

/// The tape across the upper arm's line so far beyond its own point. \[mm\] `None` where the arm is not alone.
fn tape(mesh: &Mesh, line: &Line, beyond: f64, stature: f64) -> Option<f64> {
    let p = line.point + line.along * beyond;
    let plane = Plane {
        point_mm: p.into(),
        normal: (-line.along).into(),
    };
    let far = |c: &Point3<f64>| (c - p).norm();
    let all = rings(mesh, &plane);
    let ring = all
        .iter()
        .min_by(|a, b| far(&a.centre).total_cmp(&far(&b.centre)))?;
    (far(&ring.centre) < OFF * stature).then_some(ring.tape)
}
