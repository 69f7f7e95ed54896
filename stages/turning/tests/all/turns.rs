//! Turns that are not as they should be: each is answered, or refused by its name.

use crate::body::Turn;
use std::f64::consts::TAU;

/// How far azimuths are from the true ones, once they are laid on each other, whichever way round they count: the root mean
/// square and the worst. \[°\]
fn apart(turn: &Turn, found: &[(String, f64)]) -> (f64, f64) {
    let way = |sign: f64| {
        let off = |(name, azimuth): &(String, f64)| {
            let i: usize = name[..4].parse().unwrap();
            azimuth - sign * turn.azimuths[i]
        };
        let both = found.iter().map(|f| libm::sincos(off(f)));
        let (s, c) = both.fold((0.0, 0.0), |a, b| (a.0 + b.0, a.1 + b.1));
        let middle = libm::atan2(s, c);
        let all = found.iter().map(|f| off(f) - middle);
        let all: Vec<f64> = all.map(|o| o - TAU * (o / TAU).round()).collect();
        let square = all.iter().map(|o| o * o).sum::<f64>() / all.len() as f64;
        let worst = all.iter().fold(0.0, |most: f64, o| most.max(o.abs()));
        (square.sqrt().to_degrees(), worst.to_degrees())
    };
    let (one, other) = (way(1.0), way(-1.0));
    if one.0 < other.0 { one } else { other }
}

/// The worst of them. \[°\]
fn worst(turn: &Turn, found: &[(String, f64)]) -> f64 {
    apart(turn, found).1
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
fn uneven_steps_are_followed_as_even_ones_are_with_joints_as_rough_as_a_networks() {
    let in_turns = |i: usize| if i.is_multiple_of(2) { 3.5 } else { 26.5 };
    let slow_and_fast = |i: usize| 15.0 + 11.5 * libm::sin(i as f64 / 24.0 * TAU);
    let by_chance = |i: usize| 15.0 + 11.5 * libm::sin(77.0 * (i * i) as f64);
    for way in [in_turns, slow_and_fast, by_chance] as [fn(usize) -> f64; 3] {
        let whole: f64 = (0..24).map(way).sum();
        let at = |i: usize| TAU * (0..i).map(way).sum::<f64>() / whole;
        let turn = Turn {
            azimuths: (0..24).map(at).collect(),
            noise_px: 2.0,
            ..Turn::even(24, 360.0)
        };
        for masked in [false, true] {
            let (found, warned) = turn.taken(masked).unwrap();
            assert!(!warned.contains("turned back"), "{warned}");
            assert!(found.len() > 22, "{warned}");
            let (off, worst) = apart(&turn, &found);
            assert!(off < 4.0 && worst < 15.0, "{off}°, {worst}°");
        }
    }
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
    assert!(!warned.contains("turned back"), "{warned}");
    assert_eq!(found.len(), 23);
    assert!(worst(&turn, &found) < 4.0, "{}", worst(&turn, &found));
}

#[test]
fn a_camera_in_the_hand_is_refused_as_that() {
    let turn = Turn {
        shake_px: 8.0,
        ..Turn::even(24, 360.0)
    };
    let Err(stage::Stop::Failed(error)) = turn.taken(true) else {
        panic!("taken");
    };
    assert!(error.to_string().contains("put the camera"), "{error}");
}
