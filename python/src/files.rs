//! Files of the documented formats from arrays, and back: pictures and surfaces.

use crate::artifact::Artifact;
use crate::fault::guarded;
use command::Fault;
use engine::graph::InputDecl;
use engine::source::Memo;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use shape::{Image, Mesh};
use stage::{AnyArtifact, Artifact as _, Ctx, Files, Stop};
use std::collections::BTreeMap;
use std::path::Path;
use tailor::catalog::{CATALOG, IMPORTERS};

/// Numbers of a known width out of bytes.
fn numbers<T, const N: usize>(bytes: &[u8], of: impl Fn([u8; 4]) -> T) -> Vec<[T; N]> {
    let four = bytes.as_chunks::<4>().0.iter().map(|b| of(*b));
    let mut all = four.collect::<Vec<T>>().into_iter();
    let mut rows = Vec::with_capacity(bytes.len() / (4 * N));
    while let Ok(row) = all.by_ref().take(N).collect::<Vec<T>>().try_into() {
        rows.push(row);
    }
    rows
}

/// A picture of one or three channels as PNG.
pub(crate) fn png(
    py: Python<'_>,
    pixels: Vec<u8>,
    width: usize,
    height: usize,
    channels: usize,
) -> PyResult<Py<PyBytes>> {
    let bytes = guarded(py, || {
        let wants = width
            .checked_mul(height)
            .and_then(|n| n.checked_mul(channels));
        if wants != Some(pixels.len()) || wants == Some(0) {
            return Err(Fault::input(
                "a picture has width × height × channels bytes, one at least",
            ));
        }
        match channels {
            1 => Ok(shape::gray_to_png(&Image {
                width,
                height,
                data: pixels,
            })),
            3 => {
                let data = pixels.as_chunks::<3>().0.to_vec();
                Ok(shape::rgb_to_png(&Image {
                    width,
                    height,
                    data,
                }))
            }
            _ => Err(Fault::input("a picture has one channel or three")),
        }
    })?;
    Ok(PyBytes::new(py, &bytes).unbind())
}

/// A surface as PLY: three 32-bit floats a vertex, three 32-bit numbers a face, three bytes of colour a vertex or none.
pub(crate) fn ply(
    py: Python<'_>,
    positions: &[u8],
    faces: &[u8],
    colors: &[u8],
) -> PyResult<Py<PyBytes>> {
    let bytes = guarded(py, || {
        let mesh = Mesh {
            positions: numbers(positions, f32::from_le_bytes),
            faces: numbers(faces, u32::from_le_bytes),
            colors: colors.as_chunks::<3>().0.to_vec(),
            // What its numbers are in is given where it is taken.
            unit: shape::Unit::Metric,
        };
        if !mesh.colors.is_empty() && mesh.colors.len() != mesh.positions.len() {
            return Err(Fault::input("a surface has a colour a vertex, or none"));
        }
        Ok(shape::mesh_to_ply(&mesh))
    })?;
    Ok(PyBytes::new(py, &bytes).unbind())
}

/// Files of a kind as an artifact, by the kind's importer; a surface as it is in its file.
pub(crate) fn taken(
    kind: &str,
    folder: &Path,
    beside: Option<&Artifact>,
) -> Result<Artifact, Fault> {
    let importer = CATALOG.importer(kind).ok_or_else(|| {
        let known: Vec<&str> = IMPORTERS.iter().map(|i| i.stage.yields()).collect();
        Fault::input(stage::unknown(
            "kind that can be taken from files",
            kind,
            &known,
        ))
    })?;
    let files = engine::source::files(
        folder,
        &InputDecl {
            name: kind.into(),
            about: String::new(),
            files: importer.files.iter().map(|f| (*f).to_owned()).collect(),
        },
        &mut Memo::default(),
    );
    let (files, stage) = (files.map_err(Fault::input)?, importer.stage);
    if kind == Mesh::KIND {
        let one = files
            .entries
            .first()
            .ok_or_else(|| Fault::input("there is no file"))?;
        let bytes = files.read(one).map_err(Fault::input)?;
        let mesh = shape::mesh_from_ply(&bytes).map_err(Fault::input)?;
        return Ok(Artifact::of(stage::to_bytes(&mesh), stage));
    }
    let beside = match beside {
        Some(beside) => Some(beside.read()?),
        None => None,
    };
    let port = |port: stage::PortSpec| match port.kind == Files::KIND {
        true => Some(AnyArtifact::new(files.clone())),
        false => beside.clone().filter(|b| b.kind() == port.kind),
    };
    let ports: Vec<_> = stage.ports();
    let missing = ports.iter().find(|p| {
        let given = beside.as_ref().is_some_and(|b| b.kind() == p.kind);
        !p.optional && p.kind != Files::KIND && !given
    });
    if let Some(port) = missing {
        let what = format!(
            "{kind} are read beside {}: let the stage take them, too",
            port.kind
        );
        return Err(Fault::input(what));
    }
    let inputs = ports.into_iter().map(port).collect();
    let params = stage.check(&BTreeMap::new());
    let params = params.map_err(|_| Fault::stage("bug: an importer that needs params"))?;
    match stage.run(&params, inputs, &Ctx::alone()) {
        Ok(made) => Ok(Artifact::of(made.bytes, stage)),
        Err(Stop::Cancelled) => Err(Fault::stopped()),
        Err(Stop::Failed(why)) => Err(Fault::stage(why)),
    }
}
