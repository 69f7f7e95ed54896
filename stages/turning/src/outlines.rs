//! How well outlines of a motion agree: each point of an outline lies on a ray, and the body that all other photos show
//! touches that ray (silhouette coherence: Hernández, Schmitt and Cipolla 2007).
//!
//! The depth of a ray is the greatest, along it, of the least depth in all other photos' silhouettes. Where all agree it is
//! what the hull of the others overshoots between views, a few millimetres; a step or turn that is wrong makes it deeper on
//! one side of the body and shallower on the other. So depths are drawn to their middle, if that is above 0.

use crate::joints::{Equations, median};
use crate::scene::{Motion, Step, looking};
use nalgebra::{Matrix3, Point2, Vector2, Vector3};
use rayon::prelude::*;
use shape::{Gray, Intrinsics, Mask, signed_distance};

/// One photo's silhouette.
pub struct Outline {
    /// Signed distance to the border, positive inside. \[px of the field\]
    distance: Gray,
    /// The lens at the field's size.
    lens: Intrinsics,
    /// Points of the border, on the plane z = 1.
    border: Vec<Vector2<f64>>,
}

/// About so many points of each outline are asked.
const POINTS: usize = 240;
/// Places along a ray that are looked at first.
const ALONG: usize = 40;

impl Outline {
    /// Of a mask at the size of its photo or smaller.
    pub fn of(mask: &Mask, lens: &Intrinsics) -> Outline {
        let lens = lens.resized(mask.width as u32, mask.height as u32);
        let all = border(mask);
        let every = (all.len() / POINTS).max(1);
        let border = all.into_iter().step_by(every).map(|p| lens.undistort(p));
        Outline {
            border: border.collect(),
            distance: signed_distance(mask),
            lens,
        }
    }

    /// How deep a point in the camera's frame is in the silhouette; [`f64::MAX`] out of view, where nothing denies it.
    /// \[distance to the axis\]
    fn depth(&self, at: &Vector3<f64>) -> f64 {
        let Some(px) = self.lens.project(at) else {
            return f64::MAX;
        };
        let (w, h) = (self.distance.width as f64, self.distance.height as f64);
        if px.x < 0.0 || px.y < 0.0 || px.x > w - 1.0 || px.y > h - 1.0 {
            return f64::MAX;
        }
        let far = f64::from(self.distance.sample(px.x as f32, px.y as f32));
        far * at.z / self.lens.focal[0]
    }

    /// How far the silhouette reaches to either side, on the plane z = 1.
    fn breadth(&self) -> f64 {
        self.border.iter().map(|p| p.x.abs()).fold(0.0, f64::max)
    }
}

/// Points where a mask's cover crosses one half, along rows, then along columns.
fn border(mask: &Mask) -> Vec<Point2<f64>> {
    let mut all = Vec::new();
    let cross = |a: u8, b: u8| {
        let (a, b) = (f64::from(a) - 127.5, f64::from(b) - 127.5);
        (a * b < 0.0).then(|| a / (a - b))
    };
    for y in 1..mask.height.saturating_sub(1) {
        for x in 1..mask.width.saturating_sub(2) {
            if let Some(t) = cross(mask.at(x, y), mask.at(x + 1, y)) {
                all.push(Point2::new(x as f64 + t, y as f64));
            }
            if y + 2 < mask.height
                && let Some(t) = cross(mask.at(x, y), mask.at(x, y + 1))
            {
                all.push(Point2::new(x as f64, y as f64 + t));
            }
        }
    }
    all
}

/// A point of an outline against all others.
struct Ray {
    photo: usize,
    /// The depth of its ray.
    depth: f64,
    /// How it moves with each unknown.
    slopes: Vec<(usize, f64)>,
}

/// What outlines come to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Agreement {
    /// The middle depth of rays. \[distance to the axis\]
    pub middle: f64,
    /// How far they are from it, one standard deviation by the middle deviation. \[distance to the axis\]
    pub spread: f64,
}

/// The same of rays (Holland and Welsch 1977).
const CAUCHY: f64 = 2.385;

