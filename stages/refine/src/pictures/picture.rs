//! One photo, ready to be compared: free of distortion, one level of its Gaussian pyramid.

use crate::pictures::border::Border;
use crate::pictures::crop::Crop;
use crate::pictures::fixed::{Fixed, fixed, sample, to_steps, whole};
use crate::pictures::halving::halved;
use crate::pictures::pinhole::{halved_size, pinhole, straightened};
use crate::pictures::resample::resampled;
use nalgebra::{Matrix3x4, Point3, Vector3};
use shape::{Camera, Gray, Intrinsics, Mask, Outline, Warp, signed_distance};
use std::sync::Arc;

/// What a photo shows at one level of the pyramid, wherever it was taken from: of one with a silhouette only the part that
/// shows the body.
pub struct Shown {
    gray: Arc<Fixed>,
    whole: [usize; 2],
    corner: [usize; 2],
    inside: Option<Arc<Fixed>>,
    border: Option<Border>,
    noise: f32,
}

/// A photo's brightness at one level of the pyramid, its pinhole camera, and its silhouette; of a photo with a silhouette
/// only the part that shows the body.
pub struct Picture {
    /// Brightness, 0..=255, as a lens without distortion would show it.
    pub gray: Arc<Fixed>,
    /// Width and height of the whole photo at this level. \[px\]
    pub whole: [usize; 2],
    /// Where this picture begins on it: column and row of its first pixel. \[px\]
    pub corner: [usize; 2],
    /// `pixel ~ projection * (x, 1)`, in pixels of this picture and millimetres.
    pub projection: Matrix3x4<f64>,
    /// The camera's centre. \[mm\]
    pub centre: Point3<f64>,
    /// Focal length. \[px of this level\]
    pub focal: f64,
    /// Signed distance to the silhouette's border, positive inside. \[px of this level\]
    pub inside: Option<Arc<Fixed>>,
    /// How sure that border is.
    pub border: Option<Border>,
    /// Standard deviation of the noise, estimated from the photo itself. \[grey levels\]
    pub noise: f32,
}

impl Shown {
    /// Prepares a photo with this lens, halved `halvings` times: what is the body by its silhouette and what is close
    /// around it, all of it where there is none.
    pub fn new(gray: Gray, lens: &Intrinsics, mask: Option<&Mask>, halvings: u32) -> Self {
        let noise = noise(&gray);
        let whole = halved_size(lens, halvings);
        let level = pinhole(lens, whole);
        let crop = match mask {
            Some(mask) => Crop::around(mask, lens, &level),
            None => Crop::whole(whole),
        };
        let part = match mask {
            Some(_) => crop.in_photo(&level, lens, 1 << halvings),
            None => Crop::whole([gray.width, gray.height]),
        };
        let (shown, photo) = (crop.lens(&level), part.lens(lens));
        let mut gray = match part.area() < gray.data.len() {
            true => part.of(&gray),
            false => gray,
        };
        for _ in 0..halvings {
            gray = halved(&gray);
        }
        let read = photo.resized(gray.width as u32, gray.height as u32);
        // At full size: what is halved first closes narrow gaps, as between hand and hip.
        let inside = mask.map(|mask| {
            let far = signed_distance(&part.of(mask));
            let scale = whole[0] as f32 / lens.width as f32;
            straightened(&far, &photo, &shown, |d| to_steps(d * scale))
        });
        let gray = match lens.radial != [0.0; 2] || mask.is_some() {
            true => straightened(&gray, &read, &shown, to_steps),
            false => fixed(&gray),
        };
        Shown {
            gray: Arc::new(gray),
            whole,
            corner: crop.corner,
            inside: inside.map(Arc::new),
            border: None,
            // A halving by [1 3 3 1]/8 along both sides leaves 5/16 of white noise's deviation.
            noise: (noise * 0.3125f32.powi(halvings as i32)).max(0.25),
        }
    }

