//! Marker tags found on photos.

use crate::{ByPhoto, PhotoId};
use serde::{Deserialize, Serialize};
use stage::{Artifact, Corrupt, Packer, Unpacker};

/// One tag on one photo.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Tag {
    /// Its number in the family.
    pub id: u32,
    /// Corners of its black square as printed: top left, top right, bottom right, bottom left. \[px\]
    pub corners: [[f64; 2]; 4],
}

/// The tags on each photo.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Tags {
    /// By photo, sorted by number.
    pub views: ByPhoto<Vec<Tag>>,
}

impl Artifact for Tags {
    const KIND: &'static str = "tags";
    const FORMAT: u32 = 1;

    fn pack(&self, to: &mut Packer) {
        let views: Vec<(PhotoId, &Vec<Tag>)> = self.views.iter().collect();
        to.meta(&views);
    }

    fn unpack(from: &Unpacker<'_>) -> Result<Self, Corrupt> {
        let views: Vec<(PhotoId, Vec<Tag>)> = from.meta()?;
        Ok(Tags {
            views: views.into_iter().collect(),
        })
    }
}
