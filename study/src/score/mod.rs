//! A result against ground truth: cameras, masks, surface, girths. The truth stays out of results.

mod align;
mod at_plane;
pub(crate) mod girths;
pub(crate) mod paper;
mod surface;
pub(crate) mod table;
pub(crate) mod truth;

pub use at_plane::PlaneScore;
pub use girths::GirthScore;
use girths::NO_SCALE;
pub use girths::{RELATIVE, iso_mm};
pub use paper::{iso_table, paper_tables};
pub use surface::{Part, Surface};
pub use table::text;
pub use truth::Unreadable;
pub use truth::true_tapes;

use align::{Motion, align};
use serde::Serialize;
use stage::message;
use std::collections::BTreeMap;
use std::path::Path;

/// Cameras against the true ones.
#[derive(Debug, Clone, Serialize)]
pub struct CameraScore {
    /// How many of the true cameras were found.
    pub registered: usize,
    /// How many there are.
    pub of: usize,
    /// Scale of the camera ring against the true one.
    pub scale_error_pct: Option<f64>,
    /// Median distance of centres after rigid alignment. \[mm\]
    pub centre_mm_median: Option<f64>,
    /// Greatest distance of centres after rigid alignment. \[mm\]
    pub centre_mm_max: Option<f64>,
    /// Median angle between rotations after rigid alignment. \[°\]
    pub rotation_deg_median: Option<f64>,
    /// Mean error of the focal length.
    pub focal_error_pct: Option<f64>,
}

/// Masks against the true ones: intersection over union.
#[derive(Debug, Clone, Serialize)]
pub struct MaskScore {
    /// How many were compared.
    pub count: usize,
    /// Mean.
    pub iou_mean: f64,
    /// Worst.
    pub iou_min: f64,
}

/// All that can be scored; what is missing on either side is left out.
#[derive(Debug, Clone, Serialize)]
pub struct Score {
    /// Cameras.
    pub cameras: Option<CameraScore>,
    /// Masks.
    pub masks: Option<MaskScore>,
    /// Surface.
    pub mesh: Option<Surface>,
    /// Girths by name; `None` where the result has none.
    pub girths: BTreeMap<String, Option<GirthScore>>,
    /// Every tape with a plane against the true surface at that plane; `None` where
    /// it misses it, or limbs are one with the trunk there.
    pub girths_at_measured_planes: BTreeMap<String, Option<PlaneScore>>,
}

/// Scores a folder that `measure` wrote against a folder of truth.
///
/// # Errors
///
/// A file of the result or of the truth that cannot be read.
pub fn score(result: &Path, truth: &Path) -> Result<Score, Unreadable> {
    let (cameras, motion) = cameras(result, truth)?;
    let known = truth::girths(&truth.join("measurements.json"))?;
    let true_mesh = truth::mesh(&truth.join("mesh.ply"), 1000.0)?;
    let found_mesh = truth::mesh(&result.join("body.ply"), 1.0)?;
    let file = result.join("girths.json");
    let mut girths = girths::girths(&file, &known)?;
    let mut at_planes = BTreeMap::new();
    let mesh = match (found_mesh, true_mesh) {
        (Some(found), Some(truth)) => match surface::carried(&found, &truth, motion) {
            Some(carry) => {
                at_planes = at_plane::at_planes(&file, &found, &truth, &carry)?;
                at_plane::split(&mut girths, &at_planes);
                surface::surface(&found, &truth, &carry, &known)
            }
            None => None,
        },
        _ => None,
    };
    Ok(Score {
        cameras,
        masks: masks(result, truth)?,
        mesh,
        girths,
        girths_at_measured_planes: at_planes,
    })
}

fn cameras(result: &Path, truth: &Path) -> Result<(Option<CameraScore>, Motion), Unreadable> {
    let want = truth::cameras(&truth.join("cameras.json"), 1000.0)?;
    let file = result.join("cameras.json");
    let got = truth::cameras(&file, 1.0)?;
    if truth::json(&file)?.is_some_and(|file| file["unit"] == RELATIVE) {
        return Err(truth::error(&file, message!(NO_SCALE)));
    }
    if want.is_empty() || got.is_empty() {
        return Ok((None, Motion::none()));
    }
    let both: Vec<_> = want
        .iter()
        .filter_map(|(n, w)| Some((got.get(n)?, w)))
        .collect();
    let pairs: Vec<_> = both.iter().map(|(g, w)| (g.centre, w.centre)).collect();
    let mut score = CameraScore {
        registered: both.len(),
        of: want.len(),
        scale_error_pct: None,
        centre_mm_median: None,
        centre_mm_max: None,
        rotation_deg_median: None,
        focal_error_pct: None,
    };
    let (Some(scaled), Some(rigid)) = (align(&pairs, true), align(&pairs, false)) else {
        return Ok((Some(score), Motion::none()));
    };
    let median = |mut values: Vec<f64>| {
        values.sort_by(f64::total_cmp);
        (values[(values.len() - 1) / 2] + values[values.len() / 2]) / 2.0
    };
    let off: Vec<f64> = pairs
        .iter()
        .map(|(g, w)| (rigid.apply(g) - w).norm())
        .collect();
    let turned = both.iter().map(|(g, w)| {
        (w.rotation * (g.rotation * rigid.rotation.inverse()).inverse())
            .angle()
            .to_degrees()
    });
    let focal: f64 = both.iter().map(|(g, w)| g.focal / w.focal - 1.0).sum();
    score.scale_error_pct = Some((1.0 / scaled.scale - 1.0) * 100.0);
    score.centre_mm_max = off.iter().copied().reduce(f64::max);
    score.centre_mm_median = Some(median(off));
    score.rotation_deg_median = Some(median(turned.collect()));
    score.focal_error_pct = Some(focal / both.len() as f64 * 100.0);
    Ok((Some(score), rigid))
}

fn masks(result: &Path, truth: &Path) -> Result<Option<MaskScore>, Unreadable> {
    let (want, got) = (
        truth::masks(&truth.join("masks"))?,
        truth::masks(&result.join("masks"))?,
    );
    let mut shares = Vec::new();
    for (name, want) in &want {
        let Some(got) = got.get(name) else { continue };
        let (want, got) = (truth::mask(want)?, truth::mask(got)?);
        let (mut both, mut either) = (0usize, 0usize);
        for y in 0..want.height {
            for x in 0..want.width {
                let (gx, gy) = (x * got.width / want.width, y * got.height / want.height);
                let (a, b) = (want.at(x, y) > 127, got.at(gx, gy) > 127);
                both += usize::from(a && b);
                either += usize::from(a || b);
            }
        }
        shares.push(both as f64 / either.max(1) as f64);
    }
    Ok(shares
        .iter()
        .copied()
        .reduce(f64::min)
        .map(|iou_min| MaskScore {
            count: shares.len(),
            iou_mean: shares.iter().sum::<f64>() / shares.len() as f64,
            iou_min,
        }))
}
