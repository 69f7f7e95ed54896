//! The function that is negative inside a solid, and steps onto its surface.

use crate::bounds::bounds;
use nalgebra::{Point3, Vector3};
use shape::{Furrow, Level, Solid, SolidPart};

/// No value grows faster than this with distance (structural: a larger one only takes longer).
pub(crate) const STEEP: f64 = 1.7;

/// A solid, made ready to be asked often.
pub struct Field<'a> {
    parts: Vec<Part<'a>>,
    blend_mm: f64,
}

/// A part with what is the same for all points.
struct Part<'a> {
    of: &'a SolidPart,
    /// A box around it; outside, its value is at least `slope` times the way to the box.
    low: Point3<f64>,
    high: Point3<f64>,
    slope: f64,
    /// Directions of a limb: along it, and of its half-axes.
    axes: [Vector3<f64>; 3],
    /// Of a stack's intervals, from below.
    slopes: Vec<Slopes>,
}

/// How a level's four numbers (centre, half-axes) change at both ends of an interval, times its length.
type Slopes = [[f64; 2]; 4];

impl<'a> Field<'a> {
    /// The field of a solid.
    pub fn new(solid: &'a Solid) -> Self {
        Field {
            parts: solid.parts.iter().map(Part::of).collect(),
            blend_mm: solid.blend_mm,
        }
    }

    /// A point's value: negative inside, 0 on the surface, nowhere steeper than about 1.5. \[mm\]
    /// Parts are joined by the polynomial soft minimum of width `blend_mm`, which leaves untouched
    /// what is farther than that from the other part.
    pub fn value(&self, p: &Point3<f64>) -> f64 {
        let mut least = f64::MAX;
        for part in &self.parts {
            // A part that is farther than the blend reaches changes nothing.
            let reach = (least + self.blend_mm).max(0.0) / part.slope;
            if part.squared_way_to(p) > reach * reach {
                continue;
            }
            least = soft_min(least, part.value(p), self.blend_mm);
        }
        least
    }

    /// The direction in which the value grows, by central differences.
    pub fn gradient(&self, p: &Point3<f64>) -> Vector3<f64> {
        /// Step of differences (structural: samples).
        const STEP: f64 = 1e-3;
        Vector3::from_fn(|i, _| {
            let mut d = Vector3::zeros();
            d[i] = STEP;
            (self.value(&(p + d)) - self.value(&(p - d))) / (2.0 * STEP)
        })
    }

    /// The point of the surface near `p`, by Newton steps along a gradient, which is kept while the value shrinks by it.
    pub fn onto(&self, p: &Point3<f64>) -> Point3<f64> {
        let (mut p, mut before, mut gradient) = (*p, 0.0, Vector3::zeros());
        for _ in 0..16 {
            let value = self.value(&p);
            if value.abs() > before / 4.0 {
                gradient = self.gradient(&p);
            }
            before = value.abs();
            let step = gradient * (value / gradient.norm_squared().max(0.05));
            p -= step;
            if step.norm() < 1e-6 {
                break;
            }
        }
        p
    }
}

impl<'a> Part<'a> {
    /// Sections grow no slower than their least half-axis over their greatest; half of that is safe
    /// for all exponents and for the ends.
    fn of(part: &'a SolidPart) -> Self {
        let (low, high) = bounds(&Solid {
            parts: vec![part.clone()],
            ..Solid::default()
        });
        // Between levels a cubic may pass the box by a little.
        let around = (high - low) * 0.05;
        let (mut axes, mut slopes) = ([Vector3::zeros(); 3], Vec::new());
        let halves: Vec<f64> = match part {
            SolidPart::Ellipsoid { half, .. } => half.to_vec(),
            SolidPart::Torus { .. } => vec![1.0],
            SolidPart::Limb {
                from,
                to,
                half_from,
                half_to,
                ..
            } => {
                axes = limb_axes(&(Vector3::from(*to) - Vector3::from(*from)));
                [*half_from, *half_to].concat()
            }
            SolidPart::Stack { levels, .. } => {
                slopes = (1..levels.len()).map(|i| slopes_below(levels, i)).collect();
                levels.iter().flat_map(|l| l.half).collect()
            }
        };
        let least = halves.iter().copied().fold(f64::MAX, f64::min);
        let most = halves.iter().copied().fold(0.0, f64::max);
        Part {
            of: part,
            low: low - around,
            high: high + around,
            slope: (least / most / 2.0).max(1e-3),
            axes,
            slopes,
        }
    }

    /// The squared way from a point to the box. \[mm²\]
    fn squared_way_to(&self, p: &Point3<f64>) -> f64 {
        let out = (self.low - p).sup(&(p - self.high)).sup(&Vector3::zeros());
        out.norm_squared()
    }

