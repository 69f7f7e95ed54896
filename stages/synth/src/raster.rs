//! Which of a mesh's points a camera sees, by rays through each pixel against projected triangles.

use nalgebra::{Point2, Vector3};
use shape::{Camera, Mesh, Pose};

/// What of the mesh one pixel shows.
#[derive(Debug, Clone, Copy, Default)]
pub struct Seen {
    /// Share of the pixel's rays that meet the mesh.
    pub cover: f64,
    /// Mean of the points that they meet, where they are at rest. \[mm\]
    pub at_rest: Vector3<f64>,
    /// Sum of the normals there, at rest; not of unit length.
    pub normal: Vector3<f64>,
    /// Mean distance along the optical axis. \[mm\]
    pub depth: f64,
    /// Mean of the colours there, red, green, blue, linear; `None` where the mesh has none.
    pub color: Option<[f32; 3]>,
}

impl Seen {
    /// One more ray, which meets a face at such weights of its corners; `light` is that of each level.
    fn add(
        &mut self,
        mesh: &Mesh,
        rest: &[[f32; 3]],
        normals: &[Vector3<f64>],
        light: &[f32],
        face: u32,
        weights: [f64; 3],
    ) {
        for (v, w) in mesh.faces[face as usize].iter().zip(weights) {
            let [x, y, z] = rest[*v as usize];
            self.at_rest += Vector3::new(f64::from(x), f64::from(y), f64::from(z)) * w;
            self.normal += normals[*v as usize] * w;
            if let Some(levels) = mesh.colors.get(*v as usize) {
                let sum = self.color.get_or_insert_default();
                (0..3).for_each(|c| sum[c] += w as f32 * light[usize::from(levels[c])]);
            }
        }
    }
}

/// Rows of pixels that are worked on at a time (structural: speed alone).
const BAND: usize = 32;
/// Rays so near to a triangle's box are still asked (structural: well above what numbers are rounded by). \[px\]
const SLACK: f64 = 1e-3;

/// A triangle in the camera's frame: ray d meets it where all `edges[i] · d` are not positive, at
/// the weights `edges[i] · d` over their sum and the depth `det` over their sum (Olano, Greer 1997).
struct Ready {
    face: u32,
    edges: [Vector3<f64>; 3],
    det: f64,
    /// Least and greatest column, least and greatest row. \[px\]
    columns: [usize; 2],
    rows: [usize; 2],
    /// Least and greatest place along a row and along a column at which a ray may meet it. \[px\]
    along: [f64; 2],
    down: [f64; 2],
}

impl Ready {
    /// The depth at which a ray meets it, and the weights of its first two corners there.
    #[inline]
    fn met(&self, [u, v]: [f64; 2]) -> Option<(f64, [f64; 2])> {
        let side = |e: &Vector3<f64>| e.x * u + e.y * v + e.z;
        let [e, f, g] = &self.edges;
        let (a, b, c) = (side(e), side(f), side(g));
        if a > 0.0 || b > 0.0 || c > 0.0 {
            return None;
        }
        let sum = a + b + c;
        (sum < 0.0).then(|| (self.det / sum, [a / sum, b / sum]))
    }
}

/// Which of so many rays a pixel, from the first to before the last, are between two places. \[px\]
fn between(
    [low, high]: [f64; 2],
    rays: usize,
    first: usize,
    last: usize,
) -> std::ops::Range<usize> {
    let ray = |place: f64| (place + 0.5) * rays as f64 - 0.5;
    let (from, to) = (ray(low).ceil().max(0.0), ray(high).floor().max(-1.0) + 1.0);
    first.max(from as usize)..last.min(to as usize)
}