/// What outlines ask of steps and pitch, added to `to`; `weight` of a photo's outline as a whole, in sights, and how many
/// times farther off than usual a ray may be. `None` where no two photos see the same.
pub fn equations(
    outlines: &[Outline],
    motion: &Motion,
    (weight, lax): (f64, f64),
    to: &mut Equations,
) -> Option<Agreement> {
    let reach = reach(outlines);
    let rays: Vec<Ray> = (0..outlines.len())
        .into_par_iter()
        .flat_map_iter(|i| {
            let all = outlines[i].border.iter();
            all.filter_map(move |p| ray(outlines, motion, reach, i, p))
                .collect::<Vec<_>>()
        })
        .collect();
    if rays.is_empty() {
        return None;
    }
    let mut depths: Vec<f64> = rays.iter().map(|r| r.depth).collect();
    // A hull never is less than its outlines: what agrees in being too shallow agrees on nothing.
    let middle = median(&mut depths).max(0.0);
    let mut off: Vec<f64> = rays.iter().map(|r| (r.depth - middle).abs()).collect();
    let spread = (1.4826 * median(&mut off)).max(1e-6);
    let mut counts = vec![0.0; outlines.len()];
    rays.iter().for_each(|r| counts[r.photo] += 1.0);
    for r in &rays {
        let miss = r.depth - middle;
        let share = (miss / (CAUCHY * lax * spread)).powi(2);
        let weight = weight / counts[r.photo] / (spread * spread * (1.0 + share));
        to.add(&r.slopes, miss, weight);
    }
    Some(Agreement { middle, spread })
}

/// The depth of each ray of a photo's outline in all others' silhouettes. \[distance to the axis\]
pub(crate) fn depths(outlines: &[Outline], motion: &Motion, photo: usize) -> Vec<f64> {
    let reach = reach(outlines);
    let all = outlines[photo].border.iter();
    all.filter_map(|p| Some(ray(outlines, motion, reach, photo, p)?.depth))
        .collect()
}

/// As far as any silhouette reaches to a side, the body reaches to the front.
fn reach(outlines: &[Outline]) -> f64 {
    outlines.iter().map(Outline::breadth).fold(0.0, f64::max)
}

/// One ray: where along it the others' silhouettes are deepest, and what moves that.
fn ray(
    outlines: &[Outline],
    motion: &Motion,
    reach: f64,
    photo: usize,
    sight: &Vector2<f64>,
) -> Option<Ray> {
    let turn = looking(motion.pitch);
    let direction = turn.transpose() * Vector3::new(sight.x, sight.y, 1.0);
    let step = motion.steps[photo];
    // Where it passes the body, before and behind its axis.
    let (near, far) = (1.0 + step.off[1] - reach, 1.0 + step.off[1] + reach);
    let on = |y: f64| direction * (y / direction.y);
    let depth = |view: usize, y: f64| {
        let body = step.to_body(&on(y));
        outlines[view].depth(&(turn * motion.steps[view].to_room(&body)))
    };
    let width = (far - near) / ALONG as f64;
    let mut best = (f64::MIN, near);
    let mut asked: Vec<usize> = (0..outlines.len()).filter(|v| *v != photo).collect();
    for k in 0..=ALONG {
        let y = near + width * k as f64;
        let mut least = f64::MAX;
        for at in 0..asked.len() {
            least = least.min(depth(asked[at], y));
            if least <= best.0 {
                // Whoever denies this place denies the next one, too.
                asked.swap(0, at);
                break;
            }
        }
        if least > best.0 && least < f64::MAX {
            best = (least, y);
        }
    }
    if best.0 == f64::MIN {
        return None;
    }
    // Beside the best place depths are straight lines: the crossing of the two that bound it.
    let half = width / 2.0;
    let lines: Vec<(usize, f64, f64)> = asked
        .iter()
        .filter_map(|v| {
            let (a, b) = (depth(*v, best.1 - half), depth(*v, best.1 + half));
            let seen = a < f64::MAX && b < f64::MAX;
            seen.then_some((*v, (a + b) / 2.0, (b - a) / width))
        })
        .collect();
    let least = |t: f64| {
        let value = |l: &(usize, f64, f64)| l.1 + l.2 * t;
        let by = lines.iter().min_by(|a, b| value(a).total_cmp(&value(b)));
        by.map(|l| (value(l), *l))
    };
    let (mut lo, mut hi) = (-width, width);
    for _ in 0..40 {
        let (a, b) = (lo + (hi - lo) / 3.0, hi - (hi - lo) / 3.0);
        if least(a)?.0 < least(b)?.0 {
            lo = a;
        } else {
            hi = b;
        }
    }
    let t = (lo + hi) / 2.0;
    let (left, right) = (least(t - 1e-3 * width)?.1, least(t + 1e-3 * width)?.1);
    let y = best.1 + t;
    let shares = match left.0 == right.0 || left.2 - right.2 < 1e-9 {
        true => vec![(left.0, 1.0)],
        false => {
            let share = -right.2 / (left.2 - right.2);
            vec![
                (left.0, share.clamp(0.0, 1.0)),
                (right.0, 1.0 - share.clamp(0.0, 1.0)),
            ]
        }
    };
    // Beside the border of a photo a nudge may leave it.
    let ray = sloped(outlines, motion, photo, sight, y, &shares);
    let sound = |r: &Ray| r.depth.abs() < 1.0 && r.slopes.iter().all(|(_, s)| s.abs() < 10.0);
    Some(ray).filter(sound)
}

