//! What all other photos show of each pixel of one: log-odds of the body by how deep its ray passes into the hull of
//! all other photos, or how far beside it.
//!
//! How much that is worth is counted on the capture itself: of all pixels whose rays pass so, how many did the cuts of
//! their own photos, made of each alone, call body? A garment of the wall's colour is deep in that hull. A thumb that the
//! other photos lost is just beside it, a reflection farther off.
//!
//! A gap between the legs is one event, and few photos can see it: those from the sides look through the legs, so that their
//! body is no evidence against it. The photo from the other side can. Where it shows background within the hull of all
//! other photos, either it lost a piece, or both look through a gap: such pixels are classes of their own.
//!
//! And how much a photo may contradict the rest is counted, too: how often it shows, where all of them are sure of the
//! background, what its scene did not foresee.

use crate::cells::Block;
use crate::consensus::{DISSENT, Together, View};
use crate::cut::least_cut::Known;
use crate::label::squares::Squares;
use crate::likelihood::body::{ANY_COLOR, EVIDENT};
use crate::likelihood::person::SURE;
use crate::likelihood::prepared::Prepared;
use crate::raster::raster;
use rayon::prelude::*;
use shape::{Cameras, Mask, PhotoId, signed_distance};
use stage::Hash;
use std::collections::BTreeMap;

/// Depths that are counted apart, and distances beside the hull, in cells; what is deeper or farther counts as the
/// last. By hand: looked at three scenes (158 with a plate, 160 and 170 without), at 0.7 and 1.4 of it: mean IoU ±0.0000. \[cells\]
const DEPTH_CLASSES: usize = 12;
/// Nearer to the surface than this, within or beyond, cells show nothing: their own size and a coat. By hand: looked at
/// scene 131 with a plate, at 0 and 2: mean IoU −0.0000 and +0.0000. \[cells\]
const SURFACE_CELLS: u8 = 1;
/// The class of what passes near the surface. Below it are those beside the hull, above it those within, and above these
/// those within of which the photo from the other side shows background.
const NEAR: usize = DEPTH_CLASSES;

/// What all photos show together of each.
#[derive(Default)]
pub(crate) struct Agreement {
    /// Log-odds of the body, by all other photos. \[nats\]
    odds: BTreeMap<PhotoId, Vec<f32>>,
}

impl Agreement {
    /// Nothing for less than six masks, or if they have nothing in common.
    pub(crate) fn of(masks: &[(PhotoId, Mask)], cameras: &Cameras) -> Self {
        let all = Together::of(masks, cameras);
        Agreement {
            odds: all.as_ref().map(by_all_but_one).unwrap_or_default(),
        }
    }

    /// Log-odds of the body at each pixel of a photo; empty where there is nothing. \[nats\]
    pub(crate) fn odds(&self, id: PhotoId) -> &[f32] {
        self.odds.get(&id).map_or(&[], Vec::as_slice)
    }

    /// Of all that a photo gets.
    pub(crate) fn content(&self, id: PhotoId) -> Hash {
        let odds = self.odds(id).iter().flat_map(|o| o.to_le_bytes());
        stage::hash(&odds.collect::<Vec<u8>>())
    }
}

/// Log-odds of the body at each pixel of each photo, by all other photos. \[nats\]
fn by_all_but_one(all: &Together<'_>) -> BTreeMap<PhotoId, Vec<f32>> {
    let views = &all.views;
    let classes = |view: &View<'_>| classes(view, all);
    let of: Vec<Vec<usize>> = views.par_iter().map(classes).collect();
    let mut counts = [[0.5_f64; 2]; NEAR + 2 * DEPTH_CLASSES];
    for ((_, mask, _), classes) in views.iter().zip(&of) {
        for (cover, class) in mask.data.iter().zip(classes) {
            counts[*class][usize::from(*cover > 127)] += 1.0;
        }
    }
    let odds = |class: usize| match class {
        NEAR => 0.0,
        _ => libm::log(counts[class][1] / counts[class][0]) as f32,
    };
    let odds: Vec<f32> = (0..counts.len()).map(odds).collect();
    let both = views.iter().zip(of);
    both.map(|((id, _, _), of)| (*id, of.into_iter().map(|class| odds[class]).collect()))
        .collect()
}

impl Prepared {
    /// Takes what all other photos show as evidence, beside that of a person's sense.
    pub(crate) fn add_odds(&mut self, odds: &[f32]) {
        if odds.is_empty() {
            return;
        }
        self.unforeseen = Some(self.unforeseen_by(odds));
        if self.person.is_empty() {
            self.person = vec![0.0; self.cost.len()];
        }
        for (person, odds) in self.person.iter_mut().zip(odds) {
            *person += odds;
        }
    }

