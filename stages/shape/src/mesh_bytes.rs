//! A mesh as an artifact's bytes.

use crate::{Mesh, Unit};
use stage::{Artifact, Corrupt, Packer, Unpacker};

impl Artifact for Mesh {
    const KIND: &'static str = "mesh";
    const FORMAT: u32 = 2;

    fn pack(&self, to: &mut Packer) {
        to.meta(&self.unit);
        self.sections(to);
    }

    fn unpack(from: &Unpacker<'_>) -> Result<Self, Corrupt> {
        Mesh::from_sections(from.meta()?, from)
    }
}

impl Mesh {
    /// Packs all but the unit, which is among the metadata of what holds the mesh.
    pub fn sections(&self, to: &mut Packer) {
        to.section("positions", &self.positions);
        to.section("faces", &self.faces);
        to.section("colors", &self.colors);
    }

    /// What [`Mesh::sections`] packed.
    ///
    /// # Errors
    ///
    /// A section that is missing, or a mesh that is not sound.
    pub fn from_sections(unit: Unit, from: &Unpacker<'_>) -> Result<Self, Corrupt> {
        let positions = from.section("positions")?;
        let (faces, colors) = (from.section("faces")?, from.section("colors")?);
        let mesh = Mesh {
            positions,
            faces,
            colors,
            unit,
        };
        mesh.validate()
            .map_err(|fault| Corrupt(fault.to_string()))?;
        if !mesh.colors.is_empty() && mesh.colors.len() != mesh.positions.len() {
            return Err(Corrupt("not a color a vertex".into()));
        }
        Ok(mesh)
    }
}
