//! Tags laid out on a floor, as a walk sees them.

use super::*;
use nalgebra::{Point3, Rotation3};
use shape::{Camera, Intrinsics, PhotoId, Pose, Scale, Tag, View};

pub(crate) const MM_PER_UNIT: f64 = 2.5;
pub(crate) const MAT: Mat = Mat {
    tag_mm: 60.0,
    first_id: 0,
    count: 12,
    ring_mm: 187.0,
};

/// A camera at a place, looking at the floor before it. \[units\]
fn camera(centre: Point3<f64>, roll: f64) -> Camera {
    let lens = Intrinsics::simple(1200, 1600, 1500.0);
    let level = Camera::looking(lens, centre, Point3::new(0.0, 0.0, 60.0)).pose;
    let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), roll);
    Camera {
        lens,
        pose: Pose {
            rotation: turn * level.rotation,
            translation: turn * level.translation,
        },
    }
}

/// A walk of nine photos, near and far, high and low.
pub(crate) fn walk() -> Cameras {
    let view = |i: u32| {
        let angle = f64::from(i) * 0.7;
        let far = 700.0 + 90.0 * f64::from(i % 4);
        let high = 300.0 + 80.0 * f64::from(i % 3);
        let at = Point3::new(far * libm::cos(angle), far * libm::sin(angle), high);
        let camera = camera(at, 0.1 * f64::from(i % 2));
        let view = View::of(format!("{i}.jpg"), camera);
        (PhotoId(i), view)
    };
    Cameras::of((0..9).map(view), Scale::Nothing)
}

/// What the photos show of the mat, which is at a height; sides seem farther out. \[px\]
pub(crate) fn seen(cameras: &Cameras, height: f64, bloom_px: f64) -> Tags {
    let tag = |camera: &Camera, id: u32| {
        let corners = mat_corners(&MAT, id)?;
        let mut px = [[0.0; 2]; 4];
        for (k, corner) in corners.iter().enumerate() {
            let at = Point3::from(corner.coords / MM_PER_UNIT) + Vector3::z() * height;
            let at = camera.project(&at)?;
            // Found to a tenth of a pixel, each time otherwise.
            let off = |n: u32| 0.1 * libm::sin(f64::from(n) * 12.9898 + f64::from(id) + k as f64);
            px[k] = [at.x + off(1), at.y + off(2)];
        }
        let middle = [0, 1].map(|i| px.iter().map(|c| c[i]).sum::<f64>() / 4.0);
        let side = libm::hypot(px[1][0] - px[0][0], px[1][1] - px[0][1]);
        let grown = px.map(|c| [0, 1].map(|i| c[i] + (c[i] - middle[i]) * 2.0 * bloom_px / side));
        Some(Tag { id, corners: grown })
    };
    let of = |(id, view): (PhotoId, &View)| {
        let tags = (0..12).filter_map(|k| tag(&view.camera, k)).collect();
        (id, tags)
    };
    Tags {
        views: cameras.views.iter().map(of).collect(),
    }
}

fn scale(cameras: &Cameras, tags: &Tags, mat: Option<&Mat>) -> Option<TagScale> {
    let known = Known {
        tag_mm: MAT.tag_mm,
        mat,
        most_px: 2.0,
    };
    tag_scale(cameras, tags, &known)
}

#[test]
fn a_layout_and_the_tags_alone_tell_how_long_a_unit_is() {
    let cameras = walk();
    let tags = seen(&cameras, -31.0, 0.0);
    for mat in [Some(&MAT), None] {
        let found = scale(&cameras, &tags, mat).unwrap();
        proof::near(found.mm_per_unit, MM_PER_UNIT, 0.003 * MM_PER_UNIT);
        assert_eq!(found.tags, 12);
        assert!(found.sigma < 0.012, "{}", found.sigma);
        proof::near(found.ground.unwrap(), -31.0, 0.5);
    }
}

#[test]
fn bloom_moves_sides_within_their_interval_and_a_layout_not_at_all() {
    let cameras = walk();
    let tags = seen(&cameras, 0.0, 0.3);
    let laid = scale(&cameras, &tags, Some(&MAT)).unwrap();
    proof::near(laid.mm_per_unit, MM_PER_UNIT, 0.002 * MM_PER_UNIT);
    let alone = scale(&cameras, &tags, None).unwrap();
    let off = (alone.mm_per_unit / MM_PER_UNIT - 1.0).abs();
    assert!(
        off > 0.003 && off < 2.0 * alone.sigma,
        "{off} {}",
        alone.sigma
    );
}

#[test]
fn tags_that_are_no_one_place_are_left_out() {
    let cameras = walk();
    let mut tags = seen(&cameras, 0.0, 0.0);
    let mut views: Vec<(PhotoId, Vec<Tag>)> =
        tags.views.iter().map(|(id, t)| (id, t.clone())).collect();
    for (k, (_, seen)) in views.iter_mut().enumerate() {
        // Number 3 is elsewhere in every photo, number 5 twice in each, number 7 was misread once.
        let by = 40.0 * k as f64;
        seen[3].corners = seen[3].corners.map(|c| [c[0] + by, c[1] - by]);
        let twice = seen[5];
        seen.push(twice);
        if k == 2 {
            seen[7].corners = seen[7].corners.map(|c| [c[0] + 50.0, c[1]]);
        }
    }
    tags.views = views.into_iter().collect();
    let found = scale(&cameras, &tags, None).unwrap();
    assert_eq!(found.tags, 10);
    proof::near(found.mm_per_unit, MM_PER_UNIT, 0.003 * MM_PER_UNIT);
}

#[test]
fn one_photo_or_none_tells_nothing() {
    let cameras = walk();
    let tags = seen(&cameras, 0.0, 0.0);
    let one = tags.views.iter().take(1);
    let one = Tags {
        views: one.map(|(id, t)| (id, t.clone())).collect(),
    };
    assert_eq!(scale(&cameras, &one, None), None);
    assert_eq!(scale(&cameras, &Tags::default(), Some(&MAT)), None);
}
