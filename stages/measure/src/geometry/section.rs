//! The exact intersection of a plane and a closed mesh, as closed curves.

use nalgebra::{Point3, Unit, Vector3};
use shape::{Mesh, Plane};

/// A closed curve in a plane, without repeating its first point. \[mm\]
pub type Loop = Vec<Point3<f64>>;

/// Two directions that span a plane; with its normal they are right-handed.
pub fn axes(plane: &Plane) -> (Vector3<f64>, Vector3<f64>) {
    let n = Vector3::from(plane.normal).normalize();
    let other = if n.z.abs() > 0.9 {
        Vector3::x()
    } else {
        Vector3::z()
    };
    let u = Unit::new_normalize(other - n * n.dot(&other)).into_inner();
    (u, n.cross(&u))
}

/// The curves in which a plane cuts a mesh. A vertex in the plane counts as above it, so every
/// curve of a closed mesh closes.
pub fn section(mesh: &Mesh, plane: &Plane) -> Vec<Loop> {
    let (n, p) = (
        Vector3::from(plane.normal).normalize(),
        Point3::from(plane.point_mm),
    );
    let height: Vec<f64> = (0..mesh.positions.len() as u32)
        .map(|v| n.dot(&(mesh.point(v) - p)))
        .collect();
    loops(mesh, mesh.faces.iter(), |v| height[v as usize])
}

/// The closed curves in which a plane cuts some faces of a mesh; curves that end where those faces
/// do are left out.
pub(crate) fn section_of(mesh: &Mesh, faces: &[u32], plane: &Plane) -> Vec<Loop> {
    let (n, p) = (
        Vector3::from(plane.normal).normalize(),
        Point3::from(plane.point_mm),
    );
    let faces = faces.iter().map(|f| &mesh.faces[*f as usize]);
    loops(mesh, faces, |v| n.dot(&(mesh.point(v) - p)))
}

/// Closed curves of faces where a height over vertices is nought.
fn loops<'a>(
    mesh: &Mesh,
    faces: impl Iterator<Item = &'a [u32; 3]>,
    height: impl Fn(u32) -> f64,
) -> Vec<Loop> {
    // Each cut face gives a piece from one cut edge to another; edges are named by their ends.
    let mut pieces: Vec<(Edge, Edge)> = Vec::new();
    for face in faces {
        let [a, b, c] = *face;
        let above = [height(a) >= 0.0, height(b) >= 0.0, height(c) >= 0.0];
        if above[0] == above[1] && above[1] == above[2] {
            continue;
        }
        let (mut enters, mut leaves) = (None, None);
        for i in 0..3 {
            let (a, b) = (face[i], face[(i + 1) % 3]);
            let edge = (a.min(b), a.max(b));
            match (above[i], above[(i + 1) % 3]) {
                (false, true) => enters = Some(edge),
                (true, false) => leaves = Some(edge),
                _ => {}
            }
        }
        pieces.extend(leaves.zip(enters));
    }
    let place = |(a, b): Edge| {
        let (ha, hb) = (height(a), height(b));
        let (pa, pb) = (mesh.point(a), mesh.point(b));
        pa + (pb - pa) * (ha / (ha - hb))
    };
    let curves = joined(pieces).into_iter();
    curves
        .map(|curve| curve.into_iter().map(place).collect())
        .collect()
}

/// An edge of a mesh, named by its ends, the lesser first.
type Edge = (u32, u32);

/// Pieces from one edge to another, joined where they close; of two from one edge, the last. Curves begin at their least edge, in order.
fn joined(mut pieces: Vec<(Edge, Edge)>) -> Vec<Vec<Edge>> {
    pieces.reverse();
    pieces.sort_by_key(|(from, _)| *from);
    pieces.dedup_by_key(|(from, _)| *from);
    let mut left = vec![true; pieces.len()];
    let mut curves = Vec::new();
    for begin in 0..pieces.len() {
        let start = pieces[begin].0;
        let (mut curve, mut at) = (Vec::new(), start);
        while let Ok(k) = pieces.binary_search_by_key(&at, |(from, _)| *from) {
            if !std::mem::take(&mut left[k]) {
                break;
            }
            curve.push(at);
            at = pieces[k].1;
        }
        if at == start && curve.len() >= 3 {
            curves.push(curve);
        }
    }
    curves
}

/// The points in the plane's own two coordinates. \[mm\]
pub fn flat(curve: &[Point3<f64>], plane: &Plane) -> Vec<[f64; 2]> {
    let (u, v) = axes(plane);
    let p = Point3::from(plane.point_mm);
    curve
        .iter()
        .map(|x| [u.dot(&(x - p)), v.dot(&(x - p))])
        .collect()
}

/// Length of a closed polygon. \[mm\]
pub fn length(points: &[[f64; 2]]) -> f64 {
    let n = points.len();
    (0..n)
        .map(|i| {
            libm::hypot(
                points[(i + 1) % n][0] - points[i][0],
                points[(i + 1) % n][1] - points[i][1],
            )
        })
        .sum()
}

/// Signed area of a closed polygon. \[mm²\]
pub fn area(points: &[[f64; 2]]) -> f64 {
    let n = points.len();
    let cross =
        |i: usize| points[i][0] * points[(i + 1) % n][1] - points[(i + 1) % n][0] * points[i][1];
    (0..n).map(cross).sum::<f64>() / 2.0
}

/// The convex hull, counter-clockwise (Andrew 1979).
pub fn hull(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let turns = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| {
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    };
    let chain = |points: &mut dyn Iterator<Item = [f64; 2]>| {
        let mut chain: Vec<[f64; 2]> = Vec::new();
        for p in points {
            while chain.len() >= 2
                && turns(chain[chain.len() - 2], chain[chain.len() - 1], p) <= 0.0
            {
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut hull = chain(&mut sorted.iter().copied());
    hull.extend(chain(&mut sorted.iter().rev().copied()));
    hull
}

/// A convex polygon without what is beyond a line (Sutherland and Hodgman 1974).
pub(crate) fn clipped(points: &[[f64; 2]], n: [f64; 2], reach: f64) -> Vec<[f64; 2]> {
    let off = |p: &[f64; 2]| n[0] * p[0] + n[1] * p[1] - reach;
    let mut out = Vec::with_capacity(points.len() + 2);
    for (i, a) in points.iter().enumerate() {
        let b = &points[(i + 1) % points.len()];
        let (da, db) = (off(a), off(b));
        if da <= 0.0 {
            out.push(*a);
        }
        if (da < 0.0 && db > 0.0) || (da > 0.0 && db < 0.0) {
            let t = da / (da - db);
            out.push([a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]);
        }
    }
    out
}

/// Length of a tape around points of a plane: of their convex hull. \[mm\]
pub fn tape(points: &[[f64; 2]]) -> f64 {
    length(&hull(points))
}

/// Mean of a curve's points, weighted by length; the origin for a curve without points. \[mm\]
pub fn centre(curve: &[Point3<f64>]) -> Point3<f64> {
    let n = curve.len();
    let (mut sum, mut total) = (Vector3::zeros(), 0.0);
    for i in 0..n {
        let (a, b) = (curve[i], curve[(i + 1) % n]);
        let weight = (b - a).norm();
        sum += (a.coords + b.coords) / 2.0 * weight;
        total += weight;
    }
    Point3::from(if total > 0.0 {
        sum / total
    } else {
        curve.first().map_or(Vector3::zeros(), |p| p.coords)
    })
}
