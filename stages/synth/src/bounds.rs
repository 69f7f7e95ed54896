//! A box around a solid.

use nalgebra::{Point3, Vector3};
use shape::{Solid, SolidPart};

/// Least and greatest corner of a box that holds a solid. \[mm\]
pub fn bounds(solid: &Solid) -> (Point3<f64>, Point3<f64>) {
    let (mut low, mut high) = ([f64::MAX; 3], [f64::MIN; 3]);
    let mut hold = |p: Vector3<f64>, around: Vector3<f64>| {
        for i in 0..3 {
            low[i] = low[i].min(p[i] - around[i]);
            high[i] = high[i].max(p[i] + around[i]);
        }
    };
    for part in &solid.parts {
        match part {
            SolidPart::Ellipsoid { centre, half } => hold((*centre).into(), (*half).into()),
            SolidPart::Torus { centre, ring, tube } => hold(
                (*centre).into(),
                Vector3::new(ring + tube, ring + tube, *tube),
            ),
            SolidPart::Limb {
                from,
                to,
                half_from,
                half_to,
                ..
            } => {
                for (end, half) in [(from, half_from), (to, half_to)] {
                    hold((*end).into(), Vector3::from_element(half[0].max(half[1])));
                }
            }
            // Between levels a cubic may pass its ends by a little.
            SolidPart::Stack { levels, .. } => levels.iter().for_each(|l| {
                let half = Vector3::new(1.05 * l.half[0], 1.05 * l.half[1], 0.0);
                hold(Vector3::new(l.centre[0], l.centre[1], l.z), half);
            }),
        }
    }
    // Where parts blend, the surface is a quarter of the blend farther out at most.
    let around = Vector3::from_element(solid.blend_mm / 4.0);
    (Point3::from(low) - around, Point3::from(high) + around)
}
