//! The subject within a rectangle by its colours alone (Rother, Kolmogorov, Blake 2004).

use crate::align::rectangle::Rectangle;
use crate::align::reduced::reduced;
use crate::border::full_size::band;
use crate::border::soft_border::coverage;
use crate::cut::least_cut::{Known, Window};
use crate::label::color_cut::{Settings, cut};
use crate::label::parts::largest;
use crate::likelihood::gmm::Gmm;
use shape::{Image, Mask, Rgb};

/// Share of the pixels that the colours of the background and of the body are learnt from.
const EVERY: usize = 7;

/// The subject within a rectangle by colours alone: those beyond it are the background's; inside, what
/// they explain worse than the rest does is body, and both learn from the cut in turns. `None` where
/// nothing stands out.
pub fn by_colors(
    photo: &Rgb,
    rectangle: &Rectangle,
    settings: &Settings,
    coarse_px: usize,
) -> Option<Mask> {
    let longest = photo.width.max(photo.height);
    let factor = longest.div_ceil(coarse_px.max(1)).max(1);
    let small = reduced(photo, factor);
    let mut known = vec![Known::Unknown; small.data.len()];
    rectangle.close(&mut known, small.width, factor);
    let colors = |of: &[bool], side: bool| -> Vec<[u8; 3]> {
        let on = of.iter().zip(&small.data).filter(|(b, _)| **b == side);
        on.map(|(_, c)| *c).step_by(EVERY).collect()
    };
    let mut body: Vec<bool> = known.iter().map(|k| *k == Known::Unknown).collect();
    let window = |image: &Rgb| Window {
        x: 0,
        y: 0,
        width: image.width,
        height: image.height,
    };
    let cost = |image: &Rgb, of: &Gmm| -> Vec<f32> {
        image.data.iter().map(|c| of.cost(*c) as f32).collect()
    };
    let mut learnt = None;
    // Without an empty scene the first cuts are rough: more rounds than with one.
    for _ in 0..settings.rounds.max(1) * 3 {
        let ground = Gmm::fit(&colors(&body, false), settings.clusters)?;
        let own = Gmm::fit(&colors(&body, true), settings.clusters)?;
        let costs = cost(&small, &ground);
        body = cut(&small, &costs, &window(&small), &own, settings, &|i| {
            known[i]
        });
        learnt = Some((ground, own));
    }
    let (ground, own) = learnt?;
    let sides = Image {
        width: small.width,
        height: small.height,
        data: body,
    };
    // No hole is filled for its colours: they are all that is known.
    let sides = largest(&sides, &|_| [0.0; 2]);
    if !sides.data.contains(&true) {
        return None;
    }
    let near = band(&sides);
    let at = |i: usize| {
        let (x, y) = (i % photo.width / factor, i / photo.width / factor);
        (x.min(sides.width - 1), y.min(sides.height - 1))
    };
    let settled = |i: usize| {
        let (x, y) = at(i);
        match (near.at(x, y), sides.at(x, y)) {
            (true, _) => known[y * sides.width + x],
            (false, true) => Known::Body,
            (false, false) => Known::Background,
        }
    };
    let fine = cut(
        photo,
        &cost(photo, &ground),
        &window(photo),
        &own,
        settings,
        &settled,
    );
    let fine = Image {
        width: photo.width,
        height: photo.height,
        data: fine,
    };
    Some(coverage(&largest(&fine, &|_| [0.0; 2])))
}
