//! What flows between the toys: a text as bytes.

use stage::{Artifact, Corrupt, Packer, Unpacker};

/// A text of some media type.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Document {
    /// Its media type: `text/html`, `image/png`.
    pub media: String,
    /// Its bytes.
    pub bytes: Vec<u8>,
}

impl Artifact for Document {
    const KIND: &'static str = "document";
    const FORMAT: u32 = 1;

    fn pack(&self, to: &mut Packer) {
        to.meta(&self.media);
        to.section("bytes", &self.bytes);
    }

    fn unpack(from: &Unpacker<'_>) -> Result<Self, Corrupt> {
        Ok(Document {
            media: from.meta()?,
            bytes: from.section("bytes")?,
        })
    }
}
