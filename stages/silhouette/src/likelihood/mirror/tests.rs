//! How a disk mirrors is found, and a mirrored cell is where its light comes from.

use super::*;
use nalgebra::{Rotation3, Vector3};
use shape::{Intrinsics, Pose};

const EMPTY: [f32; 3] = [0.07, 0.06, 0.05];

/// Bodies of many colours on a disk that mirrors a share of their light, and noise.
fn samples(share: f32, empty: [f32; 3], noise: f64) -> Vec<Sample> {
    let mut dice = proof::Dice(5);
    let one = |_| {
        let light = [0, 1, 2].map(|_| dice.within(0.1, 0.8) as f32);
        let noisy = |c: usize| share * light[c] - empty[c] + (noise * dice.normal()) as f32;
        (light, [0, 1, 2].map(noisy))
    };
    (0..4000).map(one).collect()
}

#[test]
fn the_share_of_light_is_found_amid_what_is_no_reflection_and_a_matt_disk_has_none() {
    let mut all = samples(0.16, EMPTY, 0.01);
    // Bits of the body that the hull lacks.
    all.extend((0..200).map(|_| ([0.3; 3], [0.6, 0.4, 0.3])));
    let gloss = Gloss::of(all).unwrap();
    assert!((gloss.share - 0.16).abs() < 0.005, "{}", gloss.share);
    assert!((0..3).all(|c| (gloss.empty[c] - EMPTY[c]).abs() < 0.005));
    assert!(Gloss::of(samples(0.0, [0.0; 3], 0.01)).is_none());
    assert!(Gloss::of(vec![]).is_none());
}

#[test]
fn a_cell_is_mirrored_where_its_light_comes_from() {
    let rotation = Rotation3::from_euler_angles(std::f64::consts::FRAC_PI_2 + 0.4, 0.0, 0.0);
    let centre = Vector3::new(0.0, -3000.0, 1200.0);
    let pose = Pose {
        rotation,
        translation: -(rotation * centre),
    };
    let lens = Intrinsics::simple(400, 500, 700.0);
    let camera = Camera { lens, pose };
    // A cell 60 mm above the disk.
    let block = Block::between([-10.0, -10.0, 50.0], [10.0, 10.0, 70.0], 1);
    let mask = Mask::filled(400, 500, 255);
    let photo = Rgb::filled(400, 500, [200, 100, 50]);
    let seen = |radius| {
        let view = (PhotoId(0), &mask, camera);
        Reflection::of(&block, &[true], &view, &photo, radius)
    };
    let reflection = seen(350.0);
    let [i] = reflection.middles[..] else {
        panic!("{:?}", reflection.middles);
    };
    assert_eq!(reflection.light[i], Some([200, 100, 50].map(light)));
    // Thrown back at the disk, that pixel's ray passes through the cell.
    let at = on_disk(
        &camera,
        Point2::new((i % 400) as f64, (i / 400) as f64),
        350.0,
    )
    .unwrap();
    let ray = (at - camera.centre()).normalize();
    let up = at + Vector3::new(ray.x, ray.y, -ray.z) * (60.0 / -ray.z);
    assert!((up - block.centre(0)).norm() < 5.0, "{up}");
    // Beyond a small disk's edge nothing is mirrored.
    assert!(seen(100.0).middles.is_empty());
    // Laid on a photo twice as large, those pixels gain the light, and no more.
    let mut gained = vec![0.0; 3 * 400 * 500];
    gained[3 * i..3 * i + 3].copy_from_slice(&[0.1; 3]);
    let before = Rgb::filled(800, 1000, [90; 3]);
    let after = mirroring(&before, &gained, 2);
    let changed = |k: &usize| after.data[*k] != before.data[*k];
    let changed: Vec<usize> = (0..after.data.len()).filter(changed).collect();
    assert_eq!(changed.len(), 4);
    assert_eq!(after.data[changed[0]], [level(light(90) + 0.1); 3]);
}
