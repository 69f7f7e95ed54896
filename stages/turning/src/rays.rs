//! One ray of an outline in all other photos' silhouettes: how deep it is in them, and what moves that.

use crate::outline::Outline;
use crate::scene::{Motion, PER_STEP, Step, looking};
use nalgebra::{Matrix3, Vector2, Vector3};
use shape::Pose;

/// Places along a ray that are looked at first (structural: samples).
const ALONG: usize = 40;

/// A point of an outline against all other outlines.
pub(crate) struct Ray {
    pub(crate) photo: usize,
    /// What it counts for.
    pub(crate) weight: f64,
    /// The depth of its ray.
    pub(crate) depth: f64,
    /// What it would be of a round body of radius 1, for the photos that bound it look from elsewhere.
    pub(crate) round: f64,
    /// How it moves with each unknown.
    pub(crate) slopes: Vec<(usize, f64)>,
}

/// All rays of a photo's outline.
pub(crate) fn rays(outlines: &[Outline], motion: &Motion, photo: usize) -> Vec<Ray> {
    let (between, reach) = (Between::of(motion), reach(outlines));
    let all = outlines[photo].border.iter();
    let ray = |(at, weight): &(Vector2<f64>, f64)| {
        let one = ray(outlines, motion, (&between, reach), photo, at)?;
        Some(Ray {
            weight: *weight,
            ..one
        })
    };
    all.filter_map(ray).collect()
}

/// As far as any silhouette reaches to a side, the body reaches to the front.
fn reach(outlines: &[Outline]) -> f64 {
    outlines.iter().map(Outline::breadth).fold(0.0, f64::max)
}

/// What all rays of one motion share: how what a photo shows is seen by another photo's camera.
struct Between {
    /// camera_from_fixed of the fixed camera.
    turn: Matrix3<f64>,
    /// fixed_from_body, by photo.
    poses: Vec<Pose>,
}

impl Between {
    fn of(motion: &Motion) -> Between {
        Between {
            turn: looking(motion.pitch),
            poses: motion.steps.iter().map(Step::pose).collect(),
        }
    }

    /// From before the camera, as a photo has it, by its body, into the camera of another.
    fn photos(&self, from: usize, to: usize) -> (Matrix3<f64>, Vector3<f64>) {
        let (from, to) = (&self.poses[from], &self.poses[to]);
        let turn = (to.rotation * from.rotation.inverse()).into_inner();
        (
            self.turn * turn,
            self.turn * (to.translation - turn * from.translation),
        )
    }
}

/// One ray: where along it the other silhouettes are deepest, and what moves that.
fn ray(
    outlines: &[Outline],
    motion: &Motion,
    (between, reach): (&Between, f64),
    photo: usize,
    sight: &Vector2<f64>,
) -> Option<Ray> {
    let direction = between.turn.transpose() * Vector3::new(sight.x, sight.y, 1.0);
    let direction = direction / direction.y;
    let step = motion.steps[photo];
    // Where it passes the body, before and behind its axis.
    let (near, far) = (1.0 + step.off[1] - reach, 1.0 + step.off[1] + reach);
    let ways: Vec<(Vector3<f64>, Vector3<f64>)> = (0..outlines.len())
        .map(|view| {
            let (turn, at) = between.photos(photo, view);
            (at, turn * direction)
        })
        .collect();
    let depth = |view: usize, y: f64| outlines[view].depth(&(ways[view].0 + ways[view].1 * y));
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
    let (y, shares) = crossing(&asked, best.1, width, &depth)?;
    // Beside the border of a photo a nudge may leave it.
    let ray = sloped(outlines, motion, between, photo, (&direction, y), &shares);
    let sound = |r: &Ray| r.depth.abs() < 1.0 && r.slopes.iter().all(|(_, s)| s.abs() < 10.0);
    Some(ray).filter(sound)
}

/// Beside the best place along a ray depths are straight lines: where the two that bound it cross, and what each has of it.
fn crossing(
    asked: &[usize],
    best: f64,
    width: f64,
    depth: &dyn Fn(usize, f64) -> f64,
) -> Option<(f64, Vec<(usize, f64)>)> {
    let half = width / 2.0;
    let lines: Vec<(usize, f64, f64)> = asked
        .iter()
        .filter_map(|v| {
            let (a, b) = (depth(*v, best - half), depth(*v, best + half));
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
    let shares = match left.0 == right.0 || left.2 - right.2 < 1e-9 {
        true => vec![(left.0, 1.0)],
        false => {
            let share = (-right.2 / (left.2 - right.2)).clamp(0.0, 1.0);
            vec![(left.0, share), (right.0, 1.0 - share)]
        }
    };
    Some((best + t, shares))
}

/// How far places are nudged to see how a depth moves (structural: the step of a difference).
const NUDGE: f64 = 5e-4;

/// A ray's depth at a place, and how it moves with its own photo's step, those of the photos that bound it, and the pitch.
fn sloped(
    outlines: &[Outline],
    motion: &Motion,
    between: &Between,
    photo: usize,
    (direction, y): (&Vector3<f64>, f64),
    shares: &[(usize, f64)],
) -> Ray {
    let photos = motion.steps.len();
    let own = &between.poses[photo];
    let there = direction * y;
    let body = own.rotation.inverse() * (there - own.translation);
    let mut slopes: Vec<(usize, f64)> = Vec::with_capacity((shares.len() + 1) * PER_STEP + 1);
    let (mut all, mut round) = (0.0, 0.0);
    let level = |from: &Pose, way: Vector3<f64>| (from.rotation.inverse() * way).xy().normalize();
    let way = level(own, *direction);
    let (mut own_slopes, mut by_pitch) = ([0.0; PER_STEP], 0.0);
    for (view, share) in shares {
        let turned = |by: f64| {
            // The pitch turns the ray, and the camera that sees it.
            let turn = looking(motion.pitch + by);
            let ray = turn.transpose() * (between.turn * direction);
            let other = &between.poses[*view];
            let at = own.rotation.inverse() * (ray * (y / ray.y) - own.translation);
            turn * (other.rotation * at + other.translation)
        };
        let depth = |at: &Vector3<f64>| outlines[*view].depth(at);
        let at = turned(0.0);
        all += share * depth(&at);
        // Seen from the other side, a border is the same.
        let other = level(&between.poses[*view], between.turn.transpose() * at);
        round += share * (1.0 - way.dot(&other).abs());
        let slope = Vector3::from_fn(|k, _| {
            let by = Vector3::ith(k, NUDGE);
            (depth(&(at + by)) - depth(&(at - by))) / (2.0 * NUDGE)
        });
        let by_place = between.turn.transpose() * slope * *share;
        for (k, moved) in motion.steps[*view].slopes(&body).iter().enumerate() {
            slopes.push((PER_STEP * view + k, by_place.dot(moved)));
        }
        let turn = between.poses[*view].rotation * own.rotation.inverse();
        for (k, moved) in motion.steps[photo].slopes(&body).iter().enumerate() {
            own_slopes[k] -= by_place.dot(&(turn * moved));
        }
        by_pitch += share * slope.dot(&(turned(NUDGE) - turned(-NUDGE))) / (2.0 * NUDGE);
    }
    (0..PER_STEP).for_each(|k| slopes.push((PER_STEP * photo + k, own_slopes[k])));
    slopes.push((PER_STEP * photos, by_pitch));
    Ray {
        photo,
        weight: 1.0,
        depth: all,
        round,
        slopes,
    }
}