    /// With what a photo with this lens shows of its outline.
    pub fn with_outline(self, outline: &Outline, lens: &Intrinsics) -> Self {
        let border = Some(Border::of(outline, lens, self.whole));
        Shown { border, ..self }
    }
}

impl Picture {
    /// Prepares a photo as [`Shown::new`] does.
    pub fn new(gray: Gray, camera: &Camera, mask: Option<&Mask>, halvings: u32) -> Self {
        Self::of(&Shown::new(gray, &camera.lens, mask, halvings), camera)
    }

    /// What a photo shows, taken by a camera whose lens it was prepared for.
    pub fn of(shown: &Shown, camera: &Camera) -> Self {
        let crop = Crop {
            corner: shown.corner,
            size: [shown.gray.width, shown.gray.height],
        };
        let lens = crop.lens(&pinhole(&camera.lens, shown.whole));
        Picture {
            gray: Arc::clone(&shown.gray),
            whole: shown.whole,
            corner: shown.corner,
            projection: projection(&lens, camera),
            centre: camera.centre(),
            focal: focal(&lens),
            inside: shown.inside.clone(),
            border: shown.border.clone(),
            noise: shown.noise,
        }
    }

    /// As [`Self::new`] makes it, but for what it shows: for who asks where a camera sees what, and not what.
    pub fn blank(camera: &Camera, halvings: u32) -> Self {
        let whole = halved_size(&camera.lens, halvings);
        let lens = pinhole(&camera.lens, whole);
        Picture {
            gray: Arc::new(Fixed {
                width: whole[0],
                height: whole[1],
                data: vec![],
            }),
            whole,
            corner: [0; 2],
            projection: projection(&lens, camera),
            centre: camera.centre(),
            focal: focal(&lens),
            inside: None,
            border: None,
            noise: 0.0,
        }
    }

    /// The picture as it would be had the body not deformed: what is seen at an offset by `warp`,
    /// brought back. `warp` in pixels of the photo, `photo_width` wide.
    pub fn undeformed(&self, warp: &Warp, photo_width: u32) -> Self {
        let scale = self.whole[0] as f64 / f64::from(photo_width);
        let (width, height) = (self.gray.width, self.gray.height);
        let of_photo = |k: usize, i: usize| ((k + self.corner[i]) as f64 + 0.5) / scale - 0.5;
        let columns: Vec<f64> = (0..width).map(|x| of_photo(x, 0)).collect();
        let rows = warp.rows_at(&columns);
        let drawn = |image: &Arc<Fixed>| -> Arc<Fixed> {
            let drawn = resampled(
                image,
                (width, height),
                whole,
                #[inline(always)]
                |y, to_x, to_y| {
                    rows.offsets(of_photo(y, 1), |x, offset| {
                        to_x[x] = (x as f64 + offset[0] * scale) as f32;
                        to_y[x] = (y as f64 + offset[1] * scale) as f32;
                    });
                },
            );
            Arc::new(drawn)
        };
        Picture {
            gray: drawn(&self.gray),
            whole: self.whole,
            corner: self.corner,
            projection: self.projection,
            centre: self.centre,
            focal: self.focal,
            inside: self.inside.as_ref().map(drawn),
            // Nearly alike from pixel to pixel.
            border: self.border.clone(),
            noise: self.noise,
        }
    }

    /// The same picture, taken from elsewhere.
    pub fn moved(&mut self, camera: &Camera) {
        let crop = Crop {
            corner: self.corner,
            size: [self.gray.width, self.gray.height],
        };
        self.projection = projection(&crop.lens(&pinhole(&camera.lens, self.whole)), camera);
        self.centre = camera.centre();
    }

    /// Pixel and depth of a point. [`None`] behind the camera. \[px, mm\]
    #[inline]
    pub fn project(&self, x: &Point3<f64>) -> Option<([f64; 2], f64)> {
        let p = self.projection * x.to_homogeneous();
        (p.z > 0.0).then(|| ([p.x / p.z, p.y / p.z], p.z))
    }

