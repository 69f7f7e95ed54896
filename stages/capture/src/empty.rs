//! Photos amid a turn that do not show the subject: the empty scene under another name, or somebody before the camera.
//!
//! Amid what moves, where all other photos show the subject, such a photo is unlike each of them, over whole stretches and
//! much of the height; beside what moves it is as they are. What one photo alone shows otherwise (an arm, a wider side of the
//! body) is at the edges of what moves.

use crate::glance::{Glance, Together};
use crate::verdict::{Findings, Grade, Seen, camera_is_fixed};
use rayon::prelude::*;
use shape::LEAST_OF_TURN;
use stage::message;

stage::messages! {
    NOT_SEEN = "find-empty": "the subject, which all other photos show, is not seen here";
    AS_PLATE = "find-empty-plate": "if this is the empty scene, set plate = \"{name}\" in capture.toml, or give --plate {name}; else leave it out, or take it again";
    LEAVE_OUT = "find-empty-mend": "leave it out, or take it again";
}

/// A pixel is unlike those of all other photos beyond this. By hand: not on record. \[levels\]
const UNLIKE_LEVELS: f32 = 25.0;
/// What does not move is as elsewhere within this. By hand: not on record. \[levels\]
const ALIKE_LEVELS: f32 = 12.0;
/// So much of the picture where nothing moves may not be alike: else the camera, the light or the background changed.
/// By hand: not on record.
const OTHERWISE_SHARE: f64 = 0.05;
/// So much of the middle of what moves is unlike all other photos, and more where photos are few. By hand: looked at
/// four made captures of 18 photos, where it is 0.06 to 0.18 for the empty scene and 0.004 at most for any other photo
/// (of 9: 0.08 to 0.22, and 0.026).
const UNLIKE_SHARE: (f64, f64) = (0.04, 0.6);
/// And over so much of its height. By hand: looked at the same, 0.28 to 0.38, and 0.05 (of 9: 0.33 to 0.50, and 0.18).
const UNLIKE_HEIGHT: f64 = 0.2;
/// The photo's brightness against the middle one: what is brighter is burnt, and looks different for that. By hand: not
/// on record.
const GAINS: (f64, f64) = (0.7, 1.12);

/// Finds the photos that do not show the subject.
pub(crate) fn absent(seen: &Seen<'_>, findings: &mut Findings<'_>) {
    for i in without_subject(seen.glances, seen.together) {
        let name = &seen.photos.photos[i].name;
        let mend = match seen.photos.plate.is_some() || name.contains('#') {
            true => message!(LEAVE_OUT),
            false => message!(AS_PLATE, name = name),
        };
        findings.put(Grade::Hopeless, message!(NOT_SEEN), mend, &[i]);
    }
}

/// The photos that do not show what all other photos show, by place.
fn without_subject(all: &[Glance], together: &Together) -> Vec<usize> {
    let n = all.len();
    if n < LEAST_OF_TURN || !camera_is_fixed(together) {
        return vec![];
    }
    let even: Vec<Vec<[f32; 3]>> = all
        .iter()
        .zip(&together.gains)
        .map(|(g, gain)| {
            g.colors
                .iter()
                .map(|c| c.map(|v| v / *gain as f32))
                .collect()
        })
        .collect();
    let area = Area::of(&together.still_pixels, all[0].small.width);
    let share = UNLIKE_SHARE.0.max(UNLIKE_SHARE.1 / n as f64);
    let alone = |i: &usize| {
        let gain = together.gains[*i];
        if gain < GAINS.0 || gain > GAINS.1 {
            return false;
        }
        let nearest = nearest(&even, *i, &area.moving);
        let outside = area
            .span
            .iter()
            .zip(&nearest)
            .filter(|(within, _)| !**within);
        let (other, count) = outside.fold((0usize, 0usize), |(other, count), (_, d)| {
            (other + usize::from(*d > ALIKE_LEVELS), count + 1)
        });
        let unlike: Vec<bool> = nearest.iter().map(|d| *d > UNLIKE_LEVELS).collect();
        let (pixels, rows) = area.solid(&unlike);
        pixels as f64 >= share * area.middle as f64
            && rows as f64 >= UNLIKE_HEIGHT * area.rows as f64
            && other as f64 <= OTHERWISE_SHARE * count as f64
    };
    (0..n).into_par_iter().filter(alone).collect()
}

fn apart(a: &[f32; 3], b: &[f32; 3]) -> f32 {
    (0..3).map(|c| (a[c] - b[c]).abs()).fold(0.0, f32::max)
}

/// By pixel, how far a photo is from the nearest other one, the most similar left out: two empty scenes are no excuse for
/// each other.
fn nearest(even: &[Vec<[f32; 3]>], i: usize, moving: &[usize]) -> Vec<f32> {
    let rest = || (0..even.len()).filter(|j| *j != i);
    let differs = |j: usize| -> f32 {
        let pixels = moving.iter();
        pixels.map(|p| apart(&even[i][*p], &even[j][*p])).sum()
    };
    let likest = rest().map(|j| (differs(j), j));
    let likest = likest.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, j)| j);
    let mut nearest = vec![f32::MAX; even[i].len()];
    for j in rest().filter(|j| Some(*j) != likest) {
        for ((least, a), b) in nearest.iter_mut().zip(&even[i]).zip(&even[j]) {
            *least = least.min(apart(a, b));
        }
    }
    nearest
}

