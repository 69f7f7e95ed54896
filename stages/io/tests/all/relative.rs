//! Where nothing of known length was given, no file of ours names a unit of length.

use io::{cameras_to_json, landmarks_to_json};
use nalgebra::{Rotation3, Vector3};
use serde_json::Value;
use shape::{
    Camera, Cameras, GirthId, Intrinsics, Landmark, Landmarks, Part, PhotoId, Plane, Pose, Scale,
    Unit, View,
};

fn landmarks(unit: Unit) -> Value {
    let plane = Plane {
        point_mm: [10.0, -20.0, 500.0],
        normal: [0.0, 0.0, 1.0],
    };
    let mut mark = Landmark::new(GirthId::Waist, plane, Part::Trunk);
    mark.sigma.level_mm = Some(12.5);
    let marks = Landmarks {
        unit,
        found: vec![mark],
        points: vec![
            ("crown".into(), [0.0, 0.0, 900.0]),
            ("front".into(), [0.0, -1.0, 0.0]),
        ],
        stature_mm: Some(900.0),
        ground_mm: Some(0.0),
        ..Landmarks::default()
    };
    serde_json::from_str(&landmarks_to_json(&marks)).unwrap()
}

fn cameras(scale: Scale) -> Cameras {
    let view = |i: u32| View {
        name: format!("{i:04}.jpg"),
        camera: Camera {
            lens: Intrinsics::simple(300, 400, 500.0),
            pose: Pose {
                rotation: Rotation3::from_euler_angles(1.5, 0.0, f64::from(i)),
                translation: Vector3::new(0.0, 0.0, 1000.0),
            },
        },
        sigma_mm: Some(1.5),
        rms_px: None,
        points: 0,
    };
    Cameras {
        views: (0..6).map(|i| (PhotoId(i), view(i))).collect(),
        scale,
        scale_sigma: None,
        disk_radius_mm: Some(200.0),
        ground_mm: -3.0,
        points: vec![],
    }
}

#[test]
fn landmarks_of_unknown_scale_are_shares_of_the_ring() {
    let (unscaled, known) = (landmarks(Unit::Relative), landmarks(Unit::Metric));
    assert!(!unscaled.to_string().contains("mm"), "{unscaled}");
    assert_eq!(unscaled["unit"], "relative");
    assert_eq!(known["unit"], "mm");
    for (relative, metric, value) in [
        (
            "/landmarks/0/plane/point_rel/2",
            "/landmarks/0/plane/point_mm/2",
            500.0,
        ),
        (
            "/landmarks/0/sigma/level_rel",
            "/landmarks/0/sigma/level_mm",
            12.5,
        ),
        ("/points/crown/2", "/points/crown/2", 900.0),
        ("/stature_rel", "/stature_mm", 900.0),
    ] {
        let at = |file: &Value, place: &str| file.pointer(place).unwrap().as_f64().unwrap();
        proof::near(at(&unscaled, relative), value / 1000.0, 1e-9);
        proof::near(at(&known, metric), value, 1e-9);
    }
    // A direction is no length.
    assert_eq!(unscaled["points"]["front"][1], -1.0);
}

#[test]
fn cameras_of_unknown_scale_name_no_millimetres() {
    let json = cameras_to_json(&cameras(Scale::Nothing));
    let file: Value = serde_json::from_str(&json).unwrap();
    assert!(!json.contains("mm"), "{json}");
    assert_eq!(file["unit"], "relative");
    assert_eq!(file["ground_rel"], -3.0);
    let known: Value = serde_json::from_str(&cameras_to_json(&cameras(Scale::Mat))).unwrap();
    assert_eq!(
        (&known["unit"], &known["ground_mm"]),
        (&"mm".into(), &(-3.0).into())
    );
    assert_eq!(known["views"][0]["t"], file["views"][0]["t"]);
}