    /// How the pixel of a point moves with the point, the two rows of the Jacobian. \[px/mm\]
    pub fn jacobian(&self, x: &Point3<f64>) -> [Vector3<f64>; 2] {
        let p = self.projection * x.to_homogeneous();
        let row =
            |r: usize| -> Vector3<f64> { self.projection.fixed_view::<1, 3>(r, 0).transpose() };
        [0, 1].map(|r| (row(r) - row(2) * (p[r] / p.z)) / p.z)
    }

    /// Whether a pixel is at least `margin` pixels from the picture's edge.
    #[inline]
    pub fn holds(&self, at: [f64; 2], margin: f64) -> bool {
        let (w, h) = (self.gray.width as f64, self.gray.height as f64);
        at[0] >= margin && at[1] >= margin && at[0] < w - 1.0 - margin && at[1] < h - 1.0 - margin
    }

    /// Signed distance of a pixel to the silhouette's border, positive inside. [`None`] without a silhouette. \[px\]
    #[inline]
    pub fn inside_px(&self, at: [f64; 2]) -> Option<f32> {
        let inside = self.inside.as_ref()?;
        Some(sample(inside, at[0] as f32, at[1] as f32))
    }

    /// Standard deviation of the silhouette's border near a pixel; 0 where it is not known. \[px\]
    pub fn border_sigma(&self, at: [f64; 2]) -> f64 {
        let on_whole = [0, 1].map(|i| at[i] + self.corner[i] as f64);
        let sigma = |border: &Border| border.sigma_px(on_whole);
        self.border.as_ref().map_or(0.0, sigma)
    }

    /// What a pixel covers at a depth. \[mm\]
    pub fn footprint(&self, depth_mm: f64) -> f64 {
        depth_mm / self.focal
    }
}

/// Focal length, the mean of both. \[px\]
fn focal(lens: &Intrinsics) -> f64 {
    f64::from((lens.focal[0] * lens.focal[1]) as f32).sqrt()
}

/// `K (R | t)` of a pinhole.
fn projection(lens: &Intrinsics, camera: &Camera) -> Matrix3x4<f64> {
    let mut pose = Matrix3x4::zeros();
    pose.fixed_view_mut::<3, 3>(0, 0)
        .copy_from(camera.pose.rotation.matrix());
    pose.set_column(3, &camera.pose.translation);
    lens.matrix() * pose
}

/// Standard deviation of an image's noise: the median of its responses to a mask that is blind to
/// constant, linear and quadratic brightness (after Immerkær 1996). \[grey levels\]
pub fn noise(image: &Gray) -> f32 {
    let mut responses = Vec::new();
    for y in (1..image.height.saturating_sub(1)).step_by(3) {
        let [a, b, c] = [y - 1, y, y + 1].map(|y| image.row(y));
        for x in (1..image.width.saturating_sub(1)).step_by(3) {
            let cross = a[x - 1] + a[x + 1] + c[x - 1] + c[x + 1];
            let plus = a[x] + c[x] + b[x - 1] + b[x + 1];
            responses.push((cross - 2.0 * plus + 4.0 * b[x]).abs());
        }
    }
    if responses.is_empty() {
        return 0.0;
    }
    let middle = responses.len() / 2;
    let (_, median, _) = responses.select_nth_unstable_by(middle, f32::total_cmp);
    // White noise of deviation 1 gives a response of deviation 6, whose absolute median is 0.6745 of it.
    *median / (6.0 * 0.6745)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_is_found_beneath_a_slope() {
        let mut dice = proof::Dice(3);
        let mut normal = || (0..12).map(|_| dice.unit()).sum::<f64>() - 6.0;
        let data = (0..200 * 200).map(|i| (i % 200) as f32 + 3.0 * normal() as f32);
        let image = Gray {
            width: 200,
            height: 200,
            data: data.collect(),
        };
        assert!((noise(&image) - 3.0).abs() < 0.2, "{}", noise(&image));
    }
}
