//! The stage that finds the cameras of a walk.

use crate::adjust::belief::Beliefs;
use crate::adjust::bundle::Settings;
use crate::calibration::params::CalibrateParams;
use crate::calibration::prior::enlargement;
use crate::calibration::trust::views;
use crate::frame::circle::{RING_MM, moved};
use crate::walk::error::WalkError;
use crate::walk::finish::{Finished, finished};
use crate::walk::groups::{Groups, Widths, stored, upright};
use crate::walk::grow::grown;
use crate::walk::rules::Growth;
use crate::walk::seen::Seen;
use crate::walk::world::{nearby, on_side, turn, world};
use shape::{Camera, Cameras, PhotoId, Photos, Scale, Tracks};
use stage::{Ctx, Stage, Stop, message};
use std::sync::Arc;

stage::messages! {
    NO_CAMERA = "warn-walk-lost": "{name} (photo {number}) shares too little with the other photos and has no camera";
    SIDEWAYS = "warn-sideways": "the photos are on their side; which end of the subject is up was guessed from where the cameras look down: turn the photos upright to be sure";
}

stage::params! {
    /// What is believed before anything is seen, and what holds a camera.
    pub struct WalkParams {
        /// How sure EXIF's focal length is, as a share of it: phones crop and stabilise.
        #[range(0.0005..=0.5)]
        #[source(by_hand = "one capture, halved and doubled: no more than chance (docs/lab/numbers.md)")]
        focal_sigma: f64 = 0.15,
        /// How sure a focal length in pixels of capture.toml is, as a share of it.
        #[range(0.00001..=0.1)]
        #[source(derived = "as of pose.calibrate")]
        given_focal: f64 = CalibrateParams::default().given_focal,
        /// How far the principal point may be from the photo's middle, as a share of its longer side.
        #[range(0.0001..=0.2)]
        #[source(by_hand = "one capture, halved and doubled: no more than chance (docs/lab/numbers.md)")]
        centre_sigma: f64 = 0.01,
        /// How sure a principal point of capture.toml is.
        #[range(0.01..=100.0)]
        #[source(derived = "as of pose.calibrate")]
        given_centre_px: f64 = CalibrateParams::default().given_centre_px,
        /// How strong radial distortion may be.
        #[range(0.0001..=1.0)]
        #[source(by_hand = "one capture, halved and doubled: no more than chance (docs/lab/numbers.md)")]
        radial_sigma: f64 = 0.1,
        /// How far focusing may change the focal length from photo to photo, as a share.
        #[range(0.000001..=0.1)]
        #[source(by_hand = "one capture: halved, no more than chance; doubled, centres +1.13 ‰ (docs/lab/numbers.md)")]
        zoom_sigma: f64 = 0.0005,
        /// Least standard deviation of a feature.
        #[range(0.05..=5.0)]
        #[source(by_hand = "0.6 with 20 points to begin with, too: cameras of a real walk 4.06 for 3.71 ‰ of their distance off")]
        feature_px: f64 = 0.5,
        /// Residuals beyond this many standard deviations lose weight.
        #[range(0.5..=20.0)]
        #[source(by_hand = "one capture, halved and doubled: no more than chance (docs/lab/numbers.md)")]
        loss: f64 = 1.0,
        /// Features further from where they should be are left out; in proportion more on photos of
        /// more than 2400 pixels.
        #[range(0.5..=50.0)]
        #[source(derived = "twice what is believed at most, root mean square (most_px of pose.calibrate)")]
        near_px: f64 = 2.0 * CalibrateParams::default().most_px,
        /// Features that are further from where they should (root mean square) are not believed; in
        /// proportion more on photos of more than 2400 pixels.
        #[range(0.1..=100.0)]
        #[source(derived = "as of pose.calibrate")]
        most_px: f64 = CalibrateParams::default().most_px,
        /// Fewest points that hold a camera.
        #[range(6..=1000)]
        #[source(by_hand = "one capture, halved and doubled: nothing changes, for its photos share more (docs/lab/numbers.md)")]
        least: u32 = 20,
        /// Least share of the points a photo shows that must agree with its camera.
        #[range(0.01..=1.0)]
        #[source(by_hand = "one capture, halved and doubled: no more than chance (docs/lab/numbers.md)")]
        least_share: f64 = 0.25,
        /// Least share of the photos that must have a camera.
        #[range(0.1..=1.0)]
        #[source(by_hand = "one capture, halved and doubled: nothing changes, for all have cameras (docs/lab/numbers.md)")]
        least_photos: f64 = 0.75,
        /// Most samples of a photo's RANSAC.
        #[range(10..=100000)]
        #[source(structural)]
        rounds: u32 = 1000,
        /// Seed of RANSAC.
        #[source(structural)]
        seed: i64 = 1,
        /// Most points that are adjusted while cameras are added.
        #[range(100..=100000)]
        #[source(structural)]
        grow_tracks: u32 = 3000,
        /// Most points that are adjusted at the end.
        #[range(100..=1000000)]
        #[source(structural)]
        most_tracks: u32 = 6000,
        /// Most steps of the last adjustments.
        #[range(1..=1000)]
        #[source(structural)]
        steps: u32 = 30,
    }
}

stage::inputs! {
    /// What was seen.
    pub struct WalkInput {
        /// The photos: their size, focal length, how they are turned.
        photos: Arc<Photos>,
        /// Features followed over the photos.
        tracks: Arc<Tracks>,
    }
}

/// A step that lowers the cost by less than this share is the last (structural: a search's end).
const GAIN: f64 = 1e-6;

/// `pose.walk`: photos, tracks → cameras.
pub struct Walk;

