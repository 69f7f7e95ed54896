//! The background out of the photos themselves: the room stands still while the body turns.
//!
//! Every pixel is seen once a photo. Colours that come again to the level are the background's, as a
//! rule; where a plain body covers a pixel most of the time its colour comes again, too. So once
//! masks are known, photos whose masks cover a pixel are not asked.

use shape::{Image, Rgb};

/// What the photos of a turn show behind the subject.
#[derive(Debug, Clone, PartialEq)]
pub struct Backdrop {
    /// The scene without the subject; of no meaning where nobody saw it.
    pub image: Rgb,
    /// Whether it was seen.
    pub seen: Image<bool>,
}

impl Backdrop {
    /// A photo of the scene without the subject.
    pub fn whole(image: Rgb) -> Self {
        let seen = Image::filled(image.width, image.height, true);
        Backdrop { image, seen }
    }
}

/// Colours nearer to each other than this are one. \[levels\]
const SAME: f32 = 4.0;
/// Share of a pixel's neighbours that must be seen, too: a body's colour comes again here and there only.
const SOLID: f32 = 0.8;

/// Colours that come again.
struct Cluster {
    mean: [f32; 3],
    /// Mean squared deviation of all channels. \[levels²\]
    spread: f32,
    count: usize,
}

/// The clusters of a pixel's colours, each around one of them that has most others near.
fn clusters(colors: &[[u8; 3]]) -> Vec<Cluster> {
    let mut left: Vec<[f32; 3]> = colors.iter().map(|c| c.map(f32::from)).collect();
    let mut found = Vec::new();
    let near = |a: &[f32; 3], b: &[f32; 3]| (0..3).all(|c| (a[c] - b[c]).abs() <= SAME);
    while left.len() >= 2 {
        let fans = |a: &[f32; 3]| left.iter().filter(|b| near(a, b)).count();
        let counts: Vec<usize> = left.iter().map(fans).collect();
        let best = (1..left.len()).fold(0, |b, i| if counts[i] > counts[b] { i } else { b });
        if counts[best] < 2 {
            break;
        }
        let seed = left[best];
        let (of, rest): (Vec<[f32; 3]>, Vec<[f32; 3]>) =
            left.into_iter().partition(|c| near(&seed, c));
        let n = of.len() as f32;
        let mean = [0, 1, 2].map(|c| of.iter().map(|o| o[c]).sum::<f32>() / n);
        let off = |o: &[f32; 3]| (0..3).map(|c| (o[c] - mean[c]).powi(2)).sum::<f32>() / 3.0;
        found.push(Cluster {
            mean,
            spread: of.iter().map(off).sum::<f32>() / n,
            count: of.len(),
        });
        left = rest;
    }
    found
}

/// The background of photos that share it pixel for pixel. `covered` names the photos (first) and
/// pixels (second) that cannot show it; without masks only what comes again often is taken.
pub fn backdrop(photos: &[Rgb], covered: Option<&[Image<bool>]>) -> Backdrop {
    let Some(first) = photos.first() else {
        return Backdrop::whole(Rgb::filled(0, 0, [0; 3]));
    };
    let mut image = Rgb::filled(first.width, first.height, [0; 3]);
    let mut seen = Image::filled(first.width, first.height, false);
    let mut spreads = Vec::with_capacity(image.data.len());
    let mut colors = Vec::with_capacity(photos.len());
    for i in 0..image.data.len() {
        colors.clear();
        let open = |k: usize| covered.is_none_or(|c| !c[k].data[i]);
        colors.extend(
            (0..photos.len())
                .filter(|k| open(*k))
                .map(|k| photos[k].data[i]),
        );
        // Many times, and to the level: a body that comes again does so less exactly.
        let worth = |c: &Cluster| c.count as f32 / (1.0 + c.spread);
        let best = clusters(&colors)
            .into_iter()
            .reduce(|a, b| if worth(&b) > worth(&a) { b } else { a });
        let least = match covered {
            Some(_) => (colors.len() * 6).div_ceil(10).max(2),
            None => photos.len().div_ceil(3).max(3),
        };
        spreads.push(f32::MAX);
        if let Some(cluster) = best.filter(|c| c.count >= least) {
            image.data[i] = cluster.mean.map(|m| m.round() as u8);
            seen.data[i] = true;
            spreads[i] = cluster.spread;
        }
    }
    // Most of what comes again is background, and as noisy as all of it.
    let mut known: Vec<f32> = spreads.iter().copied().filter(|s| *s < f32::MAX).collect();
    known.sort_by(f32::total_cmp);
    let usual = known.get(known.len() / 2).copied().unwrap_or(0.0);
    for (seen, spread) in seen.data.iter_mut().zip(&spreads) {
        *seen &= *spread <= 3.0 * usual + 1.0;
    }
    let share = shares(&seen, 2);
    for (seen, share) in seen.data.iter_mut().zip(&share) {
        *seen &= *share >= SOLID;
    }
    Backdrop { image, seen }
}

