//! Cameras of photos that were brought to one place.

use shape::{Aligned, Cameras, PhotoId, View};

/// Cameras as they would be where all photos are aligned.
pub(crate) fn aligned_alike(aligned: &Aligned) -> Option<Cameras> {
    let cameras = aligned.cameras.as_ref()?;
    let brought = |(id, view): (PhotoId, &View)| {
        let view = View {
            camera: aligned.of(id).camera(&view.camera),
            ..view.clone()
        };
        (id, view)
    };
    Some(Cameras {
        views: cameras.views.iter().map(brought).collect(),
        ..cameras.clone()
    })
}
