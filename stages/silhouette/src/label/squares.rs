//! Many squares painted on one image, of which each pixel keeps the greatest.
//!
//! Cells of a block show as squares of a few sizes, hundreds of thousands of them, which overlap. All of one size are
//! marked by their middles and grown together, along rows and then along columns.

use nalgebra::Point2;
use std::collections::BTreeMap;

/// Squares around pixels of an image, by how far they reach to each side.
pub(crate) struct Squares {
    width: usize,
    height: usize,
    by_reach: BTreeMap<usize, Vec<Square>>,
}

/// The middle of a square, in pixels beyond the first that may show some of it, and what it paints.
type Square = (u32, u32, u8);

impl Squares {
    /// None yet.
    pub(crate) fn on(width: usize, height: usize) -> Self {
        Squares {
            width,
            height,
            by_reach: BTreeMap::new(),
        }
    }

    /// A square around the pixel at a place, half as wide as so many pixels, rounded up.
    pub(crate) fn add(&mut self, at: &Point2<f64>, half_px: f64, value: u8) {
        let reach = (half_px.ceil() as i64).clamp(0, 1 << 30);
        let place = |v: f64, count: usize| {
            let beyond = (v.round() as i64).saturating_add(reach);
            let shows = (0..(count as i64).saturating_add(2 * reach)).contains(&beyond);
            shows.then_some(beyond as u32)
        };
        if let (Some(x), Some(y)) = (place(at.x, self.width), place(at.y, self.height)) {
            let of = self.by_reach.entry(reach as usize).or_default();
            of.push((x, y, value));
        }
    }

    /// The greatest value of all squares on each pixel; 0 where there is none.
    pub(crate) fn painted(&self) -> Vec<u8> {
        let mut image = vec![0; self.width * self.height];
        for (reach, squares) in &self.by_reach {
            // Growing goes over all of the image.
            let rows = self.height.saturating_add(2 * reach);
            let by_growing = self.width.saturating_mul(rows).saturating_mul(2);
            match squares.len().saturating_mul(2 * reach + 1) > by_growing {
                true => self.grown(*reach, squares, &mut image),
                false => self.one_by_one(*reach, squares, &mut image),
            }
        }
        image
    }

    fn one_by_one(&self, reach: usize, squares: &[Square], image: &mut [u8]) {
        let span = |beyond: u32, count: usize| {
            let beyond = beyond as usize;
            beyond.saturating_sub(2 * reach)..(beyond + 1).min(count)
        };
        for (x, y, value) in squares {
            for y in span(*y, self.height) {
                let row = &mut image[y * self.width..][span(*x, self.width)];
                row.iter_mut().for_each(|here| *here = (*value).max(*here));
            }
        }
    }

    fn grown(&self, reach: usize, squares: &[Square], image: &mut [u8]) {
        let (wide, tall) = (self.width + 2 * reach, self.height + 2 * reach);
        let mut middles = vec![0; wide * tall];
        for (x, y, value) in squares {
            let here = &mut middles[*y as usize * wide + *x as usize];
            *here = (*value).max(*here);
        }
        let mut rows = vec![0; self.width * tall];
        for (to, from) in rows
            .chunks_exact_mut(self.width)
            .zip(middles.chunks_exact(wide))
        {
            (0..=2 * reach).for_each(|d| greater(to, &from[d..]));
        }
        for (y, to) in image.chunks_exact_mut(self.width).enumerate() {
            (0..=2 * reach).for_each(|d| greater(to, &rows[(y + d) * self.width..]));
        }
    }
}

/// The greater of each two.
fn greater(to: &mut [u8], from: &[u8]) {
    let both = to.iter_mut().zip(from);
    both.for_each(|(to, from)| *to = (*to).max(*from));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn squares_that_are_grown_are_those_that_are_painted_one_by_one() {
        let (width, height) = (41, 30);
        let mut dice = proof::Dice(6);
        // Some are beyond the image, one wholly; one covers it.
        let mut wanted = vec![0; width * height];
        let mut squares = Squares::on(width, height);
        for k in 0..9000 {
            let at = [dice.within(-9.0, 50.0), dice.within(-9.0, 39.0)];
            let half = if k == 0 { 70.0 } else { dice.within(0.0, 3.0) };
            let value = if k == 0 {
                1
            } else {
                dice.within(1.0, 9.9) as u8
            };
            squares.add(&Point2::from(at), half, value);
            let reach = half.ceil() as i64;
            for (i, here) in wanted.iter_mut().enumerate() {
                let far = |v: usize, middle: f64| (v as i64 - middle.round() as i64).abs();
                if far(i % width, at[0]) <= reach && far(i / width, at[1]) <= reach {
                    *here = value.max(*here);
                }
            }
        }
        squares.add(&Point2::new(-1e12, 3.0), 4.0, 200);
        assert_eq!(squares.painted(), wanted);
        let each = &squares.by_reach[&2];
        let (mut grown, mut painted) = (vec![0; wanted.len()], vec![0; wanted.len()]);
        squares.grown(2, each, &mut grown);
        squares.one_by_one(2, each, &mut painted);
        assert_eq!(grown, painted);
    }
}
