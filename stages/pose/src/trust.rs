//! Whether cameras are to be trusted: what the user should know before he does.

use crate::adjust::Fit;
use crate::scene::{LensPrior, Scene, Sight};
use shape::{Camera, PhotoId, Photos};

/// Median distance between sightings and projections. \[px\]
pub(crate) fn median_px(scene: &Scene, sights: &[Sight]) -> f64 {
    let off = |s: &Sight| {
        let camera = Camera {
            lens: scene.lens,
            pose: scene.poses[s.camera],
        };
        let at = camera.project(&scene.points[s.point]);
        at.map_or(f64::MAX, |at| (at.x - s.at_px[0]).hypot(at.y - s.at_px[1]))
    };
    let mut all: Vec<f64> = sights.iter().map(off).collect();
    all.sort_by(f64::total_cmp);
    all.get(all.len() / 2).copied().unwrap_or(0.0)
}

/// What the user should know before trusting the cameras.
pub(crate) fn warnings(
    photos: &Photos,
    ids: &[PhotoId],
    scene: &Scene,
    fit: &Fit,
    prior: &LensPrior,
) -> Vec<String> {
    let mut warnings = Vec::new();
    for (id, photo) in photos.iter().filter(|(id, _)| !ids.contains(id)) {
        let n = id.0;
        warnings.push(format!(
            "{} (photo {n}) shows fewer than two tags and has no camera",
            photo.name
        ));
    }
    let off = (scene.lens.focal[0] / prior.mean[0] - 1.0).abs();
    if photos.rig.focal_35mm.is_some() && off > 0.03 {
        warnings.push(format!(
            "the focal length came out {:.1} % from what EXIF or capture.toml says: check `focal_35mm`",
            off * 100.0
        ));
    }
    // A fixed camera and a turning disk: centres lie on a circle around the axis.
    let ring: Vec<(f64, f64)> = scene
        .poses
        .iter()
        .map(|p| p.centre())
        .map(|c| (c.x.hypot(c.y), c.z))
        .collect();
    let count = ring.len() as f64;
    let (radius, height) = (
        ring.iter().map(|r| r.0).sum::<f64>() / count,
        ring.iter().map(|r| r.1).sum::<f64>() / count,
    );
    for (id, (r, z)) in ids.iter().zip(&ring) {
        let out = (r - radius).hypot(z - height) / radius;
        if out > 0.02 {
            let name = photos.get(*id).map_or("", |p| p.name.as_str());
            warnings.push(format!(
                "{name}: its camera stands {:.1} % off the circle of the others: did camera or disk move?",
                out * 100.0
            ));
        }
    }
    if fit.sigma_mm.iter().any(|s| !s.is_finite()) {
        warnings.push("the adjustment is degenerate: do not trust its uncertainties".into());
    }
    warnings
}
