//! The stage that paints the surface from the photos (paper, Fig. 4 d, g, h).

use crate::pictures::picture::Picture;
use crate::pictures::turn::{PhotoSize, TurnInput};
use crate::texture::ahead::Ahead;
use crate::texture::atlas::{Sheet, packed};
use crate::texture::charts::{NOWHERE, charts, neighbours};
use crate::texture::labels::labels;
use nalgebra::{Point2, SVector, Vector3};
use rayon::prelude::*;
use shape::{Adjacency, Camera, LOOKED_AT_MPX, Mesh, PhotoId, Photos, Rgb, Textured};
use stage::{Ctx, Stage, Stop};

stage::params! {
    /// How the surface is painted.
    pub struct TextureParams {
        /// Side of the atlas.
        #[range(64..=16384)]
        #[source(structural)]
        atlas_px: u32 = 2048,
        /// Rounds in which neighbours agree on a photo.
        #[range(0..=100)]
        #[source(structural)]
        rounds: u32 = 12,
        /// Whether brightness is evened out where photos meet.
        even: bool = true,
    }
}

/// A surface and its photos.
pub type TextureInput = TurnInput;

/// `refine.texture`: mesh, photos, cameras, masks → textured mesh.
pub struct Texture;

/// Margin around a chart (structural: what bilinear reading reaches, and its rounding). \[px\]
const MARGIN: usize = 2;

/// The photos by which faces are given to photos.
const SMALL: PhotoSize = PhotoSize {
    level: 0,
    most_mpx: 2.0,
};

impl Stage for Texture {
    const NAME: &'static str = "refine.texture";
    const VERSION: u32 = 9;
    const ABOUT: &'static str = "Paints each face from the photo that shows it best, brightness evened out where photos meet.";
    type Params = TextureParams;
    type Input = TextureInput;
    type Output = Textured;
    const METRICS: &'static [&'static str] =
        &["charts", "faces that no photo shows", "atlas against photo"];

    /// The pictures, and what hangs on the vertices.
    fn memory(p: &TextureParams, input: &TextureInput) -> u64 {
        // The atlas as it is painted, grown, encoded and packed.
        let atlas = 12.0 * f64::from(p.atlas_px).powi(2);
        input.memory(&SMALL, 1, 0.0) + atlas as u64
    }

    fn run(p: &TextureParams, input: TextureInput, ctx: &Ctx<'_>) -> Result<Textured, Stop> {
        let mesh = Mesh {
            colors: vec![],
            ..Mesh::clone(&input.mesh)
        };
        let photos = input.photos.within(LOOKED_AT_MPX);
        let cameras = input.cameras.of_photos(&photos);
        let seen = cameras.views.iter();
        let views: Vec<(PhotoId, Camera)> = seen
            .filter(|(id, _)| photos.get(*id).is_some())
            .map(|(id, view)| (id, view.camera))
            .collect();
        let small = input.pictures(&SMALL, || ctx.check().map_err(Stop::from))?;
        let beside = neighbours(&mesh);
        let labels = labels(&mesh, &beside, &small, p.rounds as usize);
        let charts = charts(&beside, &labels);
        let VertexColours { own, mean } = vertex_colours(&mesh, &labels, &photos, &views, &small)?;
        let sheet = |c| Sheet::new(&mesh, c, &views);
        let sheets: Vec<Sheet<'_>> = charts.iter().map(sheet).collect();
        let both = charts.iter().zip(&sheets);
        let boxes: Vec<[Point2<f64>; 2]> = both.map(|(c, s)| s.bounds(&mesh, c)).collect();
        let size = |[lo, hi]: &[Point2<f64>; 2]| [hi.x - lo.x, hi.y - lo.y];
        let sizes: Vec<[f64; 2]> = boxes.iter().map(size).collect();
        let side = p.atlas_px as usize;
        let (places, scale) = packed(&sizes, side, MARGIN);
        let mut atlas = Rgb::filled(side, side, [128; 3]);
        let mut corners = vec![[[0.0f32; 2]; 3]; mesh.faces.len()];
        let steps = ctx.steps("photos", views.len() + 1);
        let ids = views.iter().map(|(id, _)| Some(*id)).chain([None]);
        let mut decoded = Ahead::new(&photos, ids.collect());
        for k in 0..=views.len() {
            let photo = decoded.photo(k)?;
            let label = if photo.is_some() { k as u16 } else { NOWHERE };
            for (c, chart) in charts.iter().enumerate().filter(|(_, c)| c.photo == label) {
                let lo = boxes[c][0];
                let place = |q: &Point2<f64>| {
                    [
                        (q.x - lo.x) * scale + places[c][0] as f64,
                        (q.y - lo.y) * scale + places[c][1] as f64,
                    ]
                };
                for f in &chart.faces {
                    let face = mesh.faces[*f as usize];
                    let at_px = face.map(|v| sheets[c].at(&mesh.point(v)));
                    let on = at_px.each_ref().map(place);
                    corners[*f as usize] = on.map(|q| q.map(|x| ((x + 0.5) / side as f64) as f32));
                    let flat = face.map(|v| mean[v as usize]);
                    let shift = [0, 1, 2].map(|i| match p.even {
                        true => flat[i] - own[*f as usize][i],
                        false => Vector3::zeros(),
                    });
                    let photo = photo.as_ref();
                    paint(&mut atlas, on, |weights| match photo {
                        Some(photo) => {
                            let q = blend(&at_px.map(|q| q.coords), weights);
                            sample(photo, q.x, q.y)
                                + shift[0] * weights[0]
                                + shift[1] * weights[1]
                                + shift[2] * weights[2]
                        }
                        None => blend(&flat, weights),
                    });
                }
            }
            steps.tick()?;
        }
        let hidden = labels.iter().filter(|l| **l == NOWHERE).count() as f64 / labels.len() as f64;
        ctx.metric("charts", charts.len() as f64, "");
        ctx.metric("faces that no photo shows", hidden * 100.0, "%");
        ctx.metric("atlas against photo", scale, "");
        Ok(Textured {
            mesh,
            corners,
            atlas,
        })
    }
}

