//! The two networks, and all people on a photo by them.

use super::detect::{Detection, detections};
use super::pose::{around_face, pose};
use crate::net::{Network, Unreadable};
use crate::same::{alike, present};
use shape::{Crop, Found, Rgb};

/// The networks that find people.
#[derive(Debug)]
pub struct Networks {
    detector: Network,
    landmarks: Network,
}

impl Networks {
    /// Those of `models/person/`, in the program.
    ///
    /// # Errors
    ///
    /// A file in the program is unsound: a bug.
    pub fn built_in() -> Result<Networks, Unreadable> {
        Ok(Networks {
            detector: Network::read(include_bytes!("../../../../models/person/detector.net"))?,
            landmarks: Network::read(include_bytes!("../../../../models/person/landmarks.net"))?,
        })
    }

    /// Everybody on a photo, the surest of each look first. Who was found is painted over, and whoever is left is looked
    /// for again: of two who are side by side the network often sees one.
    pub fn people(&self, photo: &Rgb) -> Vec<Found> {
        self.with_the_rest(photo, Vec::new())
    }

    /// The same of a photo on which the first network does not find who is in a square; nothing if the second sees
    /// that one less surely than `presence`, or elsewhere.
    pub fn people_with(&self, photo: &Rgb, square: &Crop, presence: f32) -> Option<Vec<Found>> {
        let seen = Detection {
            score: 0.0,
            head_px: [0.0; 4],
            crop: *square,
        };
        let mut found = pose(&self.landmarks, photo, &seen, &[]);
        found.head_px = around_face(&found.joints);
        let there = found.presence >= presence && alike(&found.crop, square);
        there.then(|| self.with_the_rest(photo, vec![found]))
    }

    fn with_the_rest(&self, photo: &Rgb, mut all: Vec<Found>) -> Vec<Found> {
        loop {
            let seen = detections(&self.detector, photo, &all);
            let near = seen.iter().map(|d| pose(&self.landmarks, photo, d, &all));
            let new = |f: &Found| {
                all.is_empty() || present(f) && all.iter().all(|a| !alike(&f.crop, &a.crop))
            };
            let new: Vec<Found> = near.filter(new).collect();
            if new.is_empty() {
                return all;
            }
            all.extend(new);
        }
    }
}
