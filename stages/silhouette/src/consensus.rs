//! The cells around the body, and how many photos show each of them as background.

use crate::cells::Block;
use nalgebra::Point3;
use rayon::prelude::*;
use shape::{Camera, Cameras, Mask, PhotoId};

/// Most cells along the greatest side of the block that is carved. By hand: looked at scene 131 with a plate, its photos
/// half as large, at 77 and 154: mean IoU −0.0000.
const MAX_CELLS_ALONG: f64 = 210.0;
/// Least edge of a cell on the masks (structural: a smaller one shows no more than pixels do). \[px\]
const MIN_CELL_PX: f64 = 2.0;
/// Photos that may dissent: one is the photo in question, one more may be wrong. By hand:
/// looked at three scenes (158 with a plate, 160 and 170 without), at 1 and 3: mean IoU −0.0001 and +0.0000 at most.
pub(crate) const DISSENT: u8 = 2;
/// Cells around all that is shown (structural).
const MARGIN: f64 = 4.0;

impl Block {
    /// How many steps (six ways) each cell is from the nearest that is so, `most` at most.
    pub(crate) fn steps_to(&self, such: &[bool], most: u8) -> Vec<u8> {
        let [nx, ny, nz] = self.count;
        let rows = ny * nz;
        let mut steps: Vec<u8> = such.iter().map(|s| if *s { 0 } else { most }).collect();
        let mut beside = vec![0; nx];
        // Onward, then back: by the rows beside that were gone through, then along the row.
        for row in 0..rows {
            let (before, here) = steps.split_at_mut(row * nx);
            let here = &mut here[..nx];
            if row % ny > 0 {
                nearer(here, &before[(row - 1) * nx..]);
            }
            if row >= ny {
                nearer(here, &before[(row - ny) * nx..]);
            }
            onward(here, most, &mut beside);
        }
        for row in (0..rows).rev() {
            let (here, beyond) = steps.split_at_mut((row + 1) * nx);
            let here = &mut here[row * nx..];
            if row % ny + 1 < ny {
                nearer(here, beyond);
            }
            if row + ny < rows {
                nearer(here, &beyond[(ny - 1) * nx..]);
            }
            back(here, most, &mut beside);
        }
        steps
    }
}

/// A step more than beside, where that is nearer.
fn nearer(here: &mut [u8], beside: &[u8]) {
    let both = here.iter_mut().zip(beside);
    both.for_each(|(here, beside)| *here = (*here).min(beside.saturating_add(1)));
}

/// The same from each of a row to all that follow: by one step, two, four and so on, many places at once.
fn onward(row: &mut [u8], most: u8, copy: &mut [u8]) {
    for by in doubled(most, row.len()) {
        copy.copy_from_slice(row);
        let both = row[by..].iter_mut().zip(&*copy);
        both.for_each(|(here, there)| *here = (*here).min(there.saturating_add(by as u8)));
    }
}

/// The same from each to all before it.
fn back(row: &mut [u8], most: u8, copy: &mut [u8]) {
    for by in doubled(most, row.len()) {
        copy.copy_from_slice(row);
        let both = row.iter_mut().zip(&copy[by..]);
        both.for_each(|(here, there)| *here = (*here).min(there.saturating_add(by as u8)));
    }
}

/// One, two, four and so on, whose sum reaches as far as steps count, within a row of so many.
fn doubled(most: u8, row: usize) -> impl Iterator<Item = usize> {
    (0..8)
        .map(|k| 1 << k)
        .take_while(move |by| *by <= usize::from(most) && *by < row)
}

/// A mask with its photo and the camera at its size.
pub(crate) type View<'a> = (PhotoId, &'a Mask, Camera);

/// A block around the body, with how many masks have each cell outside.
pub(crate) struct Together<'a> {
    pub(crate) views: Vec<View<'a>>,
    pub(crate) block: Block,
    /// Masks that dissent, [`DISSENT`] + 1 at most.
    pub(crate) against: Vec<u8>,
}

impl<'a> Together<'a> {
    /// `None` for less than six masks, or if they have nothing in common.
    pub(crate) fn of(masks: &'a [(PhotoId, Mask)], cameras: &Cameras) -> Option<Self> {
        let one = |(id, mask): &'a (PhotoId, Mask)| {
            let view = cameras.views.get(*id)?;
            let (width, height) = (mask.width as u32, mask.height as u32);
            Some((*id, mask, view.camera.resized(width, height)))
        };
        let views: Vec<View<'a>> = masks.iter().filter_map(one).collect();
        if views.len() < 6 {
            return None;
        }
        let block = block(&views, cameras.ground_mm)?;
        let cells = (0..block.len()).into_par_iter();
        let one = |order: &mut Vec<usize>, i: usize| against(&views, order, &block.centre(i));
        let against = cells.map_init(|| (0..views.len()).collect(), one).collect();
        Some(Together {
            views,
            block,
            against,
        })
    }
}

