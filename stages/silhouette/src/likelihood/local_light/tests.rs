//! Light beside a body is found by what is around.

use super::*;
use proof::Dice;

const SIZE: [usize; 2] = [120, 90];

/// A wall, a photo of it in the light of each place, with noise, and log-odds of somebody amid it.
struct Before {
    wall: Rgb,
    photo: Rgb,
    odds: Vec<f32>,
}

fn amid(x: usize, y: usize) -> bool {
    (50..70).contains(&x) && (20..90).contains(&y)
}

fn before(light: &dyn Fn(f64, f64) -> [f64; 3]) -> Before {
    let mut dice = Dice(7);
    let [width, height] = SIZE;
    let mut wall = Rgb::filled(width, height, [0; 3]);
    let mut photo = wall.clone();
    let mut odds = vec![-5.0; width * height];
    for i in 0..width * height {
        let (x, y) = (i % width, i / width);
        let color = [110 + x % 11, 130 + y % 7, 95 + (x + y) % 5].map(|v| v as f64);
        wall.data[i] = color.map(|v| v as u8);
        let here = light(x as f64, y as f64);
        let shown = |c: usize| color[c] * here[c] + 1.5 * dice.normal();
        photo.data[i] = [0, 1, 2].map(shown).map(|v| v.round() as u8);
        // The network is unsure beside a body, too.
        if (44..76).contains(&x) && y >= 14 {
            odds[i] = 0.0;
        }
        if amid(x, y) {
            (photo.data[i], odds[i]) = ([60, 62, 58], 5.0);
        }
    }
    Before { wall, photo, odds }
}

fn found(of: &Before, ground: Ground) -> Vec<f32> {
    let noise = Noise::even(1.5);
    local_light([&of.photo, &of.wall], &|_, _| ground, &of.odds, &noise, 1)
}

/// As a phone lifts what is around somebody dark: most beside the body.
fn halo(x: f64, y: f64) -> [f64; 3] {
    let (dx, dy) = ((x - 60.0).abs() - 10.0, (20.0 - y).max(0.0));
    let away = libm::hypot(dx.max(0.0), dy);
    [1.0 + 0.15 * libm::exp(-away * away / 800.0); 3]
}

#[test]
fn a_halo_is_found_beside_a_body_where_the_network_is_unsure() {
    let of = before(&halo);
    let light = found(&of, Ground::Wall);
    let unsure = (0..SIZE[0] * SIZE[1]).filter(|i| of.odds[*i] == 0.0);
    let off = unsure.map(|i| {
        let (x, y) = ((i % SIZE[0]) as f64, (i / SIZE[0]) as f64);
        (f64::from(light[i]) - halo(x, y)[0]).abs()
    });
    let most = off.fold(0.0, f64::max);
    assert!(most < 0.04, "{most} of 0.15");
    // The photo is what the wall is in that light.
    let shown = lit(&of.wall, &light, 1);
    let beside = |image: &Rgb| -> f64 {
        let all = (24..84).map(|y| f64::from(image.at(47, y)[1]));
        all.sum::<f64>() / 60.0
    };
    let [wall, shown, photo] = [&of.wall, &shown, &of.photo].map(beside);
    let off = (shown - photo).abs();
    assert!(off < 0.2 * (wall - photo).abs(), "{wall} {shown} {photo}");
}

#[test]
fn light_that_falls_off_to_one_side_goes_on_where_nothing_is_known() {
    let of = before(&|x, _| [1.0 - 0.002 * x; 3]);
    let light = found(&of, Ground::Floor);
    let at = |x: usize, y: usize| f64::from(light[y * SIZE[0] + x]);
    for (x, y) in [(3, 45), (60, 60), (116, 45)] {
        assert!((at(x, y) - 1.0 + 0.002 * x as f64).abs() < 0.01, "{x} {y}");
    }
}

#[test]
fn where_light_is_alike_or_nothing_shows_it_there_is_none() {
    let none: Vec<f32> = Vec::new();
    assert_eq!(found(&before(&|_, _| [1.0; 3]), Ground::Wall), none);
    assert_eq!(
        found(&before(&halo), Ground::Disk),
        none,
        "a disk that turned"
    );
    let mut nobody = before(&halo);
    nobody.odds.clear();
    assert_eq!(found(&nobody, Ground::Wall), none);
    // Another colour is another thing, and no light.
    let tinted = before(&|_, y| if y < 45.0 { [1.3, 0.8, 1.2] } else { [1.0; 3] });
    assert_eq!(found(&tinted, Ground::Wall), none);
}

#[test]
fn an_image_is_lit_at_full_size_as_at_the_reduced_one() {
    let image = Rgb::filled(12, 9, [100, 150, 200]);
    assert_eq!(lit(&image, &[], 3), image);
    let light: Vec<f32> = (0..12).map(|i| if i % 4 < 2 { 1.0 } else { 1.5 }).collect();
    let shown = lit(&image, &light, 3);
    assert_eq!(*shown.row(4).first().unwrap(), [100, 150, 200]);
    assert_eq!(*shown.row(4).last().unwrap(), [150, 225, 255]);
    // Midway between the middles of two.
    let middle = shown.at(6, 4)[0];
    assert!((125..=135).contains(&middle), "{middle}");
}
