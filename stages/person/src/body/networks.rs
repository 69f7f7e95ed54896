//! The two networks, and all people on a photo by them.

use super::detect::detections;
use super::pose::pose;
use crate::net::{Network, Unreadable};
use crate::same::{alike, present};
use shape::{Found, Rgb};

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
        let mut all: Vec<Found> = Vec::new();
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
