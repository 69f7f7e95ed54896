//! What of somebody stays one rigid thing while turning: the trunk. Arms, legs and head go their own ways.

use crate::joints::Sights;
use nalgebra::Vector2;

/// Lines between joints by their places in [`shape::Found::JOINTS`], structural; what is nearest to one of the first six is
/// the trunk's.
const BONES: [[usize; 2]; 19] = [
    [11, 12],
    [23, 24],
    [11, 23],
    [12, 24],
    [11, 24],
    [12, 23],
    [0, 7],
    [0, 8],
    [7, 8],
    [11, 13],
    [13, 15],
    [15, 19],
    [12, 14],
    [14, 16],
    [16, 20],
    [23, 25],
    [25, 27],
    [24, 26],
    [26, 28],
];
/// How many of them are the trunk's, structural.
const TRUNKS: usize = 6;

/// One photo's lines, on the plane z = 1.
pub(crate) struct Trunk(Vec<(bool, [Vector2<f64>; 2])>);

impl Trunk {
    /// By the joints of a photo.
    pub(crate) fn of(sights: &Sights, photo: usize) -> Trunk {
        let line = |(k, [a, b]): (usize, &[usize; 2])| {
            Some((k < TRUNKS, [sights[*a][photo]?, sights[*b][photo]?]))
        };
        Trunk(BONES.iter().enumerate().filter_map(line).collect())
    }

    /// Whether a place is nearer to the trunk than to a limb or the head.
    pub(crate) fn holds(&self, at: &Vector2<f64>) -> bool {
        let apart = |[a, b]: &[Vector2<f64>; 2]| {
            let along = b - a;
            let t = (at - a).dot(&along) / along.norm_squared().max(f64::MIN_POSITIVE);
            (at - a - along * t.clamp(0.0, 1.0)).norm_squared()
        };
        let nearest = self
            .0
            .iter()
            .min_by(|a, b| apart(&a.1).total_cmp(&apart(&b.1)));
        nearest.is_some_and(|(trunk, _)| *trunk)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_flank_is_the_trunks_and_a_hanging_arms_border_is_not() {
        let mut sights: Sights = vec![vec![None]; shape::Found::JOINTS.len()];
        let mut put = |j: usize, x: f64, y: f64| sights[j][0] = Some(Vector2::new(x, y));
        for (side, first) in [(1.0, 0), (-1.0, 1)] {
            put(11 + first, 0.07 * side, -0.1);
            put(13 + first, 0.1 * side, 0.0);
            put(15 + first, 0.11 * side, 0.09);
            put(19 + first, 0.11 * side, 0.12);
            put(23 + first, 0.035 * side, 0.09);
            put(25 + first, 0.04 * side, 0.24);
        }
        let trunk = Trunk::of(&sights, 0);
        for (at, is) in [
            ([0.06, 0.02], true),
            ([-0.06, 0.02], true),
            ([0.12, 0.05], false),
            ([0.06, 0.2], false),
        ] {
            assert_eq!(trunk.holds(&Vector2::from(at)), is, "{at:?}");
        }
    }
}
