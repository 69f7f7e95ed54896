//! Tapes against the true surface cut by the very planes that were measured: the surface's share of an
//! error. What is left of it is the level's.

use crate::score::align::Motion;
use crate::score::girths::GirthScore;
use crate::score::truth::{Unreadable, json};
use crate::sections::{flat, section, tape};
use nalgebra::{Point3, Vector3};
use serde::Serialize;
use serde_json::Value;
use shape::{Mesh, Plane};
use std::collections::BTreeMap;
use std::path::Path;

/// One tape against the true surface at the plane that was measured.
#[derive(Debug, Clone, Serialize)]
pub struct PlaneScore {
    /// The tape around the true surface there. \[cm\]
    pub truth_there_cm: f64,
    /// The tape that was measured. \[cm\]
    pub tape_cm: f64,
    /// Its relative error: the surface's alone.
    pub tape_pct: f64,
    /// Its error. \[mm\]
    pub tape_mm: f64,
}

/// A closed curve of a section.
struct Curve {
    tape_mm: f64,
    /// Middle of its box. \[mm\]
    middle: Point3<f64>,
}

fn curves(mesh: &Mesh, plane: &Plane) -> Vec<Curve> {
    let curve = |points: Vec<Point3<f64>>| {
        let bound = |pick: fn(f64, f64) -> f64| {
            let all = points.iter().map(|p| p.coords);
            all.reduce(|a, b| a.zip_map(&b, pick)).unwrap_or_default()
        };
        Curve {
            tape_mm: tape(&flat(&points, plane)),
            middle: Point3::from((bound(f64::min) + bound(f64::max)) / 2.0),
        }
    };
    section(mesh, plane).into_iter().map(curve).collect()
}

/// A found tape that differs by more from every curve of its own surface was parted from a limb: no
/// curve is it.
const PARTED: f64 = 0.1;

/// Those whose middles are about a plane's point, which is in the middle of the girth's own part: by no more than a tape's
/// mean diameter. Another limb may be cut by the same plane, and be as thick.
fn about(curves: Vec<Curve>, point: Point3<f64>, tape_mm: f64) -> Vec<Curve> {
    let near = |c: &Curve| (c.middle - point).norm() <= tape_mm / std::f64::consts::PI;
    curves.into_iter().filter(near).collect()
}

/// The tape of the true surface at a plane that was measured: of the curve that is most like the found one
/// in place and length. \[mm\]
fn there(found: &[Curve], truth: &[Curve], tape_mm: f64) -> Option<f64> {
    let nearest = |a: &&Curve, b: &&Curve| {
        let off = |c: &Curve| (c.tape_mm - tape_mm).abs();
        off(a).total_cmp(&off(b))
    };
    let own = found.iter().min_by(nearest);
    let own = own.filter(|c| (c.tape_mm / tape_mm - 1.0).abs() <= PARTED);
    let off = |c: &Curve| {
        // Without a curve of its own, by length alone.
        let far = own.map_or(0.0, |own| (c.middle - own.middle).norm());
        (c.tape_mm - tape_mm).abs() + far
    };
    let like = truth.iter().min_by(|a, b| off(a).total_cmp(&off(b)));
    // Where the true surface, too, has a limb there that was parted, it shows nothing of the tape.
    let fits = |c: &&Curve| own.is_some() || (c.tape_mm / tape_mm - 1.0).abs() <= PARTED;
    like.filter(fits).map(|c| c.tape_mm)
}

