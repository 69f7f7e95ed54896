//! Holes of a scan that were closed by flat covers: tapes over them are short, and their intervals are wider.

use crate::made;

use made::{Given, built, meshed};
use shape::Mesh;
use std::collections::{BTreeMap, BTreeSet};

/// The surface with a hole about a place of it, closed by a fan about the middle of its edge. \[mm\]
fn covered(mesh: &Mesh, at: [f64; 3], radius: f64) -> Mesh {
    let far = |v: u32| (mesh.point(v) - nalgebra::Point3::from(at)).norm();
    let mut out = mesh.clone();
    out.faces.retain(|f| f.iter().any(|v| far(*v) > radius));
    let sides = |f: &[u32; 3]| [(f[0], f[1]), (f[1], f[2]), (f[2], f[0])];
    let all: Vec<(u32, u32)> = out.faces.iter().flat_map(sides).collect();
    let known: BTreeSet<_> = all.iter().copied().collect();
    let open: BTreeMap<u32, u32> = all
        .iter()
        .filter(|(a, b)| !known.contains(&(*b, *a)))
        .map(|(a, b)| (*b, *a))
        .collect();
    assert!(open.len() > 12, "no hole");
    let middle = open
        .keys()
        .map(|v| mesh.point(*v).coords)
        .sum::<nalgebra::Vector3<f64>>()
        / open.len() as f64;
    let new = out.positions.len() as u32;
    out.positions
        .push([middle.x, middle.y, middle.z].map(|x| x as f32));
    out.faces
        .extend(open.iter().map(|(from, to)| [*from, *to, new]));
    out.validate_closed().unwrap();
    out
}

#[test]
fn a_tape_over_a_hole_closed_flat_has_a_wider_interval_and_the_rest_stays() {
    let mesh = meshed(&built(1700.0, 1.0, 30.0), 8.0);
    let landmarks = Given::of(&mesh).landmarks();
    let free = Given::of(&mesh).girths(&landmarks, &Default::default());
    let waist = free.get("WC").unwrap();
    let side = waist
        .contour
        .iter()
        .max_by(|a, b| a[0].total_cmp(&b[0]))
        .unwrap();
    for radius in [25.0, 70.0, 100.0] {
        let given = Given::of(&covered(&mesh, side.map(f64::from), radius));
        let girths = given.girths(&landmarks, &Default::default());
        let over = girths.get("WC").unwrap();
        let [low, high] = over.interval_mm.unwrap();
        assert!(over.tape_mm < waist.tape_mm, "{radius}");
        assert!(
            (low..=high).contains(&waist.tape_mm),
            "{radius}: {low} to {high} for {}",
            waist.tape_mm
        );
        let half = |g: &shape::Girth| g.interval_mm.map(|[low, high]| (high - low) / 2.0).unwrap();
        assert!(half(over) > half(waist) + 0.5 * (waist.tape_mm - over.tape_mm));
        let warned = given.warned.0.lock().unwrap();
        let names = warned.iter().filter(|w| w.contains("flat cover"));
        assert_eq!(names.count() > 0, radius > 60.0, "{radius}");
        // But for what the surface's mean edge makes of their intervals.
        for name in ["CFC_L", "CFC_R", "NC"] {
            let (there, own) = (girths.get(name).unwrap(), free.get(name).unwrap());
            assert_eq!(there.tape_mm, own.tape_mm, "{name}");
            proof::near(half(there), half(own), 0.05);
        }
    }
}
