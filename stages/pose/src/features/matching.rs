//! Features of two photos that look alike, each other's nearest, well ahead of the next.

use crate::features::best::{Best, PLACE_PX};
use rayon::prelude::*;
use shape::{Features, Keypoint};
use stage::machine::widest;

/// Pairs of features: places in the two lists.
pub type Pairs = Vec<(u32, u32)>;

/// Of two descriptions: their product.
#[inline(always)]
pub(crate) fn likeness(a: &[u8; 128], b: &[u8; 128]) -> i32 {
    a.iter()
        .zip(b)
        .map(|(x, y)| i32::from(*x) * i32::from(*y))
        .sum()
}

/// Least likeness of one thing seen twice from one place, 0.88 of that of equal descriptions. By hand: looked at two
/// captures: halved, centres −1.94 mm for one; doubled, size +0.10 % for one (docs/lab/numbers.md).
const STILL_LIKENESS: i32 = 512 * 512 / 100 * 88;

/// Features in the order of their rows.
struct Rows<'a> {
    features: &'a Features,
    order: Vec<u32>,
    heights: Vec<f32>,
}

impl Rows<'_> {
    fn new<'a>(features: &'a Features, left_out: &[bool]) -> Rows<'a> {
        let at = |i: &u32| features.points[*i as usize].y;
        let mut order: Vec<u32> = (0..features.points.len() as u32)
            .filter(|i| !left_out.get(*i as usize).copied().unwrap_or(false))
            .collect();
        order.sort_by(|p, q| at(p).total_cmp(&at(q)).then(p.cmp(q)));
        let heights = order.iter().map(at).collect();
        Rows {
            features,
            order,
            heights,
        }
    }

    /// The features within `rise_px` of a row.
    fn near(&self, y: f32, rise_px: f32) -> &[u32] {
        let low = self.heights.partition_point(|h| *h < y - rise_px);
        let high = self.heights.partition_point(|h| *h <= y + rise_px);
        &self.order[low..high]
    }
}

/// Which features of each photo are in the other at the same place, within `still_px`, looking
/// the same: they belong to what does not turn.
pub fn still(a: &Features, b: &Features, still_px: f32) -> [Vec<bool>; 2] {
    let rows = Rows::new(b, &[]);
    let mut is_still = [vec![false; a.points.len()], vec![false; b.points.len()]];
    for (i, (k, d)) in a.points.iter().zip(&a.descriptors).enumerate() {
        for j in rows.near(k.y, still_px) {
            let other = &b.points[*j as usize];
            let here = libm::hypotf(other.x - k.x, other.y - k.y) < still_px
                && (0.75..1.34).contains(&(other.scale / k.scale));
            if here && likeness(d, &b.descriptors[*j as usize]) > STILL_LIKENESS {
                is_still[0][i] = true;
                is_still[1][*j as usize] = true;
            }
        }
    }
    is_still
}

/// Of the photos that are far away in the turn, the part that shows a feature again before it counts as standing still,
/// and the least number of them. By hand: looked at two captures, halved and doubled: no more than chance
/// (docs/lab/numbers.md).
const SEEN_AGAIN: (usize, usize) = (4, 2);

/// Which features of each photo do not move, as those more than `reach` steps away in the turn show,
/// so that what turns cannot look the same there: grain that is long and faint is found at another
/// place in each photo, so that no single pair decides.
pub fn standing(views: &[&Features], reach: usize, still_px: f32) -> Vec<Vec<bool>> {
    let n = views.len();
    let far = |i: &usize, j: &usize| (j - i).min(n + i - j) > reach;
    let pairs: Vec<(usize, usize)> = (0..n)
        .flat_map(|i| (i + 1..n).map(move |j| (i, j)))
        .filter(|(i, j)| far(i, j))
        .collect();
    let stood: Vec<[Vec<bool>; 2]> = pairs
        .par_iter()
        .map(|(i, j)| still(views[*i], views[*j], still_px))
        .collect();
    let empty = |v: &&Features| vec![0usize; v.points.len()];
    let mut times: Vec<Vec<usize>> = views.iter().map(empty).collect();
    for ((i, j), both) in pairs.iter().zip(&stood) {
        for (k, stood) in [*i, *j].into_iter().zip(both) {
            let counts = times[k].iter_mut().zip(stood);
            counts.for_each(|(t, s)| *t += usize::from(*s));
        }
    }
    let least = (n.saturating_sub(2 * reach + 1) / SEEN_AGAIN.0).max(SEEN_AGAIN.1);
    let enough = |t: &Vec<usize>| t.iter().map(|t| *t >= least).collect();
    times.iter().map(enough).collect()
}

