//! Which of the levels that recur at a pixel is the background: the one whose photos go over smoothly into
//! those beside.
//!
//! Each choice divides the photos: some show the background at a pixel, the rest the body. Where the choices of two
//! neighbours differ in a photo, the body's outline runs between them there, and that costs, less
//! where the photo has an edge. A plain shirt taken for background breaks off all around in every photo at once.

use crate::empty_scene::message_passing::{CHOICES, Costs, Field, Pairs};
use crate::empty_scene::recurring_levels::{MODES, Modes};
use crate::likelihood::person::Sense;
use rayon::prelude::*;
use shape::Rgb;

/// No photo shows the background.
const NONE: usize = MODES;
/// What an outline costs where the photo has an edge, as a share of what it costs where it has none.
const EDGE: f32 = 0.03;
/// The same where most photos have that edge: it is the background's own, or an outline that does not move.
const STATIC: f32 = 0.25;
/// Squared difference of neighbours, three channels together, that makes an edge. \[levels²\]
const CONTRAST: f32 = 300.0;
/// What it speaks for a level that one more photo shows it, on a photo of [`LONGEST`] pixels: areas grow
/// faster than outlines.
const RECURS: f32 = 0.01;
const LONGEST: f32 = 600.0;
/// What speaks for it besides where the patch has texture, which a body shows again only by chance. Most
/// photos need none, and may show an outline or a hem that never moves: it is for so large a share of them.
const TEXTURED: f32 = 0.03;
const FEW: f32 = 0.34;
/// Squared contrast of such patches. \[levels²\]
const ROUGH: f32 = 200.0;
/// What cannot be (structural).
const NEVER: f32 = 1e5;
/// So near to a photo's border, as a share of its height, what so large a share of the photos shows is background.
const MARGIN: f64 = 0.01;
const MOST: f64 = 0.85;

/// Of each pixel the mode that is the background, if any is.
///
/// `people` are log-odds of the body by a person's sense, photo by photo, or nothing \[nats\]; an outline, which costs 1
/// here, costs `gamma` there.
pub(crate) fn chosen(
    modes: &Modes,
    photos: &[Rgb],
    people: &[Sense],
    gamma: f32,
) -> Vec<Option<usize>> {
    let (width, count) = (modes.width, modes.width * modes.height);
    let weight =
        |far: usize| EDGE + (1.0 - EDGE) * libm::expf(-(far as f32) * STEP as f32 / CONTRAST);
    let weights: Vec<f32> = (0..2048).map(weight).collect();
    let beside = |step: usize, there: &(dyn Fn(usize) -> bool + Sync)| -> Vec<Pairs> {
        let one = |i: usize| match there(i) {
            true => {
                let outline = Outline::new(photos, &weights, [i, i + step]);
                seam(modes, &|k| outline.cost(k), [i, i + step])
            }
            false => [[0.0; CHOICES]; CHOICES],
        };
        (0..count).into_par_iter().map(one).collect()
    };
    let field = Field {
        width,
        height: modes.height,
        single: (0..count)
            .into_par_iter()
            .map(|i| {
                let mut costs = alone(modes, i);
                with_people(modes, i, people, gamma, &mut costs);
                costs
            })
            .collect(),
        right: beside(1, &|i| i % width + 1 < width),
        down: beside(width, &|i| i + width < count),
    };
    let choices = field.least().into_iter();
    choices.map(|c| (c != NONE).then_some(c)).collect()
}

/// What each choice of a pixel costs by itself.
fn alone(modes: &Modes, i: usize) -> Costs {
    let (w, h) = (modes.width, modes.height);
    let (x, y) = (i % w, i / w);
    let margin = ((h as f64 * MARGIN) as usize).max(2);
    let rim = x < margin || y < margin || x + margin >= w || y + margin >= h;
    let [recurs, textured] = [RECURS, TEXTURED].map(|v| v * LONGEST / w.max(h) as f32);
    let mut costs = [0.0; CHOICES];
    for (mode, cost) in costs.iter_mut().enumerate().take(MODES) {
        *cost = match modes.count(i, mode) {
            0 => NEVER,
            count => {
                let few = count as f32 <= FEW * modes.photos as f32;
                let rough = (modes.rough[i][mode] / ROUGH).min(1.0);
                let texture = if few { textured * rough } else { 0.0 };
                -(recurs + texture) * (count - 1) as f32
            }
        };
    }
    if rim && f64::from(modes.count(i, 0)) >= MOST * modes.photos as f64 {
        costs[1..].fill(NEVER);
    }
    costs
}

/// Adds to each choice what speaks against it: people on photos that it takes for background, nobody on those that
/// it takes for the body.
fn with_people(modes: &Modes, i: usize, people: &[Sense], gamma: f32, costs: &mut Costs) {
    let odds = |k: usize| {
        people
            .get(k)
            .and_then(|p| p.log_odds.get(i))
            .map_or(0.0, |o| *o)
    };
    let nobody: f32 = (0..people.len()).map(|k| (-odds(k)).max(0.0)).sum();
    for (choice, cost) in costs.iter_mut().enumerate() {
        // As if all showed the body, then photo by photo those that show the background.
        let mut against = nobody;
        if choice != NONE {
            for (word, shows) in modes.sets(i, choice).0.iter().enumerate() {
                let mut shows = *shows;
                while shows != 0 {
                    against += odds(word * 64 + shows.trailing_zeros() as usize);
                    shows &= shows - 1;
                }
            }
        }
        *cost += against / gamma.max(1.0);
    }
}

/// Squared differences that share a weight (structural). \[levels²\]
const STEP: usize = 4;

