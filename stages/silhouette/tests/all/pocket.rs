//! Without a plate: a bit of wall between an arm and the trunk, seen by few photos, is no body.

use nalgebra::{Point2, Point3, Rotation3, Vector3};
use shape::{Camera, Cameras, Image, Intrinsics, PhotoId, Pose, Rgb, Scale, View as PhotoView};
use silhouette::{Settings, Shot, still, without_plate};
use std::collections::BTreeMap;

const SIZE: (usize, usize) = (120, 160);

/// A flat trunk with a handle before its belly, standing on z = 0. \[mm\]
fn body(x: &Point3<f64>) -> bool {
    let trunk = (x.x / 150.0).powi(2) + (x.y / 60.0).powi(2) < 1.0 && (0.0..520.0).contains(&x.z);
    let across = libm::hypot(x.y - 60.0, x.z - 270.0);
    trunk || x.x.abs() < 18.0 && x.y > 0.0 && (85.0..115.0).contains(&across)
}

/// Where the handle lets through, up to its rim by some millimetres.
fn pocket(x: &Point3<f64>) -> bool {
    x.x.abs() < 2.0 && x.y > 68.0 && libm::hypot(x.y - 60.0, x.z - 270.0) < 77.0
}

/// The camera before which the body has turned on by an angle. \[rad\]
fn camera(angle: f64) -> Camera {
    // Right, down and forward as rows, for a body that faces along y.
    let (s, c) = libm::sincos(angle);
    let rows = nalgebra::Matrix3::new(c, s, 0.0, 0.0, 0.0, -1.0, -s, c, 0.0);
    Camera {
        lens: Intrinsics::simple(SIZE.0 as u32, SIZE.1 as u32, 400.0),
        pose: Pose {
            rotation: Rotation3::from_matrix_unchecked(rows),
            translation: Vector3::new(0.0, 260.0, 1600.0),
        },
    }
}

/// Photos of a turn: each pixel is the first thing that its ray meets, the wall behind all.
fn turn(count: usize, wall: &Rgb, dice: &mut proof::Dice) -> Vec<Shot> {
    let one = |k: usize| {
        let angle = k as f64 * std::f64::consts::TAU / count as f64;
        let camera = camera(angle);
        let mut small = wall.clone();
        for (i, p) in small.data.iter_mut().enumerate() {
            let at = Point2::new((i % SIZE.0) as f64, (i / SIZE.0) as f64);
            let (from, ray) = (camera.centre(), camera.ray(at));
            let steps = (0..70).map(|s| from + ray.into_inner() * (1430.0 + 5.0 * f64::from(s)));
            let mut shown = p.map(f64::from);
            if let Some(hit) = steps.into_iter().find(body) {
                // Light from one side, and spots that turn with the skin.
                let light = 22.0 * libm::sin(libm::atan2(hit.y, hit.x) - angle);
                let spots = 14.0 * libm::sin(hit.x * 0.31) * libm::sin(hit.z * 0.27 + hit.y * 0.2);
                shown = [206.0, 152.0, 122.0].map(|v| v + light + spots);
            }
            *p = shown.map(|v| (v + dice.within(-1.0, 1.0)).round() as u8);
        }
        Shot {
            id: PhotoId(k as u32),
            small,
            camera,
        }
    };
    (0..count).map(one).collect()
}

/// Cuts the photos; pixels that look through the handle, and how many of them were kept, by photo.
fn through(shots: &[Shot]) -> BTreeMap<usize, (u32, u32)> {
    let view = |shot: &Shot| PhotoView {
        name: String::new(),
        camera: shot.camera,
        sigma_mm: None,
        rms_px: None,
        points: 0,
    };
    let cameras = Cameras {
        views: shots.iter().map(|s| (s.id, view(s))).collect(),
        scale: Scale::Given,
        scale_sigma: None,
        disk_radius_mm: None,
        ground_mm: 0.0,
        points: vec![],
    };
    let settings = Settings {
        gamma: 40.0,
        rounds: 2,
        clusters: 6,
        thinner: 0.0,
    };
    let smalls: Vec<&Rgb> = shots.iter().map(|s| &s.small).collect();
    let still = still(&smalls);
    let cuts = without_plate(shots, &still, &cameras, &settings, 0.0, None, &[]);
    let mut seen = BTreeMap::new();
    for (k, (shot, cut)) in shots.iter().zip(&cuts).enumerate() {
        let cut: &Image<bool> = cut.as_ref().expect("a body");
        let (mut both, mut either, mut through, mut kept) = (0u32, 0u32, 0u32, 0u32);
        for i in 0..cut.data.len() {
            let at = Point2::new((i % SIZE.0) as f64, (i / SIZE.0) as f64);
            let (from, ray) = (shot.camera.centre(), shot.camera.ray(at));
            let mut steps =
                (0..70).map(|s| from + ray.into_inner() * (1430.0 + 5.0 * f64::from(s)));
            let truth = steps.clone().any(|x| body(&x));
            both += u32::from(truth && cut.data[i]);
            either += u32::from(truth || cut.data[i]);
            if !truth && steps.any(|x| pocket(&x)) {
                through += 1;
                kept += u32::from(cut.data[i]);
            }
        }
        let alike = f64::from(both) / f64::from(either);
        assert!(alike > 0.96, "photo {k}: {alike}");
        if through > 0 {
            seen.insert(k, (through, kept));
        }
    }
    seen
}

/// At most one in 25 of what shows through the handle was kept.
fn free(seen: &BTreeMap<usize, (u32, u32)>) -> bool {
    let sum = |sum: (u32, u32), one: &(u32, u32)| (sum.0 + one.0, sum.1 + one.1);
    let (through, kept) = seen.values().fold((0, 0), sum);
    through > 1000 && kept * 25 <= through
}

#[test]
fn wall_between_arm_and_trunk_that_few_photos_see_is_cut_out() {
    let mut dice = proof::Dice(7);
    let mut wall = Rgb::filled(SIZE.0, SIZE.1, [0; 3]);
    for p in &mut wall.data {
        let level = 150.0 + dice.within(-4.0, 4.0);
        *p = [level, level, level - 6.0].map(|v| v as u8);
    }
    let seen = through(&turn(12, &wall, &mut dice));
    assert!(free(&seen), "{seen:?}");
}

#[test]
fn a_picture_on_the_wall_that_few_photos_see_is_cut_out_though_nothing_beside_is_like_it() {
    let mut dice = proof::Dice(8);
    let spots: Vec<[f64; 3]> = (0..20 * 27)
        .map(|_| [0, 1, 2].map(|_| dice.within(10.0, 245.0)))
        .collect();
    let mut wall = Rgb::filled(SIZE.0, SIZE.1, [0; 3]);
    for (i, p) in wall.data.iter_mut().enumerate() {
        let spot = spots[i / SIZE.0 / 6 * 20 + i % SIZE.0 / 6];
        *p = spot.map(|v| (v + dice.within(-3.0, 3.0)) as u8);
    }
    let seen = through(&turn(16, &wall, &mut dice));
    assert!(free(&seen), "{seen:?}");
}
