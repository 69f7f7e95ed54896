//! Lengths that the user knows make cameras millimetres; lengths that contradict each other do not.

use crate::post;

use nalgebra::{Point3, Vector3};
use pose::mat_corners;
use post::{framed_from, framed_with, photo, turn};
use shape::{Camera, Cameras, Length, Mat, Photo, PhotoId, Reference, Rig, Scale, Tag, Tags};

/// A mat under the post.
const MAT: Mat = Mat {
    tag_mm: 120.0,
    first_id: 0,
    count: 10,
    ring_mm: 420.0,
};

/// What photos show of a mat on the ground.
fn tags(cameras: &[Camera], mat: &Mat) -> Tags {
    let tag = |camera: &Camera, id: u32| {
        let ground = Vector3::new(0.0, 0.0, -400.0);
        let at = |corner: Point3<f64>| camera.project(&Point3::from(corner.coords / 2.0 + ground));
        let [a, b, c, d] = mat_corners(mat, id)?.map(at);
        let corners = [a?, b?, c?, d?].map(|px| [px.x, px.y]);
        Some(Tag { id, corners })
    };
    let view = |(i, camera): (usize, &Camera)| {
        let seen = (0..mat.count).filter_map(|id| tag(camera, id)).collect();
        (PhotoId(i as u32), seen)
    };
    Tags {
        views: cameras.iter().enumerate().map(view).collect(),
    }
}

/// A disk of 900 mm on a darker floor, and on it a circle that is much brighter, 600 mm wide.
fn plate(camera: &Camera) -> Photo {
    let mut gray = shape::Image::filled(320, 480, 90);
    for (i, level) in gray.data.iter_mut().enumerate() {
        let (x, y) = ((i % 320) as f64, (i / 320) as f64);
        let (from, ray) = (camera.centre(), camera.ray([x, y].into()));
        let at = from + ray.into_inner() * ((-400.0 - from.z) / ray.z);
        let far = libm::hypot(at.x, at.y);
        if ray.z < 0.0 && far < 225.0 {
            *level = if far < 150.0 { 190 } else { 130 };
        }
    }
    photo("plate.png", &gray)
}

/// Cameras in millimetres from a stature and a reference length, both of the post. \[mm\]
fn framed(stature_mm: f64, reference_mm: f64) -> Result<Cameras, String> {
    framed_by(stature_mm, reference_mm, None, None)
}

/// What is known of tags on the ground: a layout, their size.
type Known = (Option<Mat>, Option<f64>);

/// As [`framed`], with tags on the ground, and a disk.
fn framed_by(
    stature_mm: f64,
    reference_mm: f64,
    mat: Option<Known>,
    disk_mm: Option<f64>,
) -> Result<Cameras, String> {
    let rig = Rig {
        disk_diameter_mm: disk_mm,
        stature_mm: Some(stature_mm),
        reference: Some(Reference {
            kind: "subject_height".into(),
            length_mm: reference_mm,
            seen: vec![],
        }),
        mat: mat.and_then(|m| m.0),
        tag_mm: mat.and_then(|m| m.1),
        ..Rig::default()
    };
    let plate = disk_mm.map(|_| plate(&turn()[0]));
    framed_with(rig, mat.map(|_| tags(&turn(), &MAT)), plate)
}

#[test]
fn a_known_length_makes_units_millimetres() {
    let found = framed(1600.0, 1600.0).unwrap();
    let far = |camera: &Camera| camera.centre().coords.xy().norm();
    let (before, after) = (turn()[0], found.views.values().next().unwrap().camera);
    // A post has no round head, which the stature allows for.
    proof::near(far(&after) / far(&before), 2.0, 0.05);
    let near = framed(1600.0, 1680.0).unwrap();
    assert_eq!(near.scale, Scale::Reference, "a twentieth is reported");
}

/// Mean distance of cameras from the axis.
fn away(cameras: &Cameras) -> f64 {
    let far = cameras
        .views
        .values()
        .map(|v| v.camera.centre().coords.xy().norm());
    far.sum::<f64>() / cameras.views.len() as f64
}