    fn value(&self, p: &Point3<f64>) -> f64 {
        match self.of {
            SolidPart::Ellipsoid { centre, half } => {
                let d = p - Point3::from(*centre);
                let r = Vector3::new(d.x / half[0], d.y / half[1], d.z / half[2]).norm();
                (r - 1.0) * half[0].min(half[1]).min(half[2])
            }
            SolidPart::Torus { centre, ring, tube } => {
                let d = p - Point3::from(*centre);
                let out = (d.x * d.x + d.y * d.y).sqrt() - ring;
                (out * out + d.z * d.z).sqrt() - tube
            }
            SolidPart::Limb {
                from,
                to,
                half_from,
                half_to,
                round,
            } => {
                let (a, b) = (Point3::from(*from), Point3::from(*to));
                let length = (b - a).norm();
                let [axis, u, v] = &self.axes;
                let d = p - a;
                let along = d.dot(axis);
                let t = (along / length).clamp(0.0, 1.0);
                let half = |i: usize| half_from[i] + t * (half_to[i] - half_from[i]);
                let side = across(d.dot(u), d.dot(v), [half(0), half(1)], 2.0);
                soft_max(side, (-along).max(along - length), *round)
            }
            SolidPart::Stack {
                levels,
                exponent,
                furrow,
                round,
            } => {
                let (Some(first), Some(last)) = (levels.first(), levels.last()) else {
                    return f64::MAX;
                };
                let here = level_at(levels, &self.slopes, p.z.clamp(first.z, last.z));
                let (x, mut y) = (p.x - here.centre[0], p.y - here.centre[1]);
                if let Some(furrow) = furrow {
                    y += furrowed(furrow, x, y / here.half[1], p.z);
                }
                let beyond = (first.z - p.z).max(p.z - last.z);
                // No radius is longer than the sum of its parts: well beyond an end nothing hangs on the section.
                let [u, v] = [x / here.half[0], y / here.half[1]].map(f64::abs);
                let most = (u + v - 1.0) * here.half[0].min(here.half[1]);
                if *exponent >= 1.0 && beyond - round >= most {
                    return beyond;
                }
                let side = across(x, y, here.half, *exponent);
                soft_max(side, beyond, *round)
            }
        }
    }
}

/// Soft minimum: equal to the minimum where the two differ by more than `width`.
fn soft_min(a: f64, b: f64, width: f64) -> f64 {
    let h = (width - (a - b).abs()).max(0.0);
    let softened = if width > 0.0 {
        h * h / (4.0 * width)
    } else {
        0.0
    };
    a.min(b) - softened
}

fn soft_max(a: f64, b: f64, width: f64) -> f64 {
    -soft_min(-a, -b, width)
}

/// Value of a section: 0 on the superellipse, its half-axes in `half`.
fn across(x: f64, y: f64, half: [f64; 2], exponent: f64) -> f64 {
    let (u, v) = ((x / half[0]).abs(), (y / half[1]).abs());
    let radius = if exponent == 2.0 {
        (u * u + v * v).sqrt()
    } else {
        libm::pow(
            libm::pow(u, exponent) + libm::pow(v, exponent),
            1.0 / exponent,
        )
    };
    (radius - 1.0) * half[0].min(half[1])
}

/// The directions of a limb: along it, level across it, and across both. For an upright
/// limb the second is world x.
fn limb_axes(along: &Vector3<f64>) -> [Vector3<f64>; 3] {
    let axis = along / along.norm();
    let level = Vector3::y().cross(&axis);
    let u = level.try_normalize(1e-6).unwrap_or(Vector3::x());
    [axis, u, axis.cross(&u)]
}

/// By how much a furrow moves the back inward at x, at a share of the half-axis, at a height.
fn furrowed(furrow: &Furrow, x: f64, back: f64, z: f64) -> f64 {
    let smooth = |t: f64| {
        let t = t.clamp(0.0, 1.0);
        t * t * (3.0 - 2.0 * t)
    };
    let up = smooth(1.0 - ((z - furrow.z) / furrow.long).abs());
    let behind = smooth((back - 0.1) / 0.5);
    if up * behind == 0.0 {
        return 0.0;
    }
    furrow.deep * up * behind * libm::exp(-(x / furrow.wide) * (x / furrow.wide))
}

/// Catmull and Rom's slopes of the interval below a level.
fn slopes_below(levels: &[Level], above: usize) -> Slopes {
    let (a, b) = (&levels[above - 1], &levels[above]);
    let before = &levels[above.saturating_sub(2)];
    let after = &levels[(above + 1).min(levels.len() - 1)];
    let h = b.z - a.z;
    let numbers = |l: &Level| [l.centre[0], l.centre[1], l.half[0], l.half[1]];
    let slope = |p: &Level, q: &Level, i: usize| (numbers(q)[i] - numbers(p)[i]) / (q.z - p.z);
    std::array::from_fn(|i| [slope(before, b, i) * h, slope(a, after, i) * h])
}

/// The superellipse at a height, cubic Hermite between levels.
fn level_at(levels: &[Level], slopes: &[Slopes], z: f64) -> Level {
    let above = levels.partition_point(|l| l.z <= z).min(levels.len() - 1);
    let i = above.saturating_sub(1);
    let (a, b) = (&levels[i], &levels[above]);
    if above == i {
        return *a;
    }
    let t = (z - a.z) / (b.z - a.z);
    let (t2, t3) = (t * t, t * t * t);
    let hermite = |a: f64, b: f64, number: usize| {
        let [at_a, at_b] = slopes[i][number];
        a * (2.0 * t3 - 3.0 * t2 + 1.0)
            + at_a * (t3 - 2.0 * t2 + t)
            + b * (3.0 * t2 - 2.0 * t3)
            + at_b * (t3 - t2)
    };
    Level {
        z,
        centre: [
            hermite(a.centre[0], b.centre[0], 0),
            hermite(a.centre[1], b.centre[1], 1),
        ],
        half: [
            hermite(a.half[0], b.half[0], 2),
            hermite(a.half[1], b.half[1], 3),
        ],
    }
}
