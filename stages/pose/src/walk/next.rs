//! Which photo is added next, and where it was taken from.

use crate::adjust::scene::{Scene, Spot};
use crate::walk::groups::Groups;
use crate::walk::points::places;
use crate::walk::register::{Known, Placed, Samples, registered};
use crate::walk::rules::Growth;
use crate::walk::seen::Seen;
use shape::{Intrinsics, PhotoId};

/// What was seen, and what is found so far.
#[derive(Clone)]
pub(crate) struct State<'a> {
    pub(crate) seen: &'a Seen,
    pub(crate) groups: &'a Groups,
    pub(crate) rules: &'a Growth,
    /// Without its points.
    pub(crate) scene: Scene,
    /// Points, by track.
    pub(crate) spots: Vec<Option<Spot>>,
}

impl State<'_> {
    /// The photo that is best added next, with its lens where that is new.
    pub(crate) fn next(&self) -> Option<(PhotoId, Option<Intrinsics>, Placed)> {
        let places = places(&self.scene, self.seen.by_photo.len());
        let open = (0..places.len()).filter(|p| places[*p].is_none());
        let mut next: Vec<(usize, usize)> = open
            .map(|p| (self.worth(&self.known(p), self.lens(p)), p))
            .filter(|(score, _)| *score > 0)
            .collect();
        next.sort_by_key(|(score, p)| (std::cmp::Reverse(*score), *p));
        next.into_iter().find_map(|(_, p)| self.placed(p))
    }

    /// How good points are for a camera.
    fn worth(&self, known: &[Known], lens: &Intrinsics) -> usize {
        match self.rules.spread {
            true => spread(known, lens),
            false => known.len(),
        }
    }

    fn lens(&self, photo: usize) -> &Intrinsics {
        &self.scene.lenses[self.groups.of[photo]]
    }

    /// The points that a photo shows.
    fn known(&self, photo: usize) -> Vec<Known> {
        let one = |(t, px): &(usize, [f64; 2])| Some((self.spots[*t].as_ref()?.at, *px));
        self.seen.by_photo[photo].iter().filter_map(one).collect()
    }

    /// A photo's camera, if enough agrees with it.
    fn placed(&self, photo: usize) -> Option<(PhotoId, Option<Intrinsics>, Placed)> {
        let known = self.known(photo);
        if known.len() < self.rules.least {
            return None;
        }
        let samples = Samples {
            near_px: 2.0 * self.rules.near_px,
            rounds: self.rules.rounds,
            seed: self.rules.seed,
        };
        let group = self.groups.of[photo];
        let new = self.scene.shots.iter().all(|s| s.lens != group);
        let factors = if new {
            &self.groups.factors[..]
        } else {
            &[1.0]
        };
        let mut best: Option<(Intrinsics, Placed)> = None;
        for factor in factors {
            let mut lens = *self.lens(photo);
            lens.focal = lens.focal.map(|f| f * factor);
            let found = registered(&lens, &known, &samples);
            if let Some(found) = found
                && best.as_ref().is_none_or(|(_, b)| found.agree > b.agree)
            {
                best = Some((lens, found));
            }
        }
        let (lens, placed) = best?;
        let enough = placed.agree >= self.rules.least
            && placed.agree as f64 >= self.rules.share * known.len() as f64;
        enough.then(|| (PhotoId(photo as u32), new.then_some(lens), placed))
    }
}

/// How many points there are and how well they are spread over the photo: cells of three grids that
/// hold one, those of finer grids worth more (Schönberger and Frahm 2016, §4.2).
fn spread(known: &[Known], lens: &Intrinsics) -> usize {
    let mut score = 0;
    for cells in [2usize, 4, 8] {
        let mut filled = vec![false; cells * cells];
        for (_, [x, y]) in known {
            let cell = |v: f64, size: u32| {
                let at = (v / f64::from(size) * cells as f64).max(0.0) as usize;
                at.min(cells - 1)
            };
            filled[cell(*y, lens.height) * cells + cell(*x, lens.width)] = true;
        }
        score += filled.iter().filter(|h| **h).count() * cells * cells;
    }
    score
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Point3;

    #[test]
    fn points_all_over_the_photo_are_worth_more_than_as_many_in_a_corner() {
        let lens = Intrinsics::simple(800, 800, 700.0);
        let known = |step: f64| -> Vec<Known> {
            let at = |i: usize| [(i % 8) as f64 * step, (i / 8) as f64 * step];
            (0..64).map(|i| (Point3::origin(), at(i))).collect()
        };
        assert_eq!(spread(&known(100.0), &lens), 4 * 4 + 16 * 16 + 64 * 64);
        assert_eq!(spread(&known(10.0), &lens), 4 + 16 + 64);
        assert_eq!(spread(&[], &lens), 0);
    }
}
