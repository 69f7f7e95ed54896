//! The pose of a surface from elsewhere: which of its pieces is the body, which way is up, what its numbers are in.

use shape::Mesh;
use std::collections::BTreeMap;

/// A stature that most grown people are near (the middle of men and women of ANSUR II). \[mm\]
const USUAL_MM: f64 = 1700.0;
/// Adults are no taller: the mean of 4 082 men and 3.5 standard deviations (ANSUR II, 1756 and 69 mm). \[mm\]
const TALLEST_MM: f64 = 2000.0;
/// Nobody's arms span more than so many statures (structural), so what is longer than that against all else is the height.
const SPAN: f64 = 1.2;
/// Third centile of girls' length at birth (WHO 2006).
const SMALLEST_MM: f64 = 456.0;
/// A second piece with so much of the volume of the first is another body, or the other half of this one. By hand:
/// looked at eyes, teeth and specks of scans, which have less than a hundredth.
const SECOND_SHARE: f64 = 0.25;

/// Pieces of a surface, taken apart.
pub(crate) struct Pieces {
    /// The one that encloses most.
    pub(crate) body: Mesh,
    /// How many other pieces there were.
    pub(crate) left_out: usize,
    /// Whether one of them is as large as a body.
    pub(crate) second: bool,
}

/// Takes apart what hangs together; the floor under a body encloses nothing.
pub(crate) fn pieces(mesh: &Mesh) -> Pieces {
    let piece = mesh.pieces(|_| true);
    let mut volumes: BTreeMap<u32, f64> = BTreeMap::new();
    for (f, piece) in piece.iter().enumerate() {
        if let Some(piece) = piece {
            // About a point of the piece, so that a floor encloses nothing wherever it is.
            let own = mesh.point(*piece);
            let [a, b, c] = mesh.triangle(f).map(|p| p - own);
            *volumes.entry(*piece).or_default() += a.dot(&b.cross(&c)) / 6.0;
        }
    }
    let mut order: Vec<(u32, f64)> = volumes.into_iter().map(|(p, v)| (p, v.abs())).collect();
    order.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    let second = matches!(order.as_slice(), [a, b, ..] if b.1 > SECOND_SHARE * a.1);
    if order.len() < 2 {
        return Pieces {
            body: mesh.clone(),
            left_out: 0,
            second,
        };
    }
    let main = Some(order[0].0);
    let faces = (0..mesh.faces.len()).filter(|f| piece[*f] == main);
    let faces: Vec<[u32; 3]> = faces.map(|f| mesh.faces[f]).collect();
    Pieces {
        body: Mesh {
            unit: mesh.unit,
            ..Mesh::packed(&mesh.positions, &faces)
        },
        left_out: order.len() - 1,
        second,
    }
}

/// The axis of a body that points to its head: 0 to 2 for x to z, and whether it is the negative one.
///
/// It is one of the two along which the body is longest: the one along which it is less like its mirror image, for left
/// and right are alike; and the head's half is heavier than the legs'.
pub(crate) fn up(mesh: &Mesh) -> Option<(usize, bool)> {
    let (low, high) = mesh.bounds()?;
    let long = high - low;
    let mut axes = [0, 1, 2];
    axes.sort_by(|a, b| long[*b].total_cmp(&long[*a]));
    let odd = |axis: usize| unlike(mesh, axis, low[axis], high[axis]);
    let alone = long[axes[0]] > SPAN * long[axes[1]];
    let axis = match alone || odd(axes[0]) >= odd(axes[1]) {
        true => axes[0],
        false => axes[1],
    };
    let (mut moment, mut volume) = (0.0, 0.0);
    let middle = low + long / 2.0;
    for f in 0..mesh.faces.len() {
        let [a, b, c] = mesh.triangle(f).map(|p| p - middle);
        let six = a.dot(&b.cross(&c));
        moment += six * (a + b + c)[axis] / 4.0;
        volume += six;
    }
    Some((axis, moment * volume < 0.0))
}

/// Bins along an axis in which a body is compared with its mirror image (structural: samples).
const BINS: usize = 40;

/// How unlike its mirror image along an axis a surface is: the area that is on one side alone, as a share; about the middle
/// that makes it least, for an arm that reaches out shifts that of the box.
fn unlike(mesh: &Mesh, axis: usize, low: f64, high: f64) -> f64 {
    let mut areas = [0.0; BINS];
    for f in 0..mesh.faces.len() {
        let [a, b, c] = mesh.triangle(f).map(|p| p.coords);
        let sum = a + b + c;
        let at = (sum[axis] / 3.0 - low) / (high - low).max(1e-12) * BINS as f64;
        areas[(at.max(0.0) as usize).min(BINS - 1)] += mesh.area_vector(f).norm();
    }
    let all: f64 = areas.iter().sum();
    let off = |shift: usize| {
        let about = BINS / 2 + shift;
        let other = |i: usize| about.checked_sub(i).and_then(|k| areas.get(k));
        let mirrored = |i: usize| other(i).copied().unwrap_or(0.0);
        let beside: f64 = (0..BINS).map(|i| (areas[i] - mirrored(i)).abs()).sum();
        // What has its mirror image outside of the box.
        beside + all - (0..BINS).map(mirrored).sum::<f64>()
    };
    let least = (BINS / 4..=3 * BINS / 4).map(off).fold(f64::MAX, f64::min);
    least / all.max(1e-12)
}

/// Turned so that an axis points up: turned, never mirrored.
pub(crate) fn turned(mesh: &mut Mesh, (axis, negative): (usize, bool)) {
    for at in &mut mesh.positions {
        let [x, y, z] = *at;
        *at = match axis {
            0 => [y, z, x],
            1 => [z, x, y],
            _ => [x, y, z],
        };
        if negative {
            *at = [at[0], -at[1], -at[2]];
        }
    }
}

/// The unit in which a height is nearest to a grown person's, as a ratio; of units with their millimetres. One in which it
/// would be that of a giant gives way to one in which it is a child's.
pub(crate) fn unit<T: Copy>(height: f64, units: &[(T, f64)]) -> Option<T> {
    let off = |mm: f64| libm::log(height * mm / USUAL_MM).abs();
    let usual = |mm: f64| (SMALLEST_MM..=TALLEST_MM).contains(&(height * mm));
    let rank = |u: &(T, f64)| (!usual(u.1), off(u.1));
    let nearest = units.iter().min_by(|a, b| {
        let (a, b) = (rank(a), rank(b));
        a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
    });
    nearest.map(|u| u.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn children_and_tall_people_are_read_in_the_unit_of_their_file() {
        let units = [("mm", 1.0), ("cm", 10.0), ("m", 1000.0), ("in", 25.4)];
        for mm in [820.0, 1000.0, 1300.0, 1700.0, 1990.0, 2150.0] {
            for (name, of) in units {
                // 84 inches may be those of a giant or the centimetres of a small child.
                if (name, mm) != ("in", 2150.0) {
                    assert_eq!(unit(mm / of, &units), Some(name), "{mm} mm in {name}");
                }
            }
        }
    }
}