/// The weighted sum of what a face's corners have.
fn blend<const N: usize>(corners: &[SVector<f64, N>; 3], weights: [f64; 3]) -> SVector<f64, N> {
    corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2]
}

/// Colours at the vertices, blurred. \[0..255\]
struct VertexColours {
    /// Of each face's corners on the face's own photo.
    own: Vec<[Vector3<f64>; 3]>,
    /// Of each vertex: the mean over all photos that show it, weighted by how squarely they do.
    mean: Vec<Vector3<f64>>,
}

/// What a photo shows of a vertex: its colour, and how squarely it is seen (the cosine).
type SeenColour = (Vector3<f64>, f64);

/// The colours that photos show at the vertices.
fn vertex_colours(
    mesh: &Mesh,
    labels: &[u16],
    photos: &Photos,
    views: &[(PhotoId, Camera)],
    small: &[Picture],
) -> Result<VertexColours, Stop> {
    let normals = mesh.normals();
    let reads: Vec<Vec<Option<SeenColour>>> = views
        .par_iter()
        .zip(small)
        .map(|((id, camera), picture)| {
            let photo = photos.get(*id).expect("bug: filtered before").decode()?;
            let reach = (f64::from(camera.lens.width) / 400.0).max(1.0);
            let map = crate::pictures::depth::DepthMap::new(mesh, picture, 1.0);
            let one = |v: u32| -> Option<SeenColour> {
                let x = mesh.point(v);
                let cosine = (picture.centre - x).normalize().dot(&normals[v as usize]);
                let (at, depth) = picture.project(&x)?;
                let body = picture.inside_px(at).is_none_or(|d| d > 3.0);
                let shown =
                    body && cosine > 0.15 && map.shows(picture, &x, 4.0 * picture.footprint(depth));
                let q = camera.project(&x).filter(|_| shown)?;
                let around = [[0.0, 0.0], [1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]];
                let sum: Vector3<f64> = around
                    .iter()
                    .map(|d| sample(&photo, q.x + d[0] * reach, q.y + d[1] * reach))
                    .sum();
                Some((sum / 5.0, cosine))
            };
            Ok((0..mesh.positions.len() as u32).map(one).collect())
        })
        .collect::<Result<_, Stop>>()?;
    let seen: Vec<Option<Vector3<f64>>> = (0..mesh.positions.len())
        .map(|v| {
            let seen = reads.iter().filter_map(|r| r[v]);
            let (sum, weight) =
                seen.fold((Vector3::zeros(), 0.0), |(s, w), (c, k)| (s + c * k, w + k));
            (weight > 0.0).then(|| sum / weight)
        })
        .collect();
    let mean = spread(&Adjacency::new(mesh), seen);
    let corners = |(label, face): (&u16, &[u32; 3])| {
        face.map(|v| {
            let read = reads.get(*label as usize).and_then(|r| r[v as usize]);
            read.map_or(mean[v as usize], |r| r.0)
        })
    };
    let own = labels.iter().zip(&mesh.faces).map(corners).collect();
    Ok(VertexColours { own, mean })
}

