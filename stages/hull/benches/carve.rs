//! What carving costs: `cargo bench -p hull`. A body of 2 m before 18 cameras of 1600×2400, cells ever
//! finer; time and memory must grow with the surface, n² log n, not n³. `benches/beside.py` times
//! scikit-image's marching cubes on dense fields of the same sizes. Processor seconds of all threads
//! are printed beside the clock's, for machines that have other work.

use hull::{Carve, CarveInput, CarveParams};
use nalgebra::{Point2, Point3, Vector3};
use shape::{Camera, Cameras, Intrinsics, Mask, Masks, PhotoId, Scale, View};
use stage::{Ctx, Stage};
use std::sync::Arc;
use std::time::Instant;

/// Trunk with head, arms, legs: ends of a bone and its thickness. \[mm\]
const BONES: [([f64; 3], [f64; 3], f64); 5] = [
    ([0.0, 0.0, 900.0], [0.0, 0.0, 1860.0], 140.0),
    ([0.0, 170.0, 1550.0], [60.0, 420.0, 900.0], 45.0),
    ([0.0, -170.0, 1550.0], [60.0, -420.0, 900.0], 45.0),
    ([0.0, 90.0, 900.0], [0.0, 140.0, 75.0], 75.0),
    ([0.0, -90.0, 900.0], [0.0, -140.0, 75.0], 75.0),
];

fn camera(angle: f64) -> Camera {
    let (s, c) = libm::sincos(angle);
    let lens = Intrinsics::simple(1600, 2400, 3300.0);
    let from = Point3::new(3200.0 * c, 3200.0 * s, 1000.0);
    Camera::looking(lens, from, Point3::new(0.0, 0.0, 1000.0))
}

/// Distance of a ray to a bone, less its thickness. \[mm\]
fn beside(
    from: &Point3<f64>,
    ray: &Vector3<f64>,
    (a, b, thick): &([f64; 3], [f64; 3], f64),
) -> f64 {
    let (a, b) = (Point3::from(*a), Point3::from(*b));
    let (u, w) = (b - a, a - from);
    let (uu, ur, uw, rw) = (u.dot(&u), u.dot(ray), u.dot(&w), ray.dot(&w));
    let t = ((ur * rw - uw) / (uu - ur * ur)).clamp(0.0, 1.0);
    let x = a + u * t - from;
    (x - ray * x.dot(ray)).norm() - thick
}

/// Seconds that all threads of this process have computed so far.
fn computed() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    // Behind the name in brackets: user and kernel time are the 12th and 13th, in hundredths.
    let rest = stat.rsplit(')').next().unwrap_or_default();
    let ticks = rest.split_whitespace().skip(11).take(2);
    ticks.filter_map(|t| t.parse::<f64>().ok()).sum::<f64>() / 100.0
}

fn main() {
    let mut cameras = Cameras::of([], Scale::Given);
    let all: Vec<Camera> = (0..18).map(|k| camera(f64::from(k) * 0.349)).collect();
    let view = |c: &Camera| View::of(String::new(), *c);
    cameras.views = all
        .iter()
        .enumerate()
        .map(|(k, c)| (PhotoId(k as u32), view(c)))
        .collect();
    let mask = |c: &Camera| {
        let from = c.centre();
        let mut mask = Mask::filled(1600, 2400, 0);
        for (i, m) in mask.data.iter_mut().enumerate() {
            let ray = c
                .ray(Point2::new((i % 1600) as f64, (i / 1600) as f64))
                .into_inner();
            let least = BONES
                .iter()
                .map(|b| beside(&from, &ray, b))
                .fold(f64::MAX, f64::min);
            *m = ((0.5 - least).clamp(0.0, 1.0) * 255.0) as u8;
        }
        mask
    };
    let masks = all
        .iter()
        .enumerate()
        .map(|(k, c)| (PhotoId(k as u32), mask(c)));
    let (masks, cameras) = (Arc::new(masks.collect::<Masks>()), Arc::new(cameras));
    for voxel_mm in [8.0, 4.0, 2.0, 1.0] {
        let input = CarveInput {
            masks: masks.clone(),
            cameras: cameras.clone(),
        };
        let params = CarveParams {
            voxel_mm,
            memory_mb: 6000.0,
            ..Default::default()
        };
        let (start, before) = (Instant::now(), computed());
        let mesh =
            Carve::run(&params, input, &Ctx::alone()).unwrap_or_else(|why| panic!("{why:?}"));
        let (took, work) = (start.elapsed().as_secs_f64(), computed() - before);
        // Cells along the body's height.
        let n = 2000.0 / voxel_mm;
        let relative = work / (n * n * libm::log(n)) * 1e6;
        let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
        let most = status
            .lines()
            .find(|l| l.starts_with("VmHWM"))
            .unwrap_or("");
        println!(
            "cells of {voxel_mm} mm: {took:6.2} s, {work:6.2} s of processors, {relative:.2} µs per n² ln n, {} thousand faces, {}",
            mesh.faces.len() / 1000,
            most.trim()
        );
    }
}
