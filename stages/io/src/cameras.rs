//! Cameras as JSON of our own and as a COLMAP text model.

use nalgebra::UnitQuaternion;
use serde_json::json;
use shape::{Cameras, Unit, View};
use std::fmt::Write;

/// `cameras.json`: unit mm, world = turntable frame, `x_in_camera = R x_in_world + t`. An uncertainty
/// that nobody knows is null. Where nothing of known length was given the unit is `relative`, numbers are
/// those of the surfaces beside it (the camera ring's radius is 1000), and no key names millimetres.
pub fn cameras_to_json(cameras: &Cameras) -> String {
    let suffix = match cameras.scale.unit() {
        Unit::Metric => "mm",
        Unit::Relative => "rel",
    };
    let key = |what: &str| format!("{what}_{suffix}");
    let view = |v: &View| {
        let (lens, pose) = (&v.camera.lens, &v.camera.pose);
        let rows = |m: nalgebra::Matrix3<f64>| -> Vec<[f64; 3]> {
            m.row_iter().map(|r| [r[0], r[1], r[2]]).collect()
        };
        json!({
            "image": v.name, "width": lens.width, "height": lens.height,
            "K": rows(lens.matrix()), "distortion": lens.radial,
            "R": rows(*pose.rotation.matrix()), "t": pose.translation.as_slice(),
            (key("sigma")): v.sigma_mm, "rms_px": v.rms_px, "points": v.points,
        })
    };
    let views: Vec<_> = cameras.views.values().map(view).collect();
    let unit = match cameras.scale.unit() {
        Unit::Metric => "mm",
        Unit::Relative => "relative",
    };
    let file = json!({
        "unit": unit, "frame": "turntable: origin on the axis at the disk's top, z up",
        "scale": cameras.scale.word(),
        "scale_sigma": cameras.scale_sigma, (key("disk_radius")): cameras.disk_radius_mm,
        (key("ground")): cameras.ground_mm, "views": views,
    });
    serde_json::to_string_pretty(&file).expect("bug: cameras JSON cannot hold")
}

/// A COLMAP text model: `cameras.txt`, `images.txt`, `points3D.txt`. COLMAP puts the centre of the
/// top-left pixel at (0.5, 0.5).
pub fn cameras_to_colmap_text(cameras: &Cameras) -> Vec<(String, Vec<u8>)> {
    let mut lenses = String::from("# CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n");
    let mut images = String::from("# IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME\n");
    for (id, view) in cameras.views.iter() {
        let (lens, pose) = (&view.camera.lens, &view.camera.pose);
        let ([fx, fy], [cx, cy], [k1, k2]) = (lens.focal, lens.centre, lens.radial);
        let (n, w, h) = (id.0 + 1, lens.width, lens.height);
        let (cx, cy) = (cx + 0.5, cy + 0.5);
        let _ = writeln!(
            lenses,
            "{n} OPENCV {w} {h} {fx} {fy} {cx} {cy} {k1} {k2} 0 0"
        );
        let q = UnitQuaternion::from_rotation_matrix(&pose.rotation);
        let t = pose.translation;
        let (qw, qx, qy, qz) = (q.w, q.i, q.j, q.k);
        let _ = writeln!(
            images,
            "{n} {qw} {qx} {qy} {qz} {} {} {} {n} {}\n",
            t.x, t.y, t.z, view.name
        );
    }
    let mut points = String::from("# POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[]\n");
    for (i, [x, y, z]) in cameras.points.iter().enumerate() {
        let _ = writeln!(points, "{} {x} {y} {z} 128 128 128 0", i + 1);
    }
    [
        ("cameras.txt", lenses),
        ("images.txt", images),
        ("points3D.txt", points),
    ]
    .map(|(name, text)| (name.to_owned(), text.into_bytes()))
    .into()
}

/// A COLMAP binary model: `cameras.bin`, `images.bin`, `points3D.bin`, with the lens `OPENCV`.
pub fn cameras_to_colmap_binary(cameras: &Cameras) -> Vec<(String, Vec<u8>)> {
    /// Its kind of lens (structural: COLMAP's number of the model).
    const OPENCV: u32 = 4;
    let count = (cameras.views.len() as u64).to_le_bytes();
    let (mut lenses, mut images) = (count.to_vec(), count.to_vec());
    let reals = |to: &mut Vec<u8>, all: &[f64]| {
        all.iter().for_each(|x| to.extend(x.to_le_bytes()));
    };
    for (id, view) in cameras.views.iter() {
        let (lens, pose) = (&view.camera.lens, &view.camera.pose);
        let ([fx, fy], [cx, cy], [k1, k2]) = (lens.focal, lens.centre, lens.radial);
        let n = (id.0 + 1).to_le_bytes();
        lenses.extend(n);
        lenses.extend(OPENCV.to_le_bytes());
        lenses.extend(u64::from(lens.width).to_le_bytes());
        lenses.extend(u64::from(lens.height).to_le_bytes());
        reals(&mut lenses, &[fx, fy, cx + 0.5, cy + 0.5, k1, k2, 0.0, 0.0]);
        let q = UnitQuaternion::from_rotation_matrix(&pose.rotation);
        images.extend(n);
        reals(&mut images, &[q.w, q.i, q.j, q.k]);
        reals(&mut images, pose.translation.as_slice());
        images.extend(n);
        images.extend(view.name.bytes().filter(|b| *b != 0));
        images.push(0);
        images.extend(0u64.to_le_bytes());
    }
    let mut points = (cameras.points.len() as u64).to_le_bytes().to_vec();
    for (i, point) in cameras.points.iter().enumerate() {
        points.extend((i as u64 + 1).to_le_bytes());
        reals(&mut points, &point.map(f64::from));
        points.extend([128; 3]);
        reals(&mut points, &[0.0]);
        points.extend(0u64.to_le_bytes());
    }
    [
        ("cameras.bin", lenses),
        ("images.bin", images),
        ("points3D.bin", points),
    ]
    .map(|(name, bytes)| (name.to_owned(), bytes))
    .into()
}
