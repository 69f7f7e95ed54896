//! Heights that the shape of a body marks, so that a visual hull shows them as well as the body.

use crate::features::body::Body;
use crate::features::extent::{breadth, depth};
use crate::features::reach::{BodyExtents, reach};
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
    /// The hollow of the back: farthest within the line from buttocks to shoulder blades.
    pub hollow: f64,
    /// Bust or pectorals: farthest before the line from belly to throat.
    pub bust: f64,
    /// Where the outline from the side comes to a point at the bust, if it does, and how sharp that
    /// is: 1 beyond doubt, 0 none.
    pub apex: Option<(f64, f64)>,
    /// Where the outline from the front is midway between neck and shoulders.
    pub shoulder: f64,
    /// Millimetres that the arms' middle lines go outward for each that they go down; `None` where
    /// no arm is clear.
    pub spread: Option<f64>,
    /// Half the trunk's tape where it is least between hip and bust, as a length across. \[mm\]
    pub girth: f64,
    /// How far the outline reaches between hip and neck.
    pub reach: BodyExtents,
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
    let back = |s: &Slice| depth(body, s.rings.first()?).map(|e| -e.0);
    let hollow = off_chord(body, hip, hip + 0.6 * long, back, -1.0)?;
    let bust = off_chord(
        body,
        hip + 0.25 * long,
        neck - 0.02 * body.stature,
        front,
        1.0,
    )?;
    let girth = body
        .between(hip, bust.max(hip + 0.3 * long))
        .filter_map(|s| s.rings.first())
        .map(|r| r.tape / 2.0)
        .reduce(f64::min)?;
    Some(Marks {
        hip: hip - ground,
        hip_shows: matches!(body.hip, Some(HipAt::Between(..))),
        hip_spread: match body.hip {
            Some(HipAt::Between(low, high)) => back_spread(body, low, high)?,
            _ => 0.0,
        },
        neck: neck - ground,
        hollow: hollow - ground,
        bust: bust - ground,
        apex: apex(body, hip, neck, front).map(|(z, sharp)| (z - ground, sharp)),
        shoulder: shoulder(body, hip, neck)? - ground,
        spread: spread(body, hip),
        girth,
        reach: reach(body, hip, neck)?,
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
        HipAt::Between(low, high) => Some(farthest_back(body, low, high)?.0),
        HipAt::Hidden(z, _) => Some(z),
    }
}

/// Where the back reaches farthest between two heights, and whether it is a prominence: less far to either
/// side. \[mm\]
pub(crate) fn farthest_back(body: &Body, low: f64, high: f64) -> Option<(f64, bool)> {
    let back = |s: &Slice| depth(body, s.rings.first()?).map(|e| -e.0);
    let reach = smoothed(body, low, high, back);
    let most = (0..reach.len()).max_by(|a, b| reach[*a].1.total_cmp(&reach[*b].1))?;
    Some((reach[most].0, most > 0 && most + 1 < reach.len()))
}

/// Half a millimetre on a grown person, a share of stature: what a surface moves from scan to scan (structural).
const SAME: f64 = 0.0003;

/// Standard deviation of the heights at which the back reaches as far but for what a surface moves by itself. \[mm\]
fn back_spread(body: &Body, low: f64, high: f64) -> Option<f64> {
    let back = |s: &Slice| depth(body, s.rings.first()?).map(|e| -e.0);
    let reach = smoothed(body, low, high, back);
    let most = reach.iter().map(|r| r.1).reduce(f64::max)?;
    let weight = |r: &(f64, f64)| libm::exp((r.1 - most) / (SAME * body.stature));
    let sum = |of: &dyn Fn(f64) -> f64| reach.iter().map(|r| weight(r) * of(r.0)).sum::<f64>();
    let all = sum(&|_| 1.0);
    let mean = sum(&|z| z) / all;
    Some((sum(&|z| (z - mean).powi(2)) / all).sqrt())
}

/// Where a profile is farthest from the straight line between its ends; above it for `side` 1.
fn off_chord(
    body: &Body,
    low: f64,
    high: f64,
    value: impl Fn(&Slice) -> Option<f64>,
    side: f64,
) -> Option<f64> {
    let profile = smoothed(body, low, high, value);
    let ((z0, v0), (z1, v1)) = (*profile.first()?, *profile.last()?);
    let off = |(z, v): &(f64, f64)| side * (v - v0 - (v1 - v0) * (z - z0) / (z1 - z0));
    let most = profile.iter().max_by(|a, b| off(a).total_cmp(&off(b)))?;
    (z1 > z0).then_some(most.0)
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
        (span..reach.len().saturating_sub(span))
            .filter(among)
            .map(|i| (reach[i].0, value(i)))
            .max_by(|a, b| a.1.total_cmp(&b.1))
    };
    // A fiftieth and a thirtieth of the stature, in slices.
    let (fine, wide) = (bend(8)?, bend(14)?);
    let sharp = ((fine.1 / body.stature - 0.010) / 0.006).clamp(0.0, 1.0);
    let agree = (fine.0 - wide.0).abs() < 0.01 * body.stature;
    (agree && sharp > 0.0).then_some(((fine.0 + wide.0) / 2.0, sharp))
}

/// The highest level at which the outline from the front is as wide as midway between neck and shoulders.
fn shoulder(body: &Body, hip: f64, neck: f64) -> Option<f64> {
    let full = |s: &Slice| breadth(s, &body.left);
    let at = |z: f64| body.slice(z).and_then(full);
    let (narrow, wide) = (at(neck)?, at(hip + 0.65 * (neck - hip))?);
    let half_way = (narrow + wide) / 2.0;
    body.between(hip, neck)
        .filter(|s| full(s).is_some_and(|w| w >= half_way))
        .map(|s| s.z)
        .reduce(f64::max)
}

/// How far the middle lines of both arms go outward for a millimetre down, just below where they
/// are clear of the trunk.
fn spread(body: &Body, hip: f64) -> Option<f64> {
    let slopes: Vec<f64> = [1.0, -1.0]
        .into_iter()
        .filter_map(|side| {
            let all = crate::features::arms::clear(body, side, hip);
            let top = all.iter().map(|c| c.z).reduce(f64::max)?;
            let near =
                |z: &f64| (top - 0.08 * body.stature..=top - 0.02 * body.stature).contains(z);
            let line: Vec<(f64, f64)> = all
                .iter()
                .filter(|c| near(&c.z))
                .map(|c| (c.z, side * c.coords.dot(&body.left)))
                .collect();
            (line.len() >= 4).then(|| -slope(&line))
        })
        .collect();
    (!slopes.is_empty()).then(|| slopes.iter().sum::<f64>() / slopes.len() as f64)
}

/// Slope of the least-squares line through (x, y).
pub(crate) fn slope(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let (mx, my) = points
        .iter()
        .fold((0.0, 0.0), |m, p| (m.0 + p.0 / n, m.1 + p.1 / n));
    let (up, down) = points.iter().fold((0.0, 0.0), |s, p| {
        (s.0 + (p.0 - mx) * (p.1 - my), s.1 + (p.0 - mx).powi(2))
    });
    up / down
}
