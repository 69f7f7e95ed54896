//! Heights that the shape of a body marks, so that a visual hull shows them as well as the body.

use crate::features::body::Body;
use crate::features::extent::depth;
use crate::geometry::peak::farthest;
use crate::geometry::slices::Slice;
use shape::HipAt;

/// Heights above the ground that the outline of an upright body marks, and how its arms hang. \[mm\]
///
/// Each is estimated from an outline seen from the front or from the side: what a visual hull has right
/// even where it fills the armpits.
#[derive(Debug, Clone, PartialEq)]
pub struct Marks {
    /// Where the buttocks reach farthest back.
    pub hip: f64,
    /// Whether that shows; else it is what the rest of the body tells.
    pub hip_shows: bool,
    /// Standard deviation of the heights at which they reach about as far.
    pub hip_spread: f64,
    /// The narrowest of the neck, cut level.
    pub neck: f64,
    /// Bust or pectorals: farthest before the line from belly to throat.
    pub bust: f64,
    /// Where the outline from the side comes to a point at the bust, if it does, and how sharp that
    /// is: 1 beyond doubt, 0 none.
    pub apex: Option<(f64, f64)>,
    /// Whether an arm is clear of the trunk.
    pub arm_is_clear: bool,
    /// From back to front of the trunk at two thirds of the way from hip to neck. \[mm\]
    pub chest_depth: f64,
}

/// Reads the marks. `None` without hip or neck.
pub fn marks(body: &Body) -> Option<Marks> {
    let ground = body.ground;
    let (hip, neck) = (hip(body)?, body.neck?);
    let long = neck - hip;
    if long < 0.15 * body.stature {
        return None;
    }
    let front = |s: &Slice| depth(body, s.rings.first()?).map(|e| e.1);
    let from = hip + 0.25 * long;
    let bust = off_chord(body, from, neck - 0.02 * body.stature, front)?;
    Some(Marks {
        hip: hip - ground,
        hip_shows: matches!(body.hip, Some(HipAt::Between(..))),
        hip_spread: match body.hip {
            Some(HipAt::Between(low, high)) => farthest_back(body, low, high)?.spread,
            _ => 0.0,
        },
        neck: neck - ground,
        bust: bust - ground,
        apex: apex(body, hip, neck, front).map(|(z, sharp)| (z - ground, sharp)),
        arm_is_clear: [1.0, -1.0].iter().any(|side| is_clear(body, *side, hip)),
        chest_depth: depth_at(body, hip + 2.0 / 3.0 * long)?,
    })
}

/// Values of slices between two heights, each the mean of five: a hull's facets jump.
fn smoothed(
    body: &Body,
    low: f64,
    high: f64,
    value: impl Fn(&Slice) -> Option<f64>,
) -> Vec<(f64, f64)> {
    let raw: Vec<(f64, f64)> = body
        .between(low, high)
        .filter_map(|s| Some((s.z, value(s)?)))
        .collect();
    let mean = |i: usize| {
        let near = &raw[i.saturating_sub(2)..(i + 3).min(raw.len())];
        near.iter().map(|r| r.1).sum::<f64>() / near.len() as f64
    };
    (0..raw.len()).map(|i| (raw[i].0, mean(i))).collect()
}

/// The height of the hip: of the greatest prominence of the buttocks, or what the rest of the body tells. \[mm\]
pub(crate) fn hip(body: &Body) -> Option<f64> {
    match body.hip? {
        HipAt::Between(low, high) => Some(farthest_back(body, low, high)?.z),
        HipAt::Hidden(z, _) => Some(z),
    }
}

/// Half a millimetre on a grown person, a share of stature: what a surface moves from scan to scan (structural).
const SAME: f64 = 0.0003;

/// The heights at which the back reaches farthest, but for what a surface moves by itself. \[mm\]
pub(crate) struct FarthestBack {
    /// Their mean.
    pub(crate) z: f64,
    /// Their standard deviation.
    pub(crate) spread: f64,
    /// Whether that is a prominence: less far to either side.
    pub(crate) shows: bool,
}

/// Where the back reaches farthest between two heights.
pub(crate) fn farthest_back(body: &Body, low: f64, high: f64) -> Option<FarthestBack> {
    let back = |s: &Slice| depth(body, s.rings.first()?).map(|e| -e.0);
    let reach = smoothed(body, low, high, back);
    let most = (0..reach.len()).max_by(|a, b| reach[*a].1.total_cmp(&reach[*b].1))?;
    let weight = |r: &(f64, f64)| libm::exp((r.1 - reach[most].1) / (SAME * body.stature));
    let sum = |of: &dyn Fn(f64) -> f64| reach.iter().map(|r| weight(r) * of(r.0)).sum::<f64>();
    let all = sum(&|_| 1.0);
    let z = sum(&|z| z) / all;
    Some(FarthestBack {
        z,
        spread: (sum(&|h| (h - z).powi(2)) / all).sqrt(),
        shows: most > 0 && most + 1 < reach.len(),
    })
}

