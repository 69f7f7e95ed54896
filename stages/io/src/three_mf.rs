//! Meshes as 3MF (core specification 1.3), for printers: always in millimetres.

use crate::write_error::WriteError;
use shape::{Mesh, Unit};
use std::fmt::Write as _;
use std::io::{Cursor, Write as _};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipWriter};

/// A mesh of unknown scale: the format knows lengths in millimetres, inches and so on alone.
#[derive(Debug, thiserror::Error)]
#[error(
    "lengths of this surface are relative, for nothing of known length was given or known lengths contradict each other, and 3MF has no such unit: give one, such as the stature, or write PLY, OBJ or STL"
)]
pub struct NoUnit;

const TYPES: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types"><Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/><Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>
"#;

const RELATIONS: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship Target="/3D/3dmodel.model" Id="rel0" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>
"#;

/// A mesh as a 3MF package; the same bytes for the same mesh.
///
/// # Errors
///
/// Lengths are relative ([`NoUnit`]).
pub fn mesh_to_3mf(mesh: &Mesh) -> Result<Vec<u8>, WriteError> {
    if mesh.unit == Unit::Relative {
        return Err(NoUnit.into());
    }
    let mut model = String::from(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"millimeter\" xml:lang=\"en\" xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\
         <metadata name=\"Application\">tailor</metadata><resources><object id=\"1\" type=\"model\"><mesh>\n<vertices>\n",
    );
    for [x, y, z] in &mesh.positions {
        let _ = writeln!(model, "<vertex x=\"{x}\" y=\"{y}\" z=\"{z}\"/>");
    }
    model += "</vertices>\n<triangles>\n";
    for [a, b, c] in &mesh.faces {
        let _ = writeln!(model, "<triangle v1=\"{a}\" v2=\"{b}\" v3=\"{c}\"/>");
    }
    model +=
        "</triangles>\n</mesh></object></resources><build><item objectid=\"1\"/></build></model>\n";
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    // No clock: the format's first day.
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .last_modified_time(DateTime::default());
    for (name, text) in [
        ("[Content_Types].xml", TYPES),
        ("_rels/.rels", RELATIONS),
        ("3D/3dmodel.model", &model),
    ] {
        zip.start_file(name, options)?;
        zip.write_all(text.as_bytes())?;
    }
    Ok(zip.finish()?.into_inner())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Read;

    #[test]
    fn a_package_holds_its_model_in_millimetres_and_no_relative_one() {
        let mesh = Mesh {
            positions: vec![[0.0; 3], [2.5, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 4.0]],
            faces: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
            ..Mesh::default()
        };
        let bytes = mesh_to_3mf(&mesh).unwrap();
        assert_eq!(bytes, mesh_to_3mf(&mesh).unwrap());
        let mut package = zip::ZipArchive::new(Cursor::new(bytes)).unwrap();
        assert_eq!(package.len(), 3);
        let mut model = String::new();
        package
            .by_name("3D/3dmodel.model")
            .unwrap()
            .read_to_string(&mut model)
            .unwrap();
        for part in [
            "unit=\"millimeter\"",
            "<vertex x=\"2.5\" y=\"0\" z=\"0\"/>",
            "<triangle v1=\"2\" v2=\"0\" v3=\"3\"/>",
        ] {
            assert!(model.contains(part), "{part}");
        }
        let relative = Mesh {
            unit: Unit::Relative,
            ..mesh
        };
        assert!(
            mesh_to_3mf(&relative)
                .unwrap_err()
                .to_string()
                .contains("relative")
        );
    }
}
