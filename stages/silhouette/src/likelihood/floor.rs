//! The floor before a camera: the disk's top where it is known, else the ground below a person's heels.
//!
//! A shadow on the floor may be deep, on a wall it is not. Where no disk is known, joints of the person give the ground's
//! height, where feet touch it, and how far a shadow reaches: as far as the person is tall, in light no lower than at 45°.

use crate::scene::disk_plane::on_disk;
use nalgebra::{Point2, Point3, Vector3};
use shape::{Aligned, Camera, Found, People, PhotoId, Pose, View};

/// The subject's shadow may fall deep on the disk and the floor around it: this many disk radii. By hand: looked at
/// scenes 131 with a plate and 132 without, at 0.7 and 1.4 of it: mean IoU at most +0.0001 and +0.0000.
const SHADOW_RADII: f64 = 5.0;

/// Joints of [`Found::JOINTS`] (structural): the nose, and both heels.
const NOSE: usize = 0;
/// (structural.)
const HEELS: [usize; 2] = [29, 30];
/// Heels and toes (structural).
const FEET: [usize; 4] = [29, 30, 31, 32];

/// Where the floor is before a photo's camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Floor {
    /// The camera, above a floor at z = 0. \[mm\]
    pub camera: Camera,
    /// Feet touch it within so far from the axis: the disk's radius, where that is known. \[mm\]
    pub touched: f64,
    /// Whether that is where it ends.
    pub is_disk: bool,
    /// How far from the axis a deep shadow may fall. \[mm\]
    pub shadow: f64,
}

impl Floor {
    /// The top of a disk.
    pub(crate) fn of_disk(camera: Camera, radius: f64) -> Floor {
        Floor {
            camera,
            touched: radius,
            is_disk: true,
            shadow: SHADOW_RADII * radius,
        }
    }

    /// The same before a photo of another size.
    pub(crate) fn resized(self, width: usize, height: usize) -> Floor {
        Floor {
            camera: self.camera.resized(width as u32, height as u32),
            ..self
        }
    }
}

/// How high the soles of a person who turns are, and how far the shadow reaches. \[mm\]
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Soles {
    height: f64,
    touched: f64,
    shadow: f64,
}

impl Soles {
    /// By the middle photo's heels and nose; `None` where nobody is seen or no camera is known.
    pub(crate) fn below(people: Option<&People>, aligned: &Aligned) -> Option<Soles> {
        let cameras = aligned.cameras.as_ref()?;
        let (mut soles, mut noses) = (Vec::new(), Vec::new());
        for (id, view) in cameras.views.iter() {
            let Some(found) = people.and_then(|people| people.subject(id)) else {
                continue;
            };
            let at = |joint| Some(view.camera.height_at_axis(pixel(found, joint)?));
            if let (Some(nose), [Some(left), Some(right)]) = (at(NOSE), HEELS.map(at)) {
                soles.push((left + right) / 2.0);
                noses.push(nose);
            }
        }
        let (height, nose) = (middle(soles)?, middle(noses)?);
        let soles = Soles {
            height,
            touched: 0.0,
            shadow: nose - height,
        };
        let feet = |(id, view): (PhotoId, &View)| {
            let found = people.and_then(|people| people.subject(id))?;
            let camera = soles.before(&view.camera).camera;
            let hit = |joint: &usize| on_disk(&camera, pixel(found, *joint)?, f64::MAX);
            let away = |hit: Point3<f64>| libm::hypot(hit.x, hit.y);
            FEET.iter().filter_map(hit).map(away).reduce(f64::max)
        };
        let touched = middle(cameras.views.iter().filter_map(feet).collect())?;
        (soles.shadow > touched).then_some(Soles { touched, ..soles })
    }

    /// As a camera sees it.
    pub(crate) fn before(&self, camera: &Camera) -> Floor {
        let Pose {
            rotation,
            translation,
        } = camera.pose;
        let pose = Pose {
            rotation,
            translation: translation + rotation * Vector3::new(0.0, 0.0, self.height),
        };
        Floor {
            camera: Camera { pose, ..*camera },
            touched: self.touched,
            is_disk: false,
            shadow: self.shadow,
        }
    }
}

