//! How a subject moved between photos, against the disk.

use crate::{ByPhoto, Pose};
use stage::{Artifact, Corrupt, Packer, Unpacker};

/// Rigid motion of the subject in each photo: `x_in_world = pose * x_at_rest`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Sway {
    /// The photos in which it is known.
    pub views: ByPhoto<Pose>,
}

impl Artifact for Sway {
    const KIND: &'static str = "sway";
    const FORMAT: u32 = 1;

    fn pack(&self, to: &mut Packer) {
        to.meta(&self.views);
    }

    fn unpack(from: &Unpacker<'_>) -> Result<Self, Corrupt> {
        Ok(Sway {
            views: from.meta()?,
        })
    }
}
