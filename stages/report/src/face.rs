//! Faces made unrecognisable, on photos and on what photos painted.

use nalgebra::{Point2, Point3};
use shape::{Camera, Landmarks, Mesh, Part, Rgb, Textured};

/// Of the body's height, what is taken for the head where no neck was found: an infant's and more. By hand: not on
/// record.
const TOP_SHARE: f64 = 0.3;
/// What is so near the head belongs to it. By hand: not on record. \[mm\]
const MARGIN_MM: f64 = 15.0;
/// What is painted over (structural: a colour).
const GRAY: [u8; 3] = [128; 3];

/// Points of the head, on the surface. \[mm\] Empty only for an empty surface.
pub(crate) fn head(body: &Mesh, landmarks: Option<&Landmarks>) -> Vec<Point3<f64>> {
    let all = || 0..body.positions.len() as u32;
    let fits = landmarks.filter(|l| l.parts.len() == body.positions.len());
    let found: Vec<_> = match fits {
        Some(l) => all()
            .filter(|v| l.parts[*v as usize] == Part::Head as u8)
            .map(|v| body.point(v))
            .collect(),
        None => vec![],
    };
    if !found.is_empty() {
        return found;
    }
    let Some((lo, hi)) = body.bounds() else {
        return vec![];
    };
    let low = hi.z - TOP_SHARE * (hi.z - lo.z);
    let points = all().map(|v| body.point(v));
    points.filter(|p| p.z >= low).collect()
}

/// Where the head is on a photo. \[px\]
pub(crate) fn on_photo(head: &[Point3<f64>], camera: &Camera) -> Vec<Point2<f64>> {
    head.iter().filter_map(|p| camera.project(p)).collect()
}

/// Makes the part around some pixels of the photo unrecognisable: big blocks of one colour.
pub(crate) fn blur(photo: &mut Rgb, at_px: &[Point2<f64>]) {
    let Some((lo, hi)) = bounds(at_px) else {
        return;
    };
    let tall = hi.y - lo.y;
    let (margin, block) = (tall * 0.1, (tall / 6.0).max(8.0) as usize);
    let clamp = |x: f64, size: usize| x.clamp(0.0, size as f64) as usize;
    let (x0, x1) = (
        clamp(lo.x - margin, photo.width),
        clamp(hi.x + margin, photo.width),
    );
    let (y0, y1) = (
        clamp(lo.y - margin, photo.height),
        clamp(hi.y + margin, photo.height),
    );
    let corners = (y0..y1).step_by(block);
    for (by, bx) in corners.flat_map(|y| (x0..x1).step_by(block).map(move |x| (y, x))) {
        let (ey, ex) = ((by + block).min(y1), (bx + block).min(x1));
        let mut sum = [0u64; 3];
        let pixels = (by..ey).flat_map(|y| (bx..ex).map(move |x| (x, y)));
        for (x, y) in pixels.clone() {
            (0..3).for_each(|c| sum[c] += u64::from(photo.at(x, y)[c]));
        }
        let mean = sum.map(|s| (s / ((ey - by) * (ex - bx)) as u64) as u8);
        pixels.for_each(|(x, y)| *photo.at_mut(x, y) = mean);
    }
}

fn bounds(at_px: &[Point2<f64>]) -> Option<(Point2<f64>, Point2<f64>)> {
    let first = *at_px.first()?;
    let wider = |(lo, hi): (Point2<f64>, Point2<f64>), p: &Point2<f64>| (lo.inf(p), hi.sup(p));
    Some(at_px.iter().fold((first, first), wider))
}

/// The box around the head in which nothing keeps its colour. \[mm\]
pub(crate) struct HeadBox(Option<(Point3<f64>, Point3<f64>)>);

impl HeadBox {
    /// Around these points.
    pub(crate) fn new(head: &[Point3<f64>]) -> Self {
        let Some(first) = head.first() else {
            return HeadBox(None);
        };
        let wider = |(lo, hi): (Point3<f64>, Point3<f64>), p: &Point3<f64>| (lo.inf(p), hi.sup(p));
        let (lo, hi) = head.iter().fold((*first, *first), wider);
        HeadBox(Some((
            lo.coords.add_scalar(-MARGIN_MM).into(),
            hi.coords.add_scalar(MARGIN_MM).into(),
        )))
    }

    fn holds(&self, p: &Point3<f64>) -> bool {
        let Some((lo, hi)) = self.0 else {
            return false;
        };
        (0..3).all(|i| (lo[i]..=hi[i]).contains(&p[i]))
    }

