//! Cameras of photos that were brought to one place.

use crate::align::alignment::Alignments;
use crate::align::alignment::Level;
use shape::{Cameras, PhotoId, View};

/// Cameras as they would be where all photos lie alike.
pub(crate) fn where_photos_lie_alike(cameras: &Cameras, levels: &Alignments) -> Cameras {
    let brought = |(id, view): (PhotoId, &View)| {
        let level = levels.get(&id).unwrap_or(&Level::NONE);
        let view = View {
            camera: level.camera(&view.camera),
            ..view.clone()
        };
        (id, view)
    };
    Cameras {
        views: cameras.views.iter().map(brought).collect(),
        ..cameras.clone()
    }
}
