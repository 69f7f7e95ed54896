//! How far each pixel is from a silhouette's border: positive inside (Felzenszwalb and
//! Huttenlocher 2012, exact squared distances in two passes).

use crate::{Image, Mask};

/// Signed distance of every pixel to the border. \[px of the mask\]
///
/// Between a pixel centre inside and one outside the border lies half-way, moved by coverage: the
/// distance is that to the nearest pixel of the other side less half a pixel.
pub fn signed_distance(mask: &Mask) -> Image<f32> {
    let inside = squared(mask, |c| c <= 127);
    let outside = squared(mask, |c| c > 127);
    let data = inside
        .iter()
        .zip(&outside)
        .map(|(i, o)| {
            if *i > 0.0 {
                i.sqrt() - 0.5
            } else {
                0.5 - o.sqrt()
            }
        })
        .collect();
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

/// Squared distance of each pixel to the nearest one that `to` names.
fn squared(mask: &Mask, to: impl Fn(u8) -> bool) -> Vec<f32> {
    let (w, h) = (mask.width, mask.height);
    const FAR: f32 = 1e12;
    let mut field: Vec<f32> = mask
        .data
        .iter()
        .map(|c| if to(*c) { 0.0 } else { FAR })
        .collect();
    let mut column = vec![0.0; h];
    for x in 0..w {
        (0..h).for_each(|y| column[y] = field[y * w + x]);
        envelope(&mut column);
        (0..h).for_each(|y| field[y * w + x] = column[y]);
    }
    field.chunks_mut(w).for_each(envelope);
    field
}

/// The lower envelope of parabolas over one line, in place.
fn envelope(line: &mut [f32]) {
    let f = line.to_vec();
    let mut roots = vec![0usize; f.len()];
    let mut starts = vec![f64::MIN; f.len() + 1];
    let mut k = 0;
    let meets = |p: usize, q: usize| {
        let value = |i: usize| f64::from(f[i]) + (i * i) as f64;
        (value(q) - value(p)) / (2.0 * (q as f64 - p as f64))
    };
    starts[1] = f64::MAX;
    for q in 1..f.len() {
        let mut at = meets(roots[k], q);
        while at <= starts[k] && k > 0 {
            k -= 1;
            at = meets(roots[k], q);
        }
        k += 1;
        roots[k] = q;
        starts[k] = at;
        starts[k + 1] = f64::MAX;
    }
    k = 0;
    for (q, out) in line.iter_mut().enumerate() {
        while starts[k + 1] < q as f64 {
            k += 1;
        }
        let step = q as f32 - roots[k] as f32;
        *out = step * step + f[roots[k]];
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
        let got = squared(&mask, |c| c == 0);
        for i in 0..mask.data.len() {
            let (x, y) = ((i % 23) as i32, (i / 23) as i32);
            let far = |j: usize| (x - (j % 23) as i32).pow(2) + (y - (j / 23) as i32).pow(2);
            let best = (0..mask.data.len())
                .filter(|j| mask.data[*j] == 0)
                .map(far)
                .min()
                .unwrap();
            assert_eq!(got[i], best as f32);
        }
    }
}
