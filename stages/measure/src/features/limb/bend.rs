//! Where a limb's line bends: two straight pieces fitted to it.

use crate::features::limb::follow::Knot;
use nalgebra::{Matrix3, Point3, Vector3};

/// A bend of so much is a joint: an elbow, a knee. By hand: looked at three scans, at 0.7 and 1.4 of it: tapes move by
/// at most 0.85 and 0 %, intervals change by at most 10 and 0 %. \[rad\]
pub(super) const BENT_RAD: f64 = 12.0 * std::f64::consts::PI / 180.0;

/// A straight line through middles of sections.
#[derive(Debug, Clone, Copy)]
pub struct Line {
    /// Amid them. \[mm\]
    pub point: Point3<f64>,
    /// Unit, toward the trunk.
    pub along: Vector3<f64>,
    /// Mean square of the middles' distances from it. \[mm²\]
    pub off: f64,
}

impl Line {
    /// The point of the line nearest to another. \[mm\]
    pub fn nearest(&self, p: Point3<f64>) -> Point3<f64> {
        self.point + self.along * self.along.dot(&(p - self.point))
    }
}

/// The least-squares line through knots, of at least three.
pub(crate) fn line<'a>(knots: impl Iterator<Item = &'a Knot>) -> Option<Line> {
    let all: Vec<&Knot> = knots.collect();
    let (first, last) = (all.first()?, all.last()?);
    if all.len() < 3 {
        return None;
    }
    let n = all.len() as f64;
    let mean = all.iter().map(|k| k.centre.coords).sum::<Vector3<f64>>() / n;
    let square = |k: &&Knot| {
        let d = k.centre.coords - mean;
        d * d.transpose()
    };
    let spread: Matrix3<f64> = all.iter().map(square).sum();
    let eigen = spread.symmetric_eigen();
    let most = eigen.eigenvalues.imax();
    let way: Vector3<f64> = eigen.eigenvectors.column(most).into();
    let turn = way.dot(&(last.centre - first.centre)).signum();
    let along = (way * turn).try_normalize(1e-9)?;
    Some(Line {
        point: mean.into(),
        along,
        off: (spread.trace() - eigen.eigenvalues[most]).max(0.0) / n,
    })
}

/// A limb's bend.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bend {
    /// Way from the tip at which the two pieces meet. \[mm\]
    pub(crate) s: f64,
    /// The angle between them. \[rad\]
    pub(crate) angle: f64,
}

/// The bend of knots: of two pieces, each at least `least` long, with `round` left out to either side
/// of where they part, those that fit best. \[mm\]
pub(crate) fn bend(knots: &[Knot], least: f64, round: f64) -> Option<Bend> {
    let (low, high) = (knots.first()?.s, knots.last()?.s);
    let parts = knots
        .iter()
        .map(|k| k.s)
        .filter(|s| (low + least..=high - least).contains(s));
    let fit = |s: f64| {
        let below = line(knots.iter().filter(|k| k.s < s - round))?;
        let above = line(knots.iter().filter(|k| k.s > s + round))?;
        let share = (s - low) / (high - low);
        let meet = meeting(&below, &above)?;
        Some((
            share * below.off + (1.0 - share) * above.off,
            meet,
            below.along.angle(&above.along),
        ))
    };
    let (_, meet, angle) = parts.filter_map(fit).min_by(|a, b| a.0.total_cmp(&b.0))?;
    let near = |k: &&Knot| (k.centre - meet).norm();
    let s = knots.iter().min_by(|a, b| near(a).total_cmp(&near(b)))?.s;
    Some(Bend { s, angle })
}

/// The bend of a line that is straight but for one place in a range, at least `least` from its ends, by
/// least squares; `None` where no such place is. \[mm\]
pub(crate) fn hinge(knots: &[Knot], range: std::ops::Range<f64>, least: f64) -> Option<Bend> {
    let (low, high) = (knots.first()?.s + least, knots.last()?.s - least);
    let fit = |at: f64| {
        let row = |k: &Knot| Vector3::new(1.0, k.s - at, (k.s - at).max(0.0));
        let (mut normal, mut right) = (Matrix3::zeros(), Matrix3::zeros());
        for k in knots {
            normal += row(k) * row(k).transpose();
            right += row(k) * k.centre.coords.transpose();
        }
        let solved = normal.cholesky()?.solve(&right);
        let off =
            |k: &Knot| (row(k).transpose() * solved - k.centre.coords.transpose()).norm_squared();
        let below: Vector3<f64> = solved.row(1).transpose();
        let above: Vector3<f64> = below + solved.row(2).transpose();
        let bend = Bend {
            s: at,
            angle: below.angle(&above),
        };
        Some((knots.iter().map(off).sum::<f64>(), bend))
    };
    let places = knots.iter().map(|k| k.s);
    let places = places.filter(|s| range.contains(s) && (low..=high).contains(s));
    let best = places.filter_map(fit).min_by(|a, b| a.0.total_cmp(&b.0))?;
    Some(best.1)
}

