//! Which photos were taken through one lens, what is believed of it, and pixels as they are in the
//! file: a phone used upright or sideways has one lens, not two.

use crate::adjust::lens::{LensPrior, lens_values};
use nalgebra::{Matrix3, Rotation3};
use shape::{Camera, Intrinsics, Photo, Photos, Pose, film_to_px};

/// How wide beliefs about a lens are.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Widths {
    /// Focal length by EXIF, as a share.
    pub(crate) focal: f64,
    /// Focal length in pixels of capture.toml, as a share.
    pub(crate) given_focal: f64,
    /// Principal point, as a share of the longer side.
    pub(crate) centre: f64,
    /// Principal point of capture.toml. \[px\]
    pub(crate) given_centre_px: f64,
    /// Radial distortion.
    pub(crate) radial: f64,
}

/// Lenses of the photos.
#[derive(Debug, Clone)]
pub(crate) struct Groups {
    /// The lens of each photo, by place.
    pub(crate) of: Vec<usize>,
    /// The lenses as they are believed to be.
    pub(crate) lenses: Vec<Intrinsics>,
    /// What is believed of each.
    pub(crate) priors: Vec<LensPrior>,
    /// Factors of the focal lengths that are tried.
    pub(crate) factors: Vec<f64>,
}

/// Standard deviation of a focal length of which nothing is known, as a share. By hand: looked at one capture, halved
/// and doubled: no more than chance (docs/lab/numbers.md).
const UNKNOWN_SIGMA: f64 = 0.5;

/// How a photo is turned upright, mirrored ones as they are.
fn turn(photo: &Photo) -> u8 {
    match photo.orientation {
        turn @ (3 | 6 | 8) => turn,
        _ => 1,
    }
}

/// Width and height in the file.
fn stored_size(photo: &Photo) -> (u32, u32) {
    match turn(photo) {
        6 | 8 => (photo.height, photo.width),
        _ => (photo.width, photo.height),
    }
}

/// The pixel of the file that is shown at an upright pixel.
pub(crate) fn stored(photo: &Photo, [x, y]: [f64; 2]) -> [f64; 2] {
    let (right, below) = (f64::from(photo.width) - 1.0, f64::from(photo.height) - 1.0);
    match turn(photo) {
        3 => [right - x, below - y],
        6 => [y, right - x],
        8 => [below - y, x],
        _ => [x, y],
    }
}

/// A camera of the file's pixels as one of upright pixels.
pub(crate) fn upright(photo: &Photo, camera: &Camera) -> Camera {
    let (w, h) = (f64::from(photo.width), f64::from(photo.height));
    let [x, y] = camera.lens.centre;
    let (centre, rows) = match turn(photo) {
        3 => ([w - 1.0 - x, h - 1.0 - y], [[-1.0, 0.0], [0.0, -1.0]]),
        6 => ([w - 1.0 - y, x], [[0.0, -1.0], [1.0, 0.0]]),
        8 => ([y, h - 1.0 - x], [[0.0, 1.0], [-1.0, 0.0]]),
        _ => return *camera,
    };
    let [[a, b], [c, d]] = rows;
    let about = Rotation3::from_matrix_unchecked(Matrix3::new(a, b, 0.0, c, d, 0.0, 0.0, 0.0, 1.0));
    Camera {
        lens: Intrinsics {
            width: photo.width,
            height: photo.height,
            centre,
            ..camera.lens
        },
        pose: Pose {
            rotation: about * camera.pose.rotation,
            translation: about * camera.pose.translation,
        },
    }
}

