//! Somebody who steps round in a film: feet are set, one after the other, and keep their places on the floor while the body
//! turns over them; all of it is a function of time, and the camera reads row by row.

use crate::paced::{between, placed, rests};
use crate::photograph::Linear;
use crate::restless::{Live, leg};
use nalgebra::{IsometryMatrix3, Point3, Translation3, Vector3};
use shape::{Camera, Cameras, Mesh, Pose, Sway};

/// A body as a film shows it.
pub(crate) struct Film<'a> {
    live: &'a Live,
    /// Where the body at rest was before the camera in each photo.
    seen: Vec<IsometryMatrix3<f64>>,
    rest: (&'a Mesh, &'a [Vector3<f64>]),
}

impl<'a> Film<'a> {
    pub(crate) fn of(
        live: &'a Live,
        cameras: &Cameras,
        sway: Option<&Sway>,
        rest: (&'a Mesh, &'a [Vector3<f64>]),
    ) -> Film<'a> {
        let rigid =
            |p: &Pose| IsometryMatrix3::from_parts(Translation3::from(p.translation), p.rotation);
        let seen = cameras.views.iter().map(|(id, view)| {
            let motion = sway.and_then(|s| s.views.get(id));
            let motion = motion.map_or(IsometryMatrix3::identity(), rigid);
            rigid(&view.camera.pose) * motion
        });
        Film {
            live,
            seen: seen.collect(),
            rest,
        }
    }

    /// Where the body was before the camera, at a time between photos.
    fn seen(&self, photo: f64) -> IsometryMatrix3<f64> {
        let at = photo.clamp(0.0, (self.seen.len() - 1) as f64) as usize;
        let next = (at + 1).min(self.seen.len() - 1);
        let part = (photo - at as f64).clamp(-1.0, 1.0);
        self.seen[at].lerp_slerp(&self.seen[next], part)
    }

    /// A photo of the body before what is behind it, as light comes in while the shutter is open: the mean of two instants.
    pub(crate) fn exposed(
        &self,
        behind: &Linear,
        photo: usize,
        camera: &Camera,
        draw: impl Fn(&mut Linear, &Mesh),
    ) -> Linear {
        // Each is the middle of a half of that time.
        let [mut mean, last] = [-0.25, 0.25].map(|part| {
            let mut seen = behind.clone();
            let at = photo as f64 + part * self.live.open;
            draw(&mut seen, &self.body(photo, at, camera));
            seen
        });
        for (sum, c) in mean.data.iter_mut().zip(last.data) {
            (0..3).for_each(|k| sum[k] = (sum[k] + c[k]) / 2.0);
        }
        mean
    }

    /// The body at rest as a photo shows it whose rows are read, about a time in the middle.
    fn body(&self, photo: usize, middle: f64, camera: &Camera) -> Mesh {
        let back = self.seen[photo].inverse();
        let ends = [-0.5, 0.5].map(|end| {
            let at = middle + end * self.live.read;
            let mut body = self.stepped(at);
            let by = back * self.seen(at);
            for p in &mut body.positions {
                *p = (by * Point3::from(p.map(f64::from))).cast::<f32>().into();
            }
            body
        });
        let [mut body, last] = ends;
        let tall = f64::from(camera.lens.height);
        for (p, q) in body.positions.iter_mut().zip(&last.positions) {
            let [from, to] = [*p, *q].map(|x| x.map(f64::from));
            let mut now = between(from, to, 0.5);
            // A row is a little elsewhere than where the body was in the middle of all rows.
            for _ in 0..2 {
                let there = (self.seen[photo] * Point3::from(now)).coords;
                let row = camera
                    .lens
                    .project(&there)
                    .map_or(0.5, |px| (px.y + 0.5) / tall);
                now = between(from, to, row.clamp(0.0, 1.0));
            }
            *p = now.map(|x| x as f32);
        }
        body
    }

    /// The body at rest but for its limbs, at a time: each leg is with its foot, the more the lower.
    fn stepped(&self, at: f64) -> Mesh {
        let live = self.live;
        let mut body = live.limbs(self.rest, at);
        let Some((lo, hi)) = self.rest.0.bounds() else {
            return body;
        };
        let back = self.seen(at).inverse();
        let pace = f64::from(live.pace);
        let feet = [0, 1].map(|foot| {
            let (place, part) = placed(at / pace, foot);
            let [from, to] = [place, place + 1].map(|k| self.seen(pace * rests(k, foot)));
            let on_floor = from.lerp_slerp(&to, part);
            // Half of the way is where it is highest.
            (back * on_floor, 4.0 * part * (1.0 - part) * live.lift_mm)
        });
        for p in &mut body.positions {
            let at = Point3::from(p.map(f64::from));
            let left = at.x > (lo.x + hi.x) / 2.0;
            let (by, lift) = feet[usize::from(!left)];
            let off = by * at - at + Vector3::new(0.0, 0.0, lift);
            let leg = leg((at.z - lo.z) / (hi.z - lo.z));
            *p = (at + leg * off).cast::<f32>().into();
        }
        body
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ring::{MakeRing, RingInput, RingParams};
    use stage::{Ctx, Stage};

    #[test]
    fn a_foot_rests_while_the_other_goes_and_each_row_is_of_its_own_time() {
        let ring = RingParams {
            views: 360,
            pace: 30,
            jitter_deg: 3.0,
            ..RingParams::default()
        };
        let cameras = MakeRing::run(&ring, RingInput {}, &Ctx::alone()).unwrap();
        let live = Live {
            feet_mm: 15.0,
            pace: 30,
            lift_mm: 40.0,
            read: 0.8,
            ..Live::default()
        };
        // Left foot, right foot, two hands, a crown.
        let body = [
            [120.0, 0.0, 0.0],
            [-120.0, 0.0, 0.0],
            [400.0, 0.0, 1500.0],
            [-400.0, 0.0, 1500.0],
            [0.0, 0.0, 1700.0],
        ];
        let mesh = Mesh {
            positions: body.into(),
            ..Mesh::default()
        };
        let normals = [Vector3::x(); 5];
        let film = Film::of(&live, &cameras, None, (&mesh, &normals));
        let at = |time: f64, point: usize| {
            let body = film.stepped(time);
            film.seen(time) * body.point(point as u32)
        };
        // Of two steps, each foot goes in one and rests in the other.
        for (goes, rests, from) in [(0, 1, 60.0), (1, 0, 90.0)] {
            assert!((at(from + 29.9, goes) - at(from, goes)).norm() > 60.0);
            for part in [6.0, 15.0, 29.9] {
                assert!((at(from + part, rests) - at(from, rests)).norm() < 0.01);
            }
        }
        let lens = cameras.views.values().next().unwrap().camera;
        let seen = film.body(75, 75.0, &lens);
        for point in [2, 3, 4] {
            let there = film.seen(75.0) * seen.point(point);
            let row = lens.lens.project(&there.coords).unwrap().y + 0.5;
            let time = 75.0 + live.read * (row / f64::from(lens.lens.height) - 0.5);
            assert!((at(time, point as usize) - there).norm() < 0.1, "{row}");
        }
        let apart = seen.point(2) - Point3::from(body[2].map(f64::from));
        assert!(apart.norm() > 1.0, "{apart}");
    }
}
