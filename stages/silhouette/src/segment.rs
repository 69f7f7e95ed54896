//! Body and background of a photo by graph cuts, coarse to fine (Rother, Kolmogorov, Blake 2004).

use crate::gmm::Gmm;
use crate::least_cut::{Known, Terms, UNIT, Window, least_cut};
use crate::unary::FLAT;
use shape::{Image, Rgb};

/// How to cut.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Weight of the border's length against colours (γ).
    pub gamma: f64,
    /// Rounds of fitting colours and cutting.
    pub rounds: usize,
    /// Clusters of each mixture of colours.
    pub clusters: usize,
}

/// A hole whose median pixel costs the background more than this is no hole.
const EXPLAINED: f32 = FLAT + 1.5;
/// Neighbours that cost the background no more than this are its own.
const OWN: f32 = FLAT + 1.5;
/// -ln of an even density over all colours: anything can be body.
const ANY_COLOR: f64 = 16.6;
/// A pixel that costs the background more than this is evidently body.
pub(crate) const EVIDENT: f32 = 22.0;
/// What the body costs where its mixture tells nothing: a colour that it has not.
pub(crate) const STRANGE: f64 = ANY_COLOR + 1.2;

/// An image reduced by a whole factor, pixels averaged.
pub fn reduced(image: &Rgb, factor: usize) -> Rgb {
    let (width, height) = (image.width / factor, image.height / factor);
    let mut small = Rgb::filled(width, height, [0; 3]);
    let area = (factor * factor) as u32;
    for y in 0..height {
        for x in 0..width {
            let mut sum = [area / 2; 3];
            for row in y * factor..(y + 1) * factor {
                for p in &image.row(row)[x * factor..(x + 1) * factor] {
                    (0..3).for_each(|c| sum[c] += u32::from(p[c]));
                }
            }
            *small.at_mut(x, y) = sum.map(|s| (s / area) as u8);
        }
    }
    small
}

/// Which pixels are body: `background` is -ln p(pixel | background), `explained` the same as far as
/// holes may trust it, `known` what is certain.
/// Returns the sides and the mixture of the body's colours. `None` if nothing can be body.
pub fn cut_whole(
    photo: &Rgb,
    background: &[f32],
    explained: &[f32],
    known: &[Known],
    settings: &Settings,
) -> Option<(Image<bool>, Gmm)> {
    let certain = |i: usize| match known[i] {
        Known::Unknown => background[i] > EVIDENT,
        other => other == Known::Body,
    };
    let mut body: Vec<bool> = (0..known.len()).map(certain).collect();
    let mut gmm = None;
    for _ in 0..settings.rounds.max(1) {
        let colors: Vec<[u8; 3]> = body
            .iter()
            .zip(&photo.data)
            .filter(|(b, _)| **b)
            .map(|(_, c)| *c)
            .step_by(7)
            .collect();
        let fitted = Gmm::fit(&colors, settings.clusters)?;
        let window = Window {
            x: 0,
            y: 0,
            width: photo.width,
            height: photo.height,
        };
        body = cut(photo, background, &window, &fitted, settings, &|i| known[i]);
        gmm = Some(fitted);
    }
    let sides = Image {
        width: photo.width,
        height: photo.height,
        data: body,
    };
    let costs = |i: usize| [background[i], explained[i]];
    Some((largest(&sides, &costs), gmm?))
}

/// -ln p(colour | body): of its mixture or, one time in three, of any colour.
pub(crate) fn body_cost(body: &Gmm, color: [u8; 3]) -> f64 {
    (body.cost(color) + 0.36).min(STRANGE)
}

/// Cuts a window: true is body. `background` and the result are row-major over the window, `known`
/// goes by the photo's pixels.
pub fn cut(
    photo: &Rgb,
    background: &[f32],
    window: &Window,
    body: &Gmm,
    settings: &Settings,
    known: &dyn Fn(usize) -> Known,
) -> Vec<bool> {
    let colours = |i: usize, here: usize| {
        // The grid is small where it matters: -ln of body = -ln(0.7 GMM + 0.3 anything).
        let keep = (f64::from(background[here]) * UNIT) as i32;
        (keep, (body_cost(body, photo.data[i]) * UNIT) as i32)
    };
    // An edge that the background has by itself is no reason to cut here.
    let own = |here: usize, there: usize| background[here].min(background[there]) < OWN;
    least_cut(
        photo,
        window,
        settings.gamma,
        &Terms {
            known,
            colours: &colours,
            own: &own,
        },
    )
}

