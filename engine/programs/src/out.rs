//! Artifacts as files for people and other programs, as their kinds write them.

use crate::{Catalog, NamedFiles, WriteError};
use stage::AnyArtifact;

/// What cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum OutError {
    /// The kind's own reason.
    #[error(transparent)]
    Kind(WriteError),
    /// No such format for this kind.
    #[error("{kind} cannot be written as `{format}`; known: {known}")]
    Format {
        /// The kind of artifact.
        kind: &'static str,
        /// What was asked for.
        format: String,
        /// What there is.
        known: String,
    },
}

/// The format of a kind that has no other: the artifact's own file, as it is in the store.
pub const RAW: &str = "artifact";

/// The formats of a kind, the usual one first.
pub fn formats(catalog: &Catalog, kind: &str) -> &'static [&'static str] {
    match catalog.kind(kind) {
        Some(kind) if !kind.formats.is_empty() => kind.formats,
        _ => &[RAW],
    }
}

/// What the file of an artifact in its usual format ends with.
pub fn extension(catalog: &Catalog, artifact: &AnyArtifact) -> &'static str {
    let kind = catalog.kind(artifact.kind());
    let own = kind.and_then(|kind| (kind.extension)(artifact));
    own.unwrap_or(formats(catalog, artifact.kind())[0])
}

/// Files of an artifact in a format, the usual one by default. `raw` gives the bytes of the
/// artifact's own file.
///
/// # Errors
///
/// No such format, or the kind's writer fails.
pub fn files(
    catalog: &Catalog,
    artifact: AnyArtifact,
    raw: impl FnOnce() -> Vec<u8>,
    beside: Option<AnyArtifact>,
    format: Option<&str>,
) -> Result<NamedFiles, OutError> {
    let kind = artifact.kind();
    let known = formats(catalog, kind);
    let format = format.unwrap_or(known[0]);
    if !known.contains(&format) {
        let (format, known) = (format.into(), known.join(", "));
        return Err(OutError::Format {
            kind,
            format,
            known,
        });
    }
    match catalog.kind(kind).filter(|_| format != RAW) {
        Some(kind) => (kind.files)(artifact, format, beside).map_err(OutError::Kind),
        None => Ok(vec![(String::new(), raw())]),
    }
}
