//! A living body in one photo: arms, legs and head are elsewhere than at rest, arms are raised, the chest is fuller, shorts hang
//! otherwise, and the camera reads it row by row while it turns.

use crate::dice::{Dice, normals};
use crate::paced::{between, clamped, paced, placed, risen};
use nalgebra::{Point3, Rotation3, Vector3};
use shape::{Camera, Mesh, Pose};
use std::f64::consts::TAU;

/// Heights by which a body is parted, as shares of it: where the head begins and is one with the neck (structural: what
/// is made).
const HEAD_HEIGHTS: [f64; 2] = [0.83, 0.87];
/// Where arms hang, as shares of height (structural: what is made).
const ARM_HEIGHTS: [f64; 2] = [0.40, 0.80];
/// Where the chest breathes, as shares of height (structural: what is made).
const CHEST_HEIGHTS: [f64; 2] = [0.60, 0.80];
/// How far from the middle arms begin, and are one with the trunk no more, as shares of height (structural: what is
/// made).
const ARMS_BESIDE: [f64; 2] = [0.12, 0.20];
/// What the head moves against hands (structural: what is made).
const HEAD_SHARE: f64 = 0.5;
/// What a breath lifts against hands (structural: what is made).
const BREATH_SHARE: f64 = 0.25;

/// Where shoulders are, aside and up, as shares of height (ANSUR II: biacromial breadth 0.23, acromial height 0.82).
const SHOULDERS: [f64; 2] = [0.11, 0.82];
/// Heights below which nothing is an arm that is raised, structural.
const BELOW_HANDS: [f64; 2] = [0.36, 0.40];

/// Heights from which legs go their own ways, fully and not at all, as shares of height, structural.
const LEGS: [f64; 2] = [0.06, 0.47];
/// Heights of a hem, of where shorts begin to come nearer to the body, and of their band, as shares of height, structural.
const SHORTS: [f64; 3] = [0.34, 0.46, 0.60];
/// How much deeper folds are than shorts are away, as a share, and how many there are around, structural.
const FOLDS: (f64, f64) = (0.4, 7.0);

/// What of a body is otherwise in each photo.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Live {
    /// How far hands move, one standard deviation a side. \[mm\]
    pub(crate) hands_mm: f64,
    /// The same of feet. \[mm\]
    pub(crate) feet_mm: f64,
    /// How far arms are raised about the shoulders, in all photos. \[rad\]
    pub(crate) arms_rad: f64,
    /// How far shorts are away from the legs, hanging otherwise in each photo. \[mm\]
    pub(crate) worn_mm: f64,
    /// How far the body turns while rows are read. \[rad\]
    pub(crate) read_rad: f64,
    /// How many photos are from step to step, between which all of it goes smoothly, as in a film; 1: none.
    pub(crate) pace: u32,
    /// How far feet are lifted in a film. \[mm\]
    pub(crate) lift_mm: f64,
    /// The share of the time from photo to photo in which rows are read, in a film.
    pub(crate) read: f64,
    /// The share of it in which the shutter is open.
    pub(crate) open: f64,
    /// Seed of it all.
    pub(crate) seed: u32,
}

impl Live {
    /// Whether it is the same in each.
    pub(crate) fn rests(&self) -> bool {
        let own = [self.hands_mm, self.feet_mm, self.worn_mm, self.arms_rad];
        own == [0.0; 4] && self.read_rad == 0.0 && self.pace == 1
    }

    /// The body at rest in a photo, and as a camera reads it row by row.
    pub(crate) fn body(
        &self,
        rest: (&Mesh, &[Vector3<f64>]),
        photo: u32,
        camera: &Camera,
        motion: Option<&Pose>,
    ) -> Mesh {
        let mut moved = self.limbs(rest, f64::from(photo));
        if self.read_rad > 0.0 {
            self.read(&mut moved, camera, motion);
        }
        moved
    }