/// How far unknowns are nudged to see how a depth moves.
const NUDGE: f64 = 5e-4;

/// A ray's depth at a place, and how it moves with its own photo's step, those of the photos that bound it, and the pitch.
fn sloped(
    outlines: &[Outline],
    motion: &Motion,
    photo: usize,
    sight: &Vector2<f64>,
    y: f64,
    shares: &[(usize, f64)],
) -> Ray {
    let photos = motion.steps.len();
    let place = |turn: &Matrix3<f64>| {
        let direction = turn.transpose() * Vector3::new(sight.x, sight.y, 1.0);
        direction * (y / direction.y)
    };
    let turn = looking(motion.pitch);
    let room = place(&turn);
    let of = |own: &Step, view: usize, other: &Step| {
        outlines[view].depth(&(turn * other.to_room(&own.to_body(&room))))
    };
    let nudged = |step: &Step, k: usize, by: f64| {
        let mut step = *step;
        match k {
            0 => step.azimuth += by,
            _ => step.off[k - 1] += by,
        }
        step
    };
    let own = &motion.steps[photo];
    let mut slopes: Vec<(usize, f64)> = Vec::with_capacity(10);
    let mut all = 0.0;
    let mut own_slopes = [0.0; 3];
    let mut by_pitch = 0.0;
    for (view, share) in shares {
        let other = &motion.steps[*view];
        all += share * of(own, *view, other);
        for k in 0..3 {
            let moved = |by: f64| of(&nudged(own, k, by), *view, other);
            own_slopes[k] += share * (moved(NUDGE) - moved(-NUDGE)) / (2.0 * NUDGE);
            let moved = |by: f64| of(own, *view, &nudged(other, k, by));
            let slope = share * (moved(NUDGE) - moved(-NUDGE)) / (2.0 * NUDGE);
            slopes.push((3 * view + k, slope));
        }
        let tilted = |by: f64| {
            let turn = looking(motion.pitch + by);
            outlines[*view].depth(&(turn * other.to_room(&own.to_body(&place(&turn)))))
        };
        by_pitch += share * (tilted(NUDGE) - tilted(-NUDGE)) / (2.0 * NUDGE);
    }
    (0..3).for_each(|k| slopes.push((3 * photo + k, own_slopes[k])));
    slopes.push((3 * photos, by_pitch));
    Ray {
        photo,
        depth: all,
        slopes,
    }
}

#[cfg(test)]
#[path = "outlines_tests.rs"]
mod tests;
