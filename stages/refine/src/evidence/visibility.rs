//! V_x: which pictures see each vertex, and how much each of them counts (paper, III-D 1).

use crate::evidence::look::Look;
use crate::evidence::patch::{Frame, MOST_VIEWS, VisibleView};
use crate::evidence::scene::{Scene, VisibilityRules};
use crate::geometry::curvature::{shape_operators, tangents};
use nalgebra::Vector3;
use rayon::prelude::*;
use stage::machine::widest;
use std::ops::Range;

/// What is known of a vertex from an earlier look: the spacing of its patch \[mm\], the pictures that see
/// it, and what came of them.
pub struct Known<'a, T> {
    /// Distance of the patch's points. \[mm\]
    pub spacing: f64,
    /// The pictures.
    pub visible: &'a [VisibleView],
    /// What came of them.
    pub result: T,
}

/// The frames of all vertices and the pictures that see them, run by run: joined they would be there twice for a while.
pub struct Visibility {
    runs: Vec<Run>,
    count: usize,
}

impl Visibility {
    /// Looks at a surface from all pictures.
    pub fn new(scene: &Scene<'_>) -> Self {
        Self::with(scene, |_| None, |_, _| [], |_, _, _| ()).0
    }

    /// Looks at a surface from all pictures, and hands over what they show at each vertex while it is at hand:
    /// `then` gets the frame, the pictures that see it, and a look of each, slopes being those along what
    /// `along` gives for a frame and a picture. Vertices of which all is `known` are not looked at.
    pub fn with<'a, const N: usize, T: Send>(
        scene: &Scene<'_>,
        known: impl Fn(usize) -> Option<Known<'a, T>> + Sync,
        along: impl Fn(&Frame, &VisibleView) -> [Vector3<f64>; N] + Sync,
        then: impl Fn(&Frame, &[VisibleView], &[Look<N>]) -> T + Sync,
    ) -> (Self, Vec<T>) {
        let edge = scene.mesh.mean_edge();
        let shapes = shape_operators(scene.mesh, scene.around, &scene.normals, 1.0 / (2.0 * edge));
        let space = || Box::new([Look::<N>::EMPTY; MOST_VIEWS]);
        let count = scene.mesh.positions.len();
        // A run of vertices at a time: a list for each would take more memory than what is in it.
        let run = |looks: &mut Box<[Look<N>; MOST_VIEWS]>, vertices: Range<usize>| {
            let mut run = Run::new(vertices.len());
            let mut results = Vec::with_capacity(vertices.len());
            for v in vertices {
                let normal = scene.normals[v];
                let mut frame = Frame {
                    x: scene.mesh.point(v as u32),
                    normal,
                    tangents: tangents(&normal),
                    shape: shapes[v],
                    spacing: 1.0,
                };
                if let Some(known) = known(v) {
                    frame.spacing = known.spacing;
                    run.push(frame, known.visible);
                    results.push(known.result);
                    continue;
                }
                widest(
                    #[inline(always)]
                    || {
                        let visible = visible(&mut frame, scene, &along, &mut looks[..]);
                        let result = then(&frame, &visible, &looks[..visible.len()]);
                        run.push(frame, &visible);
                        results.push(result);
                    },
                );
            }
            run.visible.shrink_to_fit();
            (run, results)
        };
        let all: Vec<(Run, Vec<T>)> = (0..count.div_ceil(RUN))
            .into_par_iter()
            .map_init(space, |looks, k| {
                run(looks, k * RUN..count.min((k + 1) * RUN))
            })
            .collect();
        let (runs, results): (Vec<_>, Vec<_>) = all.into_iter().unzip();
        let each = results.into_iter().flatten().collect();
        (Visibility { runs, count }, each)
    }

    /// How many vertices there are.
    #[allow(clippy::len_without_is_empty)]
    pub fn len(&self) -> usize {
        self.count
    }

    /// The frame of a vertex.
    #[inline]
    pub fn frame(&self, v: usize) -> &Frame {
        &self.runs[v / RUN].frames[v % RUN]
    }

    /// The frame of a vertex, to be moved.
    pub fn frame_mut(&mut self, v: usize) -> &mut Frame {
        &mut self.runs[v / RUN].frames[v % RUN]
    }

    /// The pictures that see a vertex, in their order.
    #[inline]
    pub fn of(&self, v: usize) -> &[VisibleView] {
        let (run, k) = (&self.runs[v / RUN], v % RUN);
        let start = if k == 0 { 0 } else { run.ends[k - 1] };
        &run.visible[start as usize..run.ends[k] as usize]
    }

    /// Share of the vertices that at least two pictures see.
    pub fn share(&self) -> f64 {
        let paired = (0..self.count).filter(|v| self.of(*v).len() >= 2).count();
        paired as f64 / self.count.max(1) as f64
    }
}

