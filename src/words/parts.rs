//! The parts of a measuring as people know them, and the nodes of each.

/// What a measuring goes through, and the nodes of each.
pub(crate) const PARTS: [(&str, &[&str]); 7] = [
    ("photos", &["frames", "developed", "photos", "person"]),
    (
        "cameras",
        &[
            "tags",
            "keypoints",
            "links",
            "tracks",
            "calibrated",
            "walked",
            "turned",
            "moved",
            "placed",
        ],
    ),
    // Cameras get their last size by the outlines.
    (
        "masks",
        &[
            "people",
            "in_view",
            "aligned",
            "plate",
            "scene",
            "evidence",
            "labels",
            "masks",
            "lost_parts",
            "cameras",
        ],
    ),
    ("hull", &["rough", "compensated_coarse", "hull"]),
    (
        "surface",
        &["coarse", "compensated", "deformation", "middle", "body"],
    ),
    ("girths", &["features", "landmarks", "girths"]),
    // Colours are for who looks at it.
    ("report", &["textured", "report"]),
];

/// The place of the part that a node belongs to; what is not known belongs to the cameras' side, where pipelines differ.
pub(crate) fn place_of(node: &str) -> usize {
    let place = PARTS.iter().position(|(_, nodes)| nodes.contains(&node));
    place.unwrap_or(1)
}

/// The part that a node belongs to.
pub(crate) fn part_of(node: &str) -> &'static str {
    PARTS[place_of(node)].0
}