/// Gives vertices that no photo shows, such as the soles, the mean colour of their neighbours, ring
/// by ring; grey where there is none to take.
fn spread(around: &Adjacency, mut seen: Vec<Option<Vector3<f64>>>) -> Vec<Vector3<f64>> {
    loop {
        let fill = |v: usize| {
            let beside = around
                .vertices(v as u32)
                .iter()
                .filter_map(|j| seen[*j as usize]);
            let (sum, count) = beside.fold((Vector3::zeros(), 0.0), |(s, n), c| (s + c, n + 1.0));
            seen[v].or_else(|| (count > 0.0).then(|| sum / count))
        };
        let next: Vec<_> = (0..seen.len()).map(fill).collect();
        let left = |all: &[Option<_>]| all.iter().filter(|c| c.is_none()).count();
        if left(&next) == left(&seen) {
            let grey = Vector3::repeat(128.0);
            return next.into_iter().map(|c| c.unwrap_or(grey)).collect();
        }
        seen = next;
    }
}

/// Paints a triangle and a rim of a pixel and a half around it; weights beyond the rim are clamped.
fn paint(atlas: &mut Rgb, [a, b, c]: [[f64; 2]; 3], colour: impl Fn([f64; 3]) -> Vector3<f64>) {
    let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let span = |i: usize, n: usize| {
        let lo = (a[i].min(b[i]).min(c[i]) - 1.5).max(0.0).floor() as usize;
        let hi = (a[i].max(b[i]).max(c[i]) + 1.5).min(n as f64 - 1.0).ceil() as usize;
        lo..=hi.min(n - 1)
    };
    for y in span(1, atlas.height) {
        for x in span(0, atlas.width) {
            let part = |p: [f64; 2], q: [f64; 2]| {
                ((q[0] - p[0]) * (y as f64 - p[1]) - (q[1] - p[1]) * (x as f64 - p[0])) / area
            };
            let raw = if area.abs() < 1e-9 {
                [1.0, 0.0, 0.0]
            } else {
                [part(b, c), part(c, a), part(a, b)]
            };
            let sides = [(b, c), (c, a), (a, b)];
            let beyond = (0..3).any(|i| {
                let (p, q) = sides[i];
                let long = libm::hypot(q[0] - p[0], q[1] - p[1]);
                raw[i] * area.abs() < -1.5 * long
            });
            if beyond {
                continue;
            }
            let clamped = raw.map(|w| w.clamp(-0.5, 1.5));
            let total: f64 = clamped.iter().sum();
            let value = colour(clamped.map(|w| w / total.max(1e-9)));
            *atlas.at_mut(x, y) = [0, 1, 2].map(|i| value[i].round().clamp(0.0, 255.0) as u8);
        }
    }
}

/// A photo between its pixels.
fn sample(photo: &Rgb, x: f64, y: f64) -> Vector3<f64> {
    let x = x.clamp(0.0, photo.width as f64 - 1.001);
    let y = y.clamp(0.0, photo.height as f64 - 1.001);
    let (cx, cy) = (x as usize, y as usize);
    let four = [(cx, cy), (cx + 1, cy), (cx, cy + 1), (cx + 1, cy + 1)];
    let four = four.map(|(x, y)| photo.at(x, y));
    let past = [x - cx as f64, y - cy as f64];
    Vector3::from_fn(|c, _| shape::bilinear(four.map(|p| f64::from(p[c])), past))
}
