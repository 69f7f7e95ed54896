//! How well a colour is explained by the body: negative log likelihoods. \[nats\]

use crate::cut::least_cut::Known;
use crate::likelihood::gmm::Gmm;
use crate::raster::raster;
use shape::Image;

/// -ln of an even density over all colours, derived: 3 ln 256. Anything can be body.
pub(crate) const ANY_COLOR: f64 = 16.6;
/// A pixel that costs the background more than this is evidently body. By hand: looked at the man with a plate, 533 × 800 pixels, at 0.7 and 1.4
/// of it: mean IoU of masks −0.0001 and −0.0053. \[nats\]
pub(crate) const EVIDENT: f32 = 22.0;
/// What the body costs where its mixture tells nothing: a colour that it has not (derived: one time in three, -ln 0.3 more).
pub(crate) const STRANGE: f64 = ANY_COLOR + 1.2;

/// What a colour costs the body at most that it evidently has: twenty times as likely as any colour (derived: its logarithm).
pub(crate) const OWN_COLOR: f64 = ANY_COLOR - 3.0;

/// -ln p(colour | body): of its mixture or, one time in three, of any colour.
pub(crate) fn body_cost(body: &Gmm, color: [u8; 3]) -> f64 {
    of_mixture(body.cost(color))
}

/// [`body_cost`] of each of some colours.
pub(crate) fn body_costs(body: &Gmm, colors: &[[u8; 3]]) -> Vec<f64> {
    body.costs(colors).into_iter().map(of_mixture).collect()
}

fn of_mixture(cost: f64) -> f64 {
    (cost + 0.36).min(STRANGE)
}

/// The pixels of a photo that evidently are no background, by what they cost as such.
pub(crate) fn evident(cost: &[f32], known: &[Known], [width, height]: [usize; 2]) -> Image<bool> {
    let both = cost.iter().zip(known);
    let data = both.map(|(cost, known)| *cost > EVIDENT && *known == Known::Unknown);
    raster(width, height, data.collect())
}
