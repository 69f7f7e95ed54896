//! A rectangle that the user drew around the subject, and cuts by colours alone (Rother 2004).

use crate::border::coverage;
use crate::full_size::band;
use crate::gmm::Gmm;
use crate::least_cut::{Known, Window};
use crate::parts::largest;
use crate::segment::{Settings, cut, reduced};
use shape::{Image, Mask, Rgb};

/// A rectangle of the photo, beyond which nothing is body. \[px\]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rectangle {
    left: usize,
    top: usize,
    right: usize,
    bottom: usize,
}

/// A rectangle that is none.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RectangleError {
    /// Not four numbers.
    #[error("`box_px` has {0} numbers, but wants four: [left, top, right, bottom]")]
    Count(usize),
    /// Empty, or off the photo.
    #[error(
        "`box_px` {said:?} is no part of a photo of {width}×{height} pixels: left must be less than right, top less than bottom, and some of the photo must be left over around it"
    )]
    Place {
        /// What was said.
        said: Vec<f64>,
        /// The photo's width.
        width: u32,
        /// The photo's height.
        height: u32,
    },
}

impl Rectangle {
    /// From `[left, top, right, bottom]`, on a photo of a size; `None` if nothing was said.
    ///
    /// # Errors
    ///
    /// Other than four numbers; a rectangle that is empty, off the photo, or all of it.
    pub fn read(said: &[f64], width: u32, height: u32) -> Result<Option<Self>, RectangleError> {
        let [left, top, right, bottom] = match said {
            [] => return Ok(None),
            [a, b, c, d] => [*a, *b, *c, *d],
            other => return Err(RectangleError::Count(other.len())),
        };
        let wrong = || RectangleError::Place {
            said: said.to_vec(),
            width,
            height,
        };
        let clipped = |v: f64, most: u32| v.clamp(0.0, f64::from(most)).round() as usize;
        let rectangle = Rectangle {
            left: clipped(left, width),
            top: clipped(top, height),
            right: clipped(right, width),
            bottom: clipped(bottom, height),
        };
        let (wide, tall) = (
            rectangle.right.saturating_sub(rectangle.left),
            rectangle.bottom.saturating_sub(rectangle.top),
        );
        let whole = width as usize * height as usize;
        let some = wide > 0 && tall > 0 && wide * tall < whole;
        some.then_some(rectangle).map(Some).ok_or_else(wrong)
    }

    /// Whether a pixel of the photo, reduced by a factor, lies in it.
    pub fn holds(&self, x: usize, y: usize, factor: usize) -> bool {
        let middle = |v: usize| v * factor + factor / 2;
        (self.left..self.right).contains(&middle(x)) && (self.top..self.bottom).contains(&middle(y))
    }

    /// Nothing beyond it is body. `width` is that of the reduced photo.
    pub fn close(&self, known: &mut [Known], width: usize, factor: usize) {
        for (i, known) in known.iter_mut().enumerate() {
            if !self.holds(i % width, i / width, factor) {
                *known = Known::Background;
            }
        }
    }
}

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
