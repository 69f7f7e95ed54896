//! What small pictures of a turn show at once: what does not move, what turns, whether photos follow each other.

use shape::{Gray, Image, Rgb, largest_part, upper_median};

/// Small pictures are about so many pixels across (structural: size of a small picture). \[px\]
const ACROSS: usize = 96;
/// A pixel that changes by less than this over the photos does not move. By hand: not on record. \[levels\]
pub(crate) const STILL_LEVELS: f32 = 9.0;
/// A row or column at the border is reached where so much of it moves. By hand: not on record.
const REACHED_SHARE: f64 = 0.04;

/// Light is about this power of what files hold (sRGB) (IEC 61966-2-1 of 1999).
const GAMMA: f64 = 2.2;
/// Fewer pixels that do not move give no exposure (structural: a count of samples; the middle of 60 that differ by 5
/// levels is sure to 0.8).
const LEAST_FIRM_PIXELS: usize = 60;

/// One photo at a glance.
#[derive(Debug, Clone, PartialEq)]
pub struct Glance {
    /// Brightness in few pixels, 0..=255.
    pub small: Gray,
    /// Its colours, in as many pixels.
    pub colors: Vec<[f32; 3]>,
    /// Share of pixels that are as white as white can be in some colour.
    pub burnt: f64,
    /// Share of pixels that are as black as black can be in all colours.
    pub black: f64,
}

/// Looks at a photo.
pub fn glance(photo: &Rgb) -> Glance {
    let block = (photo.width.max(photo.height) / ACROSS).max(1);
    let (w, h) = (photo.width / block, photo.height / block);
    let mut small = Gray::filled(w, h, 0.0);
    let mut colors = Vec::with_capacity(w * h);
    for y in 0..h {
        for x in 0..w {
            let mut sums = [0u32; 3];
            for j in y * block..(y + 1) * block {
                for i in x * block..(x + 1) * block {
                    let pixel = photo.at(i, j);
                    sums.iter_mut()
                        .zip(pixel)
                        .for_each(|(sum, c)| *sum += u32::from(c));
                }
            }
            let count = (block * block) as f32;
            *small.at_mut(x, y) = sums.iter().sum::<u32>() as f32 / (3.0 * count);
            colors.push(sums.map(|sum| sum as f32 / count));
        }
    }
    let share = |of: fn(&[u8; 3]) -> bool| {
        let count = photo.data.iter().filter(|p| of(p)).count();
        count as f64 / photo.data.len().max(1) as f64
    };
    Glance {
        burnt: share(|p| p.iter().any(|c| *c >= 254)),
        black: share(|p| p.iter().all(|c| *c <= 2)),
        small,
        colors,
    }
}

/// What the photos of a turn show together.
#[derive(Debug, Clone, PartialEq)]
pub struct Together {
    /// Share of the picture that does not move.
    pub still: f64,
    /// By pixel of the small pictures, whether it does not move.
    pub still_pixels: Vec<bool>,
    /// Brightness of each photo against the middle one.
    pub gains: Vec<f64>,
    /// Exposure of each photo against the middle one, by what does not move; empty where that is too little. \[EV\]
    pub exposure_ev: Vec<f64>,
    /// How much each photo differs from the next, the last from the first, where something moves. \[levels\]
    pub steps: Vec<f64>,
    /// Place of a photo's neighbours in order among all photos by how alike they are, in the mean: 0 where none is more
    /// alike, 1 where all are; a half by chance.
    pub neighbours: f64,
    /// Sides of the picture that what moves reaches: top, bottom, left, right.
    pub reached: [bool; 4],
}

/// Photos of one size, in order; at least two.
pub fn together(all: &[Glance]) -> Together {
    let pixels = all[0].small.data.len();
    let middle: Vec<f64> = (0..pixels)
        .map(|i| upper_median(all.iter().map(|g| f64::from(g.small.data[i]))).unwrap_or(0.0))
        .collect();
    // By the middle of the ratios of pixels that are neither black nor white.
    let clear = |i: &usize| middle[*i] > 12.0 && middle[*i] < 243.0;
    let gain = |g: &Glance, of: &[usize]| {
        let ratio = |i: &usize| f64::from(g.small.data[*i]) / middle[*i];
        match of.is_empty() {
            true => 1.0,
            false => upper_median(of.iter().map(ratio)).unwrap_or(0.0).max(0.05),
        }
    };
    let clear: Vec<usize> = (0..pixels).filter(clear).collect();
    let gains: Vec<f64> = all.iter().map(|g| gain(g, &clear)).collect();
    let even: Vec<Vec<f32>> = all
        .iter()
        .zip(&gains)
        .map(|(g, gain)| g.small.data.iter().map(|v| v / *gain as f32).collect())
        .collect();
    let steady = |i: usize| {
        let mut seen: Vec<f32> = even.iter().map(|g| g[i]).collect();
        seen.sort_by(f32::total_cmp);
        // Each end may have one photo with something in the way.
        let cut = usize::from(seen.len() > 6);
        seen[seen.len() - 1 - cut] - seen[cut] < STILL_LEVELS
    };
    let still: Vec<bool> = (0..pixels).map(steady).collect();
    let apart = |a: &[f32], b: &[f32]| {
        let moving = (0..pixels).filter(|i| !still[*i]);
        let (sum, count) = moving.fold((0.0, 0usize), |(sum, count), i| {
            (sum + f64::from((a[i] - b[i]).abs()), count + 1)
        });
        sum / count.max(1) as f64
    };
    let firm: Vec<usize> = clear.into_iter().filter(|i| still[*i]).collect();
    let exposure_ev = match firm.len() >= LEAST_FIRM_PIXELS {
        true => all
            .iter()
            .map(|g| GAMMA * libm::log2(gain(g, &firm)))
            .collect(),
        false => vec![],
    };
    let n = all.len();
    let apart: Vec<Vec<f64>> = even
        .iter()
        .map(|a| even.iter().map(|b| apart(a, b)).collect())
        .collect();
    let steps = (0..n).map(|i| apart[i][(i + 1) % n]).collect();
    Together {
        still: still.iter().filter(|s| **s).count() as f64 / pixels.max(1) as f64,
        exposure_ev,
        steps,
        neighbours: neighbours(&apart),
        reached: reached(&still, all[0].small.width),
        still_pixels: still,
        gains,
    }
}

