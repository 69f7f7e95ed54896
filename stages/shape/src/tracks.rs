//! Points seen on several photos.

use crate::PhotoId;
use stage::{Artifact, Corrupt, Packer, Unpacker};

/// Where one photo shows a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Observation {
    /// On which photo.
    pub photo: PhotoId,
    /// Where. \[px\]
    pub at_px: [f32; 2],
    /// Size of the feature. \[px\]
    pub scale_px: f32,
}

/// Points seen on several photos: each list has at least two observations, on different photos.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Tracks {
    /// One list a point, by photo.
    pub points: Vec<Vec<Observation>>,
}

impl Artifact for Tracks {
    const KIND: &'static str = "tracks";
    const FORMAT: u32 = 1;

    fn pack(&self, to: &mut Packer) {
        let all = || self.points.iter().flatten();
        let lengths: Vec<u32> = self.points.iter().map(|p| p.len() as u32).collect();
        to.section("lengths", &lengths);
        to.section("photos", &all().map(|s| s.photo.0).collect::<Vec<_>>());
        let places: Vec<[f32; 3]> = all()
            .map(|s| [s.at_px[0], s.at_px[1], s.scale_px])
            .collect();
        to.section("places", &places);
    }

    fn unpack(from: &Unpacker<'_>) -> Result<Self, Corrupt> {
        let (lengths, photos): (Vec<u32>, Vec<u32>) =
            (from.section("lengths")?, from.section("photos")?);
        let places: Vec<[f32; 3]> = from.section("places")?;
        let total: usize = lengths.iter().map(|n| *n as usize).sum();
        if total != photos.len() || total != places.len() {
            return Err(Corrupt(
                "tracks of another length than their observations".into(),
            ));
        }
        let mut all = photos
            .iter()
            .zip(&places)
            .map(|(photo, &[x, y, scale_px])| Observation {
                photo: PhotoId(*photo),
                at_px: [x, y],
                scale_px,
            });
        let points = lengths
            .iter()
            .map(|n| all.by_ref().take(*n as usize).collect())
            .collect();
        Ok(Tracks { points })
    }
}
