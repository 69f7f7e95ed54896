//! A made-up body, a tube on a disk, with three photos and one girth.

use nalgebra::{Rotation3, Vector3};
use report::HtmlInput;
use shape::{
    Camera, Cameras, Girth, GirthId, Girths, Intrinsics, Landmark, Mask, Mesh, Missing, Part,
    Photo, PhotoId, Photos, Plane, Pose, Profile, Refusal, Rgb, Scale, Sigmas, View, rgb_to_jpeg,
};
use std::f64::consts::TAU;
use std::sync::Arc;

/// A tube around the z axis, of so many faces around and up.
pub(crate) fn tube(radius: f32, height: f32, around: u32, rows: u32) -> Mesh {
    let mut mesh = Mesh::default();
    for row in 0..=rows {
        for i in 0..around {
            let (s, c) = libm::sincosf(i as f32 / around as f32 * std::f32::consts::TAU);
            mesh.positions
                .push([radius * c, radius * s, height * row as f32 / rows as f32]);
        }
    }
    for row in 0..rows {
        for i in 0..around {
            let (a, b) = (row * around + i, row * around + (i + 1) % around);
            mesh.faces
                .extend([[a, b, b + around], [a, b + around, a + around]]);
        }
    }
    mesh
}

fn camera(angle: f64) -> Camera {
    let rotation = Rotation3::from_matrix_unchecked(nalgebra::Matrix3::from_rows(&[
        Vector3::new(libm::cos(angle), libm::sin(angle), 0.0).transpose(),
        Vector3::new(0.0, 0.0, -1.0).transpose(),
        Vector3::new(-libm::sin(angle), libm::cos(angle), 0.0).transpose(),
    ]));
    let translation = Vector3::new(0.0, 200.0, 1500.0);
    Camera {
        lens: Intrinsics::simple(120, 180, 300.0),
        pose: Pose {
            rotation,
            translation,
        },
    }
}

/// Three gray photos.
fn photos() -> Photos {
    let pixels = Rgb {
        width: 120,
        height: 180,
        data: vec![[120, 80, 60]; 120 * 180],
    };
    let photo = |i: usize| Photo::of(format!("{i:04}.jpg"), [120, 180], rgb_to_jpeg(&pixels, 80));
    Photos {
        photos: (0..3).map(photo).collect(),
        ..Photos::default()
    }
}

/// A waist, with all that is known of how sure it is.
fn waist() -> Girth {
    let contour = (0..60).map(|i| {
        let (s, c) = libm::sincosf(i as f32 / 60.0 * std::f32::consts::TAU);
        [80.0 * c, 80.0 * s, 200.0]
    });
    let plane = Plane {
        point_mm: [0.0, 0.0, 200.0],
        normal: [0.0, 0.0, 1.0],
    };
    let mark = Landmark::new(GirthId::Waist, plane, Part::Trunk);
    Girth {
        label: "waist <natural>".into(),
        definition: "horizontal, at the \"natural\" waist".into(),
        contour_mm: 502.6,
        spline_mm: 502.7,
        silhouette_mm: Some(501.9),
        interval_mm: Some([500.0, 505.0]),
        sigmas: Sigmas {
            level_mm: Some(1.2),
            surface_mm: Some(0.8),
            scale_mm: None,
            split_mm: Some(0.0),
            cover_mm: Some(0.0),
        },
        contour: contour.collect(),
        ..Girth::at(&mark, 502.5)
    }
}

/// All that the report takes.
pub(crate) fn input() -> HtmlInput {
    let mut mask = Mask::filled(120, 180, 0);
    (40..140).for_each(|y| (45..75).for_each(|x| *mask.at_mut(x, y) = 255));
    let ids = || (0..3).map(PhotoId);
    let view = |id: PhotoId| View {
        name: format!("{:04}.jpg", id.0),
        camera: camera(f64::from(id.0) * TAU / 3.0),
        sigma_mm: Some(0.2),
        rms_px: Some(0.3),
        points: 90,
    };
    let profile = Profile {
        height_mm: (0..40).map(|i| f64::from(i) * 10.0).collect(),
        tape_mm: (0..40)
            .map(|i| 500.0 + 20.0 * libm::sin(f64::from(i) / 6.0))
            .collect(),
    };
    let missing = vec![Missing::because(
        GirthId::Neck,
        Refusal::NoNeck,
        "there is no neck",
    )];
    HtmlInput {
        photos: Some(Arc::new(photos())),
        masks: Some(Arc::new(ids().map(|id| (id, &mask)).collect())),
        cameras: Some(Arc::new(Cameras {
            views: ids().map(|id| (id, view(id))).collect(),
            scale: Scale::Mat,
            scale_sigma: Some(0.001),
            disk_radius_mm: Some(225.0),
            ground_mm: 0.0,
            points: vec![],
        })),
        body: Arc::new(tube(80.0, 400.0, 48, 20)),
        textured: None,
        hull: Some(Arc::new(tube(84.0, 400.0, 48, 20))),
        rigid: None,
        weighted_median: None,
        other: None,
        landmarks: None,
        girths: Arc::new(Girths {
            girths: vec![waist()],
            missing,
            profile,
            ..Girths::default()
        }),
    }
}
