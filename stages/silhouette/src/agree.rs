//! How a photo takes over what all photos say together, and what of it it may contradict.

use crate::least_cut::Known;
use crate::parts::{LIKELY_HOLE, parts};
use crate::photo_cut::Prepared;
use crate::unary::FLAT;
use shape::Image;

/// A neighbourhood that costs the background no more than this shows it beyond doubt.
const CERTAIN: f32 = FLAT + 2.0;

impl Prepared {
    /// Takes over what all photos say together. Where this one shows the background to the level,
    /// the others may not call it body: a gap between the legs is seen on two photos of eighteen.
    /// Where colours alone speak for the background, they may if all others do (`firm`), and but for
    /// a patch of the size of a gap: a garment's hem may have the wall's colour.
    pub fn agree<'a>(&mut self, agreed: impl Iterator<Item = &'a Known>, firm: &[Known]) {
        let agreed: Vec<&Known> = agreed.collect();
        let (sure, likely) = (self.gaps(&self.cost), self.gaps(self.explained()));
        let body = |i: usize| *agreed[i] == Known::Body;
        let only_likely = |i: usize| body(i) && likely[i] && firm.get(i) != Some(&Known::Body);
        let patches = Image {
            width: self.small.width,
            height: self.small.height,
            data: (0..self.known.len())
                .map(|i| i < agreed.len() && only_likely(i))
                .collect(),
        };
        let least = (0..agreed.len()).filter(|i| body(*i)).count() / LIKELY_HOLE;
        let (patch, sizes) = parts(&patches, true);
        for (i, agreed) in agreed.iter().enumerate() {
            let wide = patches.data[i] && sizes[patch.data[i] as usize] >= least;
            let against = **agreed == Known::Body && (sure[i] || wide);
            if self.known[i] == Known::Unknown && !against {
                self.known[i] = **agreed;
            }
        }
    }

    /// Pixels in a neighbourhood that shows the background beyond doubt.
    fn gaps(&self, cost: &[f32]) -> Vec<bool> {
        let (width, height) = (self.small.width, self.small.height);
        // A gap is as wide as three pixels somewhere.
        let window = |x: usize, y: usize| {
            let rows = (y - 1..y + 2).flat_map(|row| (x - 1..x + 2).map(move |c| row * width + c));
            rows.map(|i| cost[i]).sum::<f32>() / 9.0 < CERTAIN
        };
        let around = |i: usize| {
            let (x, y) = (i % width, i / width);
            let inside = |x: usize, y: usize| x > 0 && y > 0 && x + 1 < width && y + 1 < height;
            (y.max(1) - 1..y + 2)
                .any(|y| (x.max(1) - 1..x + 2).any(|x| inside(x, y) && window(x, y)))
        };
        (0..cost.len()).map(around).collect()
    }
}