impl Groups {
    /// Photos of one device, one equivalent focal length and one size have one lens.
    pub(crate) fn new(photos: &Photos, widths: &Widths) -> Groups {
        let key = |p: &Photo| {
            (
                p.device.clone(),
                p.focal_35mm.map(f64::to_bits),
                stored_size(p),
            )
        };
        let mut firsts: Vec<&Photo> = Vec::new();
        let mut of = Vec::with_capacity(photos.photos.len());
        for photo in &photos.photos {
            let place = firsts.iter().position(|f| key(f) == key(photo));
            of.push(place.unwrap_or(firsts.len()));
            if place.is_none() {
                firsts.push(photo);
            }
        }
        let rig = &photos.rig;
        let knows = |p: &Photo| match std::ptr::eq(p, firsts[0]) {
            true => rig.focal_35mm.or(p.focal_35mm),
            false => p.focal_35mm.or(rig.focal_35mm),
        };
        let mut groups = Groups {
            of,
            lenses: vec![],
            priors: vec![],
            factors: vec![1.0],
        };
        for first in &firsts {
            let (width, height) = stored_size(first);
            let (w, h) = (f64::from(width), f64::from(height));
            let longer = w.max(h);
            let like_first = stored_size(firsts[0]) == (width, height);
            let given = rig.focal_px.filter(|_| like_first);
            let by_film = knows(first).map(|mm| film_to_px(mm, width, height));
            let mut lens = Intrinsics::simple(width, height, 1.2 * longer);
            let focal = match (given, by_film) {
                (Some(px), _) => (px, widths.given_focal),
                (_, Some(px)) => (px, widths.focal),
                _ => (1.2 * longer, UNKNOWN_SIGMA),
            };
            lens.focal = [focal.0; 2];
            let centre = rig.centre_px.filter(|_| like_first);
            if let Some(centre) = centre {
                lens.centre = stored(first, centre);
            }
            let c = centre.map_or(widths.centre * longer, |_| widths.given_centre_px);
            groups.priors.push(LensPrior {
                mean: lens_values(&lens),
                sigma: [focal.1 * focal.0, c, c, widths.radial, widths.radial],
            });
            groups.lenses.push(lens);
        }
        let (known, given) = (knows(firsts[0]).is_some(), rig.focal_px.is_some());
        groups.factors = match (given, known) {
            (true, _) => vec![1.0],
            (_, true) => vec![1.0, 0.85, 1.2],
            _ => vec![0.7, 0.95, 1.3, 1.8, 2.5],
        };
        groups
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Point3, Vector3};

    fn photo(width: u32, height: u32, orientation: u8) -> Photo {
        Photo {
            name: "a".into(),
            width,
            height,
            orientation,
            focal_35mm: Some(26.0),
            device: "Phone 3".into(),
            time_s: None,
            file: Vec::new().into(),
        }
    }

    #[test]
    fn a_camera_that_is_turned_upright_sees_the_same_at_the_upright_pixel() {
        let point = Point3::new(0.2, -0.1, 3.0);
        for (orientation, width, height) in
            [(1, 400, 300), (3, 400, 300), (6, 300, 400), (8, 300, 400)]
        {
            let photo = photo(width, height, orientation);
            let mut lens = Intrinsics::simple(400, 300, 350.0);
            lens.centre = [203.0, 140.0];
            lens.radial = [0.05, -0.02];
            let pose = Pose {
                rotation: Rotation3::from_euler_angles(0.1, 0.05, -0.2),
                translation: Vector3::new(0.02, 0.03, 0.1),
            };
            let camera = Camera { lens, pose };
            let turned = upright(&photo, &camera).project(&point).unwrap();
            let back = stored(&photo, turned.into());
            let wanted = camera.project(&point).unwrap();
            assert!(libm::hypot(wanted.x - back[0], wanted.y - back[1]) < 1e-9);
            // What the decoder does: the file's first pixel goes to this corner of the upright photo.
            let corner = match orientation {
                3 => [399.0, 299.0],
                6 => [299.0, 0.0],
                8 => [0.0, 399.0],
                _ => [0.0, 0.0],
            };
            assert_eq!(stored(&photo, corner), [0.0, 0.0]);
        }
    }

    #[test]
    fn a_phone_used_upright_and_sideways_has_one_lens() {
        let widths = Widths {
            focal: 0.15,
            given_focal: 5e-4,
            centre: 0.01,
            given_centre_px: 0.5,
            radial: 0.1,
        };
        let mut other = photo(400, 300, 1);
        other.device = "Camera 7".into();
        let photos = Photos {
            photos: vec![photo(400, 300, 1), photo(300, 400, 6), other],
            ..Photos::default()
        };
        let groups = Groups::new(&photos, &widths);
        assert_eq!(groups.of, [0, 0, 1]);
        proof::near(groups.lenses[0].focal[0], film_to_px(26.0, 400, 300), 1e-9);
    }
}
