//! What was found photo by photo, as JSON: tags, tracks, and fields of offsets.

use shape::{Observation, PhotoId, Tag, Tags, Tracks, Warp, Warps};

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

/// Points by the photos that show them: place and size on each. \[px\]
pub(crate) fn tracks_to_json(tracks: &Tracks) -> String {
    let seen = |s: &Observation| {
        let [x, y] = s.at_px.map(f64::from);
        serde_json::json!({ "photo": s.photo.0, "at_px": [x, y], "scale_px": f64::from(s.scale_px) })
    };
    let point = |p: &Vec<Observation>| p.iter().map(seen).collect::<Vec<_>>();
    let points: Vec<_> = tracks.points.iter().map(point).collect();
    serde_json::to_string(&points).expect("bug: tracks JSON cannot hold")
}
