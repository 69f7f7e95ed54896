//! Body and background of a photo by graph cuts, coarse to fine (Rother, Kolmogorov, Blake 2004).

use crate::cut::least_cut::{Known, LeastCut, UNIT, Window};
use crate::likelihood::background::{FLAT, Noise};
use crate::likelihood::body::{EVIDENT, body_costs};
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
    let costs = Costs {
        background: &background,
        person,
        ..Costs::default()
    };
    let mut cut = ColorCut::new(photo, &costs, &Window::all(photo), &settings, &|i| known[i]);
    let mut gmm = None;
    for _ in 0..settings.rounds.max(1) {
        let own = body.iter().zip(&photo.data).filter(|(b, _)| **b);
        let colors: Vec<[u8; 3]> = own.map(|(_, c)| *c).step_by(7).collect();
        let fitted = Gmm::fit(&colors, settings.clusters)?;
        body = cut.sides(&fitted);
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
    ColorCut::new(photo, costs, window, settings, known).sides(body)
}

/// A window ready to be cut by the colours of a body.
struct ColorCut<'a> {
    costs: &'a Costs<'a>,
    thinner: f64,
    known: Vec<Known>,
    /// The colours of what is unknown.
    colors: Vec<[u8; 3]>,
    cut: LeastCut,
}

impl<'a> ColorCut<'a> {
    fn new(
        photo: &Rgb,
        costs: &'a Costs<'a>,
        window: &Window,
        settings: &Settings,
        known: &dyn Fn(usize) -> Known,
    ) -> Self {
        let known: Vec<Known> = window.pixels(photo).map(known).collect();
        let open = window.pixels(photo).zip(&known);
        let open = open.filter(|(_, known)| **known == Known::Unknown);
        let colors = open.map(|(i, _)| photo.data[i]).collect();
        // An edge that the background has by itself is no reason to cut here.
        let more = |here: usize| costs.person.get(here).map_or(0.0, |p| p.max(0.0));
        let own = |here: usize| costs.background[here] + more(here) < OWN_NATS;
        let own: Vec<bool> = (0..known.len()).map(own).collect();
        ColorCut {
            costs,
            thinner: settings.thinner,
            cut: LeastCut::new(photo, window, settings.gamma, known.clone(), &own),
            known,
            colors,
        }
    }

    fn sides(&mut self, body: &Gmm) -> Vec<bool> {
        let mut of_body = body_costs(body, &self.colors).into_iter();
        let open = self.known.iter().map(|known| match known {
            Known::Unknown => of_body.next(),
            _ => None,
        });
        let costs = open.enumerate().map(|(here, of_body)| {
            let of_body = of_body.map(|cost| self.nats(here, cost - self.thinner));
            of_body.map_or((0, 0), |(keep, lose)| {
                ((keep * UNIT) as i32, (lose * UNIT) as i32)
            })
        });
        self.cut.sides(costs.collect())
    }

    /// What a pixel costs as background and as body, by what its colour costs the body. \[nats\]
    fn nats(&self, here: usize, of_body: f64) -> (f64, f64) {
        // The grid is small where it matters: -ln of body = -ln(0.7 GMM + 0.3 anything).
        let alone = [f32::INFINITY; 2];
        let [ground, of_both] = self
            .costs
            .mixed
            .get(here)
            .copied()
            .flatten()
            .unwrap_or(alone);
        let keep = f64::from(self.costs.background[here].min(ground));
        let of_body = of_body.min(f64::from(of_both));
        match self.costs.person.get(here) {
            Some(odds) => with_person(keep, of_body, *odds),
            None => (keep, of_body),
        }
    }
}
