//! The neck's outline from the side, in its own middle plane: throat, chin, nape.

use crate::features::neck_tube::Tube;
use crate::geometry::peak::between_rows;

/// The outline and its marks; offsets are along the neck's axis from its tightest section. \[mm\]
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct NeckProfile {
    /// Where it is read, rising.
    pub(crate) at: Vec<f64>,
    /// How far it reaches before the axis there.
    pub(crate) front: Vec<f64>,
    /// How far behind.
    pub(crate) back: Vec<f64>,
    /// The deepest of the throat within the line from chin to chest, and how deep that is.
    pub(crate) hollow: (f64, f64),
    /// Where the throat turns forward to the floor of the mouth (the cervicomental angle), and how far
    /// that is within the line from the hollow to the chin.
    pub(crate) angle: (f64, f64),
    /// The deepest of the nape within the line from the back of the head to the back.
    pub(crate) nape: f64,
}

/// Rows up and down; a row as a share of the diameter (structural: samples).
const ROWS: usize = 75;
/// A row, as a share of the diameter (structural: samples).
const ROW: f64 = 0.02;
/// Rows of which a mean is taken, for a hull's facets jump: so many are unbroken above and below (structural: samples).
const MEAN: usize = 5;

/// Reads the outline. `None` where it has gaps.
pub(crate) fn throat(tube: &Tube) -> Option<NeckProfile> {
    let row = ROW * tube.diameter();
    let reach = reaches(tube, row);
    // From the tightest section, unbroken.
    let whole = |r: &&(f64, f64)| r.0 < 0.0 && r.1 > 0.0;
    let up = reach[ROWS..].iter().take_while(whole).count();
    let low = reach[..ROWS].iter().rev().take_while(whole).count();
    if up < MEAN || low < MEAN {
        return None;
    }
    let range = ROWS - low..ROWS + up;
    let smooth = |pick: &dyn Fn(&(f64, f64)) -> f64| -> Vec<f64> {
        let raw: Vec<f64> = reach[range.clone()].iter().map(pick).collect();
        let near = |i: usize| &raw[i.saturating_sub(MEAN / 2)..(i + MEAN / 2 + 1).min(raw.len())];
        (0..raw.len())
            .map(|i| near(i).iter().sum::<f64>() / near(i).len() as f64)
            .collect()
    };
    let at = range.clone().map(|k| (k as f64 - ROWS as f64) * row);
    let mut throat = NeckProfile {
        at: at.collect(),
        front: smooth(&|r| r.1),
        back: smooth(&|r| r.0),
        ..NeckProfile::default()
    };
    marks(&mut throat, low);
    Some(throat)
}

/// How far the surface reaches behind and before the axis in its middle plane, row by row. \[mm\]
fn reaches(tube: &Tube, row: f64) -> Vec<(f64, f64)> {
    let (axis, ahead) = (tube.axis(), tube.ahead());
    let left = axis.cross(&ahead);
    let place = |v: u32| {
        let way = tube.part.point(v) - tube.origin;
        let rows = way.dot(&axis) / row + ROWS as f64;
        [rows, way.dot(&ahead), way.dot(&left)]
    };
    let places: Vec<[f64; 3]> = (0..tube.part.positions.len() as u32).map(place).collect();
    let mut reach = vec![(f64::MAX, f64::MIN); 2 * ROWS + 1];
    for face in &tube.part.faces {
        let p = face.map(|v| places[v as usize]);
        let mut ends = (0..3).filter_map(|i| {
            let (a, b) = (p[i], p[(i + 1) % 3]);
            let t = a[2] / (a[2] - b[2]);
            let cut = (a[2] >= 0.0) != (b[2] >= 0.0);
            cut.then(|| (a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])))
        });
        let (Some(a), Some(b)) = (ends.next(), ends.next()) else {
            continue;
        };
        let (a, b) = if a.0 <= b.0 { (a, b) } else { (b, a) };
        let mut k = a.0.ceil().max(0.0);
        while k <= b.0 && k < reach.len() as f64 {
            let t = if b.0 > a.0 {
                (k - a.0) / (b.0 - a.0)
            } else {
                0.0
            };
            let v = a.1 + t * (b.1 - a.1);
            let old = &mut reach[k as usize];
            *old = (old.0.min(v), old.1.max(v));
            k += 1.0;
        }
    }
    reach
}

