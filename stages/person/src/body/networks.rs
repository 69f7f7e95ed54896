//! The two networks, and all people on a photo by them.

use super::detect::detections;
use super::pose::pose;
use crate::net::{Network, Unreadable};
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

    /// Everybody on a photo, the surest first.
    pub fn people(&self, photo: &Rgb) -> Vec<Found> {
        let seen = detections(&self.detector, photo);
        let all = seen.iter().map(|d| pose(&self.landmarks, photo, d));
        all.collect()
    }
}
