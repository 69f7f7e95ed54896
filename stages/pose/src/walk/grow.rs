//! Cameras of a walk, one photo more at a time (Snavely, Seitz and Szeliski 2006; Schönberger and
//! Frahm 2016): each registered among the points there are, adjusted with those that see the same,
//! and now and then all together.

use crate::adjust::lens::LensPrior;
use crate::walk::adjust::{Free, Terms, adjusted};
use crate::walk::begin::begun;
use crate::walk::groups::Groups;
use crate::walk::model::{Model, Seen, Shot, Spot};
use crate::walk::next::State;
use crate::walk::points::{offs, places, spots};
use crate::walk::rules::Growth;
use rayon::prelude::*;
use shape::{Intrinsics, PhotoId};

/// Cameras found so far.
#[derive(Clone)]
pub(crate) struct Grown<'a> {
    state: State<'a>,
    /// How many shots there were when all were adjusted.
    adjusted_shots: usize,
}

/// How many shots are adjusted with a new one.
/// It is structural: how often all are solved together, not what comes out at the end.
const LOCAL: usize = 6;
/// All are adjusted when there are so many times as many (structural: the same).
const MORE: f64 = 1.25;
/// Until there are so many, all are adjusted each time (structural: the same).
const FIRST: usize = 8;

/// Grows cameras from the best beginning over all that hold on, from the focal lengths that explain
/// most. None where no two photos are a beginning.
pub(crate) fn grown<'a>(
    seen: &'a Seen,
    groups: &'a Groups,
    rules: &'a Growth,
) -> Option<Grown<'a>> {
    let trial = |factor: &f64| {
        let longer = |lens: &Intrinsics| Intrinsics {
            focal: lens.focal.map(|f| f * factor),
            ..*lens
        };
        let lenses: Vec<Intrinsics> = groups.lenses.iter().map(longer).collect();
        let model = begun(seen, groups, &lenses, rules.near_px)?;
        let mut grown = Grown {
            state: State {
                seen,
                groups,
                rules,
                model,
                spots: vec![None; seen.tracks.len()],
            },
            adjusted_shots: 0,
        };
        grown.adjust_all(2);
        grown.grow(FIRST);
        Some((grown.score(), grown))
    };
    let trials: Vec<Option<(f64, Grown)>> = groups.factors.par_iter().map(trial).collect();
    let mut best: Option<(f64, Grown)> = None;
    for (score, grown) in trials.into_iter().flatten() {
        if best.as_ref().is_none_or(|(most, _)| score > *most) {
            best = Some((score, grown));
        }
    }
    let (_, mut grown) = best?;
    // What did not fit before may fit when all the rest are placed.
    loop {
        let before = grown.state.model.shots.len();
        grown.grow(usize::MAX);
        grown.adjust_all(2);
        if grown.state.model.shots.len() == before {
            return Some(grown);
        }
    }
}