fn pixel(found: &Found, joint: usize) -> Option<Point2<f64>> {
    let [x, y] = found.joints.get(joint)?.at_px.map(f64::from);
    Some(Point2::new(x, y))
}

fn middle(mut all: Vec<f64>) -> Option<f64> {
    all.sort_by(f64::total_cmp);
    all.get(all.len() / 2).copied()
}

/// The floor before the camera of a photo, where photos are aligned: the known disk's, else below the soles.
pub(crate) fn floor(aligned: &Aligned, soles: Option<Soles>, id: PhotoId) -> Option<Floor> {
    let camera = aligned.camera(id)?;
    match aligned.disk_radius_mm() {
        Some(radius) => Some(Floor::of_disk(camera, radius)),
        None => Some(soles?.before(&camera)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::likelihood::grounds::{Ground, Grounds};
    use nalgebra::Rotation3;
    use shape::{Cameras, Intrinsics, Joint, Scale};

    /// A camera 3 m before the axis and `up` above its origin, level.
    fn camera(up: f64) -> Camera {
        let rotation = Rotation3::from_euler_angles(std::f64::consts::FRAC_PI_2, 0.0, 0.0);
        let centre = Vector3::new(0.0, -3000.0, up);
        Camera {
            lens: Intrinsics::simple(480, 720, 800.0),
            pose: Pose {
                rotation,
                translation: -(rotation * centre),
            },
        }
    }

    /// Somebody 1.6 m tall up to the nose, whose feet are at a height, as that camera shows it.
    fn seen(camera: &Camera, soles: f64) -> Found {
        let mut joints = vec![[0.0, 0.0, soles + 900.0]; Found::JOINTS.len()];
        joints[NOSE] = [0.0, 0.0, soles + 1600.0];
        for (joint, at) in FEET.into_iter().zip([-120.0, 120.0, -150.0, 150.0]) {
            joints[joint] = [at, 0.0, soles];
        }
        let joint = |at: [f64; 3]| {
            let px = camera.project(&at.into()).unwrap();
            Joint {
                at_px: [px.x as f32, px.y as f32],
                ..Joint::default()
            }
        };
        Found {
            joints: joints.into_iter().map(joint).collect(),
            ..Found::default()
        }
    }

    #[test]
    fn without_a_disk_the_floor_is_below_the_soles_and_a_wall_has_no_deep_shadow() {
        // The frame's origin is 300 mm above the floor.
        let camera = camera(600.0);
        let view = View {
            name: String::new(),
            camera,
            sigma_mm: None,
            rms_px: None,
            points: 0,
        };
        let cameras = Cameras {
            views: [(PhotoId(0), view)].into_iter().collect(),
            scale: Scale::Nothing,
            scale_sigma: None,
            disk_radius_mm: None,
            ground_mm: 0.0,
            points: vec![],
        };
        let aligned = Aligned {
            views: [].into_iter().collect(),
            most_mpx: 6.0,
            cameras: Some(cameras),
            coarse_px: 800,
            box_px: vec![],
        };
        let people = People {
            views: [(PhotoId(0), vec![seen(&camera, -300.0)])]
                .into_iter()
                .collect(),
            person: true,
        };
        let soles = Soles::below(Some(&people), &aligned);
        let Soles {
            height,
            touched,
            shadow,
        } = soles.unwrap();
        assert!((height + 300.0).abs() < 2.0 && (shadow - 1600.0).abs() < 2.0);
        assert!((touched - 150.0).abs() < 2.0, "{touched}");
        let floor = floor(&aligned, soles, PhotoId(0)).unwrap();
        let grounds = Grounds::of(Some(&floor), 1, 480, 720);
        let at = |x: f64, y: f64, z: f64| {
            let px = camera.project(&[x, y, z].into()).unwrap();
            grounds.at(px.x as usize, px.y as usize)
        };
        assert_eq!(at(0.0, 0.0, -300.0), Ground::Disk);
        assert_eq!(at(400.0, 0.0, -300.0), Ground::Floor);
        // Above the horizon, and at hips before a wall.
        for height in [900.0, 500.0] {
            let at = at(0.0, 0.0, height);
            assert!(![Ground::Floor, Ground::Disk].contains(&at), "{at:?}");
        }
        // Of nobody nothing is known.
        assert_eq!(Soles::below(None, &aligned), None);
    }
}
