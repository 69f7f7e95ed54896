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
        scan: false,
    };
    let mesh = taken(folder.path(), &["scan.ply"], &metres).unwrap();
    let (low, high) = mesh.bounds().unwrap();
    let size = high - low;
    proof::near(size.z, 1800.0, 1e-3);
    proof::near(size.x, 500.0, 1e-3);
    proof::near(size.y, 300.0, 1e-3);
    assert!(mesh.volume() > 0.0, "faces still look outward");
    // Read as millimetres it is a crumb, which is refused with what to set.
    let wrong = taken(folder.path(), &["scan.ply"], &SurfaceParams::default()).unwrap_err();
    assert!(wrong.contains("set `unit`"), "{wrong}");
}

#[test]
fn what_is_no_closed_surface_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, bytes: &[u8]| std::fs::write(folder.path().join(name), bytes).unwrap();
    write("a.ply", &mesh_to_ply(&block([300.0, 200.0, 1700.0])));
    write("noise.ply", b"not a mesh");
    let cloud = Mesh {
        faces: vec![],
        ..block([300.0, 200.0, 1700.0])
    };
    write("cloud.ply", &mesh_to_ply(&cloud));
    let result = |names: &[&str]| taken(folder.path(), names, &SurfaceParams::default());
    assert!(result(&["a.ply"]).is_ok());
    assert!(
        result(&[])
            .unwrap_err()
            .contains("one file with a surface is wanted, but 0")
    );
    assert!(
        result(&["a.ply", "noise.ply"])
            .unwrap_err()
            .contains("but 2")
    );
    assert!(
        result(&["noise.ply"])
            .unwrap_err()
            .contains("cannot be read as a mesh")
    );
    assert!(result(&["cloud.ply"]).unwrap_err().contains("no faces"));
}

/// A closed body of square sections, of given widths at their heights, arms' breadth along x. \[m\]
fn figure() -> Mesh {
    // Height, half across, half deep: feet, knees, hip, waist, shoulders, neck, head, crown.
    let rows = [
        (0.0, 0.12, 0.12),
        (0.45, 0.1, 0.06),
        (0.85, 0.2, 0.12),
        (1.1, 0.15, 0.1),
        (1.4, 0.25, 0.12),
        (1.48, 0.06, 0.06),
        (1.6, 0.09, 0.1),
        (1.7, 0.05, 0.06),
    ];
    let mut mesh = Mesh::default();
    for (z, x, y) in rows {
        let ring = [[-x, -y, z], [x, -y, z], [x, y, z], [-x, y, z]];
        mesh.positions.extend(ring);
    }
    let top = 4 * (rows.len() as u32 - 1);
    for k in (0..top).step_by(4) {
        for i in 0..4 {
            let (a, b) = (k + i, k + (i + 1) % 4);
            mesh.faces.extend([[a, b, b + 4], [a, b + 4, a + 4]]);
        }
    }
    mesh.faces.extend([[0, 2, 1], [0, 3, 2]]);
    mesh.faces
        .extend([[top, top + 1, top + 2], [top, top + 2, top + 3]]);
    mesh
}

fn put(mesh: &mut Mesh, other: &Mesh, at: [f32; 3]) {
    let first = mesh.positions.len() as u32;
    let moved = |p: &[f32; 3]| std::array::from_fn(|k| p[k] + at[k]);
    mesh.positions.extend(other.positions.iter().map(moved));
    let faces = other.faces.iter().map(|f| f.map(|v| v + first));
    mesh.faces.extend(faces);
}

/// What becomes of a mesh that is looked at as at a scan.
fn recognised(mesh: &Mesh) -> Result<Mesh, String> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.ply"), mesh_to_ply(mesh)).unwrap();
    let params = SurfaceParams {
        unit: Unit::Auto,
        up: Up::Auto,
        scan: true,
    };
    taken(folder.path(), &["a.ply"], &params)
}

#[test]
fn unit_axis_pieces_and_sides_of_a_scan_are_recognised() {
    let own = figure();
    assert!(own.validate_closed().is_ok() && own.volume() > 0.0);
    let turns: [fn([f32; 3]) -> [f32; 3]; 6] = [
        |[x, y, z]| [x, y, z],
        |[x, y, z]| [x, -y, -z],
        |[x, y, z]| [x, z, -y],
        |[x, y, z]| [x, -z, y],
        |[x, y, z]| [z, x, y],
        |[x, y, z]| [-z, x, -y],
    ];
    for turn in turns {
        for unit in [1.0, 100.0, 1000.0, 1.0 / 0.0254] {
            let mut scan = own.clone();
            // A floor that is open, and a speck.
            let floor = Mesh {
                positions: vec![[-2., -2., 0.], [2., -2., 0.], [2., 2., 0.], [-2., 2., 0.]],
                faces: vec![[0, 1, 2], [0, 2, 3]],
                ..Mesh::default()
            };
            put(&mut scan, &floor, [0.0, 0.0, -0.001]);
            put(&mut scan, &block([0.01; 3]), [0.5, 0.0, 1.0]);
            scan.faces.iter_mut().for_each(|f| f.swap(0, 1));
            scan.positions
                .iter_mut()
                .for_each(|p| *p = turn(p.map(|x| x * unit)));
            let mesh = recognised(&scan).unwrap();
            assert_eq!(mesh.faces.len(), own.faces.len());
            let (low, high) = mesh.bounds().unwrap();
            proof::near(high.z - low.z, 1700.0, 0.1);
            // The head is above, and nothing is mirrored or inside out.
            let crown = mesh
                .positions
                .iter()
                .filter(|p| f64::from(p[2]) > high.z - 1.0);
            let across = crown
                .map(|p| p[0].abs().min(p[1].abs()))
                .fold(0.0, f32::max);
            proof::near(f64::from(across), 50.0, 0.1);
            assert!(mesh.volume() > 0.0);
        }
    }
}

#[test]
fn two_bodies_in_a_file_are_refused() {
    let mut two = figure();
    put(&mut two, &figure(), [1.0, 0.0, 0.0]);
    let why = recognised(&two).unwrap_err();
    assert!(why.contains("two large pieces"), "{why}");
}
