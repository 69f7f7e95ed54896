//! The edges of its photo that somebody's body comes to: there it may be cut off.

use crate::{Found, People, Photos};
use nalgebra::Point2;

/// So many of the network's pixels along an edge. By hand: looked at its outline, which is right to one or two of them,
/// so fewer may be chance.
const ALONG_EDGE_PX: usize = 3;

/// An edge of a photo.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Edge {
    /// Above the head of an upright body.
    Upper,
    /// Below the feet.
    Lower,
    /// Left or right.
    Side,
}

impl Found {
    /// The edges of a photo of this size \[px\] that the body comes to within a pixel of the network.
    pub fn edges(&self, [width, height]: [u32; 2]) -> Vec<Edge> {
        let pixel = f64::from(self.pixel_px());
        if pixel <= 0.0 {
            return vec![];
        }
        let (width, height) = (f64::from(width), f64::from(height));
        let along = |length: f64, at: &dyn Fn(f64) -> Point2<f64>| {
            let steps = (length / pixel).ceil() as usize;
            let body = |k: &usize| {
                let at = at((*k as f64 + 0.5) * pixel);
                self.log_odds(at).is_some_and(|odds| odds > 0.0)
            };
            (0..steps).filter(body).count() >= ALONG_EDGE_PX
        };
        let reaches = [
            (Edge::Upper, along(width, &|t| Point2::new(t, pixel))),
            (
                Edge::Lower,
                along(width, &|t| Point2::new(t, height - 1.0 - pixel)),
            ),
            (Edge::Side, along(height, &|t| Point2::new(pixel, t))),
            (
                Edge::Side,
                along(height, &|t| Point2::new(width - 1.0 - pixel, t)),
            ),
        ];
        let reached = reaches.into_iter().filter(|(_, reached)| *reached);
        reached.map(|(edge, _)| edge).collect()
    }
}

impl People {
    /// The photos whose lower edge cuts off the feet of the one who is followed, if most do: then heights are unknown.
    pub fn without_feet(&self, photos: &Photos) -> Option<Vec<String>> {
        let cut = photos.iter().filter(|(id, photo)| {
            let subject = self.subject(*id);
            subject.is_some_and(|f| f.edges([photo.width, photo.height]).contains(&Edge::Lower))
        });
        let names: Vec<String> = cut.map(|(_, photo)| photo.name.clone()).collect();
        (2 * names.len() > photos.photos.len()).then_some(names)
    }
}
