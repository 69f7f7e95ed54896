//! Cameras of a walk, one photo more at a time (Snavely, Seitz and Szeliski 2006; Schönberger and
//! Frahm 2016): each registered among the points there are, adjusted with those that see the same,
//! and now and then all together.

use crate::adjust::belief::Beliefs;
use crate::adjust::bundle::{Settings, adjusted};
use crate::adjust::lens::{LensPrior, lens_values};
use crate::adjust::scene::{PointObservation, Scene, Shot, Spot, offs};
use crate::walk::begin::begun;
use crate::walk::groups::Groups;
use crate::walk::next::State;
use crate::walk::points::{places, spots};
use crate::walk::rules::Growth;
use crate::walk::seen::Seen;
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
        let scene = begun(seen, groups, &lenses, rules.near_px)?;
        let mut grown = Grown {
            state: State {
                seen,
                groups,
                rules,
                scene,
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
        let before = grown.state.scene.shots.len();
        grown.grow(usize::MAX);
        grown.adjust_all(2);
        if grown.state.scene.shots.len() == before {
            return Some(grown);
        }
    }
}

impl Grown<'_> {
    /// How much of what the shots show is explained, and how well.
    fn score(&self) -> f64 {
        let sigma = self.state.rules.sigma_px;
        let (scene, seen) = self.with_points(usize::MAX, sigma);
        let one = |off: f64| 1.0 / (1.0 + (off / sigma).powi(2));
        offs(&scene, &seen).into_iter().map(one).sum()
    }

    /// At most so many points, longer tracks first.
    fn chosen(&self, most: usize) -> impl Iterator<Item = &Spot> {
        let spots = &self.state.spots;
        let mut of: Vec<usize> = (0..spots.len()).filter(|t| spots[*t].is_some()).collect();
        if of.len() > most {
            let mixed = |t: usize| (t as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15);
            let long = |t: usize| spots[t].as_ref().map_or(0, |s| s.observations.len().min(8));
            of.sort_by_key(|t| (std::cmp::Reverse(long(*t)), mixed(*t)));
            of.truncate(most);
            of.sort_unstable();
        }
        of.into_iter().filter_map(|t| spots[t].as_ref())
    }

    /// The scene with at most so many points, and what is seen of them.
    pub(crate) fn with_points(&self, most: usize, sigma_px: f64) -> (Scene, Vec<PointObservation>) {
        let mut scene = self.state.scene.clone();
        let seen = scene.filled(self.chosen(most), sigma_px);
        (scene, seen)
    }

    /// Points of all tracks, as the shots there are see them.
    pub(crate) fn look_again(&mut self, near_px: f64) {
        let all: Vec<usize> = (0..self.state.seen.tracks.len()).collect();
        self.state.spots = spots(&self.state.scene, self.state.seen, &all, near_px);
    }

    /// Adjusts all so many times, points looked up anew before each.
    fn adjust_all(&mut self, times: usize) {
        // Two photos know little of a lens, three not much more.
        let tight = if self.state.scene.shots.len() < 3 {
            1e-3
        } else {
            1.0
        };
        for k in (1..=times).rev() {
            self.look_again(self.state.rules.near_px * k as f64);
            let rules = self.state.rules;
            let beliefs = Beliefs {
                lenses: self.priors(tight),
                ..rules.beliefs.clone()
            };
            let how = Settings {
                steps: 12,
                ..rules.how
            };
            let (mut scene, seen) = self.with_points(rules.most, rules.sigma_px);
            adjusted(&mut scene, &seen, &beliefs, &how, None);
            self.take(scene);
        }
        self.look_again(self.state.rules.near_px);
        self.adjusted_shots = self.state.scene.shots.len();
    }

    /// What is believed of lenses; `tight` beliefs are about what they are now.
    fn priors(&self, tight: f64) -> Vec<LensPrior> {
        let one = |(lens, prior): (&Intrinsics, &LensPrior)| match tight < 1.0 {
            true => LensPrior {
                mean: lens_values(lens),
                sigma: prior.sigma.map(|s| s * tight),
            },
            false => *prior,
        };
        let lenses = self.state.scene.lenses.iter();
        let both = lenses.zip(&self.state.rules.beliefs.lenses);
        both.map(one).collect()
    }

    /// Takes lenses and shots over; points are looked up again.
    fn take(&mut self, scene: Scene) {
        self.state.scene = Scene {
            points: vec![],
            ..scene
        };
    }

    /// Adds photos until there are `until`, or none holds on.
    fn grow(&mut self, until: usize) {
        while self.state.scene.shots.len() < until {
            let Some((photo, lens, placed)) = self.state.next() else {
                return;
            };
            if let Some(own) = lens {
                self.state.scene.lenses[self.state.groups.of[photo.0 as usize]] = own;
            }
            self.state.scene.shots.push(Shot {
                photo,
                lens: self.state.groups.of[photo.0 as usize],
                pose: placed.pose,
                zoom: 0.0,
            });
            self.look_around(photo);
            let now = self.state.scene.shots.len();
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
            &self.state.scene,
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
        let last = self.state.scene.shots.len() - 1;
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
        let rules = self.state.rules;
        let near = |s: &&Spot| s.observations.iter().any(|(shot, _)| free[*shot]);
        let near = self.chosen(usize::MAX).filter(near).take(rules.most);
        let mut scene = self.state.scene.clone();
        let seen = scene.filled(near, rules.sigma_px);
        let how = Settings {
            steps: 8,
            ..rules.how
        };
        adjusted(&mut scene, &seen, &rules.beliefs, &how, Some(&free));
        let shots = scene.shots.iter().zip(free);
        let photos: Vec<PhotoId> = shots.filter(|(_, f)| *f).map(|(s, _)| s.photo).collect();
        self.take(scene);
        photos.into_iter().for_each(|photo| self.look_around(photo));
    }

    /// Photos without a camera.
    pub(crate) fn missing(&self) -> Vec<PhotoId> {
        let places = places(&self.state.scene, self.state.seen.by_photo.len());
        let open = (0..places.len()).filter(|p| places[*p].is_none());
        open.map(|p| PhotoId(p as u32)).collect()
    }

    /// Takes an adjusted scene over.
    pub(crate) fn adopt(&mut self, scene: Scene, near_px: f64) {
        self.take(scene);
        self.look_again(near_px);
    }
}
