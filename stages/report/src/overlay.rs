//! A small picture of each photo with the silhouette's outline and the sections over it.

use crate::base64::base64;
use nalgebra::{Point2, Point3};
use shape::{Camera, Girths, Mask, Rgb, rgb_to_jpeg};
use std::fmt::Write;

/// The photo, reduced by a whole factor so that it is at most `most_px` high.
pub(crate) fn reduced(photo: &Rgb, most_px: usize) -> (Rgb, usize) {
    let factor = photo.height.div_ceil(most_px.max(1)).max(1);
    let (width, height) = (photo.width / factor, photo.height / factor);
    let mut small = Rgb::filled(width, height, [0; 3]);
    for (y, x) in (0..height).flat_map(|y| (0..width).map(move |x| (y, x))) {
        let mut sum = [0u32; 3];
        for dy in 0..factor {
            let row = &photo.row(y * factor + dy)[x * factor..(x + 1) * factor];
            row.iter()
                .for_each(|p| (0..3).for_each(|c| sum[c] += u32::from(p[c])));
        }
        *small.at_mut(x, y) = sum.map(|s| (s / (factor * factor) as u32) as u8);
    }
    (small, factor)
}

/// Makes the part around some pixels of the photo unrecognisable: big blocks of one colour.
pub(crate) fn blur(photo: &mut Rgb, at_px: &[Point2<f64>]) {
    if at_px.is_empty() {
        return;
    }
    let fold =
        |f: fn(f64, f64) -> f64, c: usize| at_px.iter().map(|p| p[c]).reduce(f).unwrap_or(0.0);
    let (x0, x1, y0, y1) = (
        fold(f64::min, 0),
        fold(f64::max, 0),
        fold(f64::min, 1),
        fold(f64::max, 1),
    );
    let (margin, block) = ((y1 - y0) * 0.1, ((y1 - y0) / 6.0).max(8.0) as usize);
    let clamp = |x: f64, size: usize| x.clamp(0.0, size as f64) as usize;
    let (x0, x1) = (
        clamp(x0 - margin, photo.width),
        clamp(x1 + margin, photo.width),
    );
    let (y0, y1) = (
        clamp(y0 - margin, photo.height),
        clamp(y1 + margin, photo.height),
    );
    for (by, bx) in (y0..y1)
        .step_by(block)
        .flat_map(|y| (x0..x1).step_by(block).map(move |x| (y, x)))
    {
        let (ey, ex) = ((by + block).min(y1), (bx + block).min(x1));
        let mut sum = [0u64; 3];
        let pixels = (by..ey).flat_map(|y| (bx..ex).map(move |x| (x, y)));
        for (x, y) in pixels.clone() {
            (0..3).for_each(|c| sum[c] += u64::from(photo.at(x, y)[c]));
        }
        let mean = sum.map(|s| (s / ((ey - by) * (ex - bx)) as u64) as u8);
        pixels.for_each(|(x, y)| *photo.at_mut(x, y) = mean);
    }
}

/// One figure: the reduced photo, the outline of its mask and the sections as SVG paths over it.
pub(crate) fn figure(
    name: &str,
    (small, factor): &(Rgb, usize),
    mask: Option<&Mask>,
    camera: Option<&Camera>,
    girths: &Girths,
) -> String {
    let (w, h) = (small.width, small.height);
    let image = base64(&rgb_to_jpeg(small, 70));
    let mut svg = format!(
        "<figure><svg viewBox=\"0 0 {w} {h}\"><image width=\"{w}\" height=\"{h}\" \
         href=\"data:image/jpeg;base64,{image}\"/>"
    );
    if let Some(mask) = mask {
        let _ = write!(
            svg,
            "<path class=\"outline\" d=\"{}\"/>",
            outline(mask, *factor, w, h)
        );
    }
    if let Some(camera) = camera {
        let to_small =
            |p: Point2<f64>| (p.coords.add_scalar(0.5) / *factor as f64).add_scalar(-0.5);
        for girth in &girths.girths {
            let mut d = String::new();
            for p in girth
                .contour
                .iter()
                .step_by((girth.contour.len() / 120).max(1))
            {
                let Some(at) = camera.project(&Point3::from(p.map(f64::from))) else {
                    continue;
                };
                let at = to_small(at);
                let _ = write!(
                    d,
                    "{}{:.1},{:.1}",
                    if d.is_empty() { 'M' } else { 'L' },
                    at.x,
                    at.y
                );
            }
            if !d.is_empty() {
                let _ = write!(svg, "<path class=\"tape\" d=\"{d}Z\"/>");
            }
        }
    }
    svg + "</svg><figcaption>" + &crate::tables::escaped(name) + "</figcaption></figure>"
}

/// The border of a mask on the reduced photo, as pieces along pixel edges.
fn outline(mask: &Mask, factor: usize, w: usize, h: usize) -> String {
    let at = |x: usize, y: usize| {
        let (x, y) = (x * factor + factor / 2, y * factor + factor / 2);
        x < mask.width && y < mask.height && mask.at(x, y) > 127
    };
    let mut d = String::new();
    for y in 1..h {
        let mut x = 0;
        while x < w {
            let run = (x..w).take_while(|x| at(*x, y) != at(*x, y - 1)).count();
            if run > 0 {
                let _ = write!(d, "M{x},{y}h{run}");
            }
            x += run.max(1);
        }
    }
    for x in 1..w {
        let mut y = 0;
        while y < h {
            let run = (y..h).take_while(|y| at(x, *y) != at(x - 1, *y)).count();
            if run > 0 {
                let _ = write!(d, "M{x},{y}v{run}");
            }
            y += run.max(1);
        }
    }
    d
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_blurred_face_is_a_few_blocks() {
        let data = (0..100 * 100)
            .map(|i| [(i * 7 % 251) as u8, (i * 13 % 241) as u8, 9])
            .collect();
        let mut photo = Rgb {
            width: 100,
            height: 100,
            data,
        };
        let before = photo.clone();
        blur(
            &mut photo,
            &[Point2::new(30.0, 30.0), Point2::new(60.0, 60.0)],
        );
        let mut colors: Vec<_> = (30..60)
            .flat_map(|y| photo.row(y)[30..60].to_vec())
            .collect();
        colors.sort_unstable();
        colors.dedup();
        assert!(colors.len() <= 36, "{}", colors.len());
        assert_eq!(photo.at(5, 5), before.at(5, 5));
    }

    #[test]
    fn an_outline_runs_around_the_mask() {
        let mut mask = Mask::filled(8, 8, 0);
        (2..6).for_each(|y| (3..5).for_each(|x| *mask.at_mut(x, y) = 255));
        assert_eq!(outline(&mask, 1, 8, 8), "M3,2h2M3,6h2M3,2v4M5,2v4");
    }
}