    /// The mesh with a gray head.
    pub(crate) fn without_colors(&self, mesh: &Mesh) -> Mesh {
        let mut plain = mesh.clone();
        for (v, color) in (0u32..).zip(&mut plain.colors) {
            if self.holds(&mesh.point(v)) {
                *color = GRAY;
            }
        }
        plain
    }

    /// The textured mesh with a gray head: of its atlas only what other faces show is kept.
    pub(crate) fn without_atlas(&self, body: &Textured) -> Textured {
        let (w, h) = (body.atlas.width, body.atlas.height);
        let mut atlas = Rgb::filled(w, h, GRAY);
        for (face, uv) in body.mesh.faces.iter().zip(&body.corners) {
            if face.iter().any(|v| self.holds(&body.mesh.point(*v))) {
                continue;
            }
            let at = uv.map(|[u, v]| {
                Point2::new(f64::from(u) * w as f64 - 0.5, f64::from(v) * h as f64 - 0.5)
            });
            for (x, y) in pixels(&at, w, h) {
                *atlas.at_mut(x, y) = body.atlas.at(x, y);
            }
        }
        Textured {
            mesh: self.without_colors(&body.mesh),
            corners: body.corners.clone(),
            atlas,
        }
    }
}

/// The pixels that a triangle shows when sampled bilinearly: those within a pixel of it.
fn pixels(
    triangle: &[Point2<f64>; 3],
    width: usize,
    height: usize,
) -> impl Iterator<Item = (usize, usize)> + use<> {
    let t = *triangle;
    let (lo, hi) = bounds(&t).unwrap_or_default();
    let first = |x: f64| (x - 1.0).floor().max(0.0) as usize;
    let last = |x: f64, size: usize| ((x + 2.0).ceil().max(0.0) as usize).min(size);
    let rows = first(lo.y)..last(hi.y, height);
    let columns = first(lo.x)..last(hi.x, width);
    let turn = (t[1] - t[0]).perp(&(t[2] - t[0])).signum();
    let near = move |x: usize, y: usize| {
        let p = Point2::new(x as f64, y as f64);
        (0..3).all(|i| {
            let side = t[(i + 1) % 3] - t[i];
            turn * side.perp(&(p - t[i])) >= -1.5 * side.norm()
        })
    };
    rows.flat_map(move |y| columns.clone().map(move |x| (x, y)))
        .filter(move |(x, y)| near(*x, *y))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_blurred_face_is_a_few_blocks() {
        let data = (0..100 * 100)
            .map(|i| [(i * 7 % 251) as u8, (i * 13 % 241) as u8, 9])
            .collect();
        let mut photo = Rgb {
            width: 100,
            height: 100,
            data,
        };
        let before = photo.clone();
        blur(
            &mut photo,
            &[Point2::new(30.0, 30.0), Point2::new(60.0, 60.0)],
        );
        let mut colors: Vec<_> = (30..60)
            .flat_map(|y| photo.row(y)[30..60].to_vec())
            .collect();
        colors.sort_unstable();
        colors.dedup();
        assert!(colors.len() <= 36, "{}", colors.len());
        assert_eq!(photo.at(5, 5), before.at(5, 5));
    }

    #[test]
    fn an_atlas_forgets_the_head_and_keeps_the_rest() {
        let positions = vec![
            [0.0, 0.0, 0.0],
            [100.0, 0.0, 0.0],
            [0.0, 100.0, 0.0],
            [0.0, 0.0, 900.0],
            [100.0, 0.0, 900.0],
            [0.0, 100.0, 900.0],
        ];
        let mesh = Mesh {
            positions,
            faces: vec![[0, 1, 2], [3, 4, 5]],
            colors: vec![[9; 3]; 6],
            ..Mesh::default()
        };
        let corners = vec![
            [[0.0, 0.0], [0.4, 0.0], [0.0, 1.0]],
            [[1.0, 1.0], [0.6, 1.0], [1.0, 0.0]],
        ];
        let body = Textured {
            mesh,
            corners,
            atlas: Rgb::filled(40, 40, [7, 8, 9]),
        };
        let head = HeadBox::new(&head(&body.mesh, None));
        let plain = head.without_atlas(&body);
        assert_eq!(plain.atlas.at(2, 2), [7, 8, 9]);
        assert_eq!(plain.atlas.at(37, 37), GRAY);
        assert_eq!(plain.mesh.colors[0], [9; 3]);
        assert_eq!(plain.mesh.colors[4], GRAY);
    }
}
