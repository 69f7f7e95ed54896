//! The normal equations of a scene: what was seen, its points eliminated, what is believed, and what is fixed.

use crate::adjust::belief::{Beliefs, freedoms, terms};
use crate::adjust::normal::{Block, Normal, Point};
use crate::adjust::places::{Places, Way};
use crate::adjust::residual::derivatives;
use crate::adjust::scene::{PointObservation, Scene};
use rayon::prelude::*;

/// Into how many parts free points are split, whatever the number of threads (structural: the order of sums); those that
/// are known are one, for they are few.
const PARTS: usize = 8;

/// Builds them from the observations of each point; `loss` is Cauchy's c, `damping` that of the points' own blocks.
pub(crate) fn system(
    scene: &Scene,
    by_point: &[Vec<PointObservation>],
    beliefs: &Beliefs,
    places: &Places,
    loss: f64,
    damping: f64,
) -> Normal {
    let cameras = scene.cameras();
    let ways: Vec<Vec<Way>> = (0..cameras.len()).map(|s| places.ways(scene, s)).collect();
    let one = |normal: &mut Normal, p: usize, seen: &[PointObservation]| {
        let open = scene.rim.as_ref().zip(places.rim).and_then(|(rim, at)| {
            let corner = p.checked_sub(rim.first).filter(|_| p < scene.known)?;
            let (which, by) = rim.by_open(corner);
            Some((which.map(|i| at + i), by))
        });
        let mut free = (p >= scene.known).then(Point::default);
        let mut blocks = Vec::new();
        for o in seen {
            let (shot, camera) = (&scene.shots[o.camera], &cameras[o.camera]);
            let at = &scene.points[p];
            let Some(d) = derivatives(camera, shot.zoom, at, o.at_px, o.sigma_px) else {
                continue;
            };
            let lens = places.lenses[shot.lens].map(|at| Block::new(at, &d.by_lens));
            blocks.clear();
            blocks.extend(lens);
            blocks.extend(ways[o.camera].iter().map(|w| Block::of_shot(w, &d.by_shot)));
            if let Some((which, by_open)) = &open {
                let by = d.by_point * by_open;
                let one = |(k, i): (usize, &usize)| Block::new(*i, &by.column(k).into_owned());
                blocks.extend(which.iter().enumerate().map(one));
            }
            let point = free.as_mut().map(|point| (point, &d.by_point));
            normal.observe(&d.residual, &blocks, point, loss * loss);
        }
        if let Some(point) = free {
            normal.eliminate(point, damping);
        }
    };
    let (known, free) = by_point.split_at(scene.known);
    let stride = free.len().div_ceil(PARTS).max(1);
    let free = free.chunks(stride).enumerate();
    let free = free.map(|(k, part)| (scene.known + k * stride, part));
    let all: Vec<(usize, &[Vec<PointObservation>])> =
        [(0, known)].into_iter().chain(free).collect();
    let part = |(from, part): &(usize, &[Vec<PointObservation>])| {
        let mut normal = Normal::new(places.count);
        for (p, seen) in (*from..).zip(*part) {
            one(&mut normal, p, seen);
        }
        normal
    };
    let parts: Vec<Normal> = all.par_iter().map(part).collect();
    let none = Normal::new(places.count);
    let mut all = parts.into_iter().fold(none, Normal::join).complete();
    let believed = terms(scene, beliefs, places);
    let fixed = freedoms(scene, places);
    believed.iter().chain(&fixed).for_each(|t| all.believe(t));
    all
}