/// Every girth of a `girths.json` that has a plane and a tape; `None` where the plane misses the truth, or
/// goes through a limb that the true surface joins to the trunk there.
/// `found` is the surface as it was found, `carry` what brings it onto the truth.
pub(crate) fn at_planes(
    path: &Path,
    found: &Mesh,
    truth: &Mesh,
    carry: &Motion,
) -> Result<BTreeMap<String, Option<PlaneScore>>, Unreadable> {
    let file = json(path)?.unwrap_or(Value::Null);
    let list = file.get("girths").and_then(Value::as_array);
    let mut scores = BTreeMap::new();
    for girth in list.into_iter().flatten() {
        let numbers = |key: &str| -> Option<[f64; 3]> {
            let list = girth.get("plane")?.get(key)?.as_array()?;
            let all: Option<Vec<f64>> = list.iter().map(Value::as_f64).collect();
            all?.try_into().ok()
        };
        let name = girth.get("name").and_then(Value::as_str);
        let tape_cm = girth.get("tape_cm").and_then(Value::as_f64);
        let plane = numbers("point_mm").zip(numbers("normal"));
        let (Some(name), Some(tape_cm), Some((point_mm, normal))) = (name, tape_cm, plane) else {
            continue;
        };
        let here = Plane { point_mm, normal };
        let carried = Plane {
            point_mm: carry.apply(&Point3::from(point_mm)).into(),
            normal: (carry.rotation * Vector3::from(normal)).into(),
        };
        let tape_mm = tape_cm * 10.0;
        let mut own = about(curves(found, &here), point_mm.into(), tape_mm);
        own.iter_mut()
            .for_each(|c| c.middle = carry.apply(&c.middle));
        let truth = about(curves(truth, &carried), carried.point_mm.into(), tape_mm);
        let mm = there(&own, &truth, tape_mm);
        let score = mm.map(|mm| PlaneScore {
            truth_there_cm: mm / 10.0,
            tape_cm,
            tape_pct: (tape_cm * 10.0 / mm - 1.0) * 100.0,
            tape_mm: tape_cm * 10.0 - mm,
        });
        scores.insert(name.to_owned(), score);
    }
    Ok(scores)
}

