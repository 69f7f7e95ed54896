//! A textured ball on a ring of cameras: photos, cameras and masks by formula.

use nalgebra::{Point3, Vector3};
use shape::{
    ByPhoto, Camera, Cameras, Intrinsics, Mask, Masks, Mesh, Photo, PhotoId, Photos, Scale, View,
};

pub(crate) const RADIUS: f64 = 60.0;
pub(crate) const COUNT: u32 = 12;

/// A camera on a ring, looking at the origin.
pub(crate) fn camera(k: u32) -> Camera {
    let angle = f64::from(k) * std::f64::consts::TAU / f64::from(COUNT);
    let centre = Point3::new(400.0 * libm::cos(angle), 400.0 * libm::sin(angle), 90.0);
    Camera::looking(
        Intrinsics::simple(160, 160, 400.0),
        centre,
        Point3::origin(),
    )
}

/// Brightness of a point of the body: a few waves through space.
pub(crate) fn texture(x: &Point3<f64>, contrast: f64) -> f64 {
    let waves: [[f64; 4]; 6] = [
        [0.30, 0.11, 0.17, 0.0],
        [-0.31, 0.55, 0.18, 1.0],
        [0.12, -0.44, 0.61, 2.0],
        [0.83, 0.39, -0.47, 3.0],
        [-0.71, 0.66, 0.92, 4.0],
        [0.95, -0.88, 0.31, 5.0],
    ];
    let sum: f64 = waves
        .iter()
        .map(|w| libm::sin(w[0] * x.x + w[1] * x.y + w[2] * x.z + w[3]))
        .sum();
    128.0 + contrast * sum
}

/// The ball moved by `shifts`, as each camera sees it.
pub(crate) fn turn(contrast: f64, shifts: &[Vector3<f64>]) -> (Photos, Cameras, Masks) {
    let (mut photos, mut views, mut masks) = (Photos::default(), vec![], vec![]);
    for k in 0..COUNT {
        let camera = camera(k);
        let at = shifts.get(k as usize).copied().unwrap_or_default();
        let mut image = image::RgbImage::new(160, 160);
        let mut mask = Mask::filled(160, 160, 0);
        for (x, y, pixel) in image.enumerate_pixels_mut() {
            let ray = camera.ray([f64::from(x), f64::from(y)].into());
            let from = camera.centre() - at;
            let (b, c) = (
                from.coords.dot(&ray),
                from.coords.norm_squared() - RADIUS * RADIUS,
            );
            let root = b * b - c;
            let value = if root > 0.0 {
                *mask.at_mut(x as usize, y as usize) = 255;
                texture(&(from + *ray * (-b - root.sqrt())), contrast)
            } else {
                30.0
            };
            *pixel = image::Rgb([value.clamp(0.0, 255.0).round() as u8; 3]);
        }
        let mut file = std::io::Cursor::new(Vec::new());
        image.write_to(&mut file, image::ImageFormat::Png).unwrap();
        let name = format!("{k:04}.png");
        photos
            .photos
            .push(Photo::of(name.clone(), [160, 160], file.into_inner()));
        views.push((PhotoId(k), View::of(name, camera)));
        masks.push((PhotoId(k), mask));
    }
    let cameras = Cameras {
        views: views.into_iter().collect::<ByPhoto<View>>(),
        scale: Scale::Given,
        scale_sigma: None,
        disk_radius_mm: None,
        ground_mm: -RADIUS,
        points: vec![],
    };
    (photos, cameras, masks.into_iter().collect())
}

/// A ball cut from an octahedron.
pub(crate) fn ball(radius: f64) -> Mesh {
    let side: i32 = 14;
    let mut places = std::collections::BTreeMap::new();
    let mut mesh = Mesh::default();
    let mut vertex = |p: [i32; 3]| -> u32 {
        *places.entry(p).or_insert_with(|| {
            let v = Vector3::from(p.map(f64::from)).normalize() * radius;
            mesh.positions.push([v.x as f32, v.y as f32, v.z as f32]);
            mesh.positions.len() as u32 - 1
        })
    };
    let mut faces = vec![];
    for signs in 0..8 {
        let s = [0, 1, 2].map(|i| if signs >> i & 1 == 0 { 1 } else { -1 });
        for i in 0..side {
            for j in 0..side - i {
                let at = |i: i32, j: i32| [s[0] * i, s[1] * j, s[2] * (side - i - j)];
                let mut add = |a, b, c| {
                    let [a, b, c] = [a, b, c].map(&mut vertex);
                    faces.push(if s[0] * s[1] * s[2] > 0 {
                        [a, b, c]
                    } else {
                        [a, c, b]
                    });
                };
                add(at(i, j), at(i + 1, j), at(i, j + 1));
                if i + j < side - 1 {
                    add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
                }
            }
        }
    }
    mesh.faces = faces;
    mesh.validate_closed().unwrap();
    assert!(mesh.volume() > 0.0);
    mesh
}

#[allow(dead_code)]
/// Mean distance of the band that the cameras see well from the true ball. \[mm\]
pub(crate) fn off(mesh: &Mesh) -> f64 {
    let band = (0..mesh.positions.len() as u32)
        .map(|v| mesh.point(v))
        .filter(|x| x.z > -25.0 && x.z < 45.0);
    let far: Vec<f64> = band.map(|x| (x.coords.norm() - RADIUS).abs()).collect();
    far.iter().sum::<f64>() / far.len() as f64
}
