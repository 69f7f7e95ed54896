//! Connected parts of a cut: the body is the largest, and some of its holes are none.
//!
//! Parts are made of runs: pixels of one side beside each other in a row.

use crate::likelihood::background::FLAT;
use crate::likelihood::prepared::Prepared;
use shape::Image;

/// A hole whose median pixel costs the background more than this is no hole.
const EXPLAINED: f32 = FLAT + 1.5;

/// The largest connected part.
fn largest(sides: &Image<bool>) -> Image<bool> {
    let whole = Parts::of(sides, true);
    let best = (0..whole.sizes.len()).max_by_key(|i| (whole.sizes[*i], usize::MAX - i));
    let mut kept = Image::filled(sides.width, sides.height, false);
    let own = whole.runs.iter().filter(|run| Some(run.part) == best);
    own.for_each(|run| kept.data[run.start..run.end].fill(true));
    kept
}

/// The same with those of its holes filled that are small or that the background does not explain: a gap between arm and
/// trunk shows the background to the level, a blue fish on a shirt only something like it. `background` is what a pixel
/// costs as such.
pub(crate) fn filled(sides: &Image<bool>, background: &dyn Fn(usize) -> f32) -> Image<bool> {
    let mut kept = largest(sides);
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
            let explained = middle.is_some_and(|middle| *middle <= EXPLAINED);
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
            Some(_) => largest(sides),
            None => filled(sides, &|i| cost(coarse(i))),
        }
    }
}

/// Pixels of one side beside each other in a row, by their places in the image.
struct Run {
    start: usize,
    end: usize,
    part: usize,
}

/// Connected parts (four neighbours) of the pixels of one side, numbered by their first pixels.
struct Parts {
    runs: Vec<Run>,
    sizes: Vec<usize>,
}

impl Parts {
    fn of(sides: &Image<bool>, of: bool) -> Self {
        let mut runs: Vec<Run> = Vec::new();
        // The run that represents each run's part so far: never a later one.
        let mut heads: Vec<usize> = Vec::new();
        let mut above = 0..0;
        for y in 0..sides.height {
            let first = runs.len();
            let mut over = above.clone();
            for (start, end) in runs_of(sides, y, of) {
                let number = runs.len();
                heads.push(number);
                while over.start < above.end && runs[over.start].end + sides.width <= start {
                    over.start += 1;
                }
                // The last run above that touches this one may touch the next one, too.
                let mut touching = over.start;
                while touching < above.end && runs[touching].start + sides.width < end {
                    joined(&mut heads, touching, number);
                    touching += 1;
                }
                runs.push(Run {
                    start,
                    end,
                    part: 0,
                });
            }
            above = first..runs.len();
        }
        let mut sizes = Vec::new();
        let mut numbers = vec![usize::MAX; runs.len()];
        for (i, run) in runs.iter_mut().enumerate() {
            let head = head(&mut heads, i);
            if head == i {
                numbers[i] = sizes.len();
                sizes.push(0);
            }
            run.part = numbers[head];
            sizes[run.part] += run.end - run.start;
        }
        Parts { runs, sizes }
    }
}

/// The runs of one side in a row.
fn runs_of(sides: &Image<bool>, y: usize, of: bool) -> impl Iterator<Item = (usize, usize)> {
    let (row, at) = (sides.row(y), y * sides.width);
    let mut x = 0;
    std::iter::from_fn(move || {
        x += row[x..].iter().position(|side| *side == of)?;
        let start = x;
        x += row[x..]
            .iter()
            .position(|side| *side != of)
            .unwrap_or(row.len() - x);
        Some((at + start, at + x))
    })
}

/// The first run of the part that a run belongs to.
fn head(heads: &mut [usize], run: usize) -> usize {
    let mut at = run;
    while heads[at] != at {
        heads[at] = heads[heads[at]];
        at = heads[at];
    }
    at
}

/// Two runs are of one part.
fn joined(heads: &mut [usize], a: usize, b: usize) {
    let (a, b) = (head(heads, a), head(heads, b));
    heads[a.max(b)] = a.min(b);
}

/// Connected parts (four neighbours) of the pixels of one side: number of each pixel's part or
/// `u32::MAX`, and sizes.
pub(crate) fn parts(sides: &Image<bool>, of: bool) -> (Image<u32>, Vec<usize>) {
    let Parts { runs, sizes } = Parts::of(sides, of);
    let mut parts = Image::filled(sides.width, sides.height, u32::MAX);
    for run in &runs {
        parts.data[run.start..run.end].fill(run.part as u32);
    }
    (parts, sizes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::likelihood::prepared::prepare;
    use crate::raster::raster;
    use crate::scene::backdrop::Backdrop;
    use shape::Rgb;

    /// The same by setting out from pixel to pixel.
    fn flooded(sides: &Image<bool>, of: bool) -> (Vec<u32>, Vec<usize>) {
        let (mut parts, mut sizes) = (vec![u32::MAX; sides.data.len()], Vec::new());
        for start in 0..sides.data.len() {
            let mut open = vec![start];
            let number = sizes.len() as u32;
            let mut size = 0;
            while let Some(i) = open.pop() {
                if sides.data[i] != of || parts[i] != u32::MAX {
                    continue;
                }
                parts[i] = number;
                size += 1;
                let (x, y) = (i % sides.width, i / sides.width);
                open.extend((x > 0).then(|| i - 1));
                open.extend((x + 1 < sides.width).then(|| i + 1));
                open.extend((y > 0).then(|| i - sides.width));
                open.extend((y + 1 < sides.height).then(|| i + sides.width));
            }
            if size > 0 {
                sizes.push(size);
            }
        }
        (parts, sizes)
    }

    #[test]
    fn parts_of_runs_are_those_that_one_walks_through() {
        let mut dice = proof::Dice(9);
        for (width, height, share) in [(37, 23, 0.6), (50, 40, 0.55), (1, 9, 0.5), (8, 1, 0.5)] {
            let data = (0..width * height).map(|_| dice.within(0.0, 1.0) < share);
            let sides = raster(width, height, data.collect());
            for of in [false, true] {
                let (parts, sizes) = parts(&sides, of);
                assert_eq!((parts.data, sizes), flooded(&sides, of));
            }
        }
    }

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
