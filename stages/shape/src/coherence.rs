//! Which photos' outlines cut away what nearly all other photos show as body.

use crate::{Camera, Cameras, Mask, Masks, PhotoId, seen_by_half};
use nalgebra::Point3;
use rayon::prelude::*;

/// About so many points of space are asked: a few thousand of them are in a body (structural: samples).
const POINTS: f64 = 400_000.0;

/// An outline that cuts away more than this share of what nearly all other photos show contradicts them. By hand:
/// looked at whole turns, where gaps that few photos see come to less than 0.05.
const CUTS_SHARE: f64 = 0.15;

/// What outlines make of space, point by point.
#[derive(Debug, Clone, PartialEq)]
pub struct Coherence {
    /// Volume that is body on every photo that looks at it. \[mm³\]
    pub shared: f64,
    /// The same, with what at most a sixth of the photos cuts away. \[mm³\]
    pub nearly: f64,
    /// The share of `nearly` that each photo cuts away, most first.
    pub cut: Vec<(PhotoId, f64)>,
}

impl Coherence {
    /// The photos that contradict the other photos, each with the share that it cuts away.
    pub fn contradicting(&self) -> impl Iterator<Item = (PhotoId, f64)> {
        self.cut
            .iter()
            .copied()
            .filter(|(_, cut)| *cut > CUTS_SHARE)
    }
}

/// Holds all outlines against each other, in the space that at least half of the photos look into. `None` for fewer than
/// three photos with both an outline and a camera, and where nothing is body on nearly all of them.
pub fn coherence(cameras: &Cameras, masks: &Masks) -> Option<Coherence> {
    let views: Vec<(PhotoId, Camera, Mask)> = cameras
        .views
        .join(&masks.views)
        .map(|(id, view, mask)| {
            let size = (mask.width as u32, mask.height as u32);
            (id, view.camera.resized(size.0, size.1), mask.pixels())
        })
        .collect();
    let space = seen_by_half(cameras).filter(|_| views.len() >= 3)?;
    let height = space.top - space.bottom;
    let side = 2.0 * space.radius;
    let cell = libm::cbrt(side * side * height / POINTS);
    let (across, up) = (
        (side / cell).ceil() as usize,
        (height / cell).ceil() as usize,
    );
    let few = (views.len() / 6).max(1);
    let layer = |k: usize| {
        let at = |i: usize, from: f64| from + (i as f64 + 0.5) * cell;
        let mut found = Layer::of(views.len());
        for (i, j) in (0..across).flat_map(|i| (0..across).map(move |j| (i, j))) {
            let [x, y] = [i, j].map(|n| at(n, -space.radius));
            if libm::hypot(x, y) <= space.radius {
                found.ask(&views, &Point3::new(x, y, at(k, space.bottom)), few);
            }
        }
        found
    };
    let layers: Vec<Layer> = (0..up).into_par_iter().map(layer).collect();
    let mut all = Layer::of(views.len());
    for layer in &layers {
        all.shared += layer.shared;
        all.nearly += layer.nearly;
        all.cut
            .iter_mut()
            .zip(&layer.cut)
            .for_each(|(a, b)| *a += b);
    }
    let share = |n: usize| n as f64 / all.nearly as f64;
    let mut cut: Vec<_> = views
        .iter()
        .zip(&all.cut)
        .map(|(v, n)| (v.0, share(*n)))
        .collect();
    cut.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    let volume = |n: usize| n as f64 * cell.powi(3);
    (all.nearly > 0).then(|| Coherence {
        shared: volume(all.shared),
        nearly: volume(all.nearly),
        cut,
    })
}

/// Points of one height: how many are body, and how many each photo alone cuts away.
struct Layer {
    shared: usize,
    nearly: usize,
    cut: Vec<usize>,
}

impl Layer {
    fn of(views: usize) -> Layer {
        Layer {
            shared: 0,
            nearly: 0,
            cut: vec![0; views],
        }
    }

    /// Asks every photo whether a point is body; one that does not look there does not count.
    fn ask(&mut self, views: &[(PhotoId, Camera, Mask)], point: &Point3<f64>, few: usize) {
        let mut against: Vec<usize> = Vec::new();
        let mut asked = 0;
        for (i, (_, camera, mask)) in views.iter().enumerate() {
            let Some(body) = mask.shows_point(camera, point) else {
                continue;
            };
            asked += 1;
            if !body {
                against.push(i);
            }
            if against.len() > few {
                return;
            }
        }
        if 2 * asked < views.len() {
            return;
        }
        self.nearly += 1;
        self.shared += usize::from(against.is_empty());
        against.iter().for_each(|i| self.cut[*i] += 1);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Intrinsics, Scale, View};
    use nalgebra::Point3;

    /// Twelve cameras 3 m around a post 1 m tall and 0.3 m wide, and what they see of it.
    fn turn() -> (Cameras, Masks) {
        let camera = |k: u32| {
            let (s, c) = libm::sincos(f64::from(k) * std::f64::consts::TAU / 12.0);
            let lens = Intrinsics::simple(120, 160, 300.0);
            let from = Point3::new(3000.0 * c, 3000.0 * s, 500.0);
            Camera::looking(lens, from, Point3::new(0.0, 0.0, 500.0))
        };
        let view = |k: u32| View::of(format!("{k:04}.jpg"), camera(k));
        let cameras = Cameras::of((0..12).map(|k| (PhotoId(k), view(k))), Scale::Given);
        let mut mask = Mask::filled(120, 160, 0);
        for y in 30..130 {
            (45..75).for_each(|x| *mask.at_mut(x, y) = 255);
        }
        let masks = (0..12).map(|k| (PhotoId(k), &mask));
        (cameras, masks.collect())
    }

    #[test]
    fn a_photo_that_cuts_away_what_the_other_photos_show_is_the_first() {
        let (cameras, mut masks) = turn();
        let whole = coherence(&cameras, &masks).unwrap();
        assert_eq!(whole.contradicting().count(), 0, "{:?}", whole.cut);
        // A post of 0.3 m across.
        proof::near(whole.shared * 1e-6, 71.0, 6.0);
        // Photo 4 lost the lower half of its outline.
        let kept = masks.views.get_mut(PhotoId(4)).unwrap();
        let mut half = kept.pixels();
        half.data[120 * 80..].fill(0);
        *kept = half.into();
        let cut = coherence(&cameras, &masks).unwrap();
        let cutting: Vec<_> = cut.contradicting().collect();
        assert_eq!(cutting.len(), 1, "{:?}", cut.cut);
        assert_eq!(cutting[0].0, PhotoId(4));
        proof::near(cutting[0].1, 0.5, 0.04);
        proof::near(cut.shared / whole.shared, 0.5, 0.05);
        proof::near(cut.nearly / whole.nearly, 1.0, 0.06);
    }
}