/// The middle of what photos show that are not covered, channel by channel, where three are not: for
/// surfaces that turn and so are not lit alike.
pub fn middle(photos: &[Rgb], covered: &[Image<bool>]) -> Backdrop {
    let (w, h) = photos.first().map_or((0, 0), |p| (p.width, p.height));
    let mut middle = Backdrop {
        image: Rgb::filled(w, h, [0; 3]),
        seen: Image::filled(w, h, false),
    };
    let mut values = Vec::with_capacity(photos.len());
    for i in 0..w * h {
        let open: Vec<usize> = (0..photos.len()).filter(|k| !covered[*k].data[i]).collect();
        if open.len() < 3 {
            continue;
        }
        for c in 0..3 {
            values.clear();
            values.extend(open.iter().map(|k| photos[*k].data[i][c]));
            values.sort_unstable();
            middle.image.data[i][c] = values[values.len() / 2];
        }
        middle.seen.data[i] = true;
    }
    middle
}

/// Share of true pixels around each: a square of `reach` pixels to each side.
fn shares(image: &Image<bool>, reach: usize) -> Vec<f32> {
    let (w, h) = (image.width, image.height);
    let mut sums = vec![0u32; (w + 1) * (h + 1)];
    for y in 0..h {
        let mut row = 0;
        for x in 0..w {
            row += u32::from(image.at(x, y));
            sums[(y + 1) * (w + 1) + x + 1] = sums[y * (w + 1) + x + 1] + row;
        }
    }
    let one = |i: usize| {
        let (x, y) = (i % w, i / w);
        let (x0, x1) = (x.saturating_sub(reach), (x + reach + 1).min(w));
        let (y0, y1) = (y.saturating_sub(reach), (y + reach + 1).min(h));
        let at = |x: usize, y: usize| sums[y * (w + 1) + x];
        let inside = at(x1, y1) + at(x0, y0) - at(x1, y0) - at(x0, y1);
        inside as f32 / ((x1 - x0) * (y1 - y0)) as f32
    };
    (0..w * h).map(one).collect()
}

/// Pixels that all photos but one show alike; those that the moving ones enclose apart: what never
/// changes amid the turn may be a plain body that covers it all the time.
///
/// Returns for each pixel whether it stands still as background (`Some(true)`), is enclosed by the
/// turn and may always show the body (`Some(false)`), or changes.
pub fn still(photos: &[Rgb]) -> Image<Option<bool>> {
    let (w, h) = photos.first().map_or((0, 0), |p| (p.width, p.height));
    let mut colors = Vec::with_capacity(photos.len());
    let mut fixed = Image::filled(w, h, false);
    for i in 0..w * h {
        colors.clear();
        colors.extend(photos.iter().map(|p| p.data[i]));
        let most = clusters(&colors).iter().map(|c| c.count).max();
        fixed.data[i] = most.is_some_and(|m| m + 1 >= photos.len());
    }
    // Gaps of three pixels in the ring of change around the body are closed.
    let open = thinned(&fixed, 2);
    let mut reached = Image::filled(w, h, false);
    let border = (0..w).flat_map(|x| [(x, 0), (x, h.saturating_sub(1))]);
    let sides = (0..h).flat_map(|y| [(0, y), (w.saturating_sub(1), y)]);
    let mut front: Vec<(usize, usize)> = border.chain(sides).collect();
    while let Some((x, y)) = front.pop() {
        if !open.at(x, y) || std::mem::replace(reached.at_mut(x, y), true) {
            continue;
        }
        for (dx, dy) in [(-1i32, 0i32), (1, 0), (0, -1), (0, 1)] {
            let (nx, ny) = (x as i32 + dx, y as i32 + dy);
            if nx >= 0 && ny >= 0 && nx < w as i32 && ny < h as i32 {
                front.push((nx as usize, ny as usize));
            }
        }
    }
    // What was thinned away beside what was reached belongs to it.
    let near = thinned(&reached.map(|r| !r), 3);
    let verdict = |i: usize| fixed.data[i].then(|| !near.data[i]);
    Image {
        width: w,
        height: h,
        data: (0..w * h).map(verdict).collect(),
    }
}

