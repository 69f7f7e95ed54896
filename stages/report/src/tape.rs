//! The tape around a section: the convex hull of its contour, in its plane (Andrew 1979).

use nalgebra::Vector3;

/// Corners of the tape, closed without repeating the first, in order around the normal. \[mm\]
pub(crate) fn around(contour: &[[f32; 3]], normal: [f64; 3]) -> Vec<[f32; 3]> {
    let n = Vector3::from(normal);
    let aside = if n.z.abs() < 0.9 {
        Vector3::z()
    } else {
        Vector3::x()
    };
    let u = n.cross(&aside).normalize();
    let v = n.cross(&u);
    let mut flat: Vec<(f64, f64, [f32; 3])> = contour
        .iter()
        .map(|p| {
            let at = Vector3::from(p.map(f64::from));
            (at.dot(&u), at.dot(&v), *p)
        })
        .collect();
    flat.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    flat.dedup_by(|a, b| a.0 == b.0 && a.1 == b.1);
    if flat.len() < 3 {
        return flat.into_iter().map(|p| p.2).collect();
    }
    let mut tape = half(flat.iter());
    tape.extend(half(flat.iter().rev()));
    tape
}

/// One half of the hull, without its last corner.
fn half<'a>(sorted: impl Iterator<Item = &'a (f64, f64, [f32; 3])>) -> Vec<[f32; 3]> {
    let mut kept: Vec<&(f64, f64, [f32; 3])> = Vec::new();
    for p in sorted {
        while let [.., a, b] = kept[..] {
            if (b.0 - a.0) * (p.1 - a.1) > (b.1 - a.1) * (p.0 - a.0) {
                break;
            }
            kept.pop();
        }
        kept.push(p);
    }
    kept.pop();
    kept.into_iter().map(|p| p.2).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proof::Dice;

    fn length(points: &[[f32; 3]]) -> f64 {
        let at = |i: usize| Vector3::from(points[i % points.len()].map(f64::from));
        (0..points.len()).map(|i| (at(i + 1) - at(i)).norm()).sum()
    }

    #[test]
    fn a_tape_spans_a_dent() {
        let square = [
            [0.0, 0.0, 5.0],
            [10.0, 0.0, 5.0],
            [5.0, 5.0, 5.0],
            [10.0, 10.0, 5.0],
            [0.0, 10.0, 5.0],
        ];
        let tape = around(&square, [0.0, 0.0, 1.0]);
        assert_eq!(tape.len(), 4);
        assert!((length(&tape) - 40.0).abs() < 1e-9);
    }

    #[test]
    fn a_tape_around_a_tilted_circle_with_points_inside_is_the_circle() {
        let (n, a) = (Vector3::new(0.6, 0.0, 0.8), Vector3::new(0.8, 0.0, -0.6));
        let b = n.cross(&a);
        let mut dice = Dice(3);
        let mut points = Vec::new();
        for i in 0..200 {
            let (s, c) = libm::sincos(f64::from(i) * std::f64::consts::TAU / 200.0);
            points.push((100.0 * (a * c + b * s)).cast::<f32>().into());
            let r = 90.0 * dice.unit();
            points.push((r * (a * s + b * c)).cast::<f32>().into());
        }
        let tape = around(&points, n.into());
        let chord = 200.0 * 200.0 * libm::sin(std::f64::consts::PI / 200.0);
        assert!((length(&tape) - chord).abs() < 1e-2, "{}", length(&tape));
    }
}
