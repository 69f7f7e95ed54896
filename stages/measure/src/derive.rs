//! What follows from girths: ratios, body mass index, volume, and the curve of girth over height.

use crate::features::arms::arm_ring;
use crate::features::body::Body;
use shape::{Girths, Mesh, Profile};

/// Adds ratios, body mass index and volume. Stature and weight are the user's where he gave them.
pub(crate) fn derive(
    girths: &mut Girths,
    mesh: &Mesh,
    measured_mm: f64,
    said_mm: Option<f64>,
    kg: Option<f64>,
) {
    let tape = |name: &str| girths.get(name).map(|g| g.tape_mm);
    let skin = |name: &str| girths.get(name).map(|g| g.contour_mm);
    let measured = (measured_mm > 0.0).then_some(measured_mm);
    let stature = said_mm.or(measured);
    let mut ratios = Vec::new();
    let mut add = |name: &str, value: Option<f64>, note: &str| {
        if let Some(value) = value.filter(|v| v.is_finite()) {
            ratios.push((name.to_owned(), value, note.to_owned()));
        }
    };
    let over = |a: Option<f64>, b: Option<f64>| a.zip(b).map(|(a, b)| a / b);
    let who = "WHO 2008: raised risk from 0.90 (men), 0.85 (women); no diagnosis";
    add("WHR", over(skin("WC"), skin("HC")), who);
    add("WHR_tape", over(tape("WC"), tape("HC")), who);
    let half = "waist to height: NICE 2022 names 0.5 as a boundary to keep below; no diagnosis";
    add("WHtR", over(tape("WC"), stature), half);
    let volume_l = mesh.volume() * 1e-6;
    let density = kg.map(|kg| kg / volume_l);
    add(
        "density_kg_l",
        density.filter(|_| volume_l > 0.0),
        "experimental: 1 % of volume is 1 % of density, and the air in the lungs is in it",
    );
    girths.ratios = ratios;
    girths.stature_mm = measured;
    girths.weight_kg = kg;
    girths.bmi = kg.zip(stature).map(|(kg, mm)| kg / (mm / 1000.0).powi(2));
    girths.volume_l = Some(volume_l);
}

/// Densities of living bodies, with air in their lungs and what a surface errs. \[kg/l\]
const DENSITIES: std::ops::RangeInclusive<f64> = 0.8..=1.2;

/// What is said where volume and the weight that was given do not make a living body.
pub(crate) fn no_density(girths: &Girths) -> Option<String> {
    let mut ratios = girths.ratios.iter();
    let (_, density, _) = ratios.find(|(name, ..)| name == "density_kg_l")?;
    (!DENSITIES.contains(density)).then(|| {
        format!(
            "weight and volume make {density:.2} kg/l, a living body has 0.93 to 1.1: unless this is none, the scale, the weight or \
             the surface is wrong (is the body cut off?); look at the masks"
        )
    })
}

/// The trunk's tape over height above the ground, from the hip to the chest, while the arms are
/// apart from it (or the chest was measured without them).
pub(crate) fn profile(body: &Body, girths: &Girths) -> Profile {
    let level = |name: &str| {
        girths
            .get(name)
            .filter(|g| g.plane.normal[2] > 0.99)
            .map(|g| g.plane.point_mm[2])
    };
    let low = level("HC").or(body.crotch).unwrap_or(body.ground) - 0.03 * body.stature;
    let high = level("CC").unwrap_or(body.ground + 0.7 * body.stature) + 0.01 * body.stature;
    let mut profile = Profile::default();
    for slice in body.between(low, high) {
        let apart = [1.0, -1.0]
            .iter()
            .all(|side| arm_ring(body, &slice.rings, *side).is_some());
        if let Some(ring) = slice.rings.first().filter(|_| apart) {
            profile.height_mm.push(slice.z - body.ground);
            profile.tape_mm.push(ring.tape);
        }
    }
    profile
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_weight_that_does_not_fit_the_volume_is_told() {
        // A cube of half a metre: 125 l.
        let edge = |i: u32| [0, 1, 2].map(|k| if i >> k & 1 == 1 { 500.0f32 } else { 0.0 });
        let cube = Mesh {
            positions: (0..8).map(edge).collect(),
            faces: vec![
                [0, 2, 1],
                [1, 2, 3],
                [4, 5, 6],
                [5, 7, 6],
                [0, 1, 4],
                [1, 5, 4],
                [2, 6, 3],
                [3, 6, 7],
                [0, 4, 2],
                [2, 4, 6],
                [1, 3, 5],
                [3, 7, 5],
            ],
            ..Mesh::default()
        };
        let said = |kg: Option<f64>| {
            let mut girths = Girths::default();
            derive(&mut girths, &cube, 500.0, None, kg);
            no_density(&girths)
        };
        assert_eq!(said(Some(120.0)), None);
        assert_eq!(said(None), None);
        assert!(said(Some(52.0)).unwrap().contains("0.42 kg/l"));
    }
}
