//! Clothes that hang away from the legs: hips and thighs under them are not taken for the body's.

use crate::made;

use shape::{Girths, Mesh, Note, Refusal};

/// A body in shorts that hang so far away, from above the knees to the waist. \[mm\]
fn dressed(off_mm: f32) -> Mesh {
    let mut mesh = made::meshed(&made::built(1700.0, 1.0, 30.0), 8.0);
    let normals = mesh.normals();
    for (at, n) in mesh.positions.iter_mut().zip(normals) {
        let aside = libm::hypot(n.x, n.y) as f32;
        if (560.0..1000.0).contains(&at[2]) && at[0].abs() < 230.0 && aside > 0.0 {
            at[0] += off_mm * n.x as f32 / aside;
            at[1] += off_mm * n.y as f32 / aside;
        }
    }
    mesh
}

/// Shares of tapes that may be clothes, by girth.
fn worn(girths: &Girths) -> Vec<(&str, f64)> {
    let note = |n: &Note| match n {
        Note::Worn { share } => Some(*share),
        _ => None,
    };
    let all = girths.girths.iter();
    all.filter_map(|g| Some((g.name.as_str(), g.notes.iter().find_map(note)?)))
        .collect()
}

#[test]
fn a_hip_under_wide_shorts_reaches_down_to_the_bodys_and_tight_ones_change_nothing() {
    let (_, bare) = made::measured(dressed(0.0));
    let (_, tight) = made::measured(dressed(1.5));
    let (_, wide) = made::measured(dressed(14.0));
    assert_eq!(worn(&bare), []);
    assert_eq!(worn(&tight), []);
    let names: Vec<&str> = worn(&wide).into_iter().map(|w| w.0).collect();
    assert!(names.contains(&"HC"), "{names:?}");
    assert!(
        !names.contains(&"WC") && !names.contains(&"CFC_L"),
        "{names:?}"
    );
    for name in names {
        let (is, seen) = (bare.get(name).unwrap().tape_mm, wide.get(name).unwrap());
        assert!(seen.tape_mm > 1.05 * is, "{name}");
        let [low, _] = seen.interval_mm.unwrap();
        assert!(low < is, "{name}: {low} of {is}");
    }
    let (_, loose) = made::measured(dressed(20.0));
    let hip = loose.missing.iter().find(|m| m.name == "HC");
    assert_eq!(hip.unwrap().reason, Refusal::TooUncertain);
}