/// Calls `each` with column, row and what is seen, for every pixel that shows the mesh.
///
/// `rest` is where the mesh's points are at rest, `motion` moves the mesh into the world; `rays` × `rays` rays go through a pixel. Only
/// faces that look at the camera are seen. Lens distortion is exact at every ray.
pub fn cast(
    (mesh, rest): (&Mesh, &[[f32; 3]]),
    normals: &[Vector3<f64>],
    camera: &Camera,
    motion: Option<&Pose>,
    rays: usize,
    mut each: impl FnMut(usize, usize, &Seen),
) {
    let (width, height) = (camera.lens.width as usize, camera.lens.height as usize);
    let bands = height.div_ceil(BAND);
    let triangles = ready(mesh, camera, motion);
    let light = shape::light_of_levels();
    let mut bins: Vec<Vec<u32>> = vec![vec![]; bands];
    for (i, t) in triangles.iter().enumerate() {
        (t.rows[0] / BAND..=t.rows[1] / BAND).for_each(|b| bins[b].push(i as u32));
    }
    let step = 1.0 / rays as f64;
    let place = |k: usize| (k as f64 + 0.5) * step - 0.5;
    let fine = width * rays;
    for (b, bin) in bins.iter().enumerate().filter(|(_, bin)| !bin.is_empty()) {
        let (top, bottom) = (b * BAND, ((b + 1) * BAND).min(height));
        let left = bin.iter().map(|i| triangles[*i as usize].columns[0]).min();
        let right = bin.iter().map(|i| triangles[*i as usize].columns[1]).max();
        let (left, right) = (left.unwrap_or(0), right.unwrap_or(0));
        let mut direction = vec![[0.0; 2]; fine * (bottom - top) * rays];
        for y in 0..(bottom - top) * rays {
            for x in left * rays..(right + 1) * rays {
                let px = Point2::new(place(x), top as f64 + place(y));
                direction[y * fine + x] = camera.lens.undistort(px).into();
            }
        }
        // Depth, face and its first two weights at each ray.
        let mut nearest = vec![(f64::MAX, u32::MAX, 0.0, 0.0); direction.len()];
        for t in bin.iter().map(|i| &triangles[*i as usize]) {
            let (first, last) = (t.rows[0].max(top), t.rows[1].min(bottom - 1) + 1);
            let columns = between(
                t.along,
                rays,
                t.columns[0] * rays,
                (t.columns[1] + 1) * rays,
            );
            for y in between(t.down, rays, first * rays, last * rays) {
                let row = (y - top * rays) * fine;
                for x in columns.clone() {
                    if let Some((depth, [a, b])) = t.met(direction[row + x])
                        && depth < nearest[row + x].0
                    {
                        nearest[row + x] = (depth, t.face, a, b);
                    }
                }
            }
        }
        for y in top..bottom {
            for x in left..=right {
                let mut seen = Seen::default();
                for k in 0..rays * rays {
                    let at = ((y - top) * rays + k / rays) * fine + x * rays + k % rays;
                    let (depth, face, a, b) = nearest[at];
                    if face == u32::MAX {
                        continue;
                    }
                    seen.add(mesh, rest, normals, &light, face, [a, b, 1.0 - a - b]);
                    seen.depth += depth;
                    seen.cover += 1.0;
                }
                if seen.cover > 0.0 {
                    seen.at_rest /= seen.cover;
                    seen.depth /= seen.cover;
                    let count = seen.cover as f32;
                    seen.color = seen.color.map(|sum| sum.map(|c| c / count));
                    seen.cover *= step * step;
                    each(x, y, &seen);
                }
            }
        }
    }
}

/// The triangles that look at the camera and are before it, on its photo.
fn ready(mesh: &Mesh, camera: &Camera, motion: Option<&Pose>) -> Vec<Ready> {
    let (width, height) = (f64::from(camera.lens.width), f64::from(camera.lens.height));
    let place = |v: u32| {
        let rest = mesh.point(v);
        let world = motion.map_or(rest.coords, |m| m.apply(&rest));
        let x = camera.pose.apply(&world.into());
        (x, camera.lens.project(&x))
    };
    let placed: Vec<_> = (0..mesh.positions.len() as u32).map(place).collect();
    // Where the lens bends, edges are curved a little between corners.
    let bend = if camera.lens.radial == [0.0; 2] {
        0.0
    } else {
        1.0
    };
    let mut triangles = Vec::new();
    for (face, corners) in mesh.faces.iter().enumerate() {
        let [(a, pa), (b, pb), (c, pc)] = corners.map(|v| placed[v as usize]);
        let (Some(pa), Some(pb), Some(pc)) = (pa, pb, pc) else {
            continue;
        };
        let edges = [b.cross(&c), c.cross(&a), a.cross(&b)];
        let det = a.dot(&edges[0]);
        if det >= 0.0 {
            continue;
        }
        let range = |pick: fn(&Point2<f64>) -> f64, size: f64| {
            let least = pick(&pa).min(pick(&pb)).min(pick(&pc));
            let most = pick(&pa).max(pick(&pb)).max(pick(&pc));
            let (low, high) = (least - 0.5 - bend, most + 0.5 + bend);
            let inside = high >= 0.0 && low <= size - 1.0;
            let whole = |x: f64| x.clamp(0.0, size - 1.0) as usize;
            let rays = [least - SLACK - 2.0 * bend, most + SLACK + 2.0 * bend];
            inside.then(|| ([whole(low.floor()), whole(high.ceil())], rays))
        };
        let (across, up) = (range(|p| p.x, width), range(|p| p.y, height));
        if let (Some((columns, along)), Some((rows, down))) = (across, up) {
            triangles.push(Ready {
                face: face as u32,
                edges,
                det,
                columns,
                rows,
                along,
                down,
            });
        }
    }
    triangles
}
