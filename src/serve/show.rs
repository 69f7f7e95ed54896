//! Pictures of results on the way, as `tailor show` makes them: made when somebody looks.

use super::app::App;
use super::home::{self, Place};
use crate::catalog::{CATALOG, find};
use crate::store::Store;
use engine::out;
use stage::{AnyArtifact, Hash};
use std::collections::BTreeMap;

/// The nodes whose results are shown while a capture is measured, in their order, each in the format that
/// is looked at.
pub(super) const SHOWN: [(&str, &str); 4] = [
    ("placed", "svg"),
    ("masks", "sheet"),
    ("hull", "views"),
    ("body", "views"),
];

/// What results there are: stage and content by node.
pub(super) type Results = BTreeMap<String, (String, String)>;

/// A picture: its media type and its bytes.
pub(super) type Picture = (&'static str, Vec<u8>);

/// The picture of a node's result; none where it is gone, or is none that is shown.
pub(super) fn picture(app: &App, place: &Place, results: &Results, node: &str) -> Option<Picture> {
    let (_, format) = SHOWN.iter().find(|(name, _)| *name == node)?;
    let (ending, media) = match *format {
        "svg" => ("svg", "image/svg+xml"),
        _ => ("jpg", "image/jpeg"),
    };
    let content = &results.get(node)?.1;
    let folder = place.folder.join("small");
    let kept = folder.join(format!("{node}-{}.{ending}", content.get(..16)?));
    if let Ok(bytes) = std::fs::read(&kept) {
        return Some((media, bytes));
    }
    let store = Store::open(&app.global.cache).ok()?;
    let read = |node: &str| -> Option<AnyArtifact> {
        let (stage, content) = results.get(node)?;
        let blob = store.blob(Hash::from_hex(content).ok()?)?;
        find(stage)?.read(&blob).ok()
    };
    let files = out::files(
        &CATALOG,
        read(node)?,
        Vec::new,
        read("photos"),
        Some(format),
    );
    let (_, bytes) = files.ok()?.into_iter().next()?;
    // Kept if it can be; the page does not need it.
    let _ = home::make(&folder).and_then(|()| home::write(&kept, &bytes));
    Some((media, bytes))
}
