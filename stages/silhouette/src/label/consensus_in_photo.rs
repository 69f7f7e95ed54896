//! How a photo takes over what all photos say together, and what of it it may contradict.

use crate::cut::least_cut::Known;
use crate::label::parts::{LIKELY_HOLE, parts};
use crate::likelihood::background::FLAT;
use crate::likelihood::prepared::Prepared;
use shape::Image;

/// A neighbourhood that costs the background no more than this shows it beyond doubt.
pub(crate) const CERTAIN: f32 = FLAT + 2.0;

impl Prepared {
    /// Takes over what all photos say together. Where this one shows the background to the level,
    /// the others may not call it body: a gap between the legs is seen on two photos of eighteen.
    /// Where colours alone speak for the background, they may if all others do (`firm`), and but for
    /// a patch of the size of a gap: a garment's hem may have the wall's colour.
    pub fn agree<'a>(&mut self, agreed: impl Iterator<Item = &'a Known>, firm: &[Known]) {
        let agreed: Vec<&Known> = agreed.collect();
        let (sure, likely) = (self.gaps(&self.cost), self.gaps(&self.explained));
        let body = |i: usize| *agreed[i] == Known::Body;
        let only_likely = |i: usize| body(i) && likely[i] && firm.get(i) != Some(&Known::Body);
        // A gap between legs goes on to where the others say nothing, and is as large as all of it. What
        // surely shows the background is no part of it: that lies all around the body.
        let goes_on = |i: usize| *agreed[i] == Known::Unknown && likely[i] && !sure[i];
        let patches = Image {
            width: self.small.width,
            height: self.small.height,
            data: (0..self.known.len())
                .map(|i| i < agreed.len() && (only_likely(i) || goes_on(i)))
                .collect(),
        };
        let least = (0..agreed.len()).filter(|i| body(*i)).count() / LIKELY_HOLE;
        let (patch, sizes) = parts(&patches, true);
        for (i, agreed) in agreed.iter().enumerate() {
            let wide = only_likely(i) && sizes[patch.data[i] as usize] >= least;
            let against = **agreed == Known::Body && (sure[i] || wide);
            if self.known[i] == Known::Unknown && !against {
                self.known[i] = **agreed;
            }
        }
    }

    /// Takes it that pixels show the background.
    pub(crate) fn lay_bare(&mut self, pixels: &[usize]) {
        for i in pixels {
            self.known[*i] = Known::Background;
            self.cost[*i] = FLAT;
            self.explained[*i] = FLAT;
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
        let mut gaps = vec![false; cost.len()];
        for y in 1..height.saturating_sub(1) {
            for x in 1..width.saturating_sub(1) {
                if window(x, y) {
                    (y - 1..y + 2).for_each(|y| gaps[y * width + x - 1..][..3].fill(true));
                }
            }
        }
        gaps
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::likelihood::background::Noise;
    use shape::Rgb;

    #[test]
    fn the_top_of_a_gap_is_as_large_as_the_gap_and_a_patch_amid_the_body_is_not() {
        const SIDE: usize = 60;
        // Three columns of the wall's colour: a patch amid the body, and a gap from row 47 down, of
        // which the others deny three rows. So small a patch yields.
        let wall =
            |i: usize| (30..33).contains(&(i % SIDE)) && (i / SIDE >= 47 || i / SIDE / 3 == 4);
        let told = |i: usize| match i / SIDE < 50 {
            true => Known::Body,
            false => Known::Unknown,
        };
        let costs = |like: f32| (0..SIDE * SIDE).map(move |i| if wall(i) { like } else { 18.5 });
        let mut ready = Prepared {
            factor: 1,
            small: Rgb::filled(SIDE, SIDE, [0; 3]),
            cost: costs(8.0).collect(),
            explained: costs(4.5).collect(),
            strange: Vec::new(),
            person: Vec::new(),
            weighed: false,
            known: vec![Known::Unknown; SIDE * SIDE],
            noise: Noise::even(1.0),
            disk: None,
        };
        let told: Vec<Known> = (0..SIDE * SIDE).map(told).collect();
        ready.agree(told.iter(), &[]);
        let at = |row: usize| ready.known[row * SIDE + 31];
        assert_eq!((at(48), at(13)), (Known::Unknown, Known::Body));
    }
}
