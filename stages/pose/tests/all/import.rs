//! Cameras leave and come back as they were; files that are broken are refused.

use io::{
    cameras_to_colmap_binary, cameras_to_colmap_text, cameras_to_json, cameras_to_middlebury,
};
use nalgebra::{Rotation3, Vector3};
use pose::{
    Foreign, ForeignError, Ring, from_colmap_binary, from_colmap_text, from_json, from_middlebury,
};
use shape::{Camera, Cameras, Intrinsics, PhotoId, Scale, View};

fn cameras() -> Cameras {
    let ring = Ring {
        turn: Rotation3::from_euler_angles(1.7, 0.1, -0.05),
        offset: Vector3::new(10.0, 700.0, 2500.0),
        angles: vec![0.0, 0.4, 0.9, 2.5],
    };
    let mut lens = Intrinsics::simple(1600, 2400, 3300.25);
    lens.centre = [803.5, 1190.125];
    lens.radial = [-0.04, 0.01];
    let view = |(i, pose)| {
        let name = format!("{i:04} b.jpg");
        let camera = Camera { lens, pose };
        (
            PhotoId(i),
            View {
                name,
                camera,
                sigma_mm: Some(0.5),
                rms_px: Some(0.2),
                points: 9,
            },
        )
    };
    Cameras {
        views: (0..).zip(ring.poses()).map(view).collect(),
        scale: Scale::Mat,
        scale_sigma: Some(0.001),
        disk_radius_mm: Some(350.0),
        ground_mm: 3.5,
        points: vec![[1.0, 2.0, 3.5], [-4.0, 0.25, 900.0]],
    }
}

#[track_caller]
fn same(found: &[Foreign], want: &Cameras) {
    assert_eq!(found.len(), want.views.len());
    for (found, want) in found.iter().zip(want.views.values()) {
        let (lens, pose) = (want.camera.lens, want.camera.pose);
        assert_eq!(found.name, want.name);
        assert_eq!(found.size, Some([lens.width, lens.height]));
        for i in 0..2 {
            proof::near(found.focal[i], lens.focal[i], 1e-9);
            proof::near(found.centre[i], lens.centre[i], 1e-9);
            proof::near(found.radial[i], lens.radial[i], 1e-12);
        }
        assert!((found.pose.translation - pose.translation).norm() < 1e-9);
        let turned = found.pose.rotation.matrix() - pose.rotation.matrix();
        assert!(turned.norm() < 1e-9);
    }
}

#[test]
fn cameras_json_comes_back() {
    let want = cameras();
    let model = from_json("cameras.json", &cameras_to_json(&want)).unwrap();
    same(&model.cameras, &want);
    assert_eq!((model.unit_mm, model.ground), (Some(1.0), Some(3.5)));
}

#[test]
fn an_uncertainty_that_nobody_knows_is_null() {
    let mut cameras = cameras();
    assert!(cameras_to_json(&cameras).contains("\"sigma_mm\": 0.5"));
    let mut views: Vec<_> = cameras.views.iter().map(|(i, v)| (i, v.clone())).collect();
    views.iter_mut().for_each(|(_, v)| v.sigma_mm = None);
    cameras.views = views.into_iter().collect();
    let json = cameras_to_json(&cameras);
    assert_eq!(json.matches("\"sigma_mm\": null").count(), 4, "{json}");
}

#[test]
fn a_colmap_text_model_comes_back() {
    let want = cameras();
    let files = cameras_to_colmap_text(&want);
    let text = |i: usize| String::from_utf8(files[i].1.clone()).unwrap();
    let model = from_colmap_text(&text(0), &text(1), &text(2)).unwrap();
    same(&model.cameras, &want);
    assert_eq!(model.points[1], [-4.0, 0.25, 900.0]);
}

#[test]
fn a_colmap_binary_model_comes_back_and_half_of_it_is_refused() {
    let want = cameras();
    let files = cameras_to_colmap_binary(&want);
    let model = from_colmap_binary(&files[0].1, &files[1].1, &files[2].1).unwrap();
    same(&model.cameras, &want);
    assert_eq!(model.points[0], [1.0, 2.0, 3.5]);
    for cut in [0, 5, 40, files[1].1.len() - 3] {
        let broken = from_colmap_binary(&files[0].1, &files[1].1[..cut], &[]);
        assert!(
            matches!(broken, Err(ForeignError::Unread { .. })),
            "cut at {cut}"
        );
    }
}

#[test]
fn a_middlebury_file_comes_back_unless_the_lens_bends_lines() {
    let mut want = cameras();
    let why = cameras_to_middlebury(&want).unwrap_err().to_string();
    assert!(why.contains("knows no distortion"), "{why}");
    let mut views: Vec<_> = want.views.iter().map(|(i, v)| (i, v.clone())).collect();
    views
        .iter_mut()
        .for_each(|(_, v)| v.camera.lens.radial = [0.0; 2]);
    want.views = views.into_iter().collect();
    let text = cameras_to_middlebury(&want).unwrap();
    let model = from_middlebury("x_par.txt", &text).unwrap();
    assert_eq!(model.cameras.len(), 4);
    for (found, want) in model.cameras.iter().zip(want.views.values()) {
        assert_eq!(found.name, want.name.replace(' ', "_"));
        assert_eq!(found.centre, want.camera.lens.centre);
        let off = found.pose.translation - want.camera.pose.translation;
        assert!(off.norm() < 1e-9);
    }
}

#[test]
fn middlebury_reads_and_tells_a_short_line() {
    let line = "a.png 1500 0 320 0 1510 240 0 0 1 1 0 0 0 0 -1 0 1 0 0.5 -0.25 2";
    let model = from_middlebury("x_par.txt", &format!("1\n{line}\n")).unwrap();
    let camera = &model.cameras[0];
    assert_eq!(
        (camera.name.as_str(), camera.focal),
        ("a.png", [1500.0, 1510.0])
    );
    assert_eq!(camera.pose.translation, Vector3::new(0.5, -0.25, 2.0));
    let turned = camera.pose.rotation * Vector3::y() - Vector3::z();
    assert!(turned.norm() < 1e-12);
    let short = from_middlebury("x_par.txt", "1\na.png 1500 0 320\n");
    assert_eq!(
        short.unwrap_err().to_string(),
        "x_par.txt: line 2 holds 3 numbers, not 21"
    );
}

#[test]
fn a_mirror_is_no_rotation() {
    let line = "a.png 1500 0 320 0 1510 240 0 0 1 1 0 0 0 1 0 0 0 -1 0 0 2";
    assert!(from_middlebury("x_par.txt", &format!("1\n{line}\n")).is_err());
}

#[test]
fn tangential_distortion_is_refused_by_name() {
    let text = "1 OPENCV 100 80 90 90 50 40 0.1 0 0.01 0\n";
    let error = from_colmap_text(text, "", "").unwrap_err();
    assert!(matches!(error, ForeignError::Lens { model, .. } if model == "OPENCV"));
}