    /// With clothes and limbs as they are at a time, by photos.
    pub(crate) fn limbs(&self, (mesh, normals): (&Mesh, &[Vector3<f64>]), at: f64) -> Mesh {
        let mut moved = self.dressed(mesh, normals, at);
        self.restless(&mut moved, at);
        moved
    }

    /// As rows are read one after the other while it turns.
    fn read(&self, moved: &mut Mesh, camera: &Camera, motion: Option<&Pose>) {
        let tall = f64::from(camera.lens.height);
        for p in &mut moved.positions {
            let at = Point3::from(p.map(f64::from));
            let there = motion.map_or(at, |m| Point3::from(m.apply(&at)));
            if let Some(px) = camera.lens.project(&camera.pose.apply(&there)) {
                let turn = self.read_rad * (px.y / tall - 0.5);
                let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), turn);
                *p = (turn * at).map(|c| c as f32).into();
            }
        }
    }

    /// With shorts in folds, from above the knees to the waist.
    fn dressed(&self, mesh: &Mesh, normals: &[Vector3<f64>], at: f64) -> Mesh {
        let mut moved = mesh.clone();
        let Some((lo, hi)) = mesh.bounds().filter(|_| self.worn_mm > 0.0) else {
            return moved;
        };
        let (tall, middle) = (hi.z - lo.z, nalgebra::center(&lo, &hi));
        let folds = |k| [TAU * Dice::new(self.seed, 3000 + k).unit()];
        let [turned] = paced(at, self.pace, folds);
        for (p, n) in moved.positions.iter_mut().zip(normals) {
            let [x, y, z] = p.map(f64::from);
            let (height, beside) = ((z - lo.z) / tall, (x - middle.x) / tall);
            let aside = libm::hypot(n.x, n.y);
            if !(SHORTS[0]..SHORTS[2]).contains(&height) || aside == 0.0 {
                continue;
            }
            let near = risen([SHORTS[1], SHORTS[2]], height) + risen(ARMS_BESIDE, beside.abs());
            let around = libm::atan2(y - middle.y, x - middle.x);
            let fold = 1.0 + FOLDS.0 * libm::sin(FOLDS.1 * around + turned);
            let off = self.worn_mm * (1.0 - near).max(0.0) * fold / aside;
            (p[0], p[1]) = ((x + off * n.x) as f32, (y + off * n.y) as f32);
        }
        moved
    }

    /// With hands, feet and head elsewhere, and a fuller chest.
    fn restless(&self, moved: &mut Mesh, photo: f64) {
        let Some((lo, hi)) = moved.bounds() else {
            return;
        };
        let (tall, middle) = (hi.z - lo.z, nalgebra::center(&lo, &hi));
        let hands = |k| normals::<8>(self.seed, 1000 + k).map(|by| self.hands_mm * by);
        let [hx, hy, lx, ly, rx, ry, breath, _] = paced(photo, self.pace, hands);
        let (head, breath) = ([hx, hy].map(|by| HEAD_SHARE * by), BREATH_SHARE * breath);
        let foot = |foot: usize| {
            let (from, part) = match self.pace {
                1 => (photo as u32, 0.0),
                pace => placed(photo / f64::from(pace), foot),
            };
            let [from, to] = [from, from + 1].map(|k| normals::<4>(self.seed, 2000 + k));
            let [lx, ly, rx, ry] = between(from, to, part).map(|by| self.feet_mm * by);
            [[lx, ly], [rx, ry]][foot]
        };
        let (left, right) = (([lx, ly], foot(0)), ([rx, ry], foot(1)));
        for p in &mut moved.positions {
            let [x, y, z] = p.map(f64::from);
            let (height, beside) = ((z - lo.z) / tall, (x - middle.x) / tall);
            let hanging = 1.0 - risen(ARM_HEIGHTS, height);
            let arm = risen(ARMS_BESIDE, beside.abs()) * hanging;
            let (by, foot) = if beside > 0.0 { left } else { right };
            let leg = leg(height);
            let on_head = risen(HEAD_HEIGHTS, height);
            let bump = libm::sin(std::f64::consts::PI * clamped(CHEST_HEIGHTS, height));
            let front = clamped([0.0, 0.08], (middle.y - y) / tall) * (1.0 - arm);
            let at = [
                x + arm * by[0] + on_head * head[0] + leg * foot[0],
                y + arm * by[1] + on_head * head[1] - bump * front * breath + leg * foot[1],
            ];
            (p[0], p[1]) = (at[0] as f32, at[1] as f32);
            let raised =
                self.arms_rad * risen(ARMS_BESIDE, beside.abs()) * risen(BELOW_HANDS, height);
            if raised != 0.0 {
                let (s, c) = libm::sincos(beside.signum() * raised);
                let aside = middle.x + beside.signum() * SHOULDERS[0] * tall;
                let (from, down) = (at[0] - aside, lo.z + SHOULDERS[1] * tall - z);
                p[0] = (aside + c * from + s * down) as f32;
                p[2] = (z + down + s * from - c * down) as f32;
            }
        }
    }
}