    /// -ln p(pixel | background, but not as any scene foresees it), such as a reflection of the body: any colour, as often as this
    /// photo shows such where all other photos are sure of the background. \[nats\]
    fn unforeseen_by(&self, odds: &[f32]) -> f32 {
        let open = |i: &usize| self.known[*i] == Known::Unknown && odds[*i] < -SURE;
        let (mut all, mut unforeseen) = (1.0, 0.5);
        for i in (0..odds.len()).filter(open) {
            all += 1.0;
            unforeseen += f64::from(u8::from(self.cost[i] > EVIDENT));
        }
        (ANY_COLOR - libm::log(unforeseen / all)) as f32
    }
}

/// The class of each of one photo's pixels.
fn classes(view: &View<'_>, all: &Together<'_>) -> Vec<usize> {
    let (_, mask, camera) = view;
    let passes = passes(view, opposite(view, &all.views), &all.block, &all.against);
    let hull = raster(
        mask.width,
        mask.height,
        passes
            .iter()
            .map(|p| if *p > 0 { 255 } else { 0 })
            .collect(),
    );
    let middle = camera.project_with_depth(&all.block.centre(all.against.len() / 2));
    let away = middle.map_or(f64::MAX, |(_, depth)| depth);
    let cell_px = all.block.cell * camera.lens.focal[0] / away;
    let class = |(pass, inward): (&u8, &f32)| match pass {
        0 => NEAR - 1 - ((f64::from(-inward) / cell_px) as usize).min(DEPTH_CLASSES - 1),
        pass => NEAR - 1 + usize::from(*pass),
    };
    let inward = signed_distance(&hull).data;
    passes.iter().zip(&inward).map(class).collect()
}

/// The photo from the other side: of all photos the one that was taken most nearly against the direction of this one.
fn opposite<'a, 'b>(view: &View<'b>, all: &'a [View<'b>]) -> &'a View<'b> {
    let from = |view: &View<'_>| view.2.centre().coords.xy().normalize();
    let here = from(view);
    let along = |other: &View<'_>| from(other).dot(&here);
    let farther = |best: &'a View<'b>, other: &'a View<'b>| match along(other) < along(best) {
        true => other,
        false => best,
    };
    all.iter().fold(&all[0], farther)
}

/// Where the ray of each of one photo's pixels passes: 0 misses the hull of all other photos though one of them may
/// dissent, 1 is near its surface, from there on in cells of depth, and beyond [`DEPTH_CLASSES`] in cells of depth in what all but
/// the photo from the other side leave. A cell against which one photo more speaks than this one lets pass is none of their
/// hull.
fn passes(view: &View<'_>, other_side: &View<'_>, block: &Block, against: &[u8]) -> Vec<u8> {
    let (_, mask, camera) = view;
    let open = |(_, mask, camera): &View<'_>, i: usize| {
        mask.shows_point(camera, &block.centre(i)) == Some(false)
    };
    let speaking = |i: usize| match against[i] {
        count @ 1..=DISSENT => count - u8::from(open(view, i)),
        count => count,
    };
    let speaking: Vec<u8> = (0..against.len()).map(speaking).collect();
    let alone = |i: usize| speaking[i] == 1 && open(other_side, i);
    let alone: Vec<bool> = (0..against.len()).map(alone).collect();
    let most = SURFACE_CELLS + DEPTH_CLASSES as u8 - 1;
    let depths_of = |lets: &dyn Fn(usize) -> bool| {
        let beyond: Vec<bool> = (0..speaking.len())
            .map(|i| speaking[i] > 0 && !lets(i))
            .collect();
        block.steps_to(&beyond, most)
    };
    let (depths, without) = (depths_of(&|_| false), depths_of(&|i| alone[i]));
    let loose: Vec<bool> = speaking.iter().map(|n| *n <= 1).collect();
    let coat = block.steps_to(&loose, SURFACE_CELLS + 1);
    let mut squares = Squares::on(mask.width, mask.height);
    for i in (0..coat.len()).filter(|i| coat[*i] <= SURFACE_CELLS) {
        let Some((px, depth)) = camera.project_with_depth(&block.centre(i)) else {
            continue;
        };
        let px_of = |size: f64| block.cell * size * camera.lens.focal[0] / depth;
        squares.add(&px, px_of(0.8), 1);
        if depths[i] > SURFACE_CELLS {
            squares.add(&px, px_of(0.45), depths[i] - SURFACE_CELLS + 1);
        }
        if alone[i] && without[i] > SURFACE_CELLS {
            squares.add(
                &px,
                px_of(0.45),
                DEPTH_CLASSES as u8 + without[i] - SURFACE_CELLS,
            );
        }
    }
    squares.painted()
}

#[cfg(test)]
mod tests;
