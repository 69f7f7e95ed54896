//! Surfaces from elsewhere: units, axes, and what is no surface.

use capture::{Surface, SurfaceInput, SurfaceParams, Unit, Up};
use shape::{Mesh, mesh_to_ply};
use stage::{Ctx, FileEntry, Files, Stage, Stop, hash};
use std::path::Path;
use std::sync::Arc;

/// A closed box with its lower corner at the origin.
fn block(size: [f32; 3]) -> Mesh {
    let (positions, faces) = proof::block(size);
    Mesh {
        positions,
        faces,
        ..Mesh::default()
    }
}

fn taken(folder: &Path, names: &[&str], params: &SurfaceParams) -> Result<Mesh, String> {
    let entry = |name: &&str| {
        let bytes = std::fs::read(folder.join(name)).unwrap();
        FileEntry {
            name: (*name).into(),
            content: hash(&bytes),
            size: bytes.len() as u64,
        }
    };
    let files = Arc::new(Files {
        root: folder.into(),
        entries: names.iter().map(entry).collect(),
    });
    match Surface::run(params, SurfaceInput { files }, &Ctx::alone()) {
        Ok(mesh) => Ok(mesh),
        Err(Stop::Failed(e)) => Err(e.to_string()),
        Err(Stop::Cancelled) => Err("cancelled".into()),
    }
}

#[test]
fn units_become_millimetres_and_the_axis_that_points_up_becomes_z_without_mirroring() {
    let folder = tempfile::tempdir().unwrap();
    let tall = block([0.3, 1.8, 0.5]);
    std::fs::write(folder.path().join("scan.ply"), mesh_to_ply(&tall)).unwrap();
    let metres = SurfaceParams {
        unit: Unit::M,
        up: Up::Y,
    };
    let mesh = taken(folder.path(), &["scan.ply"], &metres).unwrap();
    let (low, high) = mesh.bounds().unwrap();
    let size = high - low;
    proof::near(size.z, 1800.0, 1e-3);
    proof::near(size.x, 500.0, 1e-3);
    proof::near(size.y, 300.0, 1e-3);
    assert!(mesh.volume() > 0.0, "faces still look outward");
    // Read as millimetres it is a crumb, which is told with what to set.
    let wrong = taken(folder.path(), &["scan.ply"], &SurfaceParams::default()).unwrap_err();
    assert!(wrong.contains("set `unit`"), "{wrong}");
}

#[test]
fn what_is_no_closed_surface_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, bytes: &[u8]| std::fs::write(folder.path().join(name), bytes).unwrap();
    write("a.ply", &mesh_to_ply(&block([300.0, 200.0, 1700.0])));
    write("noise.ply", b"not a mesh");
    let cloud = Mesh {
        faces: vec![],
        ..block([300.0, 200.0, 1700.0])
    };
    write("cloud.ply", &mesh_to_ply(&cloud));
    let said = |names: &[&str]| taken(folder.path(), names, &SurfaceParams::default());
    assert!(said(&["a.ply"]).is_ok());
    assert!(
        said(&[])
            .unwrap_err()
            .contains("one PLY file is wanted, but 0")
    );
    assert!(said(&["a.ply", "noise.ply"]).unwrap_err().contains("but 2"));
    assert!(
        said(&["noise.ply"])
            .unwrap_err()
            .contains("cannot be read as a PLY mesh")
    );
    assert!(said(&["cloud.ply"]).unwrap_err().contains("no faces"));
}