/// How many masks have a point outside, [`DISSENT`] + 1 at most; so many, too, where fewer than half of the photos see it.
/// It does not depend on the order, but time does: those that dissent are asked first of the next point.
fn against(views: &[View<'_>], order: &mut [usize], x: &Point3<f64>) -> u8 {
    let (mut seen, mut against) = (0, 0);
    for k in 0..order.len() {
        let (_, mask, camera) = &views[order[k]];
        let Some(body) = mask.shows_point(camera, x) else {
            continue;
        };
        seen += 1;
        if !body {
            order.swap(usize::from(against), k);
            against += 1;
        }
        if against > DISSENT {
            break;
        }
    }
    match against <= DISSENT && seen * 2 < views.len() {
        true => DISSENT + 1,
        false => against,
    }
}

/// Steps from the axis to the side by which the subject is looked for (structural: it is twenty steps wide).
const STEPS_ASIDE: usize = 40;
/// And up from the ground (structural: as wide ones).
const STEPS_UP: usize = 120;

/// The block around all that is shown.
fn block(views: &[View<'_>], ground: f64) -> Option<Block> {
    let away = views
        .iter()
        .map(|(_, _, c)| c.centre())
        .map(|c| libm::hypot(c.x, c.y));
    let reach = away.fold(f64::MAX, f64::min) * 0.8;
    let step = reach / STEPS_ASIDE as f64;
    let aside = |n: usize| (n as f64 - STEPS_ASIDE as f64) * step;
    let wide = 2 * STEPS_ASIDE + 1;
    let shown = |order: &mut Vec<usize>, i: usize| {
        let [x, y] = [i % wide, i / wide % wide].map(aside);
        let up = ground + ((i / wide / wide) as f64 + 0.5) * step;
        let x = Point3::new(x, y, up);
        (libm::hypot(x.x, x.y) < reach && against(views, order, &x) <= DISSENT).then_some(x)
    };
    let all = (0..wide * wide * STEPS_UP).into_par_iter();
    let (mut lo, mut hi) = ([f64::MAX; 3], [f64::MIN; 3]);
    let all = all.map_init(|| (0..views.len()).collect(), shown);
    for x in all.flatten().collect::<Vec<_>>() {
        (0..3).for_each(|a| (lo[a], hi[a]) = (lo[a].min(x[a] - step), hi[a].max(x[a] + step)));
    }
    if lo[0] > hi[0] {
        return None;
    }
    lo[2] = lo[2].max(ground);
    let least = (0..3).map(|a| hi[a] - lo[a]).fold(0.0, f64::max) / MAX_CELLS_ALONG;
    let middle = Point3::from([0, 1, 2].map(|a| (lo[a] + hi[a]) / 2.0));
    let pixel = |(_, _, camera): &View<'_>| {
        let seen = camera.project_with_depth(&middle);
        seen.map_or(f64::MAX, |(_, depth)| depth / camera.lens.focal[0])
    };
    let cell = least.max(MIN_CELL_PX * views.iter().map(pixel).fold(f64::MAX, f64::min));
    let margin = cell * MARGIN;
    let count = [0, 1, 2].map(|a| ((hi[a] - lo[a] + 2.0 * margin) / cell) as usize + 1);
    // The lowest cells are cut through by the ground.
    let half = cell / 2.0;
    Some(Block {
        corner: Point3::new(lo[0] - margin - half, lo[1] - margin - half, lo[2] - half),
        cell,
        count,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proof::Dice;

    #[test]
    fn steps_are_those_of_the_nearest_cell_along_the_axes() {
        let mut dice = Dice(3);
        for (count, most) in [
            ([9, 7, 8], 12),
            ([23, 2, 3], 13),
            ([1, 1, 9], 2),
            ([4, 5, 1], 1),
        ] {
            let block = Block {
                corner: Point3::origin(),
                cell: 1.0,
                count,
            };
            let such: Vec<bool> = (0..block.len()).map(|_| dice.unit() < 0.03).collect();
            let way = |i: usize, j: usize| {
                let (a, b) = (block.at(i), block.at(j));
                (0..3).map(|k| a[k].abs_diff(b[k])).sum::<usize>()
            };
            let nearest = |i: usize| {
                let ways = (0..such.len()).filter(|j| such[*j]).map(|j| way(i, j));
                ways.min().map_or(most, |n| n.min(usize::from(most)) as u8)
            };
            let want: Vec<u8> = (0..such.len()).map(nearest).collect();
            assert_eq!(block.steps_to(&such, most), want, "{count:?} {most}");
        }
    }
}