/// Finds the marks; `tightest` is the row of the tightest section.
fn marks(t: &mut NeckProfile, tightest: usize) {
    let last = t.at.len() - 1;
    let farthest = |reach: &[f64]| {
        let far = (tightest..=last).max_by(|a, b| reach[*a].total_cmp(&reach[*b]));
        far.unwrap_or(last)
    };
    let chin = farthest(&t.front);
    let (k, hollow) = deepest(&t.at, &t.front, 0, chin);
    t.hollow = hollow;
    t.angle = deepest(&t.at, &t.front, k, chin).1;
    let behind: Vec<f64> = t.back.iter().map(|b| -b).collect();
    t.nape = deepest(&t.at, &behind, 0, farthest(&behind)).1.0;
}

/// The row farthest within the line between two places; where that is, between rows, and how far it is there.
fn deepest(at: &[f64], reach: &[f64], from: usize, to: usize) -> (usize, (f64, f64)) {
    let (up, out) = (at[to] - at[from], reach[to] - reach[from]);
    let long = libm::hypot(up, out).max(1e-9);
    let within = |k: usize| (out * (at[k] - at[from]) - up * (reach[k] - reach[from])) / long;
    let most = (from..=to).max_by(|a, b| within(*a).total_cmp(&within(*b)));
    let k = most.unwrap_or(from);
    let row = |k: usize| (at[k], within(k));
    let inner = k > from && k < to;
    let place = inner.then(|| between_rows([k - 1, k, k + 1].map(row)));
    (k, (place.unwrap_or(at[k]), within(k)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hollow_and_angle_are_the_outlines_corners() {
        // Chest falling away to the pit at -50, throat to 40, floor of the mouth to the chin at 60.
        let front = |u: f64| match u {
            u if u < -50.0 => 40.0 - (u + 50.0),
            u if u < 40.0 => 40.0 + 0.2 * (u + 50.0),
            u if u < 60.0 => 58.0 + 3.0 * (u - 40.0),
            u => 118.0 - 0.3 * (u - 60.0),
        };
        let at: Vec<f64> = (-75..=75).map(|k| 2.0 * f64::from(k)).collect();
        let mut t = NeckProfile {
            front: at.iter().map(|u| front(*u)).collect(),
            back: at.iter().map(|u| -60.0 - 0.3 * (u - 10.0).abs()).collect(),
            at,
            ..NeckProfile::default()
        };
        marks(&mut t, 75);
        // Corners are within half a row.
        for (got, corner) in [(t.hollow.0, -50.0), (t.angle.0, 40.0), (t.nape, 10.0)] {
            proof::near(got, corner, 1.0);
        }
        assert!(t.hollow.1 > 20.0 && t.angle.1 > 10.0);
    }

    #[test]
    fn a_mark_does_not_jump_from_row_to_row() {
        // A throat that bends evenly, read in rows that begin ever farther along.
        let bend = |u: f64| 0.01 * u * u;
        let place = |off: f64| {
            let at: Vec<f64> = (0..40).map(|k| 2.0 * f64::from(k) + off).collect();
            let reach: Vec<f64> = at.iter().map(|u| bend(*u)).collect();
            // Of the same piece, however rows are laid.
            deepest(&at, &reach, 0, 39).1.0 - off
        };
        // Midway between both ends, as on every parabola.
        (0..20).for_each(|k| proof::near(place(0.1 * f64::from(k)), 39.0, 1e-6));
    }
}
