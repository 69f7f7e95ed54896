//! A body that is refused names what broke it: photos, outlines, a lost half; once, for all girths.

use crate::made;

use nalgebra::Point3;
use shape::{
    BodyPart, Camera, Cameras, Girths, Intrinsics, LostParts, Mask, Masks, Mesh, Missing, Person,
    PhotoId, Photos, Refusal, Rig, Scale, View,
};
use std::sync::Arc;

const PHOTOS: u32 = 12;

/// Cameras all around, 4 m from the axis.
fn cameras() -> Cameras {
    let view = |k: u32| {
        let (s, c) = libm::sincos(f64::from(k) * std::f64::consts::TAU / f64::from(PHOTOS));
        let lens = Intrinsics::simple(200, 280, 520.0);
        let from = Point3::new(4000.0 * c, 4000.0 * s, 850.0);
        let camera = Camera::looking(lens, from, Point3::new(0.0, 0.0, 850.0));
        let view = View::of(format!("{k:04}.jpg"), camera);
        (PhotoId(k), view)
    };
    Cameras {
        views: (0..PHOTOS).map(view).collect(),
        ..made::cameras(Scale::Mat, Some(0.001), 0.0)
    }
}

/// What the cameras see of a surface.
fn masks(mesh: &Mesh, cameras: &Cameras) -> Masks {
    let seen = |(id, view): (PhotoId, &View)| {
        let mut mask = Mask::filled(200, 280, 0);
        let mut near = shape::Image::filled(200, 280, f64::MIN);
        for f in 0..mesh.faces.len() {
            let corners = mesh.triangle(f).map(|p| view.camera.project(&p).unwrap());
            let flat = corners.map(|px| [px.x, px.y, 0.0]);
            shape::fill_triangle(flat, &mut near, &mut |x, y, _| *mask.at_mut(x, y) = 255);
        }
        (id, mask)
    };
    cameras.views.iter().map(seen).collect()
}

/// One photo's mask, painted over.
fn painted(masks: &mut Masks, photo: u32, paint: impl Fn(&mut Mask)) {
    let kept = masks.views.get_mut(PhotoId(photo)).unwrap();
    let mut mask = kept.pixels();
    paint(&mut mask);
    *kept = mask.into();
}

/// Without what is below the hips of every or of one photo.
fn halved(masks: &mut Masks, one: Option<u32>) {
    for k in (0..PHOTOS).filter(|k| one.is_none_or(|one| one == *k)) {
        painted(masks, k, |mask| mask.data[200 * 140..].fill(0));
    }
}

/// Girths of a surface with photos and facts; what was warned of.
fn measured(mesh: &Mesh, masks: Masks, known: (Rig, Person)) -> (Girths, Vec<String>) {
    with_lost(mesh, masks, known, None)
}

/// The same where masks are known to leave out parts of the body.
fn with_lost(
    mesh: &Mesh,
    masks: Masks,
    (rig, person): (Rig, Person),
    lost_parts: Option<LostParts>,
) -> (Girths, Vec<String>) {
    let photos = Photos {
        rig,
        ..Photos::default()
    };
    let given = made::Given {
        photos: Some(Arc::new(photos)),
        masks: Some(Arc::new(masks)),
        person: Some(Arc::new(person)),
        lost_parts: lost_parts.map(Arc::new),
        ..made::Given::on(mesh, cameras())
    };
    let (_, girths) = given.measured();
    (girths, given.warned.0.into_inner().unwrap())
}

/// The one reason of all that is missing, once.
#[track_caller]
fn reported((girths, warned): (Girths, Vec<String>)) -> Missing {
    assert!(girths.girths.is_empty());
    let first = girths.missing.first().unwrap().clone();
    for missing in &girths.missing {
        assert_eq!(
            (missing.reason, &missing.why),
            (first.reason, &first.why),
            "{}",
            missing.name
        );
    }
    let times = warned
        .iter()
        .filter(|w| w.contains(first.why.as_str()))
        .count();
    assert_eq!(times, 1, "{warned:#?}");
    assert!(
        !warned.iter().any(|w| w.contains("two legs")) || first.reason == Refusal::NoLegs,
        "{warned:#?}"
    );
    first
}

