//! Colours of the subject and of the background on one photo, by bands of rows: behind a head there is
//! another background than behind feet.

use crate::likelihood::body::{ANY_COLOR, body_cost};
use crate::likelihood::gmm::Gmm;
use crate::raster::raster;
use rayon::prelude::*;
use shape::{Image, Rgb};

/// What a colour costs that the background has nowhere: most of it is in view beside the subject, so that such a colour
/// is rather the subject's. By hand: looked at the walk of a test, at 2.2 and 4.5 more than any colour: mean IoU
/// −0.0022 and −0.0018. \[nats\]
const UNSEEN_BEHIND_NATS: f64 = ANY_COLOR + 3.2;
/// How many bands; each learns from half of its height above and below, too. By hand: looked at the walk of a test, at
/// 3 and 6: mean IoU −0.0083 and −0.0424.
const BANDS: usize = 4;
/// So many samples tell a mixture (structural: a cap on work).
const MOST_SAMPLES: usize = 6_000;
/// With fewer than these a band takes those of the whole photo (structural: a count of samples).
const FEWEST_SAMPLES: usize = 100;

/// Colours with the rows that show them.
pub(crate) type Samples = Vec<(u32, [u8; 3])>;

/// The mixtures of a photo.
#[derive(Debug, Clone)]
pub(crate) struct Colors {
    /// The subject's and the background's, by band.
    bands: Vec<[Gmm; 2]>,
    /// Rows of a band.
    rows: f64,
}

/// A mixture of at most `MOST_SAMPLES` of the colours of a band, evenly.
fn mixture(all: &Samples, from: f64, to: f64, clusters: usize) -> Option<Gmm> {
    let in_band = |(row, _): &&(u32, [u8; 3])| (from..to).contains(&f64::from(*row));
    let mut colors: Vec<[u8; 3]> = all.iter().filter(in_band).map(|s| s.1).collect();
    if colors.len() < FEWEST_SAMPLES {
        colors = all.iter().map(|s| s.1).collect();
    }
    let step = colors.len().div_ceil(MOST_SAMPLES).max(1);
    let some: Vec<[u8; 3]> = colors.into_iter().step_by(step).collect();
    Gmm::fit(&some, clusters)
}

impl Colors {
    /// Fits all mixtures of a photo of so many rows. `None` without colours of either side.
    pub(crate) fn fit(
        body: &Samples,
        background: &Samples,
        height: usize,
        clusters: usize,
    ) -> Option<Colors> {
        let rows = height as f64 / BANDS as f64;
        let one = |b: usize| {
            let (from, to) = ((b as f64 - 0.5) * rows, (b as f64 + 1.5) * rows);
            let body = mixture(body, from, to, clusters)?;
            Some([
                body,
                mixture(background, from, to, clusters + clusters / 2)?,
            ])
        };
        let bands = (0..BANDS).map(one).collect::<Option<Vec<_>>>()?;
        Some(Colors { bands, rows })
    }

    /// ln p(colour | body) − ln p(colour | background) of a colour on a row.
    pub(crate) fn favour(&self, color: [u8; 3], row: f64) -> f32 {
        let band = ((row / self.rows).max(0.0) as usize).min(BANDS - 1);
        let [body, background] = &self.bands[band];
        (background.cost(color).min(UNSEEN_BEHIND_NATS) - body_cost(body, color)) as f32
    }

    /// The same of every pixel, means of 3 × 3.
    pub(crate) fn favours(&self, photo: &Rgb) -> Image<f32> {
        let (w, h) = (photo.width, photo.height);
        let one = |i: usize| self.favour(photo.data[i], (i / w) as f64);
        let alone: Vec<f32> = (0..w * h).into_par_iter().map(one).collect();
        let mean = |i: usize| {
            let (x, y) = (i % w, i / w);
            let (mut sum, mut n) = (0.0, 0.0);
            for row in y.saturating_sub(1)..(y + 2).min(h) {
                for column in x.saturating_sub(1)..(x + 2).min(w) {
                    sum += alone[row * w + column];
                    n += 1.0;
                }
            }
            sum / n
        };
        raster(w, h, (0..w * h).into_par_iter().map(mean).collect())
    }
}
