//! The point of a mesh that is closest to a given one, exactly: a tree of boxes over triangles.

use nalgebra::Point3;
use shape::Mesh;

/// A mesh prepared for queries.
pub struct Closest<'a> {
    mesh: &'a Mesh,
    /// Faces in the order of the leaves.
    order: Vec<u32>,
    nodes: Vec<Node>,
}

/// A box over `order[first..first + count]`; inner nodes have count 0 and children at
/// `first` and `first + 1`.
struct Node {
    lo: [f32; 3],
    hi: [f32; 3],
    first: u32,
    count: u32,
}

/// What was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// How far away. \[mm\]
    pub distance: f64,
    /// The closest point. \[mm\]
    pub point: Point3<f64>,
    /// The face it is on.
    pub face: usize,
}

/// Points of a leaf (structural: the tree's form).
const LEAF: usize = 4;

impl<'a> Closest<'a> {
    /// Of a valid mesh with at least one face.
    pub fn new(mesh: &'a Mesh) -> Self {
        let mut order: Vec<u32> = (0..mesh.faces.len() as u32).collect();
        let centre = |f: u32, axis: usize| -> f32 {
            mesh.faces[f as usize]
                .iter()
                .map(|v| mesh.positions[*v as usize][axis])
                .sum()
        };
        let mut nodes = vec![bounds(mesh, &order, 0)];
        let mut open = vec![0usize];
        while let Some(at) = open.pop() {
            let (first, count) = (nodes[at].first as usize, nodes[at].count as usize);
            if count <= LEAF {
                continue;
            }
            let size: Vec<f32> = (0..3).map(|i| nodes[at].hi[i] - nodes[at].lo[i]).collect();
            let axis = (0..3).fold(0, |best, i| if size[i] > size[best] { i } else { best });
            let half = count / 2;
            order[first..first + count].select_nth_unstable_by(half, |a, b| {
                centre(*a, axis).total_cmp(&centre(*b, axis)).then(a.cmp(b))
            });
            let left = nodes.len();
            nodes.push(bounds(mesh, &order[first..first + half], first));
            nodes.push(bounds(
                mesh,
                &order[first + half..first + count],
                first + half,
            ));
            (nodes[at].first, nodes[at].count) = (left as u32, 0);
            open.extend([left, left + 1]);
        }
        Closest { mesh, order, nodes }
    }

    /// The closest point. [`None`] for a mesh without faces.
    pub fn to(&self, q: &Point3<f64>) -> Option<Hit> {
        let mut best: Option<Hit> = None;
        let mut open = vec![(self.box_distance(0, q), 0u32)];
        while let Some((near, at)) = open.pop() {
            if best.is_some_and(|b| near >= b.distance) {
                continue;
            }
            let node = &self.nodes[at as usize];
            if node.count == 0 && !self.order.is_empty() && self.nodes.len() > 1 {
                let mut children =
                    [node.first, node.first + 1].map(|c| (self.box_distance(c as usize, q), c));
                if children[0].0 < children[1].0 {
                    children.swap(0, 1);
                }
                open.extend(children);
                continue;
            }
            for f in &self.order[node.first as usize..(node.first + node.count) as usize] {
                let point = on_triangle(q, &self.mesh.triangle(*f as usize));
                let distance = (point - q).norm();
                if best.is_none_or(|b| distance < b.distance) {
                    best = Some(Hit {
                        distance,
                        point,
                        face: *f as usize,
                    });
                }
            }
        }
        best
    }

    /// Distance to the closest point, negative inside (by the face's normal). \[mm\]
    pub fn signed(&self, q: &Point3<f64>) -> Option<f64> {
        let hit = self.to(q)?;
        let outward = self.mesh.area_vector(hit.face).dot(&(q - hit.point)) >= 0.0;
        Some(if outward { hit.distance } else { -hit.distance })
    }

    fn box_distance(&self, node: usize, q: &Point3<f64>) -> f64 {
        let Node { lo, hi, .. } = &self.nodes[node];
        let beyond = |i: usize| {
            (f64::from(lo[i]) - q[i])
                .max(q[i] - f64::from(hi[i]))
                .max(0.0)
        };
        (0..3).map(|i| beyond(i) * beyond(i)).sum::<f64>().sqrt()
    }
}

/// The box over some faces.
fn bounds(mesh: &Mesh, faces: &[u32], first: usize) -> Node {
    let (mut lo, mut hi) = ([f32::MAX; 3], [f32::MIN; 3]);
    for v in faces.iter().flat_map(|f| mesh.faces[*f as usize]) {
        let p = mesh.positions[v as usize];
        (0..3).for_each(|i| (lo[i], hi[i]) = (lo[i].min(p[i]), hi[i].max(p[i])));
    }
    Node {
        lo,
        hi,
        first: first as u32,
        count: faces.len() as u32,
    }
}

/// The point of a triangle closest to `q` (Ericson 2005, Real-Time Collision Detection, §5.1.5).
fn on_triangle(q: &Point3<f64>, [a, b, c]: &[Point3<f64>; 3]) -> Point3<f64> {
    let (ab, ac, aq) = (b - a, c - a, q - a);
    let (d1, d2) = (ab.dot(&aq), ac.dot(&aq));
    if d1 <= 0.0 && d2 <= 0.0 {
        return *a;
    }
    let bq = q - b;
    let (d3, d4) = (ab.dot(&bq), ac.dot(&bq));
    if d3 >= 0.0 && d4 <= d3 {
        return *b;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return a + ab * (d1 / (d1 - d3));
    }
    let cq = q - c;
    let (d5, d6) = (ab.dot(&cq), ac.dot(&cq));
    if d6 >= 0.0 && d5 <= d6 {
        return *c;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return a + ac * (d2 / (d2 - d6));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    let sum = va + vb + vc;
    if sum.abs() < f64::MIN_POSITIVE {
        return *a;
    }
    a + ab * (vb / sum) + ac * (vc / sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tree_agrees_with_looking_at_every_face() {
        let mut dice = proof::Dice(7);
        let mut point = |reach: f64| [0; 3].map(|_| dice.within(-reach, reach) as f32);
        let positions: Vec<_> = (0..120).map(|_| point(100.0)).collect();
        let faces = (0..200u32).map(|i| [i * 7 % 120, (i * 11 + 1) % 120, (i * 13 + 2) % 120]);
        let faces = faces
            .filter(|[a, b, c]| a != b && b != c && c != a)
            .collect();
        let mesh = Mesh {
            positions,
            faces,
            ..Mesh::default()
        };
        let tree = Closest::new(&mesh);
        for _ in 0..300 {
            let q = Point3::from(point(200.0).map(f64::from));
            let plain = (0..mesh.faces.len())
                .map(|f| (on_triangle(&q, &mesh.triangle(f)) - q).norm())
                .fold(f64::MAX, f64::min);
            assert_eq!(tree.to(&q).unwrap().distance, plain);
        }
    }

    #[test]
    fn a_mesh_without_faces_has_no_closest_point() {
        let mesh = Mesh::default();
        assert_eq!(Closest::new(&mesh).to(&Point3::origin()), None);
    }
}