impl Grown<'_> {
    /// How much of what the shots show is explained, and how well.
    fn score(&self) -> f64 {
        let sigma = self.state.rules.terms.sigma_px;
        let all = offs(&self.with_spots(usize::MAX).0);
        let one = |(_, off): &(usize, f64)| 1.0 / (1.0 + (off / sigma).powi(2));
        all.iter().map(one).sum()
    }

    /// The model with at most so many points, longer tracks first, and whose tracks they are.
    pub(crate) fn with_spots(&self, most: usize) -> (Model, Vec<usize>) {
        let mut of: Vec<usize> = (0..self.state.spots.len())
            .filter(|t| self.state.spots[*t].is_some())
            .collect();
        if of.len() > most {
            let mixed = |t: usize| (t as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15);
            let long = |t: usize| {
                self.state.spots[t]
                    .as_ref()
                    .map_or(0, |s| s.observations.len().min(8))
            };
            of.sort_by_key(|t| (std::cmp::Reverse(long(*t)), mixed(*t)));
            of.truncate(most);
            of.sort_unstable();
        }
        let spots = of
            .iter()
            .filter_map(|t| self.state.spots[*t].clone())
            .collect();
        let model = Model {
            spots,
            ..self.state.model.clone()
        };
        (model, of)
    }

    /// Points of all tracks, as the shots there are see them.
    pub(crate) fn look_again(&mut self, near_px: f64) {
        let all: Vec<usize> = (0..self.state.seen.tracks.len()).collect();
        self.state.spots = spots(&self.state.model, self.state.seen, &all, near_px);
    }

    /// Adjusts all so many times, points looked up anew before each.
    fn adjust_all(&mut self, times: usize) {
        // Two photos know little of a lens, three not much more.
        let tight = if self.state.model.shots.len() < 3 {
            1e-3
        } else {
            1.0
        };
        for k in (1..=times).rev() {
            self.look_again(self.state.rules.near_px * k as f64);
            let terms = Terms {
                lenses: self.priors(tight),
                steps: 12,
                ..self.state.rules.terms.clone()
            };
            let (mut model, _) = self.with_spots(self.state.rules.most);
            let free = Free {
                lenses: true,
                shots: None,
            };
            adjusted(&mut model, &terms, &free);
            self.take(model);
        }
        self.look_again(self.state.rules.near_px);
        self.adjusted_shots = self.state.model.shots.len();
    }

    /// What is believed of lenses; `tight` beliefs are about what they are now.
    fn priors(&self, tight: f64) -> Vec<LensPrior> {
        let one = |(lens, prior): (&Intrinsics, &LensPrior)| match tight < 1.0 {
            true => LensPrior {
                mean: crate::adjust::lens::lens_values(lens),
                sigma: prior.sigma.map(|s| s * tight),
            },
            false => *prior,
        };
        let both = self
            .state
            .model
            .lenses
            .iter()
            .zip(&self.state.rules.terms.lenses);
        both.map(one).collect()
    }

    /// Takes lenses and shots over; points are looked up again.
    fn take(&mut self, model: Model) {
        self.state.model = Model {
            spots: vec![],
            ..model
        };
    }

    /// Adds photos until there are `until`, or none holds on.
    fn grow(&mut self, until: usize) {
        while self.state.model.shots.len() < until {
            let Some((photo, lens, placed)) = self.state.next() else {
                return;
            };
            if let Some(own) = lens {
                self.state.model.lenses[self.state.groups.of[photo.0 as usize]] = own;
            }
            self.state.model.shots.push(Shot {
                photo,
                lens: self.state.groups.of[photo.0 as usize],
                pose: placed.pose,
                zoom: 0.0,
            });
            self.look_around(photo);
            let now = self.state.model.shots.len();
            match now <= FIRST || now as f64 >= MORE * self.adjusted_shots as f64 {
                true => self.adjust_all(1),
                false => self.adjust_near(),
            }
        }
    }

    /// Points of the tracks that a photo shows.
    fn look_around(&mut self, photo: PhotoId) {
        let own = &self.state.seen.by_photo[photo.0 as usize];
        let which: Vec<usize> = own.iter().map(|(t, _)| *t).collect();
        let found = spots(
            &self.state.model,
            self.state.seen,
            &which,
            self.state.rules.near_px,
        );
        for (t, spot) in which.into_iter().zip(found) {
            self.state.spots[t] = spot;
        }
    }

    /// Adjusts the last shot with those that see most of what it sees, lenses fixed.
    fn adjust_near(&mut self) {
        let last = self.state.model.shots.len() - 1;
        let mut shared = vec![0usize; last + 1];
        let sees = |s: &&Spot| s.observations.iter().any(|(shot, _)| *shot == last);
        for spot in self.state.spots.iter().flatten().filter(sees) {
            spot.observations.iter().for_each(|(s, _)| shared[*s] += 1);
        }
        let mut order: Vec<usize> = (0..last).collect();
        order.sort_by_key(|s| (std::cmp::Reverse(shared[*s]), *s));
        let mut free = vec![false; last + 1];
        free[last] = true;
        order.iter().take(LOCAL).for_each(|s| free[*s] = true);
        let (mut model, _) = self.with_spots(usize::MAX);
        let near = |s: &Spot| s.observations.iter().any(|(shot, _)| free[*shot]);
        model.spots.retain(near);
        model.spots.truncate(self.state.rules.most);
        let terms = Terms {
            lenses: self.priors(1.0),
            steps: 8,
            ..self.state.rules.terms.clone()
        };
        let photos: Vec<PhotoId> = (0..=last)
            .filter(|s| free[*s])
            .map(|s| self.state.model.shots[s].photo)
            .collect();
        let free = Free {
            lenses: false,
            shots: Some(free),
        };
        adjusted(&mut model, &terms, &free);
        self.take(model);
        photos.into_iter().for_each(|photo| self.look_around(photo));
    }

    /// Photos without a camera.
    pub(crate) fn missing(&self) -> Vec<PhotoId> {
        let places = places(&self.state.model, self.state.seen.by_photo.len());
        let open = (0..places.len()).filter(|p| places[*p].is_none());
        open.map(|p| PhotoId(p as u32)).collect()
    }

    /// Takes an adjusted model over.
    pub(crate) fn adopt(&mut self, model: Model, near_px: f64) {
        self.take(model);
        self.look_again(near_px);
    }
}
