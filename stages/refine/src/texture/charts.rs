//! Charts: faces side by side of one photo.

use shape::Mesh;

/// No photo shows the face (structural).
pub const NOWHERE: u16 = u16::MAX;

/// Faces side by side that take their colours from one photo.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    /// The photo; [`NOWHERE`] for faces that none shows.
    pub photo: u16,
    /// The faces, ascending.
    pub faces: Vec<u32>,
}

/// Groups faces, each `beside` some, into charts, in the order of their least face.
pub fn charts(beside: &[Vec<u32>], labels: &[u16]) -> Vec<Chart> {
    let mut taken = vec![false; labels.len()];
    let mut charts = Vec::new();
    for first in 0..labels.len() {
        if taken[first] {
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
    charts
}

/// The faces across each face's edges.
pub fn neighbours(mesh: &Mesh) -> Vec<Vec<u32>> {
    let mut half: Vec<(u32, u32, u32)> = Vec::with_capacity(mesh.faces.len() * 3);
    for (f, &[a, b, c]) in mesh.faces.iter().enumerate() {
        half.extend([(a, b), (b, c), (c, a)].map(|(a, b)| (a.min(b), a.max(b), f as u32)));
    }
    half.sort_unstable();
    let mut beside = vec![Vec::with_capacity(3); mesh.faces.len()];
    for pair in half.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        if let [a, b] = pair {
            beside[a.2 as usize].push(b.2);
            beside[b.2 as usize].push(a.2);
        }
    }
    beside
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_face_is_on_one_chart() {
        let mesh = crate::geometry::solids::sphere(10.0, 3);
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
        let charts = charts(&neighbours(&mesh), &labels);
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