#[test]
fn lengths_that_contradict_each_other_give_no_centimetres() {
    // The post is 800 mm tall where cameras of a mat are in millimetres.
    let by_mat = |scale, stature_mm| {
        let rig = Rig {
            stature_mm: Some(stature_mm),
            ..Rig::default()
        };
        framed_from(scale, rig, None, None).unwrap()
    };
    let near = by_mat(Scale::Mat, 820.0);
    assert_eq!(near.scale, Scale::Mat, "2.5 % is what people err");
    proof::near(away(&near), away(&by_mat(Scale::Mat, 800.0)), 1e-9);
    for stature_mm in [1780.0, 880.0, 740.0] {
        let off = by_mat(Scale::Mat, stature_mm);
        let pair = [Length::Mat, Length::Stature];
        assert_eq!(off.scale, Scale::Disputed(pair), "{stature_mm}");
        assert_eq!(off.scale.unit(), shape::Unit::Relative);
        assert_eq!((off.scale_sigma, off.disk_radius_mm), (None, None));
        proof::near(away(&off), 1000.0, 1e-9);
    }
    // Without a mat as well, and what was disputed once stays so.
    let pair = [Length::Reference, Length::Stature];
    assert_eq!(framed(1600.0, 1760.0).unwrap().scale, Scale::Disputed(pair));
    let before = Scale::Disputed([Length::Mat, Length::Reference]);
    assert_eq!(by_mat(before, 800.0).scale, before);
    // Two sizes of the same tags, one of them typed wrongly.
    let rig = Rig {
        mat: Some(MAT),
        reference: Some(Reference {
            kind: "tag_size".into(),
            length_mm: 1.1 * MAT.tag_mm,
            seen: vec![],
        }),
        ..Rig::default()
    };
    let found = framed_from(Scale::Mat, rig, None, None).unwrap();
    assert_eq!(
        found.scale,
        Scale::Disputed([Length::Mat, Length::Reference])
    );
}

#[test]
fn lengths_that_contradict_each_other_by_more_than_a_fifth_are_refused_by_name() {
    let why = framed(2100.0, 1600.0).unwrap_err();
    assert!(why.contains("the reference length (stature)"), "{why}");
    assert!(why.contains("contradict each other by 31 %"), "{why}");
    assert!(why.contains("capture.toml"), "{why}");
}

#[test]
fn tags_on_the_ground_of_a_walk_go_before_a_stature_and_give_the_ground() {
    let layout = (Some(MAT), None);
    let size = (None, Some(MAT.tag_mm));
    for known in [layout, size] {
        // The stature is 3 % too long: the tags are believed.
        let found = framed_by(1648.0, 1648.0, Some(known), None).unwrap();
        assert_eq!(found.scale, Scale::Tags);
        let far = |camera: &Camera| camera.centre().coords.xy().norm();
        let (before, after) = (turn()[0], found.views.values().next().unwrap().camera);
        proof::near(far(&after) / far(&before), 2.0, 1e-3);
        let high = |camera: &Camera| camera.centre().z;
        proof::near(high(&after), 2.0 * (high(&before) + 400.0), 1.0);
        assert!(
            found
                .scale_sigma
                .is_some_and(|s| (0.001..0.05).contains(&s))
        );
    }
    // Tags of a size that nobody knows are not used.
    let found = framed_by(1600.0, 1600.0, Some((None, None)), None).unwrap();
    assert_eq!(found.scale, Scale::Reference);
}

#[test]
fn of_two_circles_the_one_that_the_stature_vouches_for_is_the_disk() {
    let found = framed_by(1600.0, 1600.0, None, Some(900.0)).unwrap();
    proof::near(found.disk_radius_mm.unwrap(), 450.0, 1e-9);
    let far = |camera: &Camera| camera.centre().coords.xy().norm();
    let (before, after) = (turn()[0], found.views.values().next().unwrap().camera);
    proof::near(far(&after) / far(&before), 2.0, 0.05);
    // No stature is given: the strongest circle it is, and only a stature could tell that it is the ring.
    assert!(framed_by(1600.0, 1600.0, None, Some(1500.0)).is_err());
}

