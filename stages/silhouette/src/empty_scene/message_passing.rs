//! One of a few choices for each pixel of a grid, so that all together cost little.

use std::array::from_fn;

/// Choices of a pixel.
pub(crate) const CHOICES: usize = 4;
/// What each choice costs.
pub(crate) type Costs = [f32; CHOICES];
/// What each choice costs with each of a neighbour's.
pub(crate) type Pairs = [[f32; CHOICES]; CHOICES];

/// Passes to and fro.
const PASSES: usize = 30;

/// Choices on a grid with the costs of each and of neighbours.
pub(crate) struct Field {
    /// Columns.
    pub(crate) width: usize,
    /// Rows.
    pub(crate) height: usize,
    /// What each choice of a pixel costs by itself.
    pub(crate) single: Vec<Costs>,
    /// With that of the pixel right of it.
    pub(crate) right: Vec<Pairs>,
    /// With that of the pixel below.
    pub(crate) down: Vec<Pairs>,
}

impl Field {
    /// The neighbours of a pixel: left, up, right, down.
    fn near(&self, i: usize) -> [Option<usize>; 4] {
        let (w, h) = (self.width, self.height);
        let (x, y) = (i % w, i / w);
        [
            (x > 0).then(|| i - 1),
            (y > 0).then(|| i - w),
            (x + 1 < w).then_some(i + 1),
            (y + 1 < h).then_some(i + w),
        ]
    }

    /// What a pixel's choice and that of its neighbour cost together.
    fn pair(&self, i: usize, side: usize, here: usize, there: usize) -> f32 {
        match side {
            0 => self.right[i - 1][there][here],
            1 => self.down[i - self.width][there][here],
            2 => self.right[i][here][there],
            _ => self.down[i][here][there],
        }
    }

    /// Choices of least cost, nearly: sequential tree-reweighted messages (Kolmogorov 2006).
    pub(crate) fn least(&self) -> Vec<usize> {
        let count = self.width * self.height;
        // The message to a pixel from the neighbour on each side.
        let mut stated: Vec<[Costs; 4]> = vec![[[0.0; CHOICES]; 4]; count];
        for _ in 0..PASSES {
            (0..count).for_each(|i| self.pass(&mut stated, i, [2, 3]));
            (0..count)
                .rev()
                .for_each(|i| self.pass(&mut stated, i, [0, 1]));
        }
        let mut choices = vec![0; count];
        for i in 0..count {
            let near = self.near(i);
            let cost = |c: usize| {
                let before =
                    [0, 1].map(|s| near[s].map_or(0.0, |j| self.pair(i, s, c, choices[j])));
                self.single[i][c] + before[0] + before[1] + stated[i][2][c] + stated[i][3][c]
            };
            let costs: Costs = from_fn(cost);
            choices[i] = (0..CHOICES)
                .min_by(|a, b| costs[*a].total_cmp(&costs[*b]))
                .unwrap_or(0);
        }
        choices
    }

    /// A pixel speaks to its neighbours on two sides.
    fn pass(&self, stated: &mut [[Costs; 4]], i: usize, sides: [usize; 2]) {
        let near = self.near(i);
        let mut sum = self.single[i];
        for reported in &stated[i] {
            (0..CHOICES).for_each(|c| sum[c] += reported[c]);
        }
        let count = |sides: [usize; 2]| sides.iter().filter(|s| near[**s].is_some()).count();
        let share = 1.0 / count([0, 1]).max(count([2, 3])).max(1) as f32;
        for side in sides {
            let Some(j) = near[side] else { continue };
            let back = stated[i][side];
            let own: Costs = from_fn(|c| share * sum[c] - back[c]);
            let mut reported: Costs = from_fn(|there| {
                (0..CHOICES)
                    .map(|here| own[here] + self.pair(i, side, here, there))
                    .fold(f32::MAX, f32::min)
            });
            let least = reported.iter().copied().fold(f32::MAX, f32::min);
            reported.iter_mut().for_each(|t| *t -= least);
            stated[j][(side + 2) % 4] = reported;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_certain_at_two_ends_meets_where_a_change_is_cheap() {
        let (width, height) = (12, 5);
        let same = |cost: f32| from_fn(|a| from_fn(|b| if a == b { 0.0 } else { cost }));
        let mut field = Field {
            width,
            height,
            single: vec![[0.0; CHOICES]; width * height],
            right: vec![same(3.0); width * height],
            down: vec![same(3.0); width * height],
        };
        for y in 0..height {
            field.single[y * width] = [9.0, 0.0, 9.0, 9.0];
            field.single[y * width + 11] = [9.0, 9.0, 9.0, 0.0];
            field.right[y * width + 6] = same(1.0);
        }
        // A lone pixel that would rather be another costs more than it saves.
        field.single[2 * width + 3] = [5.0, 5.0, 0.0, 5.0];
        let choices = field.least();
        let want = |i: usize| if i % width <= 6 { 1 } else { 3 };
        assert_eq!(choices, (0..width * height).map(want).collect::<Vec<_>>());
    }
}