impl Stage for Walk {
    const NAME: &'static str = "pose.walk";
    const VERSION: u32 = 3;
    const ABOUT: &'static str = "Finds cameras that were walked around a subject that does not move, nor does what is around it: from two photos on, one more at a time; z up, the origin where all of them look.";
    type Params = WalkParams;
    type Input = WalkInput;
    type Output = Cameras;
    const METRICS: &'static [&'static str] = &[
        "cameras",
        "reprojection rms",
        "focal",
        "focal sigma",
        "points",
        "floor",
        "nearest camera",
        "farthest camera",
    ];

    fn run(p: &WalkParams, input: WalkInput, ctx: &Ctx<'_>) -> Result<Cameras, Stop> {
        let photos = &*input.photos;
        if photos.photos.is_empty() {
            return Err(WalkError::NoBeginning.into());
        }
        let groups = Groups::new(photos, &widths(p));
        let to_file = |id: PhotoId, at| stored(&photos.photos[id.0 as usize], at);
        let seen = Seen::new(&input.tracks, photos.photos.len(), to_file);
        let growth = growth(p, photos, &groups);
        let grown = grown(&seen, &groups, &growth).ok_or(WalkError::NoBeginning)?;
        ctx.check()?;
        let missing = grown.missing();
        enough(photos, &missing, p)?;
        let done = finished(grown, &growth, p.most_tracks as usize);
        let most = p.most_px * enlargement(photos);
        if done.fit.rms_px > most {
            return Err(WalkError::Loose {
                rms: done.fit.rms_px,
                most,
            }
            .into());
        }
        for id in &missing {
            let name = &photos.photos[id.0 as usize].name;
            ctx.warn(message!(NO_CAMERA, name = name, number = id.0));
        }
        let cameras = placed(photos, &done, ctx)?;
        ctx.metric("cameras", cameras.views.len() as f64, "");
        ctx.metric("reprojection rms", done.fit.rms_px, "px");
        let lens = done.scene.shots.first().map_or(0, |s| s.lens);
        ctx.metric("focal", done.scene.lenses[lens].focal[0], "px");
        let sigma = done.fit.lens_sigmas[lens][0];
        if sigma.is_finite() {
            ctx.metric("focal sigma", sigma, "px");
        }
        ctx.metric("points", done.scene.points.len() as f64, "");
        Ok(cameras)
    }
}

fn widths(p: &WalkParams) -> Widths {
    Widths {
        focal: p.focal_sigma,
        given_focal: p.given_focal,
        centre: p.centre_sigma,
        given_centre_px: p.given_centre_px,
        radial: p.radial_sigma,
    }
}

/// How its cameras grow.
pub(crate) fn growth(p: &WalkParams, photos: &Photos, groups: &Groups) -> Growth {
    Growth {
        near_px: p.near_px * enlargement(photos),
        spread: true,
        least: p.least as usize,
        share: p.least_share,
        rounds: p.rounds as usize,
        seed: p.seed as u64,
        most: p.grow_tracks as usize,
        sigma_px: p.feature_px,
        beliefs: Beliefs {
            lenses: groups.priors.clone(),
            zoom_sigma: Some(p.zoom_sigma),
            ..Beliefs::default()
        },
        how: Settings {
            loss: p.loss,
            steps: p.steps as usize,
            gain: GAIN,
        },
    }
}

/// Refuses when too few photos have a camera.
fn enough(photos: &Photos, missing: &[PhotoId], p: &WalkParams) -> Result<(), WalkError> {
    let of = photos.photos.len();
    let found = of - missing.len();
    if found >= 3 && found as f64 >= p.least_photos * of as f64 {
        return Ok(());
    }
    let name = |id: &PhotoId| photos.photos[id.0 as usize].name.as_str();
    Err(WalkError::Few {
        found,
        of,
        names: missing
            .iter()
            .take(5)
            .map(name)
            .collect::<Vec<_>>()
            .join(", "),
    })
}

/// The cameras of upright photos, in the frame of the walk.
fn placed(photos: &Photos, done: &Finished, ctx: &Ctx<'_>) -> Result<Cameras, WalkError> {
    let mut views = views(photos, &done.scene, &done.observations, &done.fit);
    for (id, photo) in photos.iter() {
        if let Some(view) = views.get_mut(id) {
            view.camera = upright(photo, &view.camera);
        }
    }
    let list: Vec<Camera> = views.values().map(|v| v.camera).collect();
    let points = &done.scene.points;
    let world = world(&list, points).ok_or(WalkError::NoBeginning)?;
    if on_side(&list) {
        ctx.warn(message!(SIDEWAYS));
    }
    let cameras = Cameras {
        views,
        scale: Scale::Nothing,
        scale_sigma: None,
        disk_radius_mm: None,
        ground_mm: 0.0,
        points: points
            .iter()
            .map(|p| p.coords.map(|x| x as f32).into())
            .collect(),
    };
    let size = RING_MM / world.radius;
    let mut cameras = moved(&cameras, &turn(&world, &list[0]), &world.origin, size);
    if let Some(floor) = world.floor {
        cameras.ground_mm = floor * size;
        ctx.metric("floor", floor * size, "mm");
    }
    nearby(&mut cameras, RING_MM);
    let far: Vec<f64> = list
        .iter()
        .map(|c| (c.centre() - world.origin).norm() * size)
        .collect();
    let least = far.iter().copied().fold(f64::INFINITY, f64::min);
    ctx.metric("nearest camera", least, "mm");
    ctx.metric(
        "farthest camera",
        far.iter().copied().fold(0.0, f64::max),
        "mm",
    );
    Ok(cameras)
}
