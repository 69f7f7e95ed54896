//! Body and background of a photo by graph cuts, coarse to fine (Rother, Kolmogorov, Blake 2004).

use crate::gmm::Gmm;
use crate::least_cut::{Known, Terms, UNIT, Window, least_cut};
use crate::parts::largest;
use crate::unary::{FLAT, Noise};
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
    /// By how much noise makes the background's density thinner ([`crate::Noise`]): the body costs so much less. \[nats\]
    pub thinner: f64,
}

impl Settings {
    /// The same for a photo of such noise.
    pub(crate) fn with(&self, noise: Noise) -> Self {
        Settings {
            thinner: noise.thinner(),
            ..*self
        }
    }
}

/// Neighbours that cost the background no more than this are its own.
const OWN: f32 = FLAT + 1.5;
/// -ln of an even density over all colours: anything can be body.
const ANY_COLOR: f64 = 16.6;
/// A pixel that costs the background more than this is evidently body.
pub(crate) const EVIDENT: f32 = 22.0;
/// What the body costs where its mixture tells nothing: a colour that it has not.
pub(crate) const STRANGE: f64 = ANY_COLOR + 1.2;

/// What a colour costs the body at most that it evidently has: twenty times as likely as any colour. Set by
/// hand.
pub(crate) const OWN_COLOR: f64 = ANY_COLOR - 3.0;

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
        let of_body = body_cost(body, photo.data[i]) - settings.thinner;
        (keep, (of_body * UNIT) as i32)
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