/// Splits errors of girths: what the surface errs at the measured plane, and what the plane adds to it.
pub(crate) fn split(
    girths: &mut BTreeMap<String, Option<GirthScore>>,
    at_planes: &BTreeMap<String, Option<PlaneScore>>,
) {
    let share = |name: &str| Some(at_planes.get(name)?.as_ref()?.tape_mm);
    for (name, score) in girths {
        // The mean of both sides has no plane of its own.
        let both = || {
            let [left, right] = ["L", "R"].map(|side| share(&format!("{name}_{side}")));
            Some((left? + right?) / 2.0)
        };
        if let Some(score) = score {
            score.surface_mm = share(name).or_else(both);
            let whole = score.tape_error_mm.zip(score.surface_mm);
            score.level_mm = whole.map(|(all, surface)| all - surface);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::score::align::Motion;
    use nalgebra::Rotation3;
    use std::f64::consts::TAU;

    /// An upright tube of cones: radii at heights, closed above and below; so many corners around.
    fn tube(middle: [f64; 2], radii: &[(f64, f64)], mesh: &mut Mesh) {
        const N: u32 = 120;
        let first = mesh.positions.len() as u32;
        for (z, r) in radii {
            for k in 0..N {
                let (s, c) = libm::sincos(TAU * f64::from(k) / f64::from(N));
                let p = [middle[0] + r * c, middle[1] + r * s, *z];
                mesh.positions.push(p.map(|x| x as f32));
            }
        }
        let rows = radii.len() as u32;
        for row in 0..rows - 1 {
            for k in 0..N {
                let at = |row: u32, k: u32| first + row * N + k % N;
                let (a, b, c, d) = (
                    at(row, k),
                    at(row, k + 1),
                    at(row + 1, k + 1),
                    at(row + 1, k),
                );
                mesh.faces.extend([[a, b, c], [a, c, d]]);
            }
        }
        for k in 1..N - 1 {
            let top = first + (rows - 1) * N;
            mesh.faces.push([first, first + k + 1, first + k]);
            mesh.faces.push([top, top + k, top + k + 1]);
        }
    }

    #[test]
    fn an_error_is_the_surfaces_at_the_measured_plane_and_else_the_levels() {
        // True: a trunk that narrows upward by 1 mm in 10, and an arm beside it.
        let (mut truth, mut found) = (Mesh::default(), Mesh::default());
        tube([0.0, 0.0], &[(0.0, 150.0), (1000.0, 50.0)], &mut truth);
        tube([250.0, 0.0], &[(0.0, 40.0), (1000.0, 40.0)], &mut truth);
        // Found: 1 mm too fat, turned about the axis and shifted along it.
        let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), 0.3);
        let shift = Vector3::new(0.0, 0.0, 70.0);
        tube([0.0, 0.0], &[(0.0, 151.0), (1000.0, 51.0)], &mut found);
        tube([250.0, 0.0], &[(0.0, 41.0), (1000.0, 41.0)], &mut found);
        for p in &mut found.positions {
            let q = turn * Vector3::from(p.map(f64::from)) - shift;
            *p = q.map(|x| x as f32).into();
        }
        let carry = Motion {
            scale: 1.0,
            rotation: turn.inverse(),
            translation: turn.inverse() * shift,
        };
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("girths.json");
        // The waist is measured at a height of 500, where the truth is 100 mm thick; it belongs at 520.
        let round = |r: f64| 2.0 * 120.0 * r * libm::sin(TAU / 240.0);
        let girth = |name: &str, x: f64, r: f64| {
            let p = turn * Vector3::new(x, 0.0, 500.0) - shift;
            serde_json::json!({
                "name": name, "tape_cm": round(r) / 10.0,
                "plane": { "point_mm": [p.x, p.y, p.z], "normal": [0.0, 0.0, 1.0] },
            })
        };
        let list = [girth("WC", 0.0, 101.0), girth("AC_L", 250.0, 41.0)];
        std::fs::write(&path, serde_json::json!({ "girths": list }).to_string()).unwrap();
        let scores = at_planes(&path, &found, &truth, &carry).unwrap();
        let of = |name: &str| scores[name].as_ref().unwrap();
        proof::near(of("WC").tape_pct, 1.0, 0.01);
        proof::near(of("AC_L").tape_pct, 2.5, 0.01);
        proof::near(of("WC").tape_mm, round(1.0), 0.02);
        let known = (98.0, (round(101.0) / round(98.0) - 1.0) * 100.0);
        let score = GirthScore {
            truth_cm: round(known.0) / 10.0,
            cm: None,
            error_pct: None,
            tape_error_pct: Some(known.1),
            tape_error_mm: Some(round(101.0) - round(98.0)),
            interval_holds: None,
            iso_mm: 9.0,
            surface_mm: None,
            level_mm: None,
        };
        let mut girths = [("WC".to_owned(), Some(score))].into();
        split(&mut girths, &scores);
        let waist = girths["WC"].as_ref().unwrap();
        proof::near(waist.surface_mm.unwrap(), round(1.0), 0.02);
        proof::near(waist.level_mm.unwrap(), round(2.0), 0.02);
    }

    #[test]
    fn a_limb_that_was_parted_is_compared_with_its_own_true_curve_and_no_other_limbs() {
        let at = |x: f64, tape_mm: f64| Curve {
            tape_mm,
            middle: Point3::new(x, 0.0, 0.0),
        };
        let point = Point3::new(100.0, 0.0, 0.0);
        // Found: trunk and upper arm as one, and the other forearm, nearly as thick as what was measured, 153 mm.
        let found = about(vec![at(0.0, 577.0), at(-250.0, 145.0)], point, 153.0);
        assert!(found.is_empty());
        let truth = vec![at(0.0, 496.0), at(101.0, 152.0), at(-250.0, 145.5)];
        assert_eq!(
            there(&found, &about(truth, point, 153.0), 153.0),
            Some(152.0)
        );
        // The truth joins them, too.
        let joined = about(vec![at(60.0, 590.0)], point, 153.0);
        assert_eq!(there(&found, &joined, 153.0), None);
    }
}
