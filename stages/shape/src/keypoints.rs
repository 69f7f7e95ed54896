//! Points of photos that can be found again on other photos, with what surrounds them.

use crate::{ByPhoto, PhotoId};
use bytemuck::{Pod, Zeroable};
use stage::{Artifact, Corrupt, Packer, Unpacker};

/// A point of a photo. \[px; radians, x towards y\]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Keypoint {
    /// Column.
    pub x: f32,
    /// Row.
    pub y: f32,
    /// Standard deviation of the blob.
    pub scale: f32,
    /// Orientation.
    pub angle: f32,
}

/// The points of one photo and their descriptors, as many as points.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Features {
    /// The points.
    pub points: Vec<Keypoint>,
    /// Square roots of normalised gradient histograms, times 512 (RootSIFT).
    pub descriptors: Vec<[u8; 128]>,
}

/// The features of each photo.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Keypoints {
    /// By photo.
    pub views: ByPhoto<Features>,
}

impl Artifact for Keypoints {
    const KIND: &'static str = "keypoints";
    const FORMAT: u32 = 1;

    fn pack(&self, to: &mut Packer) {
        to.meta(
            &self
                .views
                .iter()
                .map(|(id, _)| id)
                .collect::<Vec<PhotoId>>(),
        );
        for (id, features) in self.views.iter() {
            to.section(format!("points {}", id.0), &features.points);
            to.section(format!("descriptors {}", id.0), &features.descriptors);
        }
    }

    fn unpack(from: &Unpacker<'_>) -> Result<Self, Corrupt> {
        let ids: Vec<PhotoId> = from.meta()?;
        let one = |id: PhotoId| {
            let points: Vec<Keypoint> = from.section(&format!("points {}", id.0))?;
            let descriptors: Vec<[u8; 128]> = from.section(&format!("descriptors {}", id.0))?;
            if points.len() != descriptors.len() {
                return Err(Corrupt("not a descriptor a point".into()));
            }
            Ok((
                id,
                Features {
                    points,
                    descriptors,
                },
            ))
        };
        Ok(Keypoints {
            views: ids.into_iter().map(one).collect::<Result<_, Corrupt>>()?,
        })
    }
}
