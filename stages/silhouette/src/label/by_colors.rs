//! The subject by its colours alone, where nothing is known of the scene but a rectangle (Rother, Kolmogorov, Blake 2004).

use crate::cut::least_cut::{Known, Window};
use crate::label::color_cut::{Costs, Settings, cut};
use crate::label::parts::without_specks;
use crate::likelihood::gmm::Gmm;
use crate::raster::raster;
use shape::{Image, Rgb};

/// One of so many pixels is what the colours of the background and of the body are learnt from (structural: samples).
const EVERY_PIXEL: usize = 7;

/// A photo, reduced, parted by its colours.
pub(crate) struct ByColors {
    /// True is body.
    pub(crate) sides: Image<bool>,
    /// The colours of the background.
    pub(crate) ground: Gmm,
    /// The colours of the body.
    pub(crate) own: Gmm,
}

/// What each colour costs.
pub(crate) fn costs(image: &Rgb, of: &Gmm) -> Vec<f32> {
    let all = of.costs(&image.data).into_iter();
    all.map(|cost| cost as f32).collect()
}

/// The subject by colours alone: those that are known to be background's; elsewhere, what
/// they explain worse than the rest does is body, and both learn from the cut in turns. `None` where
/// nothing is explained worse.
pub(crate) fn by_colors(small: &Rgb, known: &[Known], settings: &Settings) -> Option<ByColors> {
    let colors = |of: &[bool], side: bool| -> Vec<[u8; 3]> {
        let on = of.iter().zip(&small.data).filter(|(b, _)| **b == side);
        on.map(|(_, c)| *c).step_by(EVERY_PIXEL).collect()
    };
    let mut body: Vec<bool> = known.iter().map(|k| *k == Known::Unknown).collect();
    let mut learnt = None;
    // Without an empty scene the first cuts are rough: more rounds than with one.
    for _ in 0..settings.rounds.max(1) * 3 {
        let ground = Gmm::fit(&colors(&body, false), settings.clusters)?;
        let own = Gmm::fit(&colors(&body, true), settings.clusters)?;
        let costs = costs(small, &ground);
        body = cut(
            small,
            &Costs {
                background: &costs,
                ..Costs::default()
            },
            &Window::all(small),
            &own,
            settings,
            &|i| known[i],
        );
        learnt = Some((ground, own));
    }
    let (ground, own) = learnt?;
    let sides = raster(small.width, small.height, body);
    let sides = without_specks(&sides);
    sides
        .data
        .contains(&true)
        .then_some(ByColors { sides, ground, own })
}
