//! Without a plate: a bit of wall between an arm and the trunk, seen by few photos, is no body; a hand that few photos see before a
//! bit of wall is one.

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

/// The same with an arm stretched out, whose end passes each place of the wall on one photo of a turn. \[mm\]
fn outstretched(x: &Point3<f64>) -> bool {
    body(x) || libm::hypot(x.y, x.z - 430.0) < 16.0 && (0.0..420.0).contains(&x.x)
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

/// Points along the ray of a pixel, from one side of a body to the other.
fn along(camera: &Camera, i: usize) -> impl Iterator<Item = Point3<f64>> + Clone + use<> {
    let at = Point2::new((i % SIZE.0) as f64, (i / SIZE.0) as f64);
    let (from, ray) = (camera.centre(), camera.ray(at).into_inner());
    (0..176).map(move |s| from + ray * (1165.0 + 5.0 * f64::from(s)))
}

/// Photos of a turn: each pixel is the first thing that its ray meets, the wall behind all.
fn turn(
    count: usize,
    wall: &Rgb,
    dice: &mut proof::Dice,
    body: fn(&Point3<f64>) -> bool,
) -> Vec<Shot> {
    let one = |k: usize| {
        let angle = k as f64 * std::f64::consts::TAU / count as f64;
        let camera = camera(angle);
        let mut small = wall.clone();
        for (i, p) in small.data.iter_mut().enumerate() {
            let mut shown = p.map(f64::from);
            if let Some(hit) = along(&camera, i).find(body) {
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

/// What the photos are cut to.
fn cuts(shots: &[Shot]) -> Vec<Image<bool>> {
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
    cuts.into_iter().map(|cut| cut.expect("a body")).collect()
}

/// Cuts the photos; pixels that look through the handle, and how many of them were kept, by photo.
fn through(shots: &[Shot]) -> BTreeMap<usize, (u32, u32)> {
    let mut seen = BTreeMap::new();
    for (k, (shot, cut)) in shots.iter().zip(cuts(shots)).enumerate() {
        let (mut both, mut either, mut through, mut kept) = (0u32, 0u32, 0u32, 0u32);
        for i in 0..cut.data.len() {
            let mut steps = along(&shot.camera, i);
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

/// A plain wall, nearly.
fn plain(dice: &mut proof::Dice) -> Rgb {
    let mut wall = Rgb::filled(SIZE.0, SIZE.1, [0; 3]);
    for p in &mut wall.data {
        let level = 150.0 + dice.within(-4.0, 4.0);
        *p = [level, level, level - 6.0].map(|v| v as u8);
    }
    wall
}

#[test]
fn what_passes_a_place_of_the_wall_on_one_photo_is_the_bodys_there() {
    let mut dice = proof::Dice(9);
    let shots = turn(12, &plain(&mut dice), &mut dice, outstretched);
    let (mut tips, mut kept) = (0, 0);
    for (shot, cut) in shots.iter().zip(cuts(&shots)) {
        for i in 0..cut.data.len() {
            let tip = |x: Point3<f64>| outstretched(&x) && x.x > 300.0;
            if along(&shot.camera, i).any(tip) {
                tips += 1;
                kept += u32::from(cut.data[i]);
            }
        }
    }
    assert!(tips > 500 && kept * 20 > tips * 19, "{kept} of {tips}");
}

#[test]
fn wall_between_arm_and_trunk_that_few_photos_see_is_cut_out() {
    let mut dice = proof::Dice(7);
    let wall = plain(&mut dice);
    let seen = through(&turn(12, &wall, &mut dice, body));
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
    let seen = through(&turn(16, &wall, &mut dice, body));
    assert!(free(&seen), "{seen:?}");
}
