//! Which features are kept: most of them where things turn, spread over what is seen there.

use shape::Image;

/// Share of the features that may be where nothing turns. By hand: looked at two captures: halved, size +0.06 % for
/// one; doubled, size +0.06 % for one (docs/lab/numbers.md).
const STANDING_SHARE: f64 = 0.25;
/// Contrast that suffices where things turn, as a share of that elsewhere. By hand: looked at two captures: halved,
/// rotations −0.04 to +0.14°; doubled, ground +7.4 mm for one (docs/lab/numbers.md).
pub(crate) const FAINT_SHARE: f32 = 0.5;
/// Cells along the longer side of a photo; each gives its strongest by turns (structural: the grid of a spread).
const CELLS_ALONG: f32 = 40.0;

/// A place with its contrast. \[px of the photo, levels\]
#[derive(Debug, Clone, Copy)]
pub(crate) struct Spot {
    pub(crate) at: [f32; 2],
    pub(crate) contrast: f32,
}

/// Some places have several directions, each of which is a feature: of so many features as may be kept, this share is
/// places. By hand: looked at two captures: halved, size +0.21 % for one; doubled, no more than chance
/// (docs/lab/numbers.md).
const PLACES_SHARE: f64 = 0.8;

/// Which spots are kept, so that there are `most` features in all. `turns`: of each place of a photo
/// whether things turn there; elsewhere a spot needs a contrast.
pub(crate) fn kept(
    spots: &[Spot],
    most: usize,
    [width, height]: [usize; 2],
    contrast: f32,
    turns: &dyn Fn([f32; 2]) -> bool,
) -> Vec<bool> {
    let most = (most as f64 * PLACES_SHARE) as usize;
    let strength = |a: &usize, b: &usize| {
        spots[*b]
            .contrast
            .total_cmp(&spots[*a].contrast)
            .then(a.cmp(b))
    };
    let (mut inside, mut outside): (Vec<usize>, Vec<usize>) =
        (0..spots.len()).partition(|i| turns(spots[*i].at));
    inside.sort_by(strength);
    outside.retain(|i| spots[*i].contrast >= contrast);
    outside.sort_by(strength);
    // How many of its cell are stronger.
    let cell = width.max(height) as f32 / CELLS_ALONG;
    let mut counts = std::collections::BTreeMap::new();
    let mut ranked: Vec<(u32, usize)> = inside
        .iter()
        .map(|i| {
            let place = spots[*i].at.map(|v| (v / cell) as i32);
            let rank: &mut u32 = counts.entry(place).or_default();
            *rank += 1;
            (*rank, *i)
        })
        .collect();
    ranked.sort_by_key(|(rank, _)| *rank);
    let standing = ((most as f64 * STANDING_SHARE) as usize).min(outside.len());
    let mut keeps = vec![false; spots.len()];
    let turning = ranked.iter().map(|(_, i)| *i).take(most - standing);
    turning
        .chain(outside.into_iter().take(standing))
        .for_each(|i| keeps[i] = true);
    keeps
}

/// Whether a place of a photo is in a region of its reduced self.
pub(crate) fn within(region: &Image<bool>, [x, y]: [f32; 2], [width, height]: [usize; 2]) -> bool {
    let place = |v: f32, from: usize, to: usize| {
        (((v + 0.5) / from as f32 * to as f32) as usize).min(to - 1)
    };
    region.at(
        place(x, width, region.width),
        place(y, height, region.height),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_floor_of_strong_corners_leaves_three_quarters_to_what_turns() {
        let mut spots = Vec::new();
        for i in 0..4000 {
            let at = [(i % 100) as f32 * 10.0, (i / 100) as f32 * 10.0];
            let turns = at[0] >= 700.0;
            spots.push(Spot {
                at,
                contrast: if turns {
                    1.0 + (i % 7) as f32 * 0.1
                } else {
                    30.0
                },
            });
        }
        let turns = |at: [f32; 2]| at[0] >= 700.0;
        let keeps = kept(&spots, 1000, [1000, 400], 2.0, &turns);
        let inside = spots.iter().zip(&keeps).filter(|(s, k)| **k && turns(s.at));
        assert_eq!(inside.clone().count(), 600);
        assert_eq!(keeps.iter().filter(|k| **k).count(), 800);
        // All over it, not where it is strongest.
        let rows: std::collections::BTreeSet<i32> =
            inside.map(|(s, _)| s.at[1] as i32 / 25).collect();
        assert_eq!(rows.len(), 16);
    }
}
