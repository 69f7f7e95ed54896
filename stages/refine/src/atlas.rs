//! Charts of one photo each, packed onto one picture.

use crate::labels::{NOWHERE, neighbours};
use shape::Mesh;

/// Faces that lie side by side and take their colours from one photo.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    /// The photo; [`NOWHERE`] for faces that none shows.
    pub photo: u16,
    /// The faces, ascending.
    pub faces: Vec<u32>,
}

/// Groups faces into charts, in the order of their least face. All that no photo shows is one.
pub fn charts(mesh: &Mesh, labels: &[u16]) -> Vec<Chart> {
    let beside = neighbours(mesh);
    let mut taken = vec![false; labels.len()];
    let mut charts = Vec::new();
    for first in 0..labels.len() {
        if taken[first] || labels[first] == NOWHERE {
            continue;
        }
        let (mut faces, mut at) = (vec![first as u32], 0);
        taken[first] = true;
        while let Some(f) = faces.get(at).copied() {
            at += 1;
            for g in &beside[f as usize] {
                if !taken[*g as usize] && labels[*g as usize] == labels[first] {
                    taken[*g as usize] = true;
                    faces.push(*g);
                }
            }
        }
        faces.sort_unstable();
        charts.push(Chart {
            photo: labels[first],
            faces,
        });
    }
    let rest: Vec<u32> = (0..labels.len() as u32)
        .filter(|f| labels[*f as usize] == NOWHERE)
        .collect();
    if !rest.is_empty() {
        charts.push(Chart {
            photo: NOWHERE,
            faces: rest,
        });
    }
    charts
}

/// Where boxes of these sizes lie on a square, side by side on shelves, and by what they were
/// shrunk to fit. \[px\] Sizes are those at full scale; `margin` is left around each.
pub fn packed(sizes: &[[f64; 2]], side: usize, margin: usize) -> (Vec<[usize; 2]>, f64) {
    let mut order: Vec<usize> = (0..sizes.len()).collect();
    order.sort_by(|a, b| sizes[*b][1].total_cmp(&sizes[*a][1]).then(a.cmp(b)));
    let area: f64 = sizes.iter().map(|s| s[0] * s[1]).sum();
    let mut scale = ((side * side) as f64 / area.max(1.0)).sqrt().min(1.0);
    loop {
        let mut places = vec![[0, 0]; sizes.len()];
        let (mut x, mut y, mut shelf, mut fits) = (0, 0, 0, true);
        for i in &order {
            let [w, h] = sizes[*i].map(|s| (s * scale).ceil() as usize + 1 + 2 * margin);
            if x + w > side {
                (x, y, shelf) = (0, y + shelf, 0);
            }
            fits &= w <= side && y + h <= side;
            places[*i] = [x + margin, y + margin];
            x += w;
            shelf = shelf.max(h);
        }
        if fits || scale < 1e-3 {
            return (places, scale);
        }
        scale *= 0.95;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_lie_apart_and_within_the_square() {
        let mut dice = proof::Dice(4);
        let sizes: Vec<_> = (0..60)
            .map(|_| [dice.within(2.0, 300.0), dice.within(2.0, 500.0)])
            .collect();
        let (places, scale) = packed(&sizes, 512, 2);
        assert!(scale > 0.05 && scale <= 1.0);
        let mut used = vec![false; 512 * 512];
        for (p, s) in places.iter().zip(&sizes) {
            for y in p[1]..p[1] + (s[1] * scale).ceil() as usize {
                for x in p[0]..p[0] + (s[0] * scale).ceil() as usize {
                    assert!(
                        !std::mem::replace(&mut used[y * 512 + x], true),
                        "two boxes share a pixel"
                    );
                }
            }
        }
    }

    #[test]
    fn every_face_is_on_one_chart() {
        let mesh = crate::solids::sphere(10.0, 3);
        let labels: Vec<u16> = (0..mesh.faces.len())
            .map(|f| {
                if mesh.triangle(f)[0].z > 0.0 {
                    0
                } else if f % 7 == 0 {
                    NOWHERE
                } else {
                    1
                }
            })
            .collect();
        let charts = charts(&mesh, &labels);
        let mut all: Vec<u32> = charts.iter().flat_map(|c| c.faces.clone()).collect();
        all.sort_unstable();
        assert!(all.iter().copied().eq(0..mesh.faces.len() as u32));
        assert!(
            charts
                .iter()
                .all(|c| c.faces.iter().all(|f| labels[*f as usize] == c.photo))
        );
    }
}
