//! Silhouettes: how much of each pixel the body covers.

use crate::{ByPhoto, Camera, Image, MaskRuns, PhotoId};
use nalgebra::{Point2, Point3};
use stage::{Artifact, Corrupt, Packer, Unpacker};
use std::ops::Range;

/// How much of each pixel is body: 0 none, 255 all; the border runs where it crosses 127.5.
pub type Mask = Image<u8>;

impl Mask {
    /// Whether the body covers the pixel nearest to a point; nothing is body outside.
    #[inline]
    pub fn shows(&self, at_px: Point2<f64>) -> bool {
        // Cut towards zero after half a pixel more, they are rounded.
        let (x, y) = (at_px.x + 0.5, at_px.y + 0.5);
        let inside = x >= 0.0 && y >= 0.0 && x < self.width as f64 && y < self.height as f64;
        inside && self.at(x as usize, y as usize) > 127
    }

    /// Whether a photo's mask has a point of space as body; `None` where the photo does not look.
    #[inline]
    pub fn shows_point(&self, camera: &Camera, x: &Point3<f64>) -> Option<bool> {
        let px = camera.project(x).filter(|px| camera.holds(*px))?;
        Some(self.shows(px))
    }

    /// How many pixels are body.
    pub fn area(&self) -> usize {
        self.data.iter().filter(|c| **c > 127).count()
    }

    /// The columns and rows of the body, from the first to the last; [`None`] where nothing is body.
    pub fn extent(&self) -> Option<[Range<usize>; 2]> {
        let body = |c: &u8| *c > 127;
        let shown = |y: &usize| self.row(*y).iter().any(body);
        let top = (0..self.height).find(shown)?;
        let bottom = (0..self.height).rev().find(shown)?;
        let (mut left, mut right) = (self.width, 0);
        for y in top..=bottom {
            let row = self.row(y);
            left = row[..left].iter().position(body).unwrap_or(left);
            let beyond = row[right..].iter().rposition(body);
            right = beyond.map_or(right, |x| right + x + 1);
        }
        Some([left..right, top..bottom + 1])
    }
}

/// One silhouette a photo.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Masks {
    /// The photos that have one.
    pub views: ByPhoto<MaskRuns>,
}

impl<M: Into<MaskRuns>> FromIterator<(PhotoId, M)> for Masks {
    fn from_iter<I: IntoIterator<Item = (PhotoId, M)>>(masks: I) -> Self {
        let masks = masks.into_iter().map(|(id, mask)| (id, mask.into()));
        Masks {
            views: masks.collect(),
        }
    }
}

impl Artifact for Masks {
    const KIND: &'static str = "masks";
    const FORMAT: u32 = 1;

    fn pack(&self, to: &mut Packer) {
        let sizes: Vec<_> = self
            .views
            .iter()
            .map(|(id, m)| (id.0, m.width as u32, m.height as u32))
            .collect();
        to.meta(&sizes);
        for (id, mask) in self.views.iter() {
            to.section(format!("mask {}", id.0), mask.bytes());
        }
    }

    fn unpack(from: &Unpacker<'_>) -> Result<Self, Corrupt> {
        let sizes: Vec<(u32, u32, u32)> = from.meta()?;
        let mask = |(id, width, height): (u32, u32, u32)| {
            let runs = from.section(&format!("mask {id}"))?;
            let size = [width, height].map(|n| n as usize);
            Ok((PhotoId(id), MaskRuns::stored(size, runs)?))
        };
        sizes.into_iter().map(mask).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn masks_come_back_from_their_runs() {
        let mut mask = Mask::filled(70, 50, 0);
        for (i, c) in mask.data.iter_mut().enumerate() {
            *c = if i % 7 < 3 { (i % 256) as u8 } else { 255 };
        }
        let masks = Masks::from_iter([(PhotoId(3), &mask)]);
        let back = stage::from_bytes::<Masks>(&stage::to_bytes(&masks)).unwrap();
        assert_eq!(back, masks);
        let runs = back.views.get(PhotoId(3)).unwrap();
        assert_eq!(runs.pixels(), mask);
        assert_eq!(runs.share(), mask.area() as f64 / 3500.0);
    }
}
