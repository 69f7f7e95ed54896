//! A surface that is placed differently, aligned to the first: turned and moved as a whole.

use super::surfaces::{Apart, apart};
use follow::{Halves, Target, rigid};
use shape::Mesh;

/// A surface laid on the first.
#[derive(Debug, Clone, PartialEq)]
pub struct Laid {
    /// How far it was turned. \[°\]
    pub turned_deg: f64,
    /// How far its middle was moved. \[mm\]
    pub moved_mm: f64,
    /// How far it is from the first then.
    pub apart: Apart,
    /// The surface, moved.
    pub mesh: Mesh,
}

/// Surfaces that are nearer than this for nineteen twentieths are placed alike. \[mm\]
const ALIKE_MM: f64 = 5.0;

/// Aligns the second surface to the first where, as they are, they are farther apart than two measurements of one body that
/// is placed alike; `None` where they are not, or where that does not bring them nearer.
pub fn laid(first: &Mesh, other: &Mesh, unmoved: &Apart) -> Option<Laid> {
    if unmoved.p95_mm < ALIKE_MM || first.faces.is_empty() || other.faces.is_empty() {
        return None;
    }
    let motion = rigid(other, &Target::new(first), Halves::Both);
    let at = |v: u32| (motion * other.point(v)).coords.map(|x| x as f32).into();
    let mesh = Mesh {
        positions: (0..other.positions.len() as u32).map(at).collect(),
        ..other.clone()
    };
    let middle = other.bounds().map(|(a, b)| nalgebra::center(&a, &b))?;
    let apart = apart(first, &mesh);
    (apart.mean_mm < 0.9 * unmoved.mean_mm).then(|| Laid {
        turned_deg: motion.rotation.angle().to_degrees(),
        moved_mm: (motion * middle - middle).norm(),
        apart,
        mesh,
    })
}
