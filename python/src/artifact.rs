//! An artifact's bytes, which numpy looks into without copying them.

use crate::describe::describe;
use crate::fault::guarded;
use command::Fault;
use engine::out;
use engine::store::Blob;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use shape::{PhotoId, Photos, Rgb};
use stage::{AnyArtifact, AnyStage};
use std::sync::{Arc, OnceLock};

/// A result as it is in the store, verified. It stays in memory as long as an array looks into it.
#[pyclass(frozen, module = "tailor._native")]
pub(crate) struct Artifact {
    blob: Source,
    stage: &'static dyn AnyStage,
    photos: OnceLock<Arc<Photos>>,
}

/// Where the bytes are: in a blob of the store, or in memory alone.
enum Source {
    Blob(Blob),
    Own(Vec<u8>),
}

impl std::ops::Deref for Source {
    type Target = [u8];
    fn deref(&self) -> &[u8] {
        match self {
            Source::Blob(blob) => blob,
            Source::Own(bytes) => bytes,
        }
    }
}

impl Artifact {
    /// A node's result.
    pub(crate) fn new(blob: Blob, stage: &'static dyn AnyStage) -> Artifact {
        Artifact {
            blob: Source::Blob(blob),
            stage,
            photos: OnceLock::new(),
        }
    }

    /// The bytes of an artifact of the kind that a stage yields.
    pub(crate) fn of(bytes: Vec<u8>, stage: &'static dyn AnyStage) -> Artifact {
        Artifact {
            blob: Source::Own(bytes),
            stage,
            photos: OnceLock::new(),
        }
    }

    /// As stages read it.
    pub(crate) fn read(&self) -> Result<AnyArtifact, Fault> {
        self.stage.read(&self.blob).map_err(Fault::stage)
    }

    /// The photos in it, taken apart once.
    fn photos(&self) -> Result<Arc<Photos>, Fault> {
        if let Some(photos) = self.photos.get() {
            return Ok(photos.clone());
        }
        let read = self.stage.read(&self.blob).map_err(Fault::stage)?;
        let photos = read.downcast::<Photos>();
        let photos = photos.ok_or_else(|| Fault::input("these are no photos"))?;
        Ok(self.photos.get_or_init(|| photos).clone())
    }
}

/// What numpy asks for (the array interface, version 3): bytes at a place that nobody may write to.
fn interface<'py>(py: Python<'py>, bytes: &[u8], shape: &[usize]) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("version", 3)?;
    dict.set_item("typestr", "|u1")?;
    dict.set_item("shape", pyo3::types::PyTuple::new(py, shape)?)?;
    dict.set_item("data", (bytes.as_ptr() as usize, true))?;
    Ok(dict)
}

#[pymethods]
impl Artifact {
    /// What it is called.
    #[getter]
    fn kind(&self) -> &'static str {
        self.stage.yields()
    }

    /// The version of its layout.
    #[getter]
    fn format(&self) -> u32 {
        self.stage.format()
    }

    #[getter]
    fn __array_interface__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        interface(py, &self.blob, &[self.blob.len()])
    }

    /// Its arrays: name, size of an element, first and last byte.
    fn sections(&self, py: Python<'_>) -> PyResult<Vec<(String, usize, usize, usize)>> {
        guarded(py, || {
            let file = stage::opened(&self.blob).map_err(Fault::stage)?;
            let wants = (self.stage.yields(), self.stage.format());
            if file.kind() != wants {
                let (kind, format) = file.kind();
                let what = format!(
                    "it holds {kind} format {format}, not {} format {}",
                    wants.0, wants.1
                );
                return Err(Fault::stage(what));
            }
            let all = file.sections();
            let all = all.map(|(name, element, at)| (name.to_owned(), element, at.start, at.end));
            Ok(all.collect())
        })
    }

    /// All but its arrays, as JSON.
    fn document(&self, py: Python<'_>) -> PyResult<String> {
        guarded(py, || match self.kind() {
            "photos" => Ok(crate::describe::photos(&*self.photos()?).to_string()),
            _ => describe(&self.blob, self.stage),
        })
    }

    /// As files in a format of its kind that needs nothing else.
    fn files(&self, py: Python<'_>, format: &str) -> PyResult<Vec<(String, Py<PyBytes>)>> {
        let files = guarded(py, || {
            let artifact = self.stage.read(&self.blob).map_err(Fault::stage)?;
            let (catalog, raw) = (tailor::program().catalog, || self.blob.to_vec());
            out::files(catalog, artifact, raw, None, Some(format)).map_err(Fault::input)
        })?;
        let file = |(name, bytes): (String, Vec<u8>)| (name, PyBytes::new(py, &bytes).unbind());
        Ok(files.into_iter().map(file).collect())
    }

    /// A photo's pixels, upright; -1 is the plate.
    fn pixels(&self, py: Python<'_>, photo: i64) -> PyResult<Pixels> {
        guarded(py, || {
            let photos = self.photos()?;
            let found = match u32::try_from(photo) {
                Ok(id) => photos.get(PhotoId(id)),
                Err(_) => photos.plate.as_ref(),
            };
            let found = found.ok_or_else(|| Fault::input("there is no such photo"))?;
            found.decode().map(Pixels::rgb).map_err(Fault::stage)
        })
    }

    fn __len__(&self) -> usize {
        self.blob.len()
    }
}

/// An array of Rust's, which numpy looks into.
#[pyclass(frozen, module = "tailor._native")]
pub(crate) struct Pixels {
    bytes: Vec<u8>,
    shape: Vec<usize>,
}

impl Pixels {
    /// An image of three channels.
    pub(crate) fn rgb(image: Rgb) -> Pixels {
        let shape = vec![image.height, image.width, 3];
        let bytes = image.data.into_flattened();
        Pixels { bytes, shape }
    }
}

#[pymethods]
impl Pixels {
    #[getter]
    fn __array_interface__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        interface(py, &self.bytes, &self.shape)
    }
}
