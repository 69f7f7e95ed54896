//! What all other photos show of each pixel of one: log-odds of the body by how deep its ray passes into the hull of
//! all other photos, or that it misses it.
//!
//! How much that is worth is counted on the capture itself: of all pixels whose rays pass so deep, how many did the cuts of
//! their own photos, made of each alone, call body? A gap that few photos see is shallow in that hull,
//! for its neighbours look into it from both sides; a garment of the wall's colour is deep. A reflection misses it.

use crate::cut::least_cut::Known;
use crate::label::consensus::{Block, DISSENT, Together, View};
use crate::label::squares::Squares;
use crate::likelihood::prepared::Prepared;
use rayon::prelude::*;
use shape::{Cameras, Mask, PhotoId};
use stage::Hash;
use std::collections::BTreeMap;

/// Cells along the greatest side of the block.
const CELLS: f64 = 220.0;
/// Depths that are counted apart, in cells; what is deeper counts as the last. \[cells\]
const DEPTHS: usize = 12;
/// Nearer to the surface than this, within or beyond, cells show nothing: their own size and a coat. \[cells\]
const SURFACE: u8 = 1;

/// Where a ray passes, by class: 0 misses the hull of all other photos though one of them may dissent, 1 is near its surface,
/// from there on by depth.
type Classes = Vec<u8>;

/// What all photos show together of each.
#[derive(Default)]
pub(crate) struct Agreement {
    /// What is certain.
    known: BTreeMap<PhotoId, Vec<Known>>,
    /// Log-odds of the body, by all other photos. \[nats\]
    odds: BTreeMap<PhotoId, Vec<f32>>,
}

impl Agreement {
    /// Nothing for less than six masks, or if they have nothing in common.
    pub(crate) fn of(masks: &[(PhotoId, Mask)], cameras: &Cameras) -> Self {
        let Some(all) = Together::of(masks, cameras) else {
            return Agreement::default();
        };
        Agreement {
            known: all.known(DISSENT),
            odds: by_all_but_one(&all),
        }
    }

    /// Gives a photo its part.
    pub(crate) fn to(&self, id: PhotoId, ready: &mut Prepared) {
        if let Some(known) = self.known.get(&id) {
            ready.agree(known.iter(), &[]);
        }
        ready.add_odds(self.odds(id));
    }

    /// Log-odds of the body at each pixel of a photo; empty where there is nothing. \[nats\]
    pub(crate) fn odds(&self, id: PhotoId) -> &[f32] {
        self.odds.get(&id).map_or(&[], Vec::as_slice)
    }

    /// Of all that a photo gets.
    pub(crate) fn content(&self, id: PhotoId) -> Hash {
        let known = self.known.get(&id).into_iter().flatten();
        let odds = self.odds(id).iter().flat_map(|o| o.to_le_bytes());
        let bytes: Vec<u8> = known.map(|k| *k as u8).chain(odds).collect();
        stage::hash(&bytes)
    }
}

/// Log-odds of the body at each pixel of each photo, by all other photos. \[nats\]
pub(crate) fn by_all_but_one(all: &Together<'_>) -> BTreeMap<PhotoId, Vec<f32>> {
    let block = all.block.finer(CELLS);
    let count: usize = block.count.iter().product();
    let against: Vec<usize> = (0..count)
        .into_par_iter()
        .map(|i| all.against(&block.centre(i)))
        .collect();
    let classes = |view: &View<'_>| classes(view, &block, &against);
    let of: Vec<Classes> = all.views.par_iter().map(classes).collect();
    let mut counts = [[0.5_f64; 2]; DEPTHS + 1];
    for ((_, mask, _), classes) in all.views.iter().zip(&of) {
        for (cover, class) in mask.data.iter().zip(classes) {
            counts[usize::from(*class)][usize::from(*cover > 127)] += 1.0;
        }
    }
    let odds = |class: usize| match class {
        1 => 0.0,
        _ => libm::log(counts[class][1] / counts[class][0]) as f32,
    };
    let odds: Vec<f32> = (0..=DEPTHS).map(odds).collect();
    let views = all.views.iter().zip(of);
    views
        .map(|((id, _, _), of)| (*id, of.iter().map(|c| odds[usize::from(*c)]).collect()))
        .collect()
}

impl Prepared {
    /// Takes what all other photos show as evidence, beside that of a person's sense.
    pub(crate) fn add_odds(&mut self, odds: &[f32]) {
        if odds.is_empty() {
            return;
        }
        self.weighed = true;
        if self.person.is_empty() {
            self.person = vec![0.0; self.cost.len()];
        }
        for (person, odds) in self.person.iter_mut().zip(odds) {
            *person += odds;
        }
    }
}

/// The classes of one photo's pixels. A cell against which one photo more speaks than this one lets pass is none of their
/// hull.
fn classes((_, mask, camera): &View<'_>, block: &Block, against: &[usize]) -> Classes {
    let speaking = |i: usize| {
        if !(1..=DISSENT).contains(&against[i]) {
            return against[i];
        }
        let shown = camera.project(&block.centre(i));
        let own = shown.is_some_and(|px| camera.holds(px) && !mask.shows(px));
        against[i] - usize::from(own)
    };
    let speaking: Vec<usize> = (0..against.len()).map(speaking).collect();
    let most = SURFACE + DEPTHS as u8 - 1;
    let beyond: Vec<bool> = speaking.iter().map(|n| *n > 0).collect();
    let depths = block.steps_to(&beyond, most);
    let loose: Vec<bool> = speaking.iter().map(|n| *n <= 1).collect();
    let coat = block.steps_to(&loose, SURFACE + 1);
    let mut squares = Squares::on(mask.width, mask.height);
    for i in (0..coat.len()).filter(|i| coat[*i] <= SURFACE) {
        let Some((px, depth)) = camera.project_with_depth(&block.centre(i)) else {
            continue;
        };
        let px_of = |size: f64| block.cell * size * camera.lens.focal[0] / depth;
        squares.add(&px, px_of(0.8), 1);
        if depths[i] > SURFACE {
            squares.add(&px, px_of(0.45), depths[i] - SURFACE + 1);
        }
    }
    squares.painted()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::label::see_through_holes::tests::{SIZE, amid, between_legs, turn};
    use crate::likelihood::person::SURE;

    #[test]
    fn a_hole_amid_the_trunk_is_body_by_all_other_photos_and_a_gap_or_a_reflection_is_not() {
        let (mut masks, cameras) = turn(18);
        let gap = between_legs(&masks[0].1);
        let reflected = |i: usize| (30..50).contains(&(i % SIZE.0)) && i / SIZE.0 >= 300;
        for i in 0..SIZE.0 * SIZE.1 {
            if amid(i) {
                masks[0].1.data[i] = 0;
            } else if reflected(i) {
                masks[0].1.data[i] = 255;
            }
        }
        let all = Together::of(&masks, &cameras).expect("a hull");
        let odds = &by_all_but_one(&all)[&PhotoId(0)];
        let share = |of: &dyn Fn(usize) -> bool, such: &dyn Fn(f32) -> bool| {
            let of: Vec<usize> = (0..odds.len()).filter(|i| of(*i)).collect();
            of.iter().filter(|i| such(odds[**i])).count() as f64 / of.len() as f64
        };
        let [hole, open, false_body] = [
            share(&amid, &|o| o > SURE),
            share(&|i| gap.contains(&i), &|o| o <= 0.0),
            share(&reflected, &|o| o < -SURE),
        ];
        assert!(
            hole > 0.9 && open > 0.9 && false_body > 0.9,
            "{hole} {open} {false_body}"
        );
    }
}
