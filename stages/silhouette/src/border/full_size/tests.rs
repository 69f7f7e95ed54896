//! Tests of borders at full size, where nobody saw what is behind them.

use super::*;
use crate::likelihood::background::{FLAT, Ground};
use crate::likelihood::prepared::prepare;
use crate::raster::raster;

const SIDE: usize = 240;
const RADIUS: f64 = 80.0;

/// How far within the disc a pixel's middle is. \[px\]
fn depth(i: usize) -> f64 {
    RADIUS - libm::hypot((i % SIDE) as f64 - 119.3, (i / SIDE) as f64 - 119.8)
}

/// A blurred disc of skin before a wall.
fn photo() -> Rgb {
    let mut dice = proof::Dice(9);
    let light = |level: f64| f64::from(shape::light_of_level(level as f32));
    let one = |i: usize| {
        let share = libm::erfc(-depth(i) / std::f64::consts::SQRT_2) / 2.0;
        [[190.0, 110.0], [140.0, 112.0], [120.0, 118.0]].map(|[skin, wall]| {
            let mixed = light(wall) + share * (light(skin) - light(wall));
            let level = f64::from(shape::level_of_light(mixed as f32));
            (level + dice.normal()).round() as u8
        })
    };
    raster(SIDE, SIDE, (0..SIDE * SIDE).map(one).collect())
}

/// The photo, the wall as it was seen from five pixels beyond the disc on, and a coarse cut.
fn unseen_behind() -> (Rgb, Backdrop, Prepared, Image<bool>) {
    let photo = photo();
    let seen = |i: usize| depth(i) < -5.0;
    let wall = (0..SIDE * SIDE).map(|i| if seen(i) { [110, 112, 118] } else { [0; 3] });
    let without = Backdrop {
        image: raster(SIDE, SIDE, wall.collect()),
        seen: raster(SIDE, SIDE, (0..SIDE * SIDE).map(seen).collect()),
    };
    let ready = prepare(&photo, &without, None, SIDE / 2, 0.0, &|_, _| vec![]);
    let half = SIDE / 2;
    let whole = |i: usize| i / half * 2 * SIDE + i % half * 2;
    let coarse = (0..half * half).map(|i| depth(whole(i)) > -2.0);
    (photo, without, ready, raster(half, half, coarse.collect()))
}

#[test]
fn a_border_before_what_nobody_saw_is_where_the_photo_shows_it() {
    let (photo, without, ready, coarse) = unseen_behind();
    let skin = (0..SIDE * SIDE).filter(|i| depth(*i) > 4.0);
    let skin: Vec<[u8; 3]> = skin.map(|i| photo.data[i]).collect();
    let gmm = Gmm::fit(&skin, 2).expect("clusters");
    let settings = Settings {
        gamma: 40.0,
        rounds: 2,
        clusters: 2,
        thinner: 0.0,
    };
    let mask = fine(&photo, &without, &ready, &coarse, &gmm, &settings);
    let area: f64 = mask.data.iter().map(|c| f64::from(*c) / 255.0).sum();
    let off = (area - std::f64::consts::PI * RADIUS * RADIUS) / (std::f64::consts::TAU * RADIUS);
    assert!(off.abs() < 0.2, "{off} px");
}

#[test]
fn what_nobody_saw_costs_little_where_the_scene_has_its_colour_beside() {
    let (photo, without, ready, coarse) = unseen_behind();
    let settled = Settled::of(&ready, &coarse, &band(&coarse), [SIDE, SIDE]);
    let likeness = Likeness {
        photo: &photo,
        expected: &without.image,
        noise: Noise::even(1.3),
        ground: &|_, _| Ground::Wall,
        reach: REACH_PX,
    };
    let cost = settled.cost(&likeness, &without);
    let row = SIDE / 2 * SIDE;
    let of = |within: std::ops::Range<f64>| -> Vec<f32> {
        let all = (row..row + SIDE).filter(|i| within.contains(&depth(*i)));
        all.map(|i| cost[i]).collect()
    };
    let (wall, skin) = (of(-5.0..-3.5), of(3.0..5.0));
    assert!(
        wall.len() > 1 && wall.iter().all(|c| *c < FLAT + 4.0),
        "{wall:?}"
    );
    assert!(
        skin.len() > 1 && skin.iter().all(|c| *c == UNSEEN),
        "{skin:?}"
    );
}
