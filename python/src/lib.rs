//! `tailor._native`: the engine and the product for Python. What Python sees is `python/tailor/`.
#![cfg(feature = "extension")]

mod artifact;
mod asked;
mod describe;
mod fault;
mod files;
mod graph;
mod job;
mod outcome;

use pyo3::prelude::*;
use pyo3::types::PyBytes;

/// The engine and the product.
#[pymodule]
mod _native {
    use super::*;

    #[pymodule_export]
    use super::artifact::{Artifact, Pixels};
    #[pymodule_export]
    use super::graph::Graph;
    #[pymodule_export]
    use super::outcome::Run;

    /// The product's version.
    #[pymodule_export]
    #[allow(non_upper_case_globals)]
    const version: &str = env!("CARGO_PKG_VERSION");

    /// The command line; its exit code.
    #[pyfunction]
    fn main(py: Python<'_>, words: Vec<String>) -> PyResult<u8> {
        fault::guarded(py, || Ok(command::run(tailor::program(), words)))
    }

    /// `tailor measure` with these arguments: the run, the folder of results, warnings as JSON.
    #[pyfunction]
    fn measure(
        py: Python<'_>,
        words: Vec<String>,
        cache: std::path::PathBuf,
        threads: Option<usize>,
        hear: Option<Py<PyAny>>,
    ) -> PyResult<(Run, std::path::PathBuf, Vec<String>)> {
        outcome::measured(py, words, cache, threads, hear)
    }

    /// Runs a sweep, printed by the code behind `tailor sweep`: its table as JSON, and what no point has.
    #[pyfunction]
    fn sweep(
        py: Python<'_>,
        words: Vec<String>,
        cache: std::path::PathBuf,
        threads: Option<usize>,
        allow_exec: bool,
        hear: Option<Py<PyAny>>,
    ) -> PyResult<(String, Vec<String>)> {
        outcome::swept(py, words, cache, threads, allow_exec, hear)
    }

    /// The stages that take what comes from elsewhere, a kind each, as JSON.
    #[pyfunction]
    fn importers() -> String {
        graph::importers()
    }

    /// The kinds of artifacts that stages make.
    #[pyfunction]
    fn kinds() -> Vec<&'static str> {
        graph::kinds()
    }

    /// Takes a program of pipelines from here, whatever PATH has, and lets it read some folders.
    #[pyfunction]
    fn bring(name: String, path: std::path::PathBuf, reads: Vec<std::path::PathBuf>) {
        programs::bring(name, path, reads);
    }

    /// A picture of one or three channels as PNG.
    #[pyfunction]
    fn png(
        py: Python<'_>,
        pixels: Vec<u8>,
        width: usize,
        height: usize,
        channels: usize,
    ) -> PyResult<Py<PyBytes>> {
        files::png(py, pixels, width, height, channels)
    }

    /// A surface as PLY, from the bytes of its arrays.
    #[pyfunction]
    fn ply(py: Python<'_>, positions: &[u8], faces: &[u8], colors: &[u8]) -> PyResult<Py<PyBytes>> {
        files::ply(py, positions, faces, colors)
    }

    /// Files of a kind as an artifact; masks are read beside photos.
    #[pyfunction]
    fn taken(
        py: Python<'_>,
        kind: &str,
        folder: std::path::PathBuf,
        beside: Option<Py<Artifact>>,
    ) -> PyResult<Artifact> {
        let beside = beside.as_ref().map(Py::get);
        fault::guarded(py, || files::taken(kind, &folder, beside))
    }

    /// Names of the built-in pipelines.
    #[pyfunction]
    fn pipelines() -> Vec<&'static str> {
        let all = tailor::catalog::CATALOG.pipelines.iter();
        all.map(|(name, _)| *name).collect()
    }
}