/// Where a profile is farthest above the straight line between its ends.
fn off_chord(
    body: &Body,
    low: f64,
    high: f64,
    value: impl Fn(&Slice) -> Option<f64>,
) -> Option<f64> {
    let [from, to] = [low, high].map(|z| between_slices(body, z, &value));
    let slope = (to? - from?) / (high - low);
    let profile = smoothed(body, low, high, value);
    let off: Vec<(f64, f64)> = profile.iter().map(|(z, v)| (*z, v - slope * z)).collect();
    Some(farthest(&off)?.1).filter(|_| high > low)
}

/// The bust's apex: where the outline from the side bends most, over two spans that must agree; and
/// how sharp it is there. Flat chests have none.
fn apex(
    body: &Body,
    hip: f64,
    neck: f64,
    front: impl Fn(&Slice) -> Option<f64>,
) -> Option<(f64, f64)> {
    let reach = smoothed(body, hip, neck, front);
    let bend = |span: usize| {
        let value = |i: usize| 2.0 * reach[i].1 - reach[i - span].1 - reach[i + span].1;
        let among = |i: &usize| {
            (hip + 0.25 * (neck - hip)..neck - 0.06 * body.stature).contains(&reach[*i].0)
        };
        let inner = span..reach.len().saturating_sub(span);
        let all: Vec<(f64, f64)> = inner
            .filter(among)
            .map(|i| (reach[i].0, value(i)))
            .collect();
        let (most, z) = farthest(&all)?;
        Some((z, all[most].1))
    };
    // A fiftieth and a thirtieth of the stature, in slices.
    let (fine, wide) = (bend(8)?, bend(14)?);
    let sharp = ((fine.1 / body.stature - 0.010) / 0.006).clamp(0.0, 1.0);
    let agree = (fine.0 - wide.0).abs() < 0.01 * body.stature;
    (agree && sharp > 0.0).then_some(((fine.0 + wide.0) / 2.0, sharp))
}

/// From back to front of the trunk at a height, straight between slices. \[mm\]
fn depth_at(body: &Body, z: f64) -> Option<f64> {
    let depth = |s: &Slice| depth(body, s.rings.first()?).map(|(back, front)| front - back);
    between_slices(body, z, depth)
}

/// A value at a height, straight between the slices about it.
pub(crate) fn between_slices(
    body: &Body,
    z: f64,
    value: impl Fn(&Slice) -> Option<f64>,
) -> Option<f64> {
    let above = body.slices.partition_point(|s| s.z < z).max(1);
    let (low, high) = (body.slices.get(above - 1)?, body.slices.get(above)?);
    let (from, to) = (value(low)?, value(high)?);
    Some(from + (to - from) * (z - low.z) / (high.z - low.z))
}

/// Whether an arm shows for some way below where it comes to be clear of the trunk.
fn is_clear(body: &Body, side: f64, hip: f64) -> bool {
    let all = crate::features::arms::clear(body, side, hip);
    let top = all.iter().map(|c| c.z).fold(f64::MIN, f64::max);
    let near = top - 0.08 * body.stature..=top - 0.02 * body.stature;
    all.iter().filter(|c| near.contains(&c.z)).count() >= 4
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::slices::Ring;
    use nalgebra::Point3;

    /// A trunk in slices that begin at `from`, whose back is flat over so much of its height to either side of 850. \[mm\]
    fn flat(half: f64, from: f64) -> Body {
        let ring = |z: f64| {
            let off = ((z - 850.0).abs() - half).max(0.0);
            let back = 100.0 - 0.005 * off * off;
            let corners = [(-90.0, -80.0), (90.0, -80.0), (90.0, back), (-90.0, back)];
            Ring {
                curve: corners.map(|(x, y)| Point3::new(x, y, z)).to_vec(),
                area: 180.0 * (80.0 + back),
                tape: 2.0 * (260.0 + back),
                centre: Point3::new(0.0, (back - 80.0) / 2.0, z),
            }
        };
        let slice = |k: u32| {
            let z = from + 4.375 * f64::from(k);
            Slice {
                z,
                rings: vec![ring(z)],
            }
        };
        Body::of_slices((0..80).map(slice).collect())
    }

    #[test]
    fn a_back_that_is_flat_reaches_farthest_midway_and_is_as_unsure_as_it_is_flat() {
        for (half, least, most) in [(0.0, 5.0, 13.0), (40.0, 23.0, 29.0)] {
            for k in 0..8 {
                let body = flat(half, 680.0 + 0.5 * f64::from(k));
                let found = farthest_back(&body, 750.0, 950.0).unwrap();
                proof::near(found.z, 850.0, 0.3);
                assert!((least..most).contains(&found.spread), "{}", found.spread);
                assert!(found.shows);
            }
        }
        // Only a part of it is looked at.
        assert!(
            !farthest_back(&flat(0.0, 680.0), 860.0, 950.0)
                .unwrap()
                .shows
        );
    }

    #[test]
    fn a_value_between_slices_is_straight_between_theirs() {
        let body = flat(0.0, 680.0);
        let z = |s: &Slice| Some(s.z);
        proof::near(between_slices(&body, 701.3, z).unwrap(), 701.3, 1e-9);
        assert_eq!(between_slices(&body, 2000.0, z), None);
    }
}