/// Place of neighbours among all photos by how alike they are; the last photo and the first are none, for a turn may be open.
fn neighbours(apart: &[Vec<f64>]) -> f64 {
    let n = apart.len();
    let place = |i: usize, next: usize| {
        let nearer = |j: &usize| *j != i && apart[i][*j] < apart[i][next];
        (0..n).filter(nearer).count() as f64 / (n.max(3) - 2) as f64
    };
    let sum: f64 = (1..n).map(|i| place(i, i - 1) + place(i - 1, i)).sum();
    sum / (2.0 * (n.max(2) - 1) as f64)
}

/// Which sides of the picture are reached by what moves: by its largest part, for noise and a pattern that a stabiliser shifts move
/// anywhere.
fn reached(still: &[bool], width: usize) -> [bool; 4] {
    let height = still.len() / width.max(1);
    if width < 4 || height < 4 {
        return [false; 4];
    }
    let moving = largest_part(&Image {
        width,
        height,
        data: still.iter().map(|still| !still).collect(),
    });
    let moves = |places: Vec<usize>| {
        let moving = places.iter().filter(|i| moving.data[**i]).count();
        moving as f64 > REACHED_SHARE * places.len() as f64
    };
    let row = |y: usize| (0..width).map(|x| y * width + x).collect::<Vec<_>>();
    let column = |x: usize| (0..height).map(|y| y * width + x).collect::<Vec<_>>();
    // Not the outermost ones: there a picture that was shifted a little ends.
    [
        moves(row(1)),
        moves(row(height - 2)),
        moves(column(1)),
        moves(column(width - 2)),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A striped cylinder that turns before a graded wall, brightness times a gain.
    fn turned(angle: f64, gain: f64, shift: usize) -> Glance {
        let (w, h) = (96usize, 96usize);
        let data = (0..w * h).map(|i| {
            let (x, y) = (i % w + shift, i / w);
            let across = (x as f64 - 48.0) / 20.0;
            let v = match across.abs() < 1.0 && y > 12 {
                true => {
                    let a = libm::asin(across) + angle;
                    120.0 + 60.0 * libm::tanh(libm::sin(a) * 2.0 + libm::cos(3.0 * a))
                }
                false => 60.0 + (x * 7 % 90) as f64,
            };
            [(v * gain).clamp(0.0, 255.0) as u8; 3]
        });
        glance(&Rgb {
            width: w,
            height: h,
            data: data.collect(),
        })
    }

    fn turn(shift: usize) -> Vec<Glance> {
        let angle = |i: usize| std::f64::consts::TAU * i as f64 / 18.0;
        (0..18).map(|i| turned(angle(i), 1.0, i * shift)).collect()
    }

    #[test]
    fn a_turn_before_a_wall_is_at_rest_but_for_what_turns() {
        let found = together(&turn(0));
        assert!((0.5..0.75).contains(&found.still), "{}", found.still);
        assert_eq!(found.reached, [false, true, false, false]);
        assert!(found.neighbours < 0.15, "{}", found.neighbours);
        let all = turn(0);
        let shuffled: Vec<Glance> = (0..18).map(|i| all[i * 7 % 18].clone()).collect();
        let shuffled = together(&shuffled).neighbours;
        assert!(shuffled > 0.4, "{shuffled}");
        assert!(found.exposure_ev.iter().all(|ev| ev.abs() < 0.02));
        let walk = together(&turn(3));
        assert!(walk.still < 0.1, "{}", walk.still);
    }

    #[test]
    fn a_photo_of_another_exposure_is_seen() {
        let mut all = turn(0);
        all[4] = turned(std::f64::consts::TAU * 4.0 / 18.0, 0.8, 0);
        let found = together(&all);
        proof::near(found.exposure_ev[4], 2.2 * libm::log2(0.8f64), 0.1);
    }
}
