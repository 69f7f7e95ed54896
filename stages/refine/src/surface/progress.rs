//! An evolution under way, as a run that was stopped finds it again.

use shape::Mesh;

/// An evolution under way: where it is, and the best that it was.
pub struct Progress {
    /// The surface so far.
    pub mesh: Mesh,
    /// The most consistent so far.
    pub best: Mesh,
    /// How consistent that is.
    pub score: f64,
    /// How consistent the start was.
    pub first: f64,
    /// Share of the vertices that two photos see.
    pub seen: f64,
    /// How many looks were taken.
    pub done: u32,
}

impl Progress {
    /// Keeps a mesh if it is the most consistent so far.
    pub fn keep(&mut self, score: f64, mesh: &Mesh) {
        if self.done == 0 {
            self.first = score;
        }
        if self.done == 0 || score > self.score {
            self.score = score;
            self.best = mesh.clone();
        }
    }
}

impl stage::Artifact for Progress {
    const KIND: &'static str = "refine.progress";
    const FORMAT: u32 = 1;

    fn pack(&self, to: &mut stage::Packer) {
        to.meta(&(self.score, self.first, self.seen, self.done));
        for (name, mesh) in [("mesh", &self.mesh), ("best", &self.best)] {
            to.section(format!("{name} positions"), &mesh.positions);
            to.section(format!("{name} faces"), &mesh.faces);
        }
    }

    fn unpack(from: &stage::Unpacker<'_>) -> Result<Self, stage::Corrupt> {
        let (score, first, seen, done) = from.meta()?;
        let mesh = |name: &str| -> Result<Mesh, stage::Corrupt> {
            let mesh = Mesh {
                positions: from.section(&format!("{name} positions"))?,
                faces: from.section(&format!("{name} faces"))?,
                ..Mesh::default()
            };
            let whole = mesh.validate();
            whole.map_err(|fault| stage::Corrupt(fault.to_string()))?;
            Ok(mesh)
        };
        Ok(Progress {
            mesh: mesh("mesh")?,
            best: mesh("best")?,
            score,
            first,
            seen,
            done,
        })
    }
}
