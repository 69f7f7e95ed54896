//! The body of a cut is its largest connected part, and some of its holes are none.

use crate::likelihood::background::FLAT;
use crate::likelihood::prepared::Prepared;
use shape::{Image, Parts, largest_part};

/// A hole whose median pixel costs the background more than this is no hole: what noise of three channels adds on the
/// mean (derived: 3/2). \[nats\]
const EXPLAINED_NATS: f32 = FLAT + 1.5;

/// The largest connected part with those of its holes filled that are small or that the background does not explain: a gap between arm and
/// trunk shows the background to the level, a blue fish on a shirt only something like it. `background` is what a pixel
/// costs as such.
pub(crate) fn filled(sides: &Image<bool>, background: &dyn Fn(usize) -> f32) -> Image<bool> {
    let mut kept = largest_part(sides);
    let size = kept.data.iter().filter(|body| **body).count();
    let (least, most) = (size / 2000, size / 10);
    let holes = Parts::of(&kept, false);
    let mut costs: Vec<Vec<f32>> = vec![vec![]; holes.sizes.len()];
    for run in holes
        .runs
        .iter()
        .filter(|run| holes.sizes[run.part] <= most)
    {
        costs[run.part].extend((run.start..run.end).map(background));
    }
    let fill: Vec<bool> = costs
        .iter_mut()
        .zip(&holes.sizes)
        .map(|(costs, size)| {
            costs.sort_by(f32::total_cmp);
            let middle = costs.get(costs.len() / 2);
            let explained = middle.is_some_and(|middle| *middle <= EXPLAINED_NATS);
            *size <= most && !(*size >= least && explained)
        })
        .collect();
    let filled = holes.runs.iter().filter(|run| fill[run.part]);
    filled.for_each(|run| kept.data[run.start..run.end].fill(true));
    kept
}

impl Prepared {
    /// The body of a cut: its largest part. Once all other photos are weighed in, a hole needs no rule of its own, however
    /// small; `coarse` is the reduced pixel of a pixel.
    pub(crate) fn body_of(
        &self,
        sides: &Image<bool>,
        coarse: &dyn Fn(usize) -> usize,
    ) -> Image<bool> {
        let cost = |i: usize| {
            let person = self.person.get(i).map_or(0.0, |p| p.max(0.0));
            self.cost[i] + person
        };
        match self.unforeseen {
            Some(_) => largest_part(sides),
            None => filled(sides, &|i| cost(coarse(i))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::likelihood::prepared::prepare;
    use crate::raster::raster;
    use crate::scene::backdrop::Backdrop;
    use shape::Rgb;

    #[test]
    fn a_small_hole_that_a_photo_shows_stays_once_all_photos_are_weighed_in() {
        let hole = |i: usize| (40..43).contains(&(i % 100)) && i / 100 == 50;
        let photo = Rgb::filled(100, 100, [90; 3]);
        let mut ready = prepare(&photo, &Backdrop::whole(photo.clone()), None, 100, 0.0);
        let sides = raster(100, 100, (0..10_000).map(|i| !hole(i)).collect());
        let open = |ready: &Prepared| {
            let body = ready.body_of(&sides, &|i| i);
            body.data.iter().filter(|body| !**body).count()
        };
        assert_eq!(open(&ready), 0);
        ready.unforeseen = Some(20.0);
        assert_eq!(open(&ready), 3);
    }
}