/// Vertices that one thread looks at in a run (structural: speed alone).
const RUN: usize = 512;

/// What was seen of a run of vertices.
struct Run {
    frames: Vec<Frame>,
    visible: Vec<VisibleView>,
    /// Where each vertex' part of `visible` ends.
    ends: Vec<u32>,
}

impl Run {
    fn new(count: usize) -> Self {
        Run {
            frames: Vec::with_capacity(count),
            visible: Vec::new(),
            ends: Vec::with_capacity(count),
        }
    }

    fn push(&mut self, frame: Frame, visible: &[VisibleView]) {
        self.frames.push(frame);
        self.visible.extend_from_slice(visible);
        self.ends.push(self.visible.len() as u32);
    }
}

/// The pictures that see one vertex, a look of each in `looks`; sets the spacing of its patch.
#[inline(always)]
fn visible<const N: usize>(
    frame: &mut Frame,
    scene: &Scene<'_>,
    along: &impl Fn(&Frame, &VisibleView) -> [Vector3<f64>; N],
    looks: &mut [Look<N>],
) -> Vec<VisibleView> {
    let found = facing(frame, scene);
    if found.len() < 2 {
        return vec![];
    }
    let spacing = found.iter().map(|f| f.spacing);
    frame.spacing = spacing.fold(f64::MAX, f64::min);
    let mut visible = Vec::with_capacity(found.len().min(MOST_VIEWS));
    for f in nearest(found) {
        let picture = &scene.pictures[f.picture];
        let mut view = VisibleView {
            picture: f.picture as u16,
            weight: 0.0,
            toward: f.toward.map(|t| t as f32).into(),
        };
        let look = &mut looks[visible.len()];
        if !look.read(picture, frame, 0.0, &along(frame, &view), scene.window) {
            continue;
        }
        let floor = scene.rules.noise_gain * f64::from(picture.noise).powi(2);
        let contrast = f64::from(look.variance) / (f64::from(look.variance) + floor);
        view.weight = (f.cosine * contrast) as f32;
        visible.push(view);
    }
    doubt(&mut visible, looks, scene.window.len(), scene.rules);
    visible
}

/// A picture before which a vertex is not hidden.
struct Facing {
    picture: usize,
    /// Of the angle between normal and line of sight.
    cosine: f64,
    /// Unit vector towards the camera.
    toward: Vector3<f64>,
    /// Distance of a patch's points that this picture asks for. \[mm\]
    spacing: f64,
}

/// The pictures before which a vertex is not hidden, whatever they show there, in their order.
fn facing(frame: &Frame, scene: &Scene<'_>) -> Vec<Facing> {
    let (rules, mut found) = (scene.rules, Vec::new());
    if frame.normal == Vector3::zeros() {
        return found;
    }
    let radius = scene.window.half as f64 * rules.spacing_px;
    let least = libm::cos(rules.most_tilt);
    for (i, (picture, map)) in scene.pictures.iter().zip(&scene.maps).enumerate() {
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
        // The patch may reach over the contour a little: what is there is another surface.
        let least = (0.6 * radius * cosine + 0.5) as f32;
        if picture.inside_px(at).is_some_and(|d| d < least) {
            continue;
        }
        let bias = footprint * map.step * (1.0 + 2.0 * (1.0 - cosine * cosine).sqrt() / cosine);
        if !map.shows(picture, &frame.x, bias) {
            continue;
        }
        found.push(Facing {
            picture: i,
            cosine,
            toward,
            spacing: footprint * rules.spacing_px,
        });
    }
    found
}

/// Those that look at a vertex most squarely, at most [`MOST_VIEWS`], in the pictures' order.
fn nearest(mut found: Vec<Facing>) -> Vec<Facing> {
    found.sort_by(|a, b| b.cosine.total_cmp(&a.cosine));
    found.truncate(MOST_VIEWS);
    found.sort_by_key(|f| f.picture);
    found
}

/// A picture that agrees with none of the other pictures is not believed: a hand in front, a highlight.
#[inline(always)]
fn doubt<const N: usize>(
    visible: &mut [VisibleView],
    looks: &[Look<N>],
    count: usize,
    rules: &VisibilityRules,
) {
    let mut best = [-1.0f32; MOST_VIEWS];
    for i in 0..visible.len() {
        for j in i + 1..visible.len() {
            if rules.pairing.takes(&visible[i], &visible[j]) {
                let agree = looks[i].agrees(&looks[j], count);
                best[i] = best[i].max(agree);
                best[j] = best[j].max(agree);
            }
        }
    }
    let views = visible.iter_mut().zip(best);
    views.for_each(|(view, best)| view.weight *= (best / 0.6).clamp(0.1, 1.0));
}
