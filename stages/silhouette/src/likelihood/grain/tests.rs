//! Bare feet on wood nearly of their colour lack its grain; their soft shadow does not.

use super::{missed_in_photo, strange};
use crate::likelihood::background::FLAT;
use crate::likelihood::floor::Floor;
use crate::likelihood::prepared::{Prepared, prepare};
use crate::scene::backdrop::{Backdrop, thinned};
use crate::scene::disk_plane::on_disk;
use crate::scene::still_and_disk::{Shot, scene};
use nalgebra::{Matrix3, Point2, Point3, Rotation3, Vector3};
use shape::{Camera, Image, Intrinsics, PhotoId, Pose, Rgb};

const SIZE: (usize, usize) = (180, 200);
const RADIUS: f64 = 300.0;
const PHOTOS: usize = 9;

/// The foot of a leg, and how far a place is from its middle line. \[mm\]
fn foot(side: f64, x: &Point3<f64>) -> f64 {
    let along = (x.y + 30.0).clamp(0.0, 150.0) - 30.0;
    libm::hypot(x.x - side * 100.0, x.y - along)
}

/// Two legs on z = 0, with feet that point along y. \[mm\]
fn body(x: &Point3<f64>) -> bool {
    // Most points that are asked are far from both.
    let near = x.x.abs() < 142.0 && (-72.0..162.0).contains(&x.y) && (0.0..430.0).contains(&x.z);
    near && [-1.0, 1.0].into_iter().any(|side| {
        let leg = libm::hypot(x.x - side * 100.0, x.y) < 42.0 && (0.0..430.0).contains(&x.z);
        leg || foot(side, x) < 42.0 && (0.0..55.0).contains(&x.z)
    })
}

/// Right, down and forward in the frame of the disk, which has turned on by an angle. \[rad\]
fn camera(angle: f64) -> Camera {
    tilted(angle, 0.5)
}

/// The same, which looks down by another angle. \[rad\]
fn tilted(angle: f64, by: f64) -> Camera {
    let (s, c) = libm::sincos(angle);
    let (down, level) = libm::sincos(by);
    let rows = Matrix3::new(
        c,
        s,
        0.0, //
        s * down,
        -c * down,
        -level, //
        -s * level,
        c * level,
        -down,
    );
    Camera {
        lens: Intrinsics::simple(SIZE.0 as u32, SIZE.1 as u32, 420.0),
        pose: Pose {
            rotation: Rotation3::from_matrix_unchecked(rows),
            translation: Vector3::new(0.0, 130.0, 1850.0),
        },
    }
}

/// The wood's light and dark lines.
fn grain(x: &Point3<f64>) -> f64 {
    let wide = libm::sin(x.y * 0.11 + 1.5 * libm::sin(x.x * 0.02));
    1.0 + 0.09 * wide + 0.05 * libm::sin(x.y * 0.19 + x.x * 0.04 + 1.0)
}

/// What is left of the light on the disk where the legs' shadows fall, all to one side of the wall.
fn shade(x: &Point3<f64>, angle: f64) -> f64 {
    let (s, c) = libm::sincos(angle);
    let step = Vector3::new(c, s, 0.0) * 20.0;
    let far = |side: f64, k: i32| foot(side, &(x - step * f64::from(k)));
    let near = (0..6).flat_map(|k| [far(-1.0, k), far(1.0, k)]);
    let near = near.fold(f64::MAX, f64::min);
    1.0 - 0.45 * libm::exp(-(near / 70.0) * (near / 70.0))
}

/// What a pixel shows.
#[derive(Clone, Copy, PartialEq)]
enum Shown {
    Wall,
    Disk,
    Foot,
    Leg,
}

/// A photo of the turn, and what each of its pixels shows; without the legs the disk's light is even.
fn photo(k: usize, legs: bool, wall: &Rgb, dice: &mut proof::Dice) -> (Shot, Vec<Shown>) {
    let angle = k as f64 * std::f64::consts::TAU / PHOTOS as f64;
    let camera = camera(angle);
    let (mut small, mut shows) = (wall.clone(), Vec::new());
    for (i, p) in small.data.iter_mut().enumerate() {
        let at = Point2::new((i % SIZE.0) as f64, (i / SIZE.0) as f64);
        let (from, ray) = (camera.centre(), camera.ray(at).into_inner());
        let mut steps = (0..260).map(|s| from + ray * (1350.0 + 4.0 * f64::from(s)));
        let (shown, color) = if let Some(hit) = steps.find(|x| legs && body(x)) {
            // Skin nearly of the wood's hue, lit from one side, with faint spots.
            let light = 0.9 + 0.12 * libm::sin(libm::atan2(hit.y, hit.x.abs() - 100.0) - angle);
            let spots = 4.0 * libm::sin(hit.x * 0.17) * libm::sin(hit.y * 0.13 + hit.z * 0.1);
            let skin = [176.0, 137.0, 114.0].map(|v| v * light + spots);
            let foot = hit.z < 55.0;
            (if foot { Shown::Foot } else { Shown::Leg }, skin)
        } else if let Some(hit) = on_disk(&camera, at, RADIUS) {
            let shade = if legs { shade(&hit, angle) } else { 1.0 };
            let light = grain(&hit) * shade;
            (Shown::Disk, [178.0, 146.0, 112.0].map(|v| v * light))
        } else {
            (Shown::Wall, p.map(f64::from))
        };
        *p = color.map(|v| (v + dice.within(-1.5, 1.5)).round() as u8);
        shows.push(shown);
    }
    let id = PhotoId(k as u32);
    (Shot { id, small, camera }, shows)
}

