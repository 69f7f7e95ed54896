//! A known length between two points that somebody pointed at in photos.

use crate::post;

use nalgebra::Point3;
use post::{framed_with, turn};
use shape::{Cameras, Reference, Rig, Scale, SeenEnds};

/// Two points 600 units apart, as they are seen in some photos of the turn, each pixel off by so much.
fn pointed(photos: &[usize], off_px: f64) -> Vec<SeenEnds> {
    let cameras = turn();
    let ends = [
        Point3::new(-250.0, 90.0, -380.0),
        Point3::new(350.0, 90.0, -380.0),
    ];
    let one = |i: &usize| {
        let sign = if i.is_multiple_of(2) { 1.0 } else { -1.0 };
        let px = ends.map(|end| {
            let at = cameras[*i].project(&end).unwrap();
            [at.x + sign * off_px, at.y - sign * off_px]
        });
        let photo = format!("{i:04}.png");
        SeenEnds { photo, px }
    };
    photos.iter().map(one).collect()
}

/// Cameras by a length of 1200 mm between two points, and a stature.
fn by_points(seen: Vec<SeenEnds>) -> Cameras {
    let rig = Rig {
        stature_mm: Some(1600.0),
        reference: Some(Reference {
            kind: "points".into(),
            length_mm: 1200.0,
            seen,
        }),
        ..Rig::default()
    };
    framed_with(rig, None, None).unwrap()
}

#[test]
fn a_length_between_two_points_that_somebody_pointed_at_makes_units_millimetres() {
    let far = |cameras: &Cameras| {
        let first = cameras.views.values().next().unwrap();
        first.camera.centre().coords.xy().norm()
    };
    let before = turn()[0].centre().coords.xy().norm();
    let size = |cameras: &Cameras| far(cameras) / before;
    let exact = by_points(pointed(&[0, 2, 5, 7], 0.0));
    assert_eq!(exact.scale, Scale::Reference);
    proof::near(size(&exact), 2.0, 1e-6);
    // Two pixels off, and its own interval contains the truth.
    let rough = by_points(pointed(&[0, 2, 5, 7], 1.5));
    let sigma = rough.scale_sigma.unwrap();
    assert!((size(&rough) / 2.0 - 1.0).abs() < 3.0 * sigma && sigma < 0.05);
    // More photos are surer.
    let more = by_points(pointed(&[0, 1, 2, 3, 4, 5, 6, 7], 0.0));
    assert!(more.scale_sigma < exact.scale_sigma);
}

#[test]
fn two_points_of_no_use_leave_the_length_to_other_marks() {
    let mut swapped = pointed(&[0, 2, 5], 0.0);
    swapped[1].px.reverse();
    let mut nameless = pointed(&[0, 2], 0.0);
    nameless[0].photo = "9999.png".into();
    for seen in [swapped, nameless, pointed(&[3], 0.0)] {
        assert_eq!(by_points(seen).scale, Scale::Stature);
    }
}