/// Where the subject moves.
struct Area {
    width: usize,
    /// The pixels that move.
    moving: Vec<usize>,
    /// By pixel, whether it is between the first and the last of its row that move.
    span: Vec<bool>,
    /// By pixel, whether it is in the middle half of these.
    amid: Vec<bool>,
    /// How many are.
    middle: usize,
    /// Rows in which something moves.
    rows: usize,
}

impl Area {
    fn of(still: &[bool], width: usize) -> Area {
        let mut area = Area {
            width,
            moving: (0..still.len()).filter(|p| !still[*p]).collect(),
            span: vec![false; still.len()],
            amid: vec![false; still.len()],
            middle: 0,
            rows: 0,
        };
        let width = width.max(1);
        let spans = area.span.chunks_mut(width).zip(area.amid.chunks_mut(width));
        for (row, (span, amid)) in still.chunks(width).zip(spans) {
            let (first, last) = (row.iter().position(|s| !s), row.iter().rposition(|s| !s));
            if let Some((first, last)) = first.zip(last).filter(|(first, last)| first < last) {
                span[first..=last].fill(true);
                let side = (last + 1 - first) / 4;
                amid[first + side..=last - side].fill(true);
                area.middle += last + 1 - first - 2 * side;
                area.rows += 1;
            }
        }
        area
    }

    /// How many pixels of the middle are marked with all eight around them, and in how many rows.
    fn solid(&self, marked: &[bool]) -> (usize, usize) {
        let (w, h) = (self.width, marked.len() / self.width.max(1));
        let around = |p: usize| (0..9).all(|k| marked[p + (k / 3) * w + k % 3 - w - 1]);
        let row = |y: usize| {
            let places = (1..w.saturating_sub(1)).map(|x| y * w + x);
            places.filter(|p| self.amid[*p] && around(*p)).count()
        };
        let rows = (1..h.saturating_sub(1)).map(row).filter(|count| *count > 0);
        rows.fold((0, 0), |(pixels, rows), count| (pixels + count, rows + 1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::glance::{glance, together};
    use shape::Rgb;

    /// What somebody did to a photo.
    #[derive(Clone, Copy, PartialEq)]
    enum Done {
        Nothing,
        Empty,
        Shifted,
        Raised,
        Passer,
        Bright,
    }

    /// An oval, clothed figure with arms that turns before a wall with a pattern.
    fn photo(angle: f64, done: Done) -> Glance {
        let (w, h) = (96usize, 144usize);
        let pixel = |i: usize| {
            let (x, y) = ((i % w) as f64, (i / w) as f64);
            let x = x + if done == Done::Shifted { 3.0 } else { 0.0 };
            let wall = 120.0 + 40.0 * libm::sin(x * 0.4) + 0.2 * y;
            let half = 14.0 + 5.0 * libm::cos(2.0 * angle);
            let across = (x - 48.0) / half;
            let arm = (x - 48.0 - 24.0 * libm::sin(angle)).abs() < 3.0 && (40.0..60.0).contains(&y);
            let body = across.abs() < 1.0 && (20.0..135.0).contains(&y);
            let color = if done == Done::Passer && (4.0..18.0).contains(&x) && y > 15.0 {
                [30.0, 60.0, 30.0]
            } else if done == Done::Raised && (66.0..71.0).contains(&x) && (5.0..40.0).contains(&y)
            {
                [200.0, 160.0, 140.0]
            } else if (body || arm) && done != Done::Empty {
                let turned = libm::asin(across.clamp(-1.0, 1.0)) + angle;
                let cloth = 60.0 + 12.0 * libm::sin(3.0 * turned) + 8.0 * libm::sin(y * 0.3);
                [cloth, 40.0, 180.0 - cloth]
            } else {
                [wall, wall, wall * 0.9]
            };
            let gain = if done == Done::Bright { 1.5 } else { 1.0 };
            color.map(|v| (v * gain).clamp(0.0, 255.0) as u8)
        };
        glance(&Rgb {
            width: w,
            height: h,
            data: (0..w * h).map(pixel).collect(),
        })
    }

    fn turn(count: usize, odd: &[(usize, Done)]) -> Vec<usize> {
        let angle = |i: usize| std::f64::consts::TAU * i as f64 / count as f64;
        let done = |i: usize| odd.iter().find(|o| o.0 == i).map_or(Done::Nothing, |o| o.1);
        let all: Vec<Glance> = (0..count).map(|i| photo(angle(i), done(i))).collect();
        without_subject(&all, &together(&all))
    }

    #[test]
    fn one_or_two_photos_of_the_empty_scene_are_found_at_any_place() {
        for count in [10, 18, 36] {
            assert_eq!(turn(count, &[(4, Done::Empty)]), [4], "{count}");
            assert_eq!(turn(count, &[(0, Done::Empty)]), [0], "{count}");
            let ends = [(0, Done::Empty), (count - 1, Done::Empty)];
            assert_eq!(turn(count, &ends), [0, count - 1], "{count}");
        }
    }

    #[test]
    fn photos_that_are_odd_otherwise_raise_no_alarm() {
        for count in [10, 18, 36] {
            assert_eq!(turn(count, &[]), Vec::<usize>::new(), "{count}");
            for done in [Done::Shifted, Done::Raised, Done::Passer, Done::Bright] {
                for at in [0, 3, count / 2] {
                    assert_eq!(
                        turn(count, &[(at, done)]),
                        Vec::<usize>::new(),
                        "{count} {at}"
                    );
                }
            }
        }
    }
}