/// The wall.
fn wall(dice: &mut proof::Dice) -> Rgb {
    let mut wall = Rgb::filled(SIZE.0, SIZE.1, [0; 3]);
    for p in &mut wall.data {
        let level = 90.0 + dice.within(-12.0, 12.0);
        *p = [level, level + 4.0, level + 12.0].map(|v| v as u8);
    }
    wall
}

#[test]
fn feet_of_the_colour_of_the_wood_lack_its_grain_and_their_shadow_does_not() {
    let mut dice = proof::Dice(5);
    let wall = wall(&mut dice);
    let (shots, shows): (Vec<Shot>, Vec<Vec<Shown>>) = (0..PHOTOS)
        .map(|k| photo(k, true, &wall, &mut dice))
        .unzip();
    // As a first cut tells it: the feet, and a little around them.
    let covered: Vec<Image<bool>> = shows
        .iter()
        .map(|shows| {
            let (width, height) = SIZE;
            let data = shows.iter().map(|s| !matches!(s, Shown::Foot | Shown::Leg));
            let free = Image {
                width,
                height,
                data: data.collect(),
            };
            thinned(&free, 2).map(|free| !free)
        })
        .collect();
    let around = scene(&shots, Backdrop::whole(wall), RADIUS, &covered);
    let strange = strange(&shots, &around, &covered);
    let (mut feet, mut cheap, mut found, mut shaded, mut raised) = (0, 0, 0, 0, 0);
    let all = shots.iter().zip(&shows).zip(&strange).zip(&covered);
    for (((shot, shows), strange), covered) in all {
        let behind = around.behind(&shot.small, &shot.camera);
        let disk = Some(Floor::of_disk(shot.camera, RADIUS));
        let ready = prepare(&shot.small, &behind, disk, usize::MAX, 0.0, &|_, _| vec![]);
        for i in (0..shows.len()).filter(|i| behind.seen.data[*i]) {
            let at = Point2::new((i % SIZE.0) as f64, (i / SIZE.0) as f64);
            let Some(hit) = on_disk(&shot.camera, at, 0.95 * RADIUS) else {
                continue;
            };
            let angle = f64::from(shot.id.0) * std::f64::consts::TAU / PHOTOS as f64;
            match shows[i] {
                Shown::Foot => {
                    feet += 1;
                    cheap += u32::from(ready.cost[i] < FLAT + 4.0);
                    found += u32::from(strange[i] > 4.0);
                }
                Shown::Disk if shade(&hit, angle) < 0.9 && !covered.data[i] => {
                    shaded += 1;
                    raised += u32::from(strange[i] > 0.0);
                }
                _ => {}
            }
        }
    }
    // By colour alone a quarter of the feet would do as shaded wood.
    assert!(feet > 1000 && cheap * 4 > feet, "{cheap} of {feet}");
    assert!(found * 5 > feet * 4, "{found} of {feet}");
    // Beside soles, where a shadow ends within a window, it is one pixel of forty.
    assert!(
        shaded > 1000 && raised * 25 < shaded,
        "{raised} of {shaded}"
    );
}

/// A photo before its plate, without and with the grain.
fn weighed(shot: &Shot, plate: Rgb) -> [Prepared; 2] {
    let disk = Some(Floor::of_disk(shot.camera, RADIUS));
    let behind = Backdrop::whole(plate);
    let ready = || prepare(&shot.small, &behind, disk, usize::MAX, 0.0, &|_, _| vec![]);
    let mut after = ready();
    missed_in_photo(&mut after, &behind.image);
    [ready(), after]
}

