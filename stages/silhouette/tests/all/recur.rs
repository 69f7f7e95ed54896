//! What photos of a turn share to the level is background, and a body that has turned is not.

use shape::{Image, Rgb};
use silhouette::Recurring;

/// A wall before which a plain block swings to and fro; turning changes its shade.
fn turn(dice: &mut proof::Dice) -> (Rgb, Vec<Rgb>) {
    let mut wall = Rgb::filled(60, 40, [0; 3]);
    for p in &mut wall.data {
        *p = [0, 1, 2].map(|_| dice.within(60.0, 200.0) as u8);
    }
    let mut photos = Vec::new();
    for (k, left) in [20, 22, 24, 26, 28, 30, 30, 28, 26, 24, 22, 20]
        .into_iter()
        .enumerate()
    {
        let body = |i: usize| (left..left + 14).contains(&(i % 60)) && (8..32).contains(&(i / 60));
        let mut photo = wall.clone();
        for (i, p) in photo.data.iter_mut().enumerate() {
            let shade = 25.0 * libm::sin(k as f64 * 1.1 + (i % 60) as f64 * 0.2);
            let shown = if body(i) {
                [210.0 + shade, 180.0 + shade, 160.0 + shade]
            } else {
                p.map(f64::from)
            };
            let noise = dice.within(-1.5, 1.5);
            *p = shown.map(|c| (c + noise).round() as u8);
        }
        photos.push(photo);
    }
    (wall, photos)
}

#[test]
fn the_wall_is_found_though_a_plain_body_covers_it_most_of_the_time() {
    let (wall, photos) = turn(&mut proof::Dice(2));
    let reported = Recurring::of(&photos).shown(None, 1.0);
    let off = |x: usize| {
        let (got, want) = (reported.image.at(x, 20), wall.at(x, 20));
        (0..3).map(|c| got[c].abs_diff(want[c])).max().unwrap()
    };
    // The body leaves these columns free on four photos of twelve.
    for x in [23, 40] {
        assert!(reported.seen.at(x, 20) && off(x) <= 2, "{x}: {}", off(x));
    }
    // Never free: nobody saw the wall there, and what there is is not called so.
    assert!((31..33).all(|x| !reported.seen.at(x, 20)));
}

#[test]
fn hidden_photos_are_not_asked() {
    let (wall, mut photos) = turn(&mut proof::Dice(3));
    // Seven photos agree on a blot that two do not show.
    for photo in &mut photos[..7] {
        (0..2400)
            .filter(|i| i % 60 < 12)
            .for_each(|i| photo.data[i] = [9, 90, 9]);
    }
    let hidden: Vec<Image<bool>> = (0..12).map(|k| Image::filled(60, 40, k < 7)).collect();
    assert_eq!(
        Recurring::of(&photos).shown(None, 1.0).image.at(5, 20),
        [9, 90, 9]
    );
    let reported = Recurring::of(&photos)
        .shown(Some(&hidden), 1.0)
        .image
        .at(5, 20);
    assert!((0..3).all(|c| reported[c].abs_diff(wall.at(5, 20)[c]) <= 2));
}

#[test]
fn a_crown_that_hardly_changes_while_it_turns_is_no_background() {
    let (wall, mut photos) = turn(&mut proof::Dice(4));
    // Always covered, each photo a level brighter: some pairs agree, but barely.
    let mut dice = proof::Dice(5);
    for (k, photo) in photos.iter_mut().enumerate() {
        for i in (0..2400).filter(|i| i % 60 < 12) {
            let level = 90.0 + 0.9 * k as f64;
            photo.data[i] = [0, 1, 2].map(|_| (level + dice.within(-1.5, 1.5)).round() as u8);
        }
    }
    let seen = Recurring::of(&photos).shown(None, 1.0).seen;
    let count = |from: usize, to: usize| {
        let within = |i: &usize| (from..to).contains(&(i % 60));
        (0..2400).filter(within).filter(|i| seen.data[*i]).count()
    };
    assert!(count(2, 10) < 8 * 40 / 20, "{}", count(2, 10));
    assert!(
        count(50, 58) == 8 * 40,
        "{} {:?}",
        count(50, 58),
        wall.at(55, 5)
    );
}