/// How far what is so high goes with a foot; the height is a share of the body's.
pub(crate) fn leg(height: f64) -> f64 {
    1.0 - risen(LEGS, height)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ring::{MakeRing, RingInput, RingParams};
    use stage::{Ctx, Stage};

    /// Rings of points around an axis, one a centimetre of a metre.
    fn post() -> (Mesh, Vec<Vector3<f64>>) {
        let around = |k: usize| libm::sincos(TAU * (k % 36) as f64 / 36.0);
        let point = |k: usize| {
            let (s, c) = around(k);
            [100.0 * c as f32, 100.0 * s as f32, (k / 36) as f32 * 10.0]
        };
        let mesh = Mesh {
            positions: (0..36 * 101).map(point).collect(),
            ..Mesh::default()
        };
        let normal = |k: usize| Vector3::new(around(k).1, around(k).0, 0.0);
        (mesh, (0..36 * 101).map(normal).collect())
    }

    /// How far each height's points are elsewhere at most, in a photo.
    fn moved(live: &Live, photo: u32) -> Vec<f32> {
        let ring = MakeRing::run(&RingParams::default(), RingInput {}, &Ctx::alone()).unwrap();
        let camera = ring.views.values().next().unwrap().camera;
        let (mesh, normals) = post();
        let now = live.body((&mesh, &normals), photo, &camera, None);
        let far = |k: usize| {
            let (a, b) = (mesh.positions[k], now.positions[k]);
            libm::hypotf(a[0] - b[0], a[1] - b[1])
        };
        let ring = |z: usize| (0..36).map(|k| far(36 * z + k)).fold(0.0, f32::max);
        (0..=100).map(ring).collect()
    }

    #[test]
    fn feet_move_legs_shorts_hang_away_below_the_hip_and_rows_twist() {
        let rest = Live {
            seed: 1,
            pace: 1,
            ..Live::default()
        };
        assert!(rest.rests() && moved(&rest, 0).iter().all(|far| *far == 0.0));
        let feet = Live {
            feet_mm: 20.0,
            ..rest
        };
        let far = moved(&feet, 0);
        assert!(
            far[0] > 5.0 && far[0] > far[30] && far[50] == 0.0,
            "{far:?}"
        );
        let shorts = Live {
            worn_mm: 30.0,
            ..rest
        };
        let far = moved(&shorts, 0);
        assert_eq!((far[30], far[70]), (0.0, 0.0));
        assert!((30.0..43.0).contains(&far[40]), "{far:?}");
        assert_ne!(far, moved(&shorts, 1));
        let arms = Live {
            arms_rad: 0.5,
            ..rest
        };
        assert!(moved(&arms, 0).iter().all(|far| *far == 0.0), "a trunk");
        let rows = Live {
            read_rad: 0.1,
            ..rest
        };
        let far = moved(&rows, 0);
        assert!(far[0] > far[50] && far[100] > 0.0, "{far:?}");
    }
}
