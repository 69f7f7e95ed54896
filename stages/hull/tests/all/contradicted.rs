//! A mask that leaves out body which all other photos show is named; gaps that few photos see are not.

use hull::{Carve, CarveInput, CarveParams};
use nalgebra::{Point2, Point3, Vector3};
use shape::{Camera, Cameras, Intrinsics, Mask, PhotoId, Scale, View};
use stage::{Ctx, Host, Metric, Stage};
use std::f64::consts::TAU;
use std::sync::{Arc, Mutex};

const AWAY: f64 = 2500.0;
const WIDE: usize = 100;
const TALL: usize = 300;
/// The photo that looks between the legs.
const FRONT: u32 = 4;

/// A camera level with the body's middle; photo 4 looks along y.
fn camera(k: u32) -> Camera {
    let (s, c) = libm::sincos((f64::from(k) + 0.5) * TAU / 18.0);
    let lens = Intrinsics::simple(WIDE as u32, TALL as u32, 440.0);
    let from = Point3::new(AWAY * c, AWAY * s, 800.0);
    Camera::looking(lens, from, Point3::new(0.0, 0.0, 800.0))
}

/// A trunk on two legs, 8 mm apart below the crotch and more from there down.
fn body(camera: &Camera) -> Mask {
    let centre = camera.centre();
    // How far beside an upright line at (x, 0) a ray passes, and how high.
    let beside = |ray: &Vector3<f64>, x: f64| {
        let (dx, dy) = (x - centre.x, -centre.y);
        let level = libm::hypot(ray.x, ray.y);
        let along = (dx * ray.x + dy * ray.y) / level;
        let off = (dx * ray.y - dy * ray.x).abs() / level;
        (off, centre.z + ray.z / level * along)
    };
    let data = (0..WIDE * TALL).map(|i| {
        let ray = camera
            .ray(Point2::new((i % WIDE) as f64, (i / WIDE) as f64))
            .into_inner();
        let (off, z) = beside(&ray, 0.0);
        let trunk = (700.0..1500.0).contains(&z) && off < 150.0;
        let gap = 4.0 + 40.0 * ((550.0 - z) / 550.0).max(0.0);
        let leg = |side: f64| beside(&ray, side * (72.0 + gap)).0 < 72.0;
        let legs = (20.0..700.0).contains(&z) && (leg(1.0) || leg(-1.0));
        if trunk || legs { 255 } else { 0 }
    });
    Mask {
        width: WIDE,
        height: TALL,
        data: data.collect(),
    }
}

#[derive(Default)]
struct Heard {
    warnings: Mutex<Vec<String>>,
    worst: Mutex<Option<f64>>,
}

impl Host for Heard {
    fn warn(&self, text: &stage::Message) {
        self.warnings.lock().unwrap().push(text.into());
    }
    fn metric(&self, metric: Metric) {
        if metric.name == "contradicted" {
            *self.worst.lock().unwrap() = Some(metric.value);
        }
    }
}

/// Carves these photos, each with its mask edited: warnings, and the worst share.
fn carved(
    photos: impl Iterator<Item = u32> + Clone,
    contradicted_pct: f64,
    edit: impl Fn(u32, &mut Mask),
) -> (Vec<String>, Option<f64>) {
    let view = |k: u32| View::of(format!("{k:04}.jpg"), camera(k));
    let mask = |k: u32| {
        let mut mask = body(&camera(k));
        edit(k, &mut mask);
        mask
    };
    let input = CarveInput {
        masks: Arc::new(photos.clone().map(|k| (PhotoId(k), mask(k))).collect()),
        cameras: Arc::new(Cameras::of(
            photos.map(|k| (PhotoId(k), view(k))),
            Scale::Given,
        )),
    };
    let params = CarveParams {
        voxel_mm: 12.0,
        contradicted_pct,
        ..Default::default()
    };
    let host = Heard::default();
    let nothing = stage::Hash::from_bytes([0; 32]);
    Carve::run(&params, input, &Ctx::new(&host, nothing, nothing)).unwrap();
    let mut warnings = host.warnings.into_inner().unwrap();
    warnings.retain(|w| w.contains("its mask"));
    (warnings, host.worst.into_inner().unwrap())
}

/// A stripe of 5 pixels, 28 mm, over photo 7's chest.
fn stripe(k: u32, mask: &mut Mask) {
    for y in (80..85).filter(|_| k == 7) {
        (0..WIDE).for_each(|x| *mask.at_mut(x, y) = 0);
    }
}

#[test]
fn masks_that_agree_are_not_warned_of_though_one_photo_alone_sees_a_gap() {
    // Without the photo from behind, photo 4 alone looks through the gap of 8 mm.
    let front_alone = (0..18).filter(|k| *k != FRONT + 9);
    for (warnings, worst) in [
        carved(0..18, 1.2, |_, _| ()),
        carved(front_alone, 1.2, |_, _| ()),
    ] {
        assert!(warnings.is_empty(), "{warnings:?}");
        assert!(worst.unwrap() < 0.2, "{worst:?}");
    }
}

#[test]
fn a_stripe_over_one_mask_names_that_photo_alone() {
    let (warnings, worst) = carved(0..18, 1.2, stripe);
    let share = worst.unwrap();
    assert!((1.0..3.0).contains(&share), "{share}");
    assert_eq!(
        warnings,
        [format!(
            "0007.jpg: its mask leaves out body that all other photos show ({share:.1} % of it): look at this mask and correct it"
        )]
    );
    // Not where nobody asked, and not of so few photos that gaps look alike.
    assert_eq!(carved(0..18, 0.0, stripe), (vec![], None));
    assert_eq!(carved(0..11, 1.2, stripe).1, None);
}

#[test]
fn a_head_that_one_mask_lacks_is_seen_though_the_hull_has_none() {
    let beheaded = |k: u32, mask: &mut Mask| {
        for y in (0..60).filter(|_| k == 2) {
            (0..WIDE).for_each(|x| *mask.at_mut(x, y) = 0);
        }
    };
    let (warnings, _) = carved(0..18, 1.2, beheaded);
    assert!(
        warnings.len() == 1 && warnings[0].starts_with("0002.jpg: its mask leaves out"),
        "{warnings:?}"
    );
}
