//! Who turns is followed, past bystanders and photos that miss them.

use super::*;
use shape::{Image, Joint};

fn found(x: f32, side: f32, score: f32, presence: f32) -> Found {
    let joint = Joint {
        at_px: [x, 500.0],
        visibility: 1.0,
        presence: 1.0,
    };
    Found {
        score,
        presence,
        head_px: [0.0; 4],
        crop: Crop {
            centre_px: [x, 500.0],
            side_px: side,
            angle: 0.0,
        },
        body: Image::filled(0, 0, 0),
        joints: vec![joint; 33],
    }
}

fn turn(of: impl Fn(u32) -> Vec<Found>) -> ByPhoto<Vec<Found>> {
    (0..12).map(|i| (PhotoId(i), of(i))).collect()
}

#[test]
fn the_one_on_the_axis_is_followed_past_a_surer_bystander() {
    let views = turn(|i| match i {
        3 | 4 => vec![
            found(900.0 + i as f32, 700.0, 0.99, 0.99),
            found(402.0, 810.0, 0.8, 0.9),
        ],
        _ => vec![found(400.0 + i as f32, 800.0, 0.9, 0.99)],
    });
    let Followed {
        views,
        person,
        beside,
    } = followed(views);
    assert!(person);
    assert!(views.values().all(|f| f[0].crop.centre_px[0] < 420.0));
    assert_eq!(views.get(PhotoId(3)).unwrap().len(), 2);
    assert_eq!(beside, [PhotoId(3), PhotoId(4)]);
}

#[test]
fn who_is_not_found_on_a_photo_is_to_be_looked_for_where_most_photos_show_that_one() {
    let views = turn(|i| match i {
        7 => vec![found(900.0, 500.0, 0.6, 0.95)],
        9 => vec![],
        11 => vec![found(430.0, 400.0, 0.6, 0.8)],
        _ => vec![found(400.0 + i as f32, 800.0, 0.9, 0.99)],
    });
    let views: Vec<_> = views.iter().map(|(id, f)| (id, f.clone())).collect();
    let missing = not_found(&views).unwrap();
    // On the third the network took the upper half of that one for all.
    assert_eq!(missing.photos, [(7, 0.99), (9, 0.99), (11, PRESENT)]);
    assert!((400.0..412.0).contains(&missing.square.centre_px[0]));
    assert!(not_found(&views[7..10]).is_none(), "one of three is nobody");
}

#[test]
fn who_is_surely_on_most_photos_is_looked_for_on_the_rest_and_what_is_not_surely_anybody_is_not() {
    let views = |presence: f32| {
        let views = turn(|i| match i {
            0..=3 => vec![],
            _ => vec![found(400.0 + i as f32, 800.0, 0.9, presence)],
        });
        views
            .iter()
            .map(|(id, f)| (id, f.clone()))
            .collect::<Vec<_>>()
    };
    let missing = not_found(&views(0.995)).unwrap();
    assert_eq!(missing.photos.len(), 4);
    assert!(not_found(&views(0.9)).is_none());
}

/// Somebody whose shoulders are so wide. \[px\]
fn faces(x: f32, score: f32, wide: f32) -> Found {
    let mut found = found(x, 800.0, score, 0.99);
    found.joints[11].at_px[0] = x + wide / 2.0;
    found.joints[12].at_px[0] = x - wide / 2.0;
    found
}

#[test]
fn the_one_who_turns_is_followed_past_one_who_is_surer_on_all_photos() {
    let turned = |i: u32| 160.0 * libm::cosf(i as f32 * std::f32::consts::TAU / 12.0);
    // The one beside is seen from behind: the network takes his left for his right on every second photo.
    let beside = |i: u32| {
        faces(
            1300.0,
            0.99,
            if i.is_multiple_of(2) { 150.0 } else { -158.0 },
        )
    };
    let views = turn(|i| match i {
        5 => vec![beside(i)],
        _ => vec![beside(i), faces(400.0, 0.7, turned(i))],
    });
    let Followed {
        views,
        person,
        beside,
    } = followed(views);
    assert!(person && beside.len() == 12);
    let first = |i: u32| views.get(PhotoId(i)).unwrap().first();
    assert!(first(5).is_none(), "who is not followed is nobody");
    assert!(
        (0..12)
            .filter_map(first)
            .all(|f| f.crop.centre_px[0] < 420.0)
    );
}

#[test]
fn what_is_seen_here_and_there_is_no_person() {
    let jumps = turn(|i| vec![found(100.0 * (i % 5) as f32, 300.0, 0.9, 0.9)]);
    assert!(!followed(jumps).person);
    let seldom = turn(|i| match i % 2 {
        0 => vec![found(400.0, 800.0, 0.9, 0.99)],
        _ => vec![],
    });
    assert!(!followed(seldom).person);
    let unsure = turn(|_| vec![found(400.0, 800.0, 0.9, 0.2)]);
    assert!(!followed(unsure).person);
    assert!(!followed(ByPhoto::default()).person);
}
