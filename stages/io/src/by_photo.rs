//! What was found photo by photo, as JSON: tags, and fields of offsets.

use shape::{PhotoId, Tag, Tags, Warp, Warps};

/// Fields of offsets by photo: the nodes' distance and, row by row, their offsets. \[px\]
pub(crate) fn warps_to_json(warps: &Warps) -> String {
    let view = |(id, w): (PhotoId, &Warp)| {
        let rows: Vec<_> = w.offsets.chunks(w.columns).collect();
        serde_json::json!({ "photo": id.0, "cell_px": w.cell_px, "offsets": rows })
    };
    let views: Vec<_> = warps.views.iter().map(view).collect();
    serde_json::to_string_pretty(&views).expect("bug: warps JSON cannot hold")
}

/// Tags by photo: number and corners. \[px\]
pub(crate) fn tags_to_json(tags: &Tags) -> String {
    let tag = |t: &Tag| serde_json::json!({ "id": t.id, "corners": t.corners });
    let views: Vec<_> = tags
        .views
        .iter()
        .map(|(id, tags)| serde_json::json!({ "photo": id.0, "tags": tags.iter().map(tag).collect::<Vec<_>>() }))
        .collect();
    serde_json::to_string_pretty(&views).expect("bug: tags JSON cannot hold")
}
