//! Features of two photos that look alike, each other's nearest, well ahead of the next.

use shape::{Features, Keypoint};

/// Pairs of features: places in the two lists.
pub type Pairs = Vec<(u32, u32)>;

fn likeness(a: &[u8; 128], b: &[u8; 128]) -> i32 {
    a.iter()
        .zip(b)
        .map(|(x, y)| i32::from(*x) * i32::from(*y))
        .sum()
}

/// A description's likeness to itself.
const SAME: i32 = 512 * 512;
/// Least likeness of one thing seen twice from one place.
const ALIKE: i32 = SAME / 100 * 88;
/// Features nearer to each other than this are one place with several directions. \[px\]
const PLACE_PX: f32 = 2.0;

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

/// Which features of each photo stand in the other at the same place, within `still_px`, looking
/// the same: they belong to what does not turn.
pub fn still(a: &Features, b: &Features, still_px: f32) -> [Vec<bool>; 2] {
    let rows = Rows::new(b, &[]);
    let mut stands = [vec![false; a.points.len()], vec![false; b.points.len()]];
    for (i, (k, d)) in a.points.iter().zip(&a.descriptors).enumerate() {
        for j in rows.near(k.y, still_px) {
            let other = &b.points[*j as usize];
            let here = (other.x - k.x).hypot(other.y - k.y) < still_px
                && (0.75..1.34).contains(&(other.scale / k.scale));
            if here && likeness(d, &b.descriptors[*j as usize]) > ALIKE {
                stands[0][i] = true;
                stands[1][*j as usize] = true;
            }
        }
    }
    stands
}

/// Pairs that are each other's nearest, and nearer than `ratio` times the next one of `b` that lies
/// elsewhere. They lie within `rise_px` of one row and have a like scale; features that are
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
    let distance = |likeness: i32| f64::from(2 * (SAME - likeness).max(0)).sqrt();
    let mut there = Vec::new();
    for (i, (k, d)) in a.points.iter().zip(&a.descriptors).enumerate() {
        if left_out[0].get(i).copied().unwrap_or(false) {
            continue;
        }
        let (first, second) = two_nearest(&rows, k, d, rise_px, |j, alike| {
            let best = &mut back[j as usize];
            if alike > best.0 {
                *best = (alike, i as u32);
            }
        });
        let ahead = second == i32::MIN || distance(first.0) < ratio * distance(second);
        if first.1 != u32::MAX && ahead {
            there.push((i as u32, first.1));
        }
    }
    there.retain(|(i, j)| back[*j as usize].1 == *i);
    there
}

/// The likeness and place of the nearest, and the likeness of the next one elsewhere; tells `see`
/// of each that was looked at.
fn two_nearest(
    rows: &Rows<'_>,
    k: &Keypoint,
    d: &[u8; 128],
    rise_px: f32,
    mut see: impl FnMut(u32, i32),
) -> ((i32, u32), i32) {
    let b = rows.features;
    let (mut first, mut second) = ((i32::MIN, u32::MAX), i32::MIN);
    for j in rows.near(k.y, rise_px) {
        let other = &b.points[*j as usize];
        if !(0.4..2.5).contains(&(other.scale / k.scale)) {
            continue;
        }
        let alike = likeness(d, &b.descriptors[*j as usize]);
        see(*j, alike);
        if alike <= second {
            continue;
        }
        let elsewhere = first.1 != u32::MAX && {
            let f = &b.points[first.1 as usize];
            (f.x - other.x).hypot(f.y - other.y) >= PLACE_PX
        };
        if alike > first.0 {
            if elsewhere {
                second = first.0;
            }
            first = (alike, *j);
        } else if elsewhere {
            second = alike;
        }
    }
    (first, second)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Features at random places with random descriptions.
    fn features(dice: &mut proof::Dice, count: usize) -> Features {
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
    fn what_moved_is_matched_and_what_stands_still_is_left_out() {
        let a = features(&mut proof::Dice(3), 200);
        let mut b = a.clone();
        b.points[100..].iter_mut().for_each(|k| k.x += 40.0);
        let left_out = still(&a, &b, 3.0);
        assert!((0..200).all(|i| left_out[0][i] == (i < 100) && left_out[1][i] == (i < 100)));
        let found = mutual(&a, &b, 0.85, 100.0, &left_out);
        assert_eq!(found, (100..200).map(|i| (i, i)).collect::<Vec<_>>());
    }

    #[test]
    fn a_feature_seen_twice_has_no_match() {
        let mut a = features(&mut proof::Dice(5), 20);
        let mut b = a.clone();
        b.points.iter_mut().for_each(|k| k.x += 40.0);
        // The seventh's twin stands elsewhere; the eighth's at the same place.
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