#[test]
fn with_a_plate_one_photo_shows_feet_from_wood_of_their_colour() {
    let mut dice = proof::Dice(6);
    let wall = wall(&mut dice);
    let (mut feet, mut cheap, mut found, mut shaded, mut raised) = (0, 0, 0, 0, 0);
    for k in 0..PHOTOS {
        let (shot, shows) = photo(k, true, &wall, &mut dice);
        let (plate, _) = photo(k, false, &wall, &mut dice);
        let [before, after] = weighed(&shot, plate.small);
        for (i, shown) in shows.iter().enumerate() {
            let at = Point2::new((i % SIZE.0) as f64, (i / SIZE.0) as f64);
            match (shown, on_disk(&shot.camera, at, 0.95 * RADIUS)) {
                (Shown::Foot, Some(_)) => {
                    feet += 1;
                    cheap += u32::from(before.cost[i] < FLAT + 4.0);
                    found += u32::from(after.cost[i] > FLAT + 4.0);
                }
                (Shown::Disk, Some(hit)) => {
                    let angle = k as f64 * std::f64::consts::TAU / PHOTOS as f64;
                    if shade(&hit, angle) < 0.9 {
                        shaded += 1;
                        raised += u32::from(after.cost[i] > before.cost[i]);
                    }
                }
                _ => {}
            }
        }
    }
    assert!(feet > 1000 && cheap * 4 > feet, "{cheap} of {feet}");
    assert!(found * 10 > feet * 9, "{found} of {feet}");
    assert!(
        shaded > 1000 && raised * 25 < shaded,
        "{raised} of {shaded}"
    );
}

#[test]
fn trousers_of_the_floors_colour_lack_its_grain_and_the_bare_floor_does_not() {
    let mut dice = proof::Dice(7);
    let floor = wall(&mut dice);
    let (mut legs, mut cheap, mut found, mut bare, mut raised) = (0, 0, 0, 0, 0);
    for k in 0..PHOTOS {
        let (mut shot, shows) = photo(k, true, &floor, &mut dice);
        for (p, _) in shot
            .small
            .data
            .iter_mut()
            .zip(&shows)
            .filter(|(_, s)| **s == Shown::Leg)
        {
            *p = [81.0, 85.0, 92.0].map(|v: f64| (v + dice.within(-4.0, 4.0)).round() as u8);
        }
        let (plate, _) = photo(k, false, &floor, &mut dice);
        let [before, after] = weighed(&shot, plate.small);
        for (i, shown) in shows.iter().enumerate() {
            let at = Point2::new((i % SIZE.0) as f64, (i / SIZE.0) as f64);
            match (shown, on_disk(&shot.camera, at, 1.05 * RADIUS)) {
                (Shown::Leg, None) => {
                    legs += 1;
                    cheap += u32::from(before.cost[i] < FLAT + 4.0);
                    found += u32::from(after.cost[i] > FLAT + 4.0);
                }
                (Shown::Wall, None) => {
                    bare += 1;
                    raised += u32::from(after.cost[i] > before.cost[i]);
                }
                _ => {}
            }
        }
    }
    assert!(legs > 1000 && cheap * 4 > legs, "{cheap} of {legs}");
    assert!(found * 10 > legs * 9, "{found} of {legs}");
    assert!(bare > 1000 && raised * 25 < bare, "{raised} of {bare}");
}

#[test]
fn shorts_of_the_walls_colour_lack_its_grain_and_the_bare_wall_does_not() {
    let mut dice = proof::Dice(8);
    // The wall is above the horizon, 78 pixels from the top.
    let shorts = |i: usize| (60..110).contains(&(i % SIZE.0)) && (10..60).contains(&(i / SIZE.0));
    let plate = wall(&mut dice);
    let (mut small, camera) = (plate.clone(), tilted(0.0, 0.05));
    for (i, p) in small.data.iter_mut().enumerate() {
        let [middle, most] = if shorts(i) {
            [91.0, 4.0]
        } else {
            [f64::from(p[0]), 1.5]
        };
        *p = [0.0, 4.0, 12.0].map(|v| (middle + v + dice.within(-most, most)).round() as u8);
    }
    let id = PhotoId(0);
    let [before, after] = weighed(&Shot { id, small, camera }, plate);
    let wall = (0..SIZE.0 * 70).partition::<Vec<usize>, _>(|i| shorts(*i));
    let share = |of: &[usize], so: &dyn Fn(usize) -> bool| {
        of.iter().filter(|i| so(**i)).count() as f64 / of.len() as f64
    };
    assert!(share(&wall.0, &|i| before.cost[i] < FLAT + 4.0) > 0.25);
    let found = share(&wall.0, &|i| after.cost[i] > FLAT + 4.0);
    assert!(found > 0.8, "{found}");
    assert!(share(&wall.1, &|i| after.cost[i] > before.cost[i]) < 0.04);
}