/// What an outline between two neighbours costs in a photo.
struct Outline<'a> {
    photos: &'a [Rgb],
    weights: &'a [f32],
    between: [usize; 2],
    /// By how much the neighbours differ in the middle one of the photos.
    usual: [i32; 3],
}

impl<'a> Outline<'a> {
    fn new(photos: &'a [Rgb], weights: &'a [f32], between: [usize; 2]) -> Self {
        let mut outline = Outline {
            photos,
            weights,
            between,
            usual: [0; 3],
        };
        // On the stack, so that no pixel allocates.
        let mut values = [0; 256];
        let some = photos.len().min(values.len());
        for c in 0..3 {
            let differ = |k| outline.differ(k, c);
            (0..some).for_each(|k| values[k] = differ(k));
            let middle = values[..some].select_nth_unstable(some / 2).1;
            outline.usual[c] = *middle;
        }
        outline
    }

    fn differ(&self, k: usize, c: usize) -> i32 {
        let at = |i: usize| i32::from(self.photos[k].data[i][c]);
        at(self.between[0]) - at(self.between[1])
    }

    fn cost(&self, k: usize) -> f32 {
        let weight = |by: &dyn Fn(usize) -> i32| {
            let far: i32 = (0..3).map(|c| by(c) * by(c)).sum();
            self.weights[(far as usize / STEP).min(self.weights.len() - 1)]
        };
        let moves = weight(&|c| self.differ(k, c) - self.usual[c]);
        moves.min(weight(&|c| self.differ(k, c)).max(STATIC))
    }
}

/// What the choices of two neighbours cost together: the outlines that run between them.
fn seam(modes: &Modes, outline: &dyn Fn(usize) -> f32, [i, j]: [usize; 2]) -> Pairs {
    let mut pairs = [[0.0; CHOICES]; CHOICES];
    for word in 0..modes.words {
        let left = modes.photos - word * 64;
        let all = if left < 64 { (1 << left) - 1 } else { u64::MAX };
        let sets = |pixel: usize, choice: usize| {
            if choice == NONE {
                return (0, all);
            }
            let (shows, rest) = modes.sets(pixel, choice);
            (shows[word], rest[word])
        };
        // Weights of photos, once they are asked for.
        let mut known = [f32::NAN; 64];
        for (a, row) in pairs.iter_mut().enumerate() {
            let (shows, rest) = sets(i, a);
            for (b, cost) in row.iter_mut().enumerate() {
                let (shows_too, rest_too) = sets(j, b);
                let mut differ = shows & rest_too | rest & shows_too;
                while differ != 0 {
                    let k = differ.trailing_zeros() as usize;
                    if known[k].is_nan() {
                        known[k] = outline(word * 64 + k);
                    }
                    *cost += known[k];
                    differ &= differ - 1;
                }
            }
        }
    }
    pairs
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::empty_scene::recurring::recurring;

    /// A body that swings to and fro before a wall and whose middle covers it always; its shade changes, but
    /// its chest is too bright to show any: the wall, the photos, and how many of them show the wall at
    /// each column where the body is.
    fn turn() -> (Rgb, Vec<Rgb>, Vec<usize>) {
        let mut dice = proof::Dice(9);
        let mut wall = Rgb::filled(160, 220, [0; 3]);
        for (i, p) in wall.data.iter_mut().enumerate() {
            // One side plain, one of bricks.
            let brick = ((i / 160 / 5 + i % 160 / 8) % 3) as f64;
            let spot = if i % 160 < 75 { 25.0 * brick } else { 0.0 };
            *p = [90.0, 110.0, 120.0].map(|v| (v + spot) as u8);
        }
        let lefts = [52, 56, 60, 64, 68, 70, 70, 68, 64, 60, 56, 52];
        let body = |left: usize, x: usize| (left..left + 40).contains(&x);
        let photo = |(k, left): (usize, &usize)| {
            let mut photo = wall.clone();
            let shade = 24.0 * libm::sin(k as f64 * 2.2);
            for (i, p) in photo.data.iter_mut().enumerate() {
                let shown = match (body(*left, i % 160), i / 160) {
                    (true, 85..110) => [255.0; 3],
                    (true, 30..200) => [200.0, 170.0, 150.0].map(|v| v + shade),
                    _ => p.map(f64::from),
                };
                *p = shown.map(|v| (v + dice.within(-1.0, 1.0)).round() as u8);
            }
            photo
        };
        let photos = lefts.iter().enumerate().map(photo).collect();
        let free = |x: usize| lefts.iter().filter(|l| !body(**l, x)).count();
        (wall.clone(), photos, (0..160).map(free).collect())
    }

    #[test]
    fn a_plain_body_that_most_photos_show_alike_is_no_background_and_the_wall_that_few_show_is() {
        let (wall, photos, free) = turn();
        let modes = Modes::of(&photos);
        let backdrop = modes.backdrop(&chosen(&modes, &photos, &[], 40.0));
        let shows_wall = |backdrop: &crate::Backdrop, x: usize| {
            let off = |c: usize| backdrop.image.at(x, 97)[c].abs_diff(wall.at(x, 97)[c]);
            backdrop.seen.at(x, 97) && (0..3).all(|c| off(c) <= 3)
        };
        let wrong: Vec<usize> = (0..160)
            .filter(|x| match free[*x] {
                0 => backdrop.seen.at(*x, 97),
                1 => false,
                _ => !shows_wall(&backdrop, *x),
            })
            .collect();
        assert!(wrong.is_empty(), "{wrong:?}");
        // By photos that agree alone the body was taken.
        let agreed = recurring(&photos, None, 1.0).backdrop;
        let taken = (0..160).filter(|x| agreed.seen.at(*x, 97) && !shows_wall(&agreed, *x));
        assert!(taken.count() > 20);
    }
}
