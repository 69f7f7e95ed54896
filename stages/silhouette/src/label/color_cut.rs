//! Body and background of a photo by graph cuts, coarse to fine (Rother, Kolmogorov, Blake 2004).

use crate::cut::least_cut::{Known, Terms, UNIT, Window, least_cut};
use crate::likelihood::background::{FLAT, Noise};
use crate::likelihood::body::{EVIDENT, body_cost};
use crate::likelihood::gmm::Gmm;
use crate::likelihood::person::{SURE, with_person};
use crate::likelihood::prepared::Prepared;
use crate::params::CutParams;
use crate::raster::raster;
use shape::{Image, Rgb, largest_part};

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
    /// By the user's params.
    pub(crate) fn of(p: &CutParams) -> Self {
        Settings {
            gamma: p.gamma,
            rounds: p.rounds as usize,
            clusters: p.clusters as usize,
            thinner: 0.0,
        }
    }

    /// For a cut by colours that are known already.
    pub(crate) fn of_border(gamma: f64) -> Self {
        Settings {
            gamma,
            rounds: 1,
            clusters: 1,
            thinner: 0.0,
        }
    }

    /// The same for a photo of such noise.
    pub(crate) fn with(&self, noise: Noise) -> Self {
        Settings {
            thinner: noise.thinner(),
            ..*self
        }
    }
}

/// Neighbours that cost the background no more than this are its own: what noise of three channels adds on the mean
/// (derived: 3/2). \[nats\]
pub(crate) const OWN_NATS: f32 = FLAT + 1.5;

/// The coarse cut: which pixels are body, and the mixture of the body's colours. `None` if nothing can be body.
pub fn coarse(ready: &Prepared, settings: &Settings) -> Option<(Image<bool>, Gmm)> {
    let (photo, person, known) = (&ready.small, &ready.person, &ready.known);
    let settings = settings.with(ready.noise);
    let sure = |i: usize| person.get(i).is_some_and(|p| *p > SURE);
    let certain = |i: usize| match known[i] {
        Known::Unknown => ready.cost[i] > EVIDENT || sure(i),
        other => other == Known::Body,
    };
    let mut body: Vec<bool> = (0..known.len()).map(certain).collect();
    let cost = |cost: &f32| ready.foreseen_or_not(*cost);
    let background: Vec<f32> = ready.cost.iter().map(cost).collect();
    let window = Window::all(photo);
    let mut gmm = None;
    for _ in 0..settings.rounds.max(1) {
        let own = body.iter().zip(&photo.data).filter(|(b, _)| **b);
        let colors: Vec<[u8; 3]> = own.map(|(_, c)| *c).step_by(7).collect();
        let fitted = Gmm::fit(&colors, settings.clusters)?;
        let costs = Costs {
            background: &background,
            person,
            ..Costs::default()
        };
        body = cut(photo, &costs, &window, &fitted, &settings, &|i| known[i]);
        gmm = Some(fitted);
    }
    let sides = raster(photo.width, photo.height, body);
    Some((largest_part(&sides), gmm?))
}

/// What the pixels of a window cost, row by row; `person` and `mixed` are empty where nothing is known of them. \[nats\]
#[derive(Default)]
pub(crate) struct Costs<'a> {
    /// As background.
    pub(crate) background: &'a [f32],
    /// Log-odds of the body by a person's sense.
    pub(crate) person: &'a [f32],
    /// As background and as body, if a pixel is a mixture of both.
    pub(crate) mixed: &'a [Option<[f32; 2]>],
}

/// Cuts a window: true is body. The result is row-major over the window, `known` goes by the photo's pixels.
pub(crate) fn cut(
    photo: &Rgb,
    costs: &Costs<'_>,
    window: &Window,
    body: &Gmm,
    settings: &Settings,
    known: &dyn Fn(usize) -> Known,
) -> Vec<bool> {
    let Costs {
        background,
        person,
        mixed,
    } = costs;
    let colours = |i: usize, here: usize| {
        // The grid is small where it matters: -ln of body = -ln(0.7 GMM + 0.3 anything).
        let alone = [f32::INFINITY; 2];
        let [ground, of_both] = mixed.get(here).copied().flatten().unwrap_or(alone);
        let keep = f64::from(background[here].min(ground));
        let of_body = (body_cost(body, photo.data[i]) - settings.thinner).min(f64::from(of_both));
        let (keep, of_body) = match person.get(here) {
            Some(odds) => with_person(keep, of_body, *odds),
            None => (keep, of_body),
        };
        ((keep * UNIT) as i32, (of_body * UNIT) as i32)
    };
    // An edge that the background has by itself is no reason to cut here.
    let more = |here: usize| person.get(here).map_or(0.0, |p| p.max(0.0));
    let cost = |here: usize| background[here] + more(here);
    let own = |here: usize, there: usize| cost(here).min(cost(there)) < OWN_NATS;
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