/// Amid the points of two lines that are nearest to each other. `None` for all but parallel ones.
fn meeting(a: &Line, b: &Line) -> Option<Point3<f64>> {
    let (off, cos) = (b.point - a.point, a.along.dot(&b.along));
    let under = 1.0 - cos * cos;
    if under < 1e-4 {
        return None;
    }
    let (da, db) = (a.along.dot(&off), b.along.dot(&off));
    let (ta, tb) = ((da - cos * db) / under, (cos * da - db) / under);
    Some(nalgebra::center(
        &(a.point + a.along * ta),
        &(b.point + b.along * tb),
    ))
}

/// A statement about two places x, y on a line: a x + b y = c, give or take sigma.
pub(crate) struct Constraint {
    pub(crate) a: f64,
    pub(crate) b: f64,
    pub(crate) c: f64,
    pub(crate) sigma: f64,
}

/// Two places and their covariance (xx, xy, yy) from statements, by least squares.
pub(crate) fn places(reported: &[Constraint]) -> Option<([f64; 2], [f64; 3])> {
    let (mut n, mut r) = ([0.0f64; 3], [0.0f64; 2]);
    for t in reported {
        let w = t.sigma.powi(-2);
        n[0] += w * t.a * t.a;
        n[1] += w * t.a * t.b;
        n[2] += w * t.b * t.b;
        r[0] += w * t.a * t.c;
        r[1] += w * t.b * t.c;
    }
    let under = n[0] * n[2] - n[1] * n[1];
    if under <= 0.0 || !under.is_finite() {
        return None;
    }
    let cov = [n[2] / under, -n[1] / under, n[0] / under];
    Some((
        [cov[0] * r[0] + cov[1] * r[1], cov[1] * r[0] + cov[2] * r[1]],
        cov,
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bent(angle: f64) -> Vec<Knot> {
        (0..60)
            .map(|i| {
                let s = 8.0 * f64::from(i);
                let over = (s - 250.0).max(0.0);
                let (sin, cos) = libm::sincos(angle);
                let centre = Point3::new(over * sin, 0.0, s.min(250.0) + over * cos);
                Knot {
                    s,
                    centre,
                    along: Vector3::z(),
                    tape: 250.0,
                    round: 1.0,
                }
            })
            .collect()
    }

    #[test]
    fn a_bend_is_found_where_it_is_and_by_its_angle() {
        for degrees in [15.0f64, 40.0, 80.0] {
            let found = bend(&bent(degrees.to_radians()), 60.0, 15.0).unwrap();
            proof::near(found.s, 250.0, 8.0);
            proof::near(found.angle.to_degrees(), degrees, 0.1);
        }
        assert!(bend(&bent(0.0), 60.0, 15.0).is_none());
    }

    #[test]
    fn a_hinge_is_found_in_its_range_alone() {
        for degrees in [5.0f64, 20.0, 80.0] {
            let found = hinge(&bent(degrees.to_radians()), 150.0..350.0, 40.0).unwrap();
            proof::near(found.s, 250.0, 8.0);
            proof::near(found.angle.to_degrees(), degrees, 1.0);
        }
        let found = hinge(&bent(0.5), 50.0..200.0, 40.0).unwrap();
        assert!((50.0..200.0).contains(&found.s));
        assert!(hinge(&bent(0.5), 440.0..500.0, 40.0).is_none());
    }

    #[test]
    fn places_weigh_what_is_known_of_them() {
        let reported = |a, b, c, sigma| Constraint { a, b, c, sigma };
        let ([x, y], cov) =
            places(&[reported(1.0, 0.0, 3.0, 1.0), reported(-1.0, 1.0, 4.0, 2.0)]).unwrap();
        proof::near(x, 3.0, 1e-9);
        proof::near(y, 7.0, 1e-9);
        proof::near(cov[2], 5.0, 1e-9);
        assert!(places(&[reported(1.0, 1.0, 3.0, 1.0)]).is_none());
    }
}
