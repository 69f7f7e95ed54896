//! How far each pixel is from a silhouette's border: positive inside (Felzenszwalb and
//! Huttenlocher 2012, exact squared distances in two passes).

use crate::{Image, Mask};

/// Signed distance of every pixel to the border. \[px of the mask\]
///
/// The border is half-way between a pixel centre inside and one outside, moved by coverage: the
/// distance is that to the nearest pixel of the other side less half a pixel.
pub fn signed_distance(mask: &Mask) -> Image<f32> {
    let far = squared(mask);
    let signed = |(far, cover): (&f32, &u8)| match body(*cover) {
        true => far.sqrt() - 0.5,
        false => 0.5 - far.sqrt(),
    };
    let data = far.iter().zip(&mask.data).map(signed).collect();
    let mut field = Image {
        width: mask.width,
        height: mask.height,
        data,
    };
    // Beside the border coverage knows better than whole pixels do.
    for y in 1..mask.height.saturating_sub(1) {
        for x in 1..mask.width.saturating_sub(1) {
            if field.at(x, y).abs() > 0.75 {
                continue;
            }
            let c = |dx: i32, dy: i32| {
                f32::from(mask.at((x as i32 + dx) as usize, (y as i32 + dy) as usize)) / 255.0
            };
            let gx =
                (c(1, 0) - c(-1, 0)) * 0.5 + (c(1, 1) - c(-1, 1) + c(1, -1) - c(-1, -1)) * 0.25;
            let gy =
                (c(0, 1) - c(0, -1)) * 0.5 + (c(1, 1) - c(1, -1) + c(-1, 1) - c(-1, -1)) * 0.25;
            // Both differences span two pixels and are averaged: half of the sum is the slope.
            let slope = (gx * gx + gy * gy).sqrt() * 0.5;
            if slope > 0.2 {
                let at = (c(0, 0) - 0.5) / slope;
                *field.at_mut(x, y) = at.clamp(-1.0, 1.0);
            }
        }
    }
    field
}

/// Whether a pixel shows the body.
fn body(cover: u8) -> bool {
    cover > 127
}

/// Squared distance of each pixel to the nearest one of the other side.
fn squared(mask: &Mask) -> Vec<f32> {
    let (w, h) = (mask.width, mask.height);
    /// Nothing is that far (structural: more than any distance in a picture).
    const FAR: f32 = 1e6;
    // Along columns, down and up, a row at a time.
    let mut field = vec![FAR; mask.data.len()];
    let nearer = |here: &mut [f32], beside: &[f32], y: usize, other: usize| {
        let sides = mask.row(y).iter().zip(mask.row(other));
        let steps = sides
            .zip(beside)
            .map(|((a, b), far)| match body(*a) == body(*b) {
                true => far + 1.0,
                false => 1.0,
            });
        let both = here.iter_mut().zip(steps);
        both.for_each(|(here, step)| *here = here.min(step));
    };
    for y in 1..h {
        let (above, here) = field.split_at_mut(y * w);
        nearer(&mut here[..w], &above[(y - 1) * w..], y, y - 1);
    }
    for y in (1..h).rev() {
        let (here, below) = field.split_at_mut(y * w);
        nearer(&mut here[(y - 1) * w..], &below[..w], y - 1, y);
    }
    field.iter_mut().for_each(|d| *d *= *d);
    let (mut work, mut line) = (Envelope::default(), Vec::new());
    for y in 0..h {
        // Pixels of the other side are 0 away and hide what is behind them, so each run is a line of its own.
        let (sides, row) = (mask.row(y), &mut field[y * w..][..w]);
        let mut first = 0;
        while first < w {
            let side = body(sides[first]);
            let run = sides[first..].iter().take_while(|c| body(**c) == side);
            let end = first + run.count();
            let (before, after) = (usize::from(first > 0), usize::from(end < w));
            line.clear();
            line.resize(before, 0.0);
            line.extend_from_slice(&row[first..end]);
            line.resize(line.len() + after, 0.0);
            work.lower(&mut line);
            row[first..end].copy_from_slice(&line[before..][..end - first]);
            first = end;
        }
    }
    field
}

/// What the lower envelope of parabolas over a line is found with.
#[derive(Default)]
struct Envelope {
    /// The parabolas' values at their apex, and with the square of their place.
    apex: Vec<f32>,
    sums: Vec<f64>,
    /// Those on the envelope, by where each begins to be the lowest.
    roots: Vec<(f64, u32)>,
    /// 1 / 2d for distances d of two apices.
    halves: Vec<f64>,
}

impl Envelope {
    /// Replaces squared distances along other lines by those in the plane.
    fn lower(&mut self, line: &mut [f32]) {
        let n = line.len();
        for d in self.halves.len()..n {
            self.halves.push(0.5 / d as f64);
        }
        self.apex.clear();
        self.apex.extend_from_slice(line);
        self.sums.clear();
        let sum = |(i, f): (usize, &f32)| f64::from(*f) + (i * i) as f64;
        self.sums.extend(line.iter().enumerate().map(sum));
        let (sums, halves) = (&self.sums, &self.halves);
        // At whole places a rounded crossing picks the same distance as an exact one.
        let meets = |p: usize, q: usize| (sums[q] - sums[p]) * halves[q - p];
        self.roots.resize(n.max(self.roots.len()), (0.0, 0));
        let roots = &mut self.roots[..n];
        roots[0] = (f64::MIN, 0);
        let mut k = 0;
        for q in 1..n {
            let mut at = meets(roots[k].1 as usize, q);
            while at <= roots[k].0 && k > 0 {
                k -= 1;
                at = meets(roots[k].1 as usize, q);
            }
            k += 1;
            roots[k] = (at, q as u32);
        }
        let mut first = 0;
        for (i, (_, root)) in roots[..=k].iter().enumerate() {
            let end = match roots[..=k].get(i + 1) {
                Some((next, _)) if *next < 0.0 => 0,
                Some((next, _)) => (*next as usize + 1).min(n),
                None => n,
            };
            let apex = self.apex[*root as usize];
            for (q, out) in (first..end).zip(&mut line[first..]) {
                let step = q as f32 - *root as f32;
                *out = step * step + apex;
            }
            first = first.max(end);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_those_to_the_nearest_pixel_of_the_other_side() {
        let mut dice = proof::Dice(11);
        let mut mask = Mask::filled(23, 17, 0);
        mask.data
            .iter_mut()
            .for_each(|c| *c = if dice.unit() < 0.8 { 255 } else { 0 });
        let got = squared(&mask);
        for i in 0..mask.data.len() {
            let (x, y) = ((i % 23) as i32, (i / 23) as i32);
            let far = |j: usize| (x - (j % 23) as i32).pow(2) + (y - (j / 23) as i32).pow(2);
            let best = (0..mask.data.len())
                .filter(|j| mask.data[*j] != mask.data[i])
                .map(far)
                .min()
                .unwrap();
            assert_eq!(got[i], best as f32);
        }
    }
}
