//! Tests of mixtures: a blurred disc before a wall.

use super::*;
use crate::likelihood::background::{Ground, Noise, background_cost};
use crate::likelihood::neighbourhoods::REACH_PX;
use shape::{Image, Rgb};

const SIDE: usize = 120;
const RADIUS: f64 = 40.0;

/// How far within a disc a pixel's middle is.
fn depth(x: usize, y: usize) -> f64 {
    RADIUS - libm::hypot(x as f64 - 59.3, y as f64 - 59.8)
}

/// Looks at a disc before a wall, blurred by so much, and all its pixels.
fn of_disc<T>(
    blur: f64,
    [body, wall]: [[f64; 3]; 2],
    look: impl FnOnce(&Sides<'_>, &[(usize, usize)]) -> T,
) -> T {
    let mut dice = proof::Dice(5);
    let light = |level: f64| f64::from(shape::light_of_level(level as f32));
    let mut photo = Image::filled(SIDE, SIDE, [0; 3]);
    for (i, p) in photo.data.iter_mut().enumerate() {
        let deviations = depth(i % SIDE, i / SIDE) / blur;
        let share = libm::erfc(-deviations / std::f64::consts::SQRT_2) / 2.0;
        *p = std::array::from_fn(|c| {
            let mixed = light(wall[c]) + share * (light(body[c]) - light(wall[c]));
            let level = f64::from(shape::level_of_light(mixed as f32));
            (level + 1.0 * dice.normal()).round() as u8
        });
    }
    let plate = Backdrop::whole(Rgb::filled(SIDE, SIDE, wall.map(|v| v as u8)));
    let (noise, ground) = (Noise::even(1.3), |_: usize, _: usize| Ground::Wall);
    let cost = background_cost(
        &photo,
        &plate.image,
        noise,
        &ground,
        REACH_PX,
        [0, 0, SIDE, SIDE],
    );
    let likeness = Likeness {
        photo: &photo,
        expected: &plate.image,
        noise,
        ground: &ground,
        reach: REACH_PX,
    };
    let places: Vec<_> = (0..SIDE * SIDE).map(|i| (i % SIDE, i / SIDE)).collect();
    let open = vec![Known::Unknown; cost.len()];
    look(&Sides::of(&likeness, &plate, &cost, &open), &places)
}

const SKIN: [f64; 3] = [190.0, 140.0, 120.0];
const GREY: [f64; 3] = [110.0, 112.0, 118.0];

#[test]
fn how_wide_borders_are_is_measured() {
    for blur in [0.6, 1.0, 1.5] {
        for pair in [[SKIN, GREY], [GREY, SKIN]] {
            let times = of_disc(blur, pair, |sides, places| {
                sides.blur(places, &sides.mixtures(places, FIRST_APART_PX))
            }) / blur as f32;
            assert!((0.85..1.2).contains(&times), "{blur} px times {times}");
        }
    }
    // A border as sharp as pixels has no mixtures.
    let sharp = of_disc(1e-3, [SKIN, GREY], |sides, places| {
        Mixtures::of(sides, places)
    });
    assert!(sharp.0.is_empty());
}

#[test]
fn a_mixture_is_on_the_side_that_it_shows_more_of() {
    let (all, cost) = of_disc(1.2, [SKIN, GREY], |sides, places| {
        (Mixtures::of(sides, places), sides.cost.to_vec())
    });
    assert!(all.0.len() > 500);
    let mut alone = 0;
    for (i, [background, body]) in &all.0 {
        let depth = depth(i % SIDE, i / SIDE);
        if depth.abs() > 0.5 {
            assert_eq!(body < background, depth > 0.0, "{depth} px");
        }
        // By itself it is no background.
        alone += usize::from(depth < -0.5 && cost[*i] > EVIDENT);
    }
    assert!(alone > 100, "{alone}");
}

#[test]
fn a_window_has_the_costs_of_its_own_pixels() {
    let all = of_disc(1.2, [SKIN, GREY], |sides, places| {
        Mixtures::of(sides, places)
    });
    let window = Window {
        x: 15,
        y: 30,
        width: 20,
        height: 30,
    };
    let within = all.within(&window, SIDE);
    for (here, (x, y)) in window.places().enumerate() {
        let at = all.0.iter().find(|(i, _)| *i == y * SIDE + x);
        assert_eq!(within[here], at.map(|(_, costs)| *costs));
    }
    assert!(within.iter().flatten().count() > 50);
}
