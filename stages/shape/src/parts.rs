//! Connected parts of a picture of two sides, made of runs: pixels of one side beside each other in a row.

use crate::{Image, join, root};

/// Pixels of one side beside each other in a row, by their places in the image.
pub struct Run {
    /// Place of its first pixel.
    pub start: usize,
    /// Place after its last one.
    pub end: usize,
    /// Number of its part.
    pub part: usize,
}

/// Connected parts (four neighbours) of the pixels of one side, numbered by their first pixels.
pub struct Parts {
    /// Row by row.
    pub runs: Vec<Run>,
    /// How many pixels each part has.
    pub sizes: Vec<usize>,
}

impl Parts {
    /// The parts of the pixels that are `of`.
    pub fn of(sides: &Image<bool>, of: bool) -> Self {
        let mut runs: Vec<Run> = Vec::new();
        // The run that represents each run's part so far: never a later one.
        let mut heads: Vec<u32> = Vec::new();
        let mut above = 0..0;
        for y in 0..sides.height {
            let first = runs.len();
            let mut over = above.clone();
            for (start, end) in runs_of(sides, y, of) {
                heads.push(runs.len() as u32);
                while over.start < above.end && runs[over.start].end + sides.width <= start {
                    over.start += 1;
                }
                // The last run above that touches this one may touch the next one, too.
                let mut touching = over.start;
                while touching < above.end && runs[touching].start + sides.width < end {
                    join(&mut heads, touching as u32, runs.len() as u32);
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
            let head = root(&mut heads, i as u32) as usize;
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

/// Connected parts (four neighbours) of the pixels of one side: number of each pixel's part or
/// `u32::MAX`, and sizes.
pub fn parts(sides: &Image<bool>, of: bool) -> (Image<u32>, Vec<usize>) {
    let Parts { runs, sizes } = Parts::of(sides, of);
    let mut parts = Image::filled(sides.width, sides.height, u32::MAX);
    for run in &runs {
        parts.data[run.start..run.end].fill(run.part as u32);
    }
    (parts, sizes)
}

/// The largest connected part of what is true; of equal ones the first.
pub fn largest_part(sides: &Image<bool>) -> Image<bool> {
    let whole = Parts::of(sides, true);
    let best = (0..whole.sizes.len()).max_by_key(|i| (whole.sizes[*i], usize::MAX - i));
    let mut kept = Image::filled(sides.width, sides.height, false);
    let own = whole.runs.iter().filter(|run| Some(run.part) == best);
    own.for_each(|run| kept.data[run.start..run.end].fill(true));
    kept
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

#[cfg(test)]
mod tests {
    use super::*;

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
            let sides = Image {
                width,
                height,
                data: data.collect(),
            };
            for of in [false, true] {
                let (parts, sizes) = parts(&sides, of);
                assert_eq!((parts.data, sizes), flooded(&sides, of));
            }
        }
    }
}