/// Pairs that are each other's nearest, and nearer than `ratio` times the next one of `b` that is
/// elsewhere. They are within `rise_px` of one row and have a like scale; features that are
/// `left_out` take no part.
pub fn mutual(
    a: &Features,
    b: &Features,
    ratio: f64,
    rise_px: f32,
    left_out: &[Vec<bool>; 2],
) -> Pairs {
    let rows = Rows::new(b, &left_out[1]);
    let mut back = vec![(i32::MIN, u32::MAX); b.points.len()];
    // Descriptors have length 512, so the squared distance is 2 (512² - likeness).
    let mut there = Vec::new();
    for (i, (k, d)) in a.points.iter().zip(&a.descriptors).enumerate() {
        if left_out[0].get(i).copied().unwrap_or(false) {
            continue;
        }
        let see = |j: u32, alike: i32| {
            let best = &mut back[j as usize];
            if alike > best.0 {
                *best = (alike, i as u32);
            }
        };
        let best = widest(
            #[inline(always)]
            || two_nearest(&rows, k, d, rise_px, see),
        );
        if best.ahead(ratio) {
            there.push((i as u32, best.at as u32));
        }
    }
    there.retain(|(i, j)| back[*j as usize].1 == *i);
    there
}

/// The nearest and the next one elsewhere; tells `see`
/// of each that was looked at.
#[inline(always)]
fn two_nearest(
    rows: &Rows<'_>,
    k: &Keypoint,
    d: &[u8; 128],
    rise_px: f32,
    mut see: impl FnMut(u32, i32),
) -> Best {
    let b = rows.features;
    let elsewhere = |i: usize, j: usize| {
        let (p, q) = (&b.points[i], &b.points[j]);
        libm::hypotf(p.x - q.x, p.y - q.y) >= PLACE_PX
    };
    let mut best = Best::default();
    for j in rows.near(k.y, rise_px) {
        let other = &b.points[*j as usize];
        if !(0.4..2.5).contains(&(other.scale / k.scale)) {
            continue;
        }
        let alike = likeness(d, &b.descriptors[*j as usize]);
        see(*j, alike);
        best.see(*j as usize, alike as f32, &elsewhere);
    }
    best
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// Features at random places with random descriptions.
    pub(crate) fn features(dice: &mut proof::Dice, count: usize) -> Features {
        let mut all = Features::default();
        for _ in 0..count {
            let mut d = [0.0f64; 128];
            d.iter_mut().for_each(|d| *d = dice.normal().abs());
            let length = d.iter().map(|d| d * d).sum::<f64>().sqrt();
            all.descriptors
                .push(d.map(|d| (d / length * 512.0).round().min(255.0) as u8));
            all.points.push(Keypoint {
                x: dice.within(0.0, 900.0) as f32,
                y: dice.within(0.0, 900.0) as f32,
                scale: 3.0,
                angle: 0.0,
            });
        }
        all
    }

    #[test]
    fn what_moved_is_matched_and_what_is_still_is_left_out() {
        let a = features(&mut proof::Dice(3), 200);
        let mut b = a.clone();
        b.points[100..].iter_mut().for_each(|k| k.x += 40.0);
        let left_out = still(&a, &b, 3.0);
        assert!((0..200).all(|i| left_out[0][i] == (i < 100) && left_out[1][i] == (i < 100)));
        let found = mutual(&a, &b, 0.85, 100.0, &left_out);
        assert_eq!(found, (100..200).map(|i| (i, i)).collect::<Vec<_>>());
    }

    #[test]
    fn what_is_found_near_its_place_in_many_photos_is_still_though_no_pair_shows_it() {
        let mut dice = proof::Dice(7);
        let first = features(&mut dice, 200);
        // The first half jitters by more than a pair bears, the other half turns.
        let photos: Vec<Features> = (0..18)
            .map(|k| {
                let mut photo = first.clone();
                for (i, p) in photo.points.iter_mut().enumerate() {
                    p.x += match i < 100 {
                        true => 2.5 * dice.normal() as f32,
                        false => 40.0 * k as f32,
                    };
                }
                photo
            })
            .collect();
        let views: Vec<&Features> = photos.iter().collect();
        let missed = |is_still: &[bool]| is_still[..100].iter().filter(|s| !**s).count();
        assert!(missed(&still(views[0], views[1], 3.0)[0]) > 20);
        let all = standing(&views, 3, 3.0);
        assert!(all.iter().map(|s| missed(s)).sum::<usize>() < 18 * 5);
        assert!(all.iter().all(|s| s[100..].iter().all(|s| !s)));
    }

    #[test]
    fn a_feature_seen_twice_has_no_match() {
        let mut a = features(&mut proof::Dice(5), 20);
        let mut b = a.clone();
        b.points.iter_mut().for_each(|k| k.x += 40.0);
        // The seventh's twin is elsewhere; the eighth's at the same place.
        for (of, x) in [(7, 300.0), (8, 0.5)] {
            let mut twin = b.points[of];
            twin.x += x;
            b.points.push(twin);
            b.descriptors.push(b.descriptors[of]);
        }
        a.points.truncate(20);
        let found = mutual(&a, &b, 0.85, 100.0, &[vec![], vec![]]);
        assert!(!found.iter().any(|(i, _)| *i == 7) && found.iter().any(|(i, _)| *i == 8));
        assert_eq!(found.len(), 19);
    }
}