#[test]
fn tags_on_the_disk_not_given_are_within_its_edge() {
    let rig = || Rig {
        disk_diameter_mm: Some(900.0),
        ..Rig::default()
    };
    let disk = || Some(plate(&turn()[0]));
    let far = |cameras: &Cameras| {
        let first = cameras.views.values().next().unwrap();
        first.camera.centre().coords.xy().norm()
    };
    let before = turn()[0].centre().coords.xy().norm();
    // The bright circle of 600 mm is stronger than the disk's edge.
    let blind = framed_with(rig(), None, disk()).unwrap();
    proof::near(far(&blind) / before, 3.0, 0.1);
    let mat = Mat {
        tag_mm: 80.0,
        first_id: 0,
        count: 10,
        ring_mm: 340.0,
    };
    let found = framed_with(rig(), Some(tags(&turn(), &mat)), disk()).unwrap();
    assert_eq!(found.scale, Scale::Disk);
    proof::near(far(&found) / before, 2.0, 0.03);
    assert!(found.scale_sigma > blind.scale_sigma);
    // Tags that reach beyond every circle: no length is better than a wrong one.
    let wide = Mat {
        ring_mm: 520.0,
        ..MAT
    };
    let none = framed_with(rig(), Some(tags(&turn(), &wide)), disk()).unwrap();
    let radius = none.disk_radius_mm;
    assert_eq!(
        none.scale,
        Scale::Nothing,
        "{radius:?} {}",
        far(&none) / before
    );
}

#[test]
fn where_no_disk_is_given_a_floor_has_none() {
    // A dark floor before a bright wall, the body before both.
    let mut gray = shape::Image::filled(320, 480, 90);
    let soles = turn()[0].project(&Point3::new(0.0, 0.0, -400.0)).unwrap();
    gray.data[..320 * (soles.y as usize - 12)].fill(200);
    let rig = Rig {
        stature_mm: Some(1600.0),
        ..Rig::default()
    };
    let found = framed_with(rig, None, Some(photo("plate.png", &gray))).unwrap();
    assert_eq!(found.disk_radius_mm, None);
    let height = found.views.values().next().unwrap().camera.centre().z;
    let before = turn()[0].centre().z + 400.0;
    proof::near(height / before, 2.0, 0.05);
}

#[test]
fn a_stature_is_less_sure_where_soles_alone_give_the_ground() {
    let sure = |disk_mm| framed_by(1600.0, 1600.0, None, disk_mm).unwrap();
    let (by_soles, by_disk) = (sure(None), sure(Some(900.0)));
    let sigma = |cameras: &Cameras| cameras.scale_sigma.unwrap();
    assert_eq!(by_soles.scale, by_disk.scale);
    assert!(sigma(&by_soles) > 0.01, "{}", sigma(&by_soles));
    assert!(sigma(&by_disk) < 0.01, "{}", sigma(&by_disk));
}

/// A bright disk of 900 mm on a dark floor through a lens that is so soft, as light falls on a sensor. \[px\]
fn soft_plate(camera: &Camera, soft_px: f64) -> Photo {
    let lit = |x: f64, y: f64| {
        let (from, ray) = (camera.centre(), camera.ray([x, y].into()));
        let at = from + ray.into_inner() * ((-400.0 - from.z) / ray.z);
        let bright = ray.z < 0.0 && libm::hypot(at.x, at.y) < 225.0;
        if bright { 0.8 } else { 0.05 }
    };
    let spread: Vec<(f64, f64)> = (-8..=8)
        .flat_map(|i| (-8..=8).map(move |j| (f64::from(i) / 4.0, f64::from(j) / 4.0)))
        .collect();
    let mut gray = shape::Image::filled(320, 480, 0u8);
    for (i, level) in gray.data.iter_mut().enumerate() {
        let (x, y) = ((i % 320) as f64, (i / 320) as f64);
        let parts = spread
            .iter()
            .map(|(a, b)| lit(x + a * soft_px, y + b * soft_px));
        let light = parts.sum::<f64>() / spread.len() as f64;
        *level = shape::level_of_light(light as f32).round() as u8;
    }
    photo("plate.png", &gray)
}

#[test]
fn a_disk_gives_the_same_lengths_however_soft_its_photo_is() {
    let size = |soft_px| {
        let rig = Rig {
            disk_diameter_mm: Some(900.0),
            ..Rig::default()
        };
        let found = framed_with(rig, None, Some(soft_plate(&turn()[0], soft_px))).unwrap();
        let first = found.views.values().next().unwrap();
        first.camera.centre().coords.xy().norm() / turn()[0].centre().coords.xy().norm()
    };
    let (sharp, soft) = (size(0.25), size(1.2));
    proof::near(sharp, 2.0, 8e-3);
    proof::near(soft, sharp, 3e-3);
}
