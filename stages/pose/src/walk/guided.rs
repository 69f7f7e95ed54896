//! Features along epipolar lines: where a photo shows many alike, few of them are there.

use crate::features::best::{Best, PLACE_PX, SAME};
use crate::features::matching::{Pairs, likeness};
use nalgebra::{Matrix3, Vector3};
use shape::{Features, Keypoint};

/// Least likeness of what is on one epipolar line: distance 0.7 of descriptions of length one, as
/// COLMAP has it (derived: 1 − 0.7²/2).
const ON_LINE: f32 = SAME * (1.0 - 0.7 * 0.7 / 2.0);
/// Width of a strip of a photo (structural: speed alone). \[px\]
const STRIP_PX: f32 = 32.0;

/// Features by strips of a photo along one axis, sorted along the other.
struct Strips {
    strips: Vec<Vec<(f32, usize)>>,
}

impl Strips {
    /// `across` numbers strips, `along` sorts within.
    fn new(
        points: &[Keypoint],
        across: fn(&Keypoint) -> f32,
        along: fn(&Keypoint) -> f32,
    ) -> Strips {
        let place = |k: &Keypoint| (across(k).max(0.0) / STRIP_PX) as usize;
        let count = points.iter().map(place).max().map_or(0, |most| most + 1);
        let mut strips = vec![Vec::new(); count];
        for (i, k) in points.iter().enumerate() {
            strips[place(k)].push((along(k), i));
        }
        for strip in &mut strips {
            strip.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        }
        Strips { strips }
    }

    /// Adds what may be within a band of the line `slope · across + from`, as wide along the strips.
    fn near(&self, [slope, from, wide]: [f32; 3], found: &mut Vec<usize>) {
        for (s, strip) in self.strips.iter().enumerate() {
            let at = |edge: usize| slope * (edge as f32 * STRIP_PX) + from;
            // What is off the photo's edge is in the first strip.
            let start = if s == 0 { -slope.abs() * STRIP_PX } else { 0.0 };
            let (a, b) = (at(s), at(s + 1));
            let (low, high) = (a.min(b) - wide + start, a.max(b) + wide - start);
            let first = strip.partition_point(|(v, _)| *v < low);
            let inside = strip[first..].iter().take_while(|(v, _)| *v <= high);
            found.extend(inside.map(|(_, i)| *i));
        }
    }
}

/// Pairs of features that are each other's nearest, and nearer than `ratio` times the next one of `b`
/// that is elsewhere, among those within `band_px` of the epipolar line, `bᵀ F a = 0`.
pub(crate) fn guided(
    [a, b]: [&Features; 2],
    motion: &Matrix3<f64>,
    band_px: f64,
    ratio: f64,
) -> Pairs {
    let columns = Strips::new(&b.points, |k| k.x, |k| k.y);
    let rows = Strips::new(&b.points, |k| k.y, |k| k.x);
    let elsewhere = |i: usize, j: usize| {
        let (p, q) = (&b.points[i], &b.points[j]);
        libm::hypotf(p.x - q.x, p.y - q.y) >= PLACE_PX
    };
    let band = band_px as f32;
    let mut back = vec![(f32::MIN, usize::MAX); b.points.len()];
    let mut there: Vec<(usize, usize)> = Vec::new();
    let mut near: Vec<usize> = Vec::new();
    for (i, k) in a.points.iter().enumerate() {
        let line = motion * Vector3::new(f64::from(k.x), f64::from(k.y), 1.0);
        let line = (line / line.xy().norm().max(1e-12)).map(|v| v as f32);
        near.clear();
        // One more pixel for what single precision loses.
        match line.y.abs() >= line.x.abs() {
            true => columns.near(
                [
                    -line.x / line.y,
                    -line.z / line.y,
                    band / line.y.abs() + 1.0,
                ],
                &mut near,
            ),
            false => rows.near(
                [
                    -line.y / line.x,
                    -line.z / line.x,
                    band / line.x.abs() + 1.0,
                ],
                &mut near,
            ),
        }
        near.sort_unstable();
        let mut best = Best::default();
        for j in near.iter().copied() {
            let other = &b.points[j];
            let off = line.x * other.x + line.y * other.y + line.z;
            if off.abs() >= band || !(0.4..2.5).contains(&(other.scale / k.scale)) {
                continue;
            }
            let alike = likeness(&a.descriptors[i], &b.descriptors[j]) as f32;
            if alike > back[j].0 {
                back[j] = (alike, i);
            }
            best.see(j, alike, &elsewhere);
        }
        if best.first >= ON_LINE && best.ahead(ratio) {
            there.push((i, best.at));
        }
    }
    there.retain(|(i, j)| back[*j].1 == *i);
    let of = |(i, j): (usize, usize)| (i as u32, j as u32);
    there.into_iter().map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::walk::nearest::nearest;

    #[test]
    fn of_many_alike_the_one_on_the_line_is_found() {
        let mut dice = proof::Dice(4);
        let mut at = |x: f64, y: f64| Keypoint {
            x: x as f32,
            y: (y + 0.1 * dice.normal()) as f32,
            scale: 3.0,
            angle: 0.0,
        };
        // A row of equal things above another; the camera moved sideways.
        let (mut a, mut b) = (Features::default(), Features::default());
        for row in 0..20 {
            a.points.push(at(100.0, 40.0 * f64::from(row)));
            b.points.push(at(130.0, 40.0 * f64::from(row)));
        }
        let mut same = [0u8; 128];
        same[..64].fill(64);
        a.descriptors = vec![same; 20];
        b.descriptors = vec![same; 20];
        let all: Vec<u32> = (0..20).collect();
        assert!(nearest([&a, &b], [&all, &all], 0.8).is_empty());
        let sideways = Vector3::x().cross_matrix();
        let found = guided([&a, &b], &sideways, 2.0, 0.8);
        assert_eq!(found, (0..20).map(|i| (i, i)).collect::<Vec<_>>());
    }

    #[test]
    fn strips_miss_nothing_that_is_on_a_line() {
        let mut dice = proof::Dice(14);
        let points: Vec<Keypoint> = (0..500)
            .map(|_| Keypoint {
                x: dice.within(-0.5, 640.0) as f32,
                y: dice.within(-0.5, 480.0) as f32,
                scale: 2.0,
                angle: 0.0,
            })
            .collect();
        let columns = Strips::new(&points, |k| k.x, |k| k.y);
        let mut hits = 0;
        for _ in 0..100 {
            let (slope, from) = (
                dice.within(-1.0, 1.0) as f32,
                dice.within(0.0, 480.0) as f32,
            );
            let mut found = Vec::new();
            columns.near([slope, from, 5.0], &mut found);
            for (i, k) in points.iter().enumerate() {
                let on = (k.y - slope * k.x - from).abs() < 5.0;
                hits += usize::from(on);
                assert!(!on || found.contains(&i));
            }
        }
        assert!(hits > 100, "{hits}");
    }
}
