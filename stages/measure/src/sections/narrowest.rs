//! The narrowest of a trunk between two heights, its arms parted from it as for any of its girths.

use crate::features::arms::arm_ring;
use crate::features::body::Body;
use crate::features::extent::across;
use crate::geometry::slices::Slice;
use crate::sections::taken::taken;
use rayon::prelude::*;
use shape::{GirthId, Landmark, Mesh, Part};

/// How often the step between slices is halved about the narrowest of them (structural: a fifth of a millimetre on a grown person).
const HALVED: i32 = 4;

/// The height of a true minimum of the trunk's tape between two heights. \[mm\]
pub(crate) fn narrowest(mesh: &Mesh, body: &Body, (low, high): (f64, f64)) -> Option<f64> {
    let parted = |z: f64| {
        let plane = across(body, z);
        let landmark = Landmark::new(GirthId::WaistNarrowest, plane, Part::Trunk);
        Some(taken(mesh, Some(body), &landmark).ok()?.tape_mm)
    };
    // Where both arms are apart from it, a slice's own tape is the trunk's.
    let apart = |s: &Slice| {
        let arm = |side: f64| arm_ring(body, &s.rings, side).is_some();
        arm(1.0) && arm(-1.0)
    };
    let tape = |s: &Slice| match apart(s) {
        true => Some(s.rings.first()?.tape),
        false => parted(s.z),
    };
    let slices: Vec<&Slice> = body.between(low, high).collect();
    let tapes: Vec<(f64, f64)> = slices
        .into_par_iter()
        .filter_map(|s| Some((s.z, tape(s)?)))
        .collect();
    let mut least = *tapes.iter().min_by(|a, b| a.1.total_cmp(&b.1))?;
    let ends = tapes.first()?.1.min(tapes.last()?.1);
    let step = body.slices.get(1)?.z - body.slices[0].z;
    // A tape between two slices may be shorter than both.
    for k in 1..=HALVED {
        let way = step * libm::pow(0.5, f64::from(k));
        for z in [least.0 - way, least.0 + way].map(|z| z.clamp(low, high)) {
            least = match parted(z) {
                Some(tape) if tape < least.1 => (z, tape),
                _ => least,
            };
        }
    }
    (least.1 < 0.99 * ends).then_some(least.0)
}
