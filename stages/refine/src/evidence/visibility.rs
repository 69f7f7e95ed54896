//! V_x: which pictures see each vertex, and how much each of them counts (paper, III-D 1).

use crate::evidence::look::Look;
use crate::evidence::patch::{Frame, MOST_VIEWS, Pairing, VisibleView, Window};
use crate::geometry::curvature::{shape_operators, tangents};
use crate::pictures::depth::DepthMap;
use crate::pictures::picture::Picture;
use nalgebra::Vector3;
use rayon::prelude::*;
use shape::{Adjacency, Mesh};

/// What decides whether a picture is compared at a vertex.
#[derive(Debug, Clone, Copy)]
pub struct VisibilityRules {
    /// Greatest angle between the normal and the line of sight. \[rad\]
    pub most_tilt: f64,
    /// Distance of a patch's points in pixels of the nearest picture. \[px\]
    pub spacing_px: f64,
    /// Which pictures are compared with each other.
    pub pairing: Pairing,
    /// Brightness varies at least this many times as much as noise does before it counts in full.
    pub noise_gain: f64,
}

impl VisibilityRules {
    /// A patch's points a pixel apart; the greatest tilt in degrees.
    pub fn new(tilt_deg: f64, pairing: Pairing, noise_gain: f64) -> Self {
        VisibilityRules {
            most_tilt: tilt_deg.to_radians(),
            spacing_px: 1.0,
            pairing,
            noise_gain,
        }
    }
}

/// The frames of all vertices and the pictures that see them.
pub struct Visibility {
    /// One a vertex.
    pub frames: Vec<Frame>,
    starts: Vec<u32>,
    visible: Vec<VisibleView>,
}

impl Visibility {
    /// Looks at a mesh from all pictures.
    pub fn new(
        mesh: &Mesh,
        around: &Adjacency,
        pictures: &[Picture],
        window: &Window,
        rules: &VisibilityRules,
    ) -> Self {
        let normals = mesh.normals();
        let maps: Vec<_> = pictures
            .par_iter()
            .map(|p| DepthMap::new(mesh, p, 2.0))
            .collect();
        let edge = mesh.mean_edge();
        let shapes = shape_operators(mesh, around, &normals, 1.0 / (2.0 * edge));
        let looked: Vec<(Frame, Vec<VisibleView>)> = (0..mesh.positions.len())
            .into_par_iter()
            .with_min_len(256)
            .map(|v| {
                let mut frame = Frame {
                    x: mesh.point(v as u32),
                    normal: normals[v],
                    tangents: tangents(&normals[v]),
                    shape: shapes[v],
                    spacing: 1.0,
                };
                let visible = visible(&mut frame, pictures, &maps, window, rules);
                (frame, visible)
            })
            .collect();
        let mut all = Visibility {
            frames: vec![],
            starts: vec![0],
            visible: vec![],
        };
        for (frame, visible) in looked {
            all.frames.push(frame);
            all.visible.extend(visible);
            all.starts.push(all.visible.len() as u32);
        }
        all
    }

    /// The pictures that see a vertex, in their order.
    #[inline]
    pub fn of(&self, v: usize) -> &[VisibleView] {
        &self.visible[self.starts[v] as usize..self.starts[v + 1] as usize]
    }

    /// Share of the vertices that at least two pictures see.
    pub fn share(&self) -> f64 {
        let paired = self.starts.windows(2).filter(|w| w[1] - w[0] >= 2).count();
        paired as f64 / self.frames.len().max(1) as f64
    }
}

/// The pictures that see one vertex; sets the spacing of its patch.
fn visible(
    frame: &mut Frame,
    pictures: &[Picture],
    maps: &[DepthMap],
    window: &Window,
    rules: &VisibilityRules,
) -> Vec<VisibleView> {
    if frame.normal == Vector3::zeros() {
        return vec![];
    }
    let radius = window.half as f64 * rules.spacing_px;
    let least = rules.most_tilt.cos();
    let mut found = Vec::new();
    let mut spacing = f64::MAX;
    for (i, (picture, map)) in pictures.iter().zip(maps).enumerate() {
        let toward = (picture.centre - frame.x).normalize();
        let cosine = toward.dot(&frame.normal);
        if cosine < least {
            continue;
        }
        let Some((at, depth)) = picture.project(&frame.x) else {
            continue;
        };
        if !picture.holds(at, radius + 2.0) {
            continue;
        }
        let footprint = picture.footprint(depth);
        // The patch may reach over the contour a little: what lies there is another surface.
        let inside = picture.inside.as_ref();
        if inside.is_some_and(|m| {
            m.sample(at[0] as f32, at[1] as f32) < (0.6 * radius * cosine + 0.5) as f32
        }) {
            continue;
        }
        let bias = footprint * map.step * (1.0 + 2.0 * (1.0 - cosine * cosine).sqrt() / cosine);
        if !map.shows(picture, &frame.x, bias) {
            continue;
        }
        spacing = spacing.min(footprint * rules.spacing_px);
        found.push((i, cosine, toward));
    }
    found.sort_by(|a, b| b.1.total_cmp(&a.1));
    found.truncate(MOST_VIEWS);
    found.sort_by_key(|f| f.0);
    if found.len() < 2 {
        return vec![];
    }
    frame.spacing = spacing;
    let mut looks = Vec::new();
    let mut visible = Vec::new();
    for (i, cosine, toward) in found {
        let mut look = Look::EMPTY;
        if !look.read::<false>(&pictures[i], frame, 0.0, &frame.normal, window) {
            continue;
        }
        let floor = rules.noise_gain * f64::from(pictures[i].noise).powi(2);
        let contrast = f64::from(look.variance) / (f64::from(look.variance) + floor);
        looks.push(look);
        visible.push(VisibleView {
            picture: i as u16,
            weight: (cosine * contrast) as f32,
            toward: [toward.x as f32, toward.y as f32, toward.z as f32],
        });
    }
    doubt(&mut visible, &looks, window.len(), rules);
    visible
}

/// A picture that agrees with none of the others is not believed: a hand in front, a highlight.
fn doubt(visible: &mut [VisibleView], looks: &[Look], count: usize, rules: &VisibilityRules) {
    let trust: Vec<f32> = (0..visible.len())
        .map(|i| {
            let others = (0..visible.len())
                .filter(|j| *j != i && rules.pairing.takes(&visible[i], &visible[*j]));
            let best = others
                .map(|j| looks[i].agrees(&looks[j], count))
                .fold(-1.0f32, f32::max);
            (best / 0.6).clamp(0.1, 1.0)
        })
        .collect();
    visible
        .iter_mut()
        .zip(trust)
        .for_each(|(s, t)| s.weight *= t);
}
