//! Whether two captures are of the same person: what weight does not change.

use super::series::Visit;
use std::fmt;

/// Statures of one adult at two captures are hardly farther apart: the spine's day (up to 20 mm) and one's posture, beside
/// what both captures err. \[mm\]
const STATURE_MM: f64 = 25.0;
/// A surface whose middle vertex is farther off than this in the same pose is another body, or one that changed very much. \[mm\]
const FAR_MM: f64 = 15.0;

/// Why a capture may be somebody else's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Doubt {
    /// The stature is another.
    Stature {
        /// By how much. \[mm\]
        off_mm: f64,
        /// How much would be no doubt. \[mm\]
        most_mm: f64,
    },
    /// The shape is another, in the same pose.
    Shape {
        /// How far off half of the surface is. \[mm\]
        off_mm: f64,
    },
}

impl fmt::Display for Doubt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Doubt::Stature { off_mm, most_mm } => write!(
                f,
                "its stature is {off_mm:+.0} mm off, more than {most_mm:.0} mm"
            ),
            Doubt::Shape { off_mm } => write!(
                f,
                "half of its surface is more than {off_mm:.0} mm off the first one in the same pose"
            ),
        }
    }
}

/// What speaks against the same person: stature, and how far the surface is off.
pub fn doubts(first: &Visit, other: &Visit, growth: &[f64]) -> Vec<Doubt> {
    let stature = |v: &Visit| {
        let girths = &v.capture.girths;
        Some((
            10.0 * girths.stature?,
            10.0 * girths.stature_sigma.unwrap_or(0.0),
        ))
    };
    let statures = stature(first).zip(stature(other));
    doubts_of(statures, growth)
}

fn doubts_of(statures: Option<((f64, f64), (f64, f64))>, growth: &[f64]) -> Vec<Doubt> {
    let stature = statures.and_then(|(a, b)| {
        let off_mm = b.0 - a.0;
        let most_mm = libm::hypot(STATURE_MM, 1.96 * libm::hypot(a.1, b.1));
        (off_mm.abs() > most_mm).then_some(Doubt::Stature { off_mm, most_mm })
    });
    let far: Vec<f64> = growth.iter().map(|g| g.abs()).collect();
    let off_mm = shape::upper_median(&far).unwrap_or(0.0);
    let shape = (off_mm > FAR_MM).then_some(Doubt::Shape { off_mm });
    stature.into_iter().chain(shape).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stature_and_shape_speak_for_somebody_else_and_a_thicker_waist_does_not() {
        let near = Some(((1750.0, 4.0), (1738.0, 4.0)));
        let far = Some(((1750.0, 4.0), (1700.0, 4.0)));
        // A quarter of the surface grew by 30 mm.
        let grown: Vec<f64> = (0..100).map(|i| if i < 25 { 30.0 } else { 1.0 }).collect();
        assert_eq!(doubts_of(near, &grown), []);
        assert!(matches!(
            doubts_of(far, &grown)[..],
            [Doubt::Stature { .. }]
        ));
        assert!(
            matches!(doubts_of(None, &[-20.0; 9])[..], [Doubt::Shape { off_mm }] if off_mm == 20.0)
        );
    }
}