#[test]
fn a_refused_body_names_its_cause_once() {
    let body = made::meshed(&made::built(1700.0, 1.0, 12.0), 12.0);
    let whole = masks(&body, &cameras());
    // What a hull keeps of a body whose legs one photo lacks.
    let mut upper = body.clone();
    upper
        .positions
        .iter_mut()
        .for_each(|p| p[2] = p[2].max(850.0));
    let none = <(Rig, Person)>::default;

    let mut one = whole.clone();
    halved(&mut one, Some(4));
    let cut = reported(measured(&upper, one, none()));
    assert_eq!(cut.reason, Refusal::Outlines);
    assert!(
        cut.why.contains("0004.jpg") && !cut.why.contains("0003.jpg"),
        "{}",
        cut.why
    );

    let mut empty = whole.clone();
    painted(&mut empty, 7, |mask| {
        mask.data.fill(0);
        mask.data[200 * 100 + 90..][..20].fill(255);
    });
    let cut = reported(measured(&upper, empty, none()));
    assert_eq!(cut.reason, Refusal::EmptyPhoto);
    assert!(cut.why.contains("0007.jpg"), "{}", cut.why);

    // Every outline is cut through at the hips: two pieces, of which one was kept.
    let mut through = whole.clone();
    for k in 0..PHOTOS {
        painted(&mut through, k, |mask| {
            mask.data[200 * 138..200 * 142].fill(0)
        });
    }
    let apart = reported(measured(&upper, through, none()));
    assert_eq!(apart.reason, Refusal::Incomplete);
    assert!(apart.why.contains("hangs apart"), "{}", apart.why);

    // All lack the lower half: only what is known of the body tells.
    let mut half = whole.clone();
    halved(&mut half, None);
    let known = |stature_mm, weight_kg| {
        let rig = Rig {
            stature_mm,
            ..Rig::default()
        };
        let person = Person {
            weight_kg,
            ..Person::default()
        };
        (rig, person)
    };
    let short = reported(measured(
        &upper,
        half.clone(),
        known(Some(1700.0), Some(70.0)),
    ));
    assert_eq!(short.reason, Refusal::Incomplete);
    assert!(
        short.why.contains("85 cm high") && short.why.contains("50 %"),
        "{}",
        short.why
    );
    let light = reported(measured(&upper, half.clone(), known(None, Some(70.0))));
    assert_eq!(light.reason, Refusal::Incomplete);
    assert!(light.why.contains("70.0 kg"), "{}", light.why);
    let unknown = reported(measured(&upper, half, none()));
    assert!(
        [Refusal::NoLegs, Refusal::NotUpright].contains(&unknown.reason),
        "{unknown:?}"
    );
}

#[test]
fn legs_that_most_masks_leave_out_have_no_girths_and_those_of_one_mask_have() {
    let body = made::meshed(&made::built(1700.0, 1.0, 12.0), 12.0);
    let whole = masks(&body, &cameras());
    let reported = |photos: u32| {
        let mut parts = LostParts {
            photos: PHOTOS,
            ..LostParts::default()
        };
        parts.lost[BodyPart::Legs as usize] = (0..photos).map(PhotoId).collect();
        with_lost(&body, whole.clone(), Default::default(), Some(parts))
    };
    let names =
        |girths: &Girths| -> Vec<String> { girths.girths.iter().map(|g| g.name.clone()).collect() };
    let (one, _) = reported(1);
    assert_eq!(
        names(&one),
        names(&measured(&body, whole.clone(), Default::default()).0)
    );
    let (most, warned) = reported(7);
    let left: Vec<String> = names(&one)
        .into_iter()
        .filter(|name| !name.starts_with("TC") && !name.starts_with("CFC"))
        .collect();
    assert!(left.len() < one.girths.len(), "{:?}", names(&one));
    assert_eq!(names(&most), left);
    let why = "7 of 12 masks leave out a part of the body that this needs";
    let reported = warned.iter().filter(|w| w.contains(why)).count();
    assert_eq!(reported, 1, "{warned:#?}");
}
