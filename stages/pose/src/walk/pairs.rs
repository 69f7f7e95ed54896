//! Which photos show the same: the largest features of all pairs, then all features of those that
//! hold together.

use crate::features::matching::Pairs;
use crate::two_view::epipolar::{agreeing, fundamental};
use crate::two_view::five_point::Both;
use crate::walk::guided::guided;
use crate::walk::nearest::nearest;
use shape::Features;

/// How pairs are compared.
#[derive(Clone, Copy)]
pub(crate) struct Rules {
    /// The nearest description must be nearer than this share of the next one.
    pub(crate) ratio: f64,
    /// How far a match may be off its epipolar line. \[px\]
    pub(crate) epipolar_px: f64,
    /// Features that move less are still. \[px\]
    pub(crate) still_px: f64,
    /// Fewest matches that hold two photos together.
    pub(crate) least: usize,
    /// Least share of the matches that must agree.
    pub(crate) share: f64,
    /// Most samples.
    pub(crate) rounds: usize,
    /// Seed of the samples.
    pub(crate) seed: u64,
}

/// What two photos have in common.
#[derive(Default)]
pub(crate) struct Shared {
    /// Matches that agree with one motion; none where too few do.
    pub(crate) matches: Pairs,
    /// How many matches stood still in the photo.
    pub(crate) still: usize,
}

/// The places of the `count` largest features: where they are found in one photo, they are found in
/// another at half the distance, too.
pub(crate) fn largest(features: &Features, count: usize) -> Vec<u32> {
    let size = |i: &u32| features.points[*i as usize].scale;
    let mut order: Vec<u32> = (0..features.points.len() as u32).collect();
    order.sort_by(|a, b| size(b).total_cmp(&size(a)).then(a.cmp(b)));
    order.truncate(count);
    order.sort_unstable();
    order
}

/// Compares some features of two photos.
pub(crate) fn compared(views: [&Features; 2], some: [&[u32]; 2], rules: &Rules) -> Shared {
    let mut found = nearest(views, some, rules.ratio);
    let both = |(i, j): &(u32, u32)| -> Both {
        let (k, l) = (&views[0].points[*i as usize], &views[1].points[*j as usize]);
        [
            [f64::from(k.x), f64::from(k.y)],
            [f64::from(l.x), f64::from(l.y)],
        ]
    };
    let all = found.len();
    found.retain(|m| {
        let [k, l] = both(m);
        libm::hypot(k[0] - l[0], k[1] - l[1]) >= rules.still_px
    });
    let still = all - found.len();
    if found.len() < rules.least {
        return Shared {
            matches: vec![],
            still,
        };
    }
    let pairs: Vec<Both> = found.iter().map(both).collect();
    let agree = agreeing(&pairs, rules.epipolar_px, rules.rounds, rules.seed);
    let kept: Pairs = found
        .iter()
        .zip(&agree)
        .filter(|(_, agree)| **agree)
        .map(|(m, _)| *m)
        .collect();
    let holds = kept.len() >= rules.least && kept.len() as f64 >= rules.share * found.len() as f64;
    Shared {
        matches: if holds { kept } else { vec![] },
        still,
    }
}

/// All features of two photos along the motion that their matches tell, beside those.
pub(crate) fn again(views: [&Features; 2], shared: Shared, rules: &Rules) -> Shared {
    let both = |(i, j): &(u32, u32)| -> Both {
        let (k, l) = (&views[0].points[*i as usize], &views[1].points[*j as usize]);
        [
            [f64::from(k.x), f64::from(k.y)],
            [f64::from(l.x), f64::from(l.y)],
        ]
    };
    let pairs: Vec<Both> = shared.matches.iter().map(both).collect();
    let Some(motion) = fundamental(&pairs) else {
        return shared;
    };
    let mut found = guided(views, &motion, rules.epipolar_px, rules.ratio);
    found.retain(|m| {
        let [k, l] = both(m);
        libm::hypot(k[0] - l[0], k[1] - l[1]) >= rules.still_px
    });
    match found.len() >= shared.matches.len() {
        true => Shared {
            matches: found,
            still: shared.still,
        },
        false => shared,
    }
}

/// The pairs to be compared in full: of each photo the `partners` with which it shares most, and
/// its neighbours in the order of the photos. `shared` lists pairs `i < j` and what they share.
pub(crate) fn chosen(
    photos: usize,
    shared: &[((usize, usize), usize)],
    partners: usize,
    neighbours: usize,
) -> Vec<(usize, usize)> {
    let mut chosen: Vec<(usize, usize)> = Vec::new();
    for i in 0..photos {
        let own = |((a, b), count): &((usize, usize), usize)| {
            ((*a == i || *b == i) && *count > 0).then_some((*count, (*a, *b)))
        };
        let mut own: Vec<(usize, (usize, usize))> = shared.iter().filter_map(own).collect();
        own.sort_by_key(|(count, pair)| (std::cmp::Reverse(*count), *pair));
        chosen.extend(own.into_iter().take(partners).map(|(_, pair)| pair));
        for step in 1..=neighbours {
            let j = (i + step) % photos;
            if i != j {
                chosen.push((i.min(j), i.max(j)));
            }
        }
    }
    chosen.sort_unstable();
    chosen.dedup();
    chosen
}

/// Photos that hang together over pairs, largest part first.
pub(crate) fn parts(photos: usize, pairs: &[(usize, usize)]) -> Vec<Vec<usize>> {
    let mut part: Vec<usize> = (0..photos).collect();
    for (a, b) in pairs {
        let (from, to) = (part[*a].max(part[*b]), part[*a].min(part[*b]));
        part.iter_mut()
            .filter(|p| **p == from)
            .for_each(|p| *p = to);
    }
    let of = |p: usize| (0..photos).filter(|i| part[*i] == p).collect::<Vec<_>>();
    let mut all: Vec<Vec<usize>> = (0..photos).map(of).filter(|p| !p.is_empty()).collect();
    all.sort_by_key(|p| std::cmp::Reverse(p.len()));
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_photo_keeps_its_best_partners_and_its_neighbours() {
        let shared = [((0, 2), 90), ((0, 3), 50), ((1, 3), 40), ((2, 3), 0)];
        assert_eq!(chosen(5, &shared, 1, 0), [(0, 2), (0, 3), (1, 3)]);
        let with = chosen(5, &shared, 1, 1);
        assert_eq!(
            with,
            [
                (0, 1),
                (0, 2),
                (0, 3),
                (0, 4),
                (1, 2),
                (1, 3),
                (2, 3),
                (3, 4)
            ]
        );
    }

    #[test]
    fn parts_are_what_hangs_together() {
        let found = parts(6, &[(4, 5), (0, 2), (2, 3), (5, 4)]);
        assert_eq!(found, [vec![0, 2, 3], vec![4, 5], vec![1]]);
    }
}
