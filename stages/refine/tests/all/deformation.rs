//! A body that deformed differently in each photo is seen as if it had not moved.

use crate::turn;

use refine::{EstimateDeformation, EstimateDeformationInput};
use shape::{Cameras, Masks, Photos, Warps, gray_from_file, gray_to_png};
use stage::{Ctx, Stage};
use turn::{COUNT, RADIUS, ball, camera, turn};

/// The offset by which photo `k` shows what should be seen at a pixel.
fn offset(k: u32, [x, y]: [f64; 2]) -> [f64; 2] {
    // Photos shift to and fro in turn, so that what they share is nothing.
    let sign = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
    let phase = f64::from(k / 2);
    [
        sign * 0.9 * libm::sin(0.03 * y + phase),
        sign * 0.7 * libm::cos(0.025 * x + 2.0 * phase),
    ]
}

/// The ball's photos, each drawn where it is seen.
fn scene(deforms: bool) -> (Photos, Cameras, Masks) {
    let (mut photos, cameras, masks) = turn(18.0, &[]);
    for (k, photo) in photos.photos.iter_mut().enumerate().filter(|_| deforms) {
        let flat = gray_from_file(&photo.file).unwrap();
        let straight = flat.map(|v| f32::from(*v));
        let mut image = flat;
        for y in 0..image.height {
            for x in 0..image.width {
                // What lands on a pixel came from where the offset points back to.
                let mut from = [x as f64, y as f64];
                for _ in 0..5 {
                    let o = offset(k as u32, from);
                    from = [x as f64 - o[0], y as f64 - o[1]];
                }
                *image.at_mut(x, y) = straight.sample(from[0] as f32, from[1] as f32).round() as u8;
            }
        }
        photo.file = gray_to_png(&image).into();
    }
    (photos, cameras, masks)
}

fn found(deforms: bool) -> Warps {
    let (photos, cameras, masks) = scene(deforms);
    let mut p = <EstimateDeformation as Stage>::Params::default();
    (p.look.size.level, p.cell_px, p.differ_px, p.contour_weight) = (0, 16.0, 0.6, 0.0);
    let input = EstimateDeformationInput {
        mesh: ball(RADIUS).into(),
        photos: photos.into(),
        cameras: cameras.into(),
        masks: Some(masks.into()),
    };
    EstimateDeformation::run(&p, input, &Ctx::alone()).unwrap()
}

/// Rms over the middle of the ball of what is left of the deformation, and of the deformation. \[px\]
fn left(warps: &Warps, deforms: bool) -> (f64, f64) {
    let (mut left, mut all, mut count) = (0.0, 0.0, 0.0);
    for k in 0..COUNT {
        let middle = camera(k).project(&nalgebra::Point3::origin()).unwrap();
        let warp = warps.views.get(shape::PhotoId(k)).unwrap();
        for (i, j) in (-4..=4).flat_map(|i| (-4..=4).map(move |j| (i, j))) {
            let at = [middle.x + 8.0 * f64::from(i), middle.y + 8.0 * f64::from(j)];
            let (want, got) = (if deforms { offset(k, at) } else { [0.0; 2] }, warp.at(at));
            left += (want[0] - got[0]).powi(2) + (want[1] - got[1]).powi(2);
            all += want[0].powi(2) + want[1].powi(2);
            count += 1.0;
        }
    }
    ((left / count).sqrt(), (all / count).sqrt())
}

#[test]
fn most_of_a_smooth_deformation_is_found() {
    let (left, all) = left(&found(true), true);
    assert!(left < 0.5 * all, "{left:.3} of {all:.3} px are left");
}

#[test]
fn a_body_that_did_not_deform_is_left_alone() {
    let (false_px, _) = left(&found(false), false);
    assert!(false_px < 0.06, "{false_px:.3} px");
}
