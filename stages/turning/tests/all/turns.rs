//! Turns that are not as they should be: each is answered, or refused by its name.

use crate::body::Turn;
use std::f64::consts::TAU;

/// How far azimuths are from the true ones, once the first are laid on each other, whichever way round they count. \[°\]
fn worst(turn: &Turn, found: &[(String, f64)]) -> f64 {
    let way = |sign: f64| {
        let off = |(name, azimuth): &(String, f64)| {
            let i: usize = name[..4].parse().unwrap();
            let off = azimuth - sign * turn.azimuths[i];
            off - TAU * (off / TAU).round()
        };
        let first = off(&found[0]);
        let all = found.iter().map(|f| off(f) - first);
        let all = all.map(|o| (o - TAU * (o / TAU).round()).abs());
        all.fold(0.0, f64::max).to_degrees()
    };
    way(1.0).min(way(-1.0))
}

/// Why a turn is refused.
fn refused(turn: &Turn) -> String {
    match turn.taken(false) {
        Err(stage::Stop::Failed(error)) => error.to_string(),
        _ => String::new(),
    }
}

#[test]
fn two_turns_are_taken_together_and_named() {
    let turn = Turn::even(48, 720.0);
    let (found, warned) = turn.taken(false).unwrap();
    assert!(warned.contains("turned 2 times"), "{warned}");
    assert_eq!(found.len(), 48);
    assert!(worst(&turn, &found) < 4.0, "{}", worst(&turn, &found));
}

#[test]
fn half_a_turn_is_refused_with_the_photos_beside_the_gap() {
    let text = refused(&Turn::even(16, 190.0));
    assert!(text.contains("between 0015.jpg and 0000.jpg"), "{text}");
    assert!(text.contains("all the way round"), "{text}");
}

#[test]
fn turning_back_is_followed_and_named() {
    let mut turn = Turn::even(24, 360.0);
    turn.azimuths
        .extend((0..6).map(|i| TAU * (23.0 - f64::from(i) * 1.5) / 24.0));
    let (found, warned) = turn.taken(false).unwrap();
    assert!(warned.contains("turned back by"), "{warned}");
    assert!(worst(&turn, &found) < 4.0, "{}", worst(&turn, &found));
}

#[test]
fn a_slow_film_of_many_photos_is_followed() {
    let turn = Turn::even(36, 360.0);
    let (found, _) = turn.taken(false).unwrap();
    assert!(worst(&turn, &found) < 4.0, "{}", worst(&turn, &found));
}

#[test]
fn a_mirrored_picture_is_a_turn_the_other_way() {
    let turn = Turn {
        change: |[x, y]| [-x, y],
        mirrored: true,
        ..Turn::even(24, 360.0)
    };
    let (found, warned) = turn.taken(false).unwrap();
    assert_eq!(warned, "");
    assert!(worst(&turn, &found) < 4.0, "{}", worst(&turn, &found));
}

#[test]
fn upside_down_is_refused_as_that() {
    let turn = Turn {
        change: |[x, y]| [-x, -y],
        ..Turn::even(24, 360.0)
    };
    let text = refused(&turn);
    assert!(text.contains("upside down"), "{text}");
}

#[test]
fn somebody_else_on_a_photo_is_left_out_by_name() {
    let turn = Turn {
        other: Some(7),
        ..Turn::even(24, 360.0)
    };
    let (found, warned) = turn.taken(true).unwrap();
    assert!(
        warned.contains("the outline on 0007.jpg fits nowhere"),
        "{warned}"
    );
    assert_eq!(found.len(), 23);
    assert!(worst(&turn, &found) < 4.0, "{}", worst(&turn, &found));
}
