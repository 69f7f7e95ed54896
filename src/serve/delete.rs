//! A capture removed for good: its photos, its results, and what of it is in the cache.

use super::answer::Wrong;
use super::app::App;
use super::home::Place;
use crate::store::{Store, StoreError, forget};
use axum::http::StatusCode;
use serde::Serialize;

/// What went.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Gone {
    /// Photos and videos.
    pub(super) files: usize,
    /// Their size. \[bytes\]
    pub(super) bytes: u64,
    /// Results in the cache.
    pub(super) results: usize,
    /// Their size. \[bytes\]
    pub(super) results_bytes: u64,
    /// Folders from which some of that came as well: it is made again for them.
    pub(super) shared: Vec<String>,
    /// What may have come of it, could not be read, and stays in the cache.
    pub(super) unread: Vec<String>,
}

/// Removes a capture. Nothing goes while something is measured in the same cache.
///
/// # Errors
///
/// Something is being measured, or the disk refuses.
pub(super) fn delete(app: &App, place: &Place) -> Result<Gone, Wrong> {
    let busy = || Wrong::new(StatusCode::CONFLICT, "wrong-busy");
    let record = place.record()?;
    if !app.jobs.drop_idle(&place.id) {
        return Err(busy());
    }
    let store = Store::open(&app.global.cache).map_err(Wrong::broken)?;
    // Before the photos: what fails here leaves a capture that can be removed again.
    let forgotten = forget(&store, &place.photos()).map_err(|why| match why {
        StoreError::Busy(_) => busy(),
        other => Wrong::broken(other),
    })?;
    app.home.remove(place)?;
    Ok(Gone {
        files: record.files.len(),
        bytes: record.bytes(),
        results: forgotten.results,
        results_bytes: forgotten.bytes,
        shared: forgotten.shared,
        unread: forgotten.unread,
    })
}
