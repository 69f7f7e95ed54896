//! A mesh with an atlas: what a viewer shows.

use crate::{Image, Mesh, Rgb, Unit};
use stage::{Artifact, Corrupt, Packer, Unpacker};

/// A mesh, the place of each face's corners on the atlas, and the atlas.
#[derive(Debug, Clone, PartialEq)]
pub struct Textured {
    /// The surface.
    pub mesh: Mesh,
    /// Three corners a face, in 0..=1 from the atlas' top-left corner; as many as faces.
    pub corners: Vec<[[f32; 2]; 3]>,
    /// The atlas.
    pub atlas: Rgb,
}

impl Artifact for Textured {
    const KIND: &'static str = "textured";
    const FORMAT: u32 = 2;

    fn pack(&self, to: &mut Packer) {
        to.meta(&(
            self.mesh.unit,
            self.atlas.width as u64,
            self.atlas.height as u64,
        ));
        self.mesh.sections(to);
        to.section("corners", &self.corners);
        to.section("atlas", &self.atlas.data);
    }

    fn unpack(from: &Unpacker<'_>) -> Result<Self, Corrupt> {
        let (unit, width, height): (Unit, u64, u64) = from.meta()?;
        let mesh = Mesh::from_sections(unit, from)?;
        let atlas = Image {
            width: width as usize,
            height: height as usize,
            data: from.section("atlas")?,
        };
        let corners: Vec<[[f32; 2]; 3]> = from.section("corners")?;
        let pixels = atlas.width.checked_mul(atlas.height);
        if corners.len() != mesh.faces.len() || pixels != Some(atlas.data.len()) {
            return Err(Corrupt(
                "mesh, corners and atlas do not fit together".into(),
            ));
        }
        Ok(Textured {
            mesh,
            corners,
            atlas,
        })
    }
}