/// Pixels whose whole neighbourhood is true: a square of `reach` pixels to each side.
pub fn thinned(image: &Image<bool>, reach: usize) -> Image<bool> {
    let along = |from: &Image<bool>, across: bool| {
        let (w, h) = (from.width, from.height);
        let one = |i: usize| {
            let (x, y) = (i % w, i / w);
            if across {
                (x.saturating_sub(reach)..(x + reach + 1).min(w)).all(|x| from.at(x, y))
            } else {
                (y.saturating_sub(reach)..(y + reach + 1).min(h)).all(|y| from.at(x, y))
            }
        };
        Image {
            width: w,
            height: h,
            data: (0..w * h).map(one).collect(),
        }
    };
    along(&along(image, true), false)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A wall of random colours before which a plain block swings to and fro around the middle.
    fn turn(dice: &mut proof::Dice) -> (Rgb, Vec<Rgb>, Vec<Image<bool>>) {
        let mut wall = Rgb::filled(60, 40, [0; 3]);
        for p in &mut wall.data {
            *p = [0, 1, 2].map(|_| dice.within(20.0, 200.0) as u8);
        }
        let mut photos = Vec::new();
        let mut covered = Vec::new();
        for k in 0..12usize {
            let left = 20 + [0, 2, 4, 6, 8, 10, 10, 8, 6, 4, 2, 0][k];
            let body =
                |i: usize| (left..left + 14).contains(&(i % 60)) && i / 60 >= 8 && i / 60 < 32;
            let mut photo = wall.clone();
            for (i, p) in photo.data.iter_mut().enumerate() {
                let noise = dice.within(-1.5, 1.5);
                let shown = if body(i) { [230, 190, 170] } else { *p };
                *p = shown.map(|c| (f64::from(c) + noise).round() as u8);
            }
            photos.push(photo);
            covered.push(Image {
                width: 60,
                height: 40,
                data: (0..2400).map(body).collect(),
            });
        }
        (wall, photos, covered)
    }

    #[test]
    fn what_never_changes_amid_the_turn_is_body_and_outside_of_it_background() {
        let (_, photos, _) = turn(&mut proof::Dice(1));
        let still = still(&photos);
        assert_eq!(still.at(5, 5), Some(true));
        assert_eq!(still.at(31, 20), Some(false));
        assert_eq!(still.at(23, 20), None);
    }

    #[test]
    fn with_masks_a_pixel_that_the_body_mostly_covers_shows_the_wall() {
        let (wall, photos, covered) = turn(&mut proof::Dice(2));
        let guess = backdrop(&photos, None);
        let known = backdrop(&photos, Some(&covered));
        let off = |b: &Backdrop, x: usize| {
            let (got, want) = (b.image.at(x, 20), wall.at(x, 20));
            (0..3).map(|c| got[c].abs_diff(want[c])).max().unwrap()
        };
        assert!(off(&known, 24) <= 2 && off(&known, 39) <= 2);
        assert!(
            off(&guess, 27) > 10,
            "a guess without masks takes the body here"
        );
        // Never uncovered: nobody saw the wall there.
        assert!(!known.seen.at(31, 20));
    }
}