/// A hole that the background only likely explains is at least this part of the body: gaps between arm
/// and trunk were 0.7 to 1 %, a grey waistband taken for a grey wall 0.2 %.
pub(crate) const LIKELY_HOLE: usize = 250;

/// The largest connected part, with those of its holes filled that are small or that the background
/// does not explain: a gap between arm and trunk shows the background to the level, a blue fish on
/// a shirt only something like it. What a pixel costs as background is given twice, as it was seen and
/// as it is likely: a hole that is only likely must be of the size of such a gap, for a hole in one
/// photo is a tunnel through the hull.
pub fn largest(sides: &Image<bool>, background: &dyn Fn(usize) -> [f32; 2]) -> Image<bool> {
    let (parts, sizes) = parts(sides, true);
    let Some(best) = (0..sizes.len()).max_by_key(|i| (sizes[*i], usize::MAX - i)) else {
        return sides.clone();
    };
    let mut kept = Image {
        data: parts.data.iter().map(|p| *p == best as u32).collect(),
        ..*sides
    };
    let (least, most) = (sizes[best] / 2000, sizes[best] / 10);
    let (holes, hole_sizes) = self::parts(&kept, false);
    let likely_least = sizes[best] / LIKELY_HOLE;
    let mut costs: Vec<[Vec<f32>; 2]> = vec![Default::default(); hole_sizes.len()];
    for (i, hole) in holes
        .data
        .iter()
        .enumerate()
        .filter(|(_, h)| **h != u32::MAX)
    {
        if hole_sizes[*hole as usize] <= most {
            let [seen, likely] = background(i);
            costs[*hole as usize][0].push(seen);
            costs[*hole as usize][1].push(likely);
        }
    }
    let fill: Vec<bool> = costs
        .iter_mut()
        .zip(&hole_sizes)
        .map(|(costs, size)| {
            let explained = |costs: &mut Vec<f32>| {
                costs.sort_by(f32::total_cmp);
                costs
                    .get(costs.len() / 2)
                    .is_some_and(|middle| *middle <= EXPLAINED)
            };
            let [seen, likely] = costs;
            let open =
                *size >= least && explained(seen) || *size >= likely_least && explained(likely);
            *size <= most && !open
        })
        .collect();
    for (keep, hole) in kept.data.iter_mut().zip(&holes.data) {
        *keep |= *hole != u32::MAX && fill[*hole as usize];
    }
    kept
}

/// Connected parts (four neighbours) of the pixels of one side: number of each pixel's part or
/// `u32::MAX`, and sizes.
pub(crate) fn parts(sides: &Image<bool>, of: bool) -> (Image<u32>, Vec<usize>) {
    let mut parts = Image {
        width: sides.width,
        height: sides.height,
        data: vec![u32::MAX; sides.data.len()],
    };
    let mut sizes = Vec::new();
    for start in 0..sides.data.len() {
        if sides.data[start] != of || parts.data[start] != u32::MAX {
            continue;
        }
        let number = sizes.len() as u32;
        let (mut open, mut size) = (vec![start], 0);
        parts.data[start] = number;
        while let Some(i) = open.pop() {
            size += 1;
            let (x, y) = (i % sides.width, i / sides.width);
            let near = [
                (x > 0).then(|| i - 1),
                (x + 1 < sides.width).then(|| i + 1),
                (y > 0).then(|| i - sides.width),
                (y + 1 < sides.height).then(|| i + sides.width),
            ];
            for j in near.into_iter().flatten() {
                if sides.data[j] == of && parts.data[j] == u32::MAX {
                    parts.data[j] = number;
                    open.push(j);
                }
            }
        }
        sizes.push(size);
    }
    (parts, sizes)
}
