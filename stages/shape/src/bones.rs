//! Which part of the body a point of a photo belongs to, by joints.

use crate::{BodyPart, Found};

/// Lines between joints, by their places in [`Found::JOINTS`], structural: what is nearest to one is of its part.
const BONES: [(BodyPart, usize, usize); 25] = [
    (BodyPart::Head, 0, 7),
    (BodyPart::Head, 0, 8),
    (BodyPart::Head, 7, 8),
    (BodyPart::Trunk, 11, 12),
    (BodyPart::Trunk, 11, 23),
    (BodyPart::Trunk, 12, 24),
    (BodyPart::Trunk, 23, 24),
    (BodyPart::Trunk, 11, 24),
    (BodyPart::Trunk, 12, 23),
    (BodyPart::Arms, 11, 13),
    (BodyPart::Arms, 13, 15),
    (BodyPart::Arms, 15, 19),
    (BodyPart::Arms, 12, 14),
    (BodyPart::Arms, 14, 16),
    (BodyPart::Arms, 16, 20),
    (BodyPart::Legs, 23, 25),
    (BodyPart::Legs, 25, 27),
    (BodyPart::Legs, 24, 26),
    (BodyPart::Legs, 26, 28),
    (BodyPart::Feet, 27, 29),
    (BodyPart::Feet, 29, 31),
    (BodyPart::Feet, 27, 31),
    (BodyPart::Feet, 28, 30),
    (BodyPart::Feet, 30, 32),
    (BodyPart::Feet, 28, 32),
];

impl Found {
    /// The part of the line that a point of the photo is nearest to. \[px\]
    pub fn part_at(&self, at_px: [f32; 2]) -> BodyPart {
        let apart = |(_, a, b): &(BodyPart, usize, usize)| {
            let (a, b) = (self.joints[*a].at_px, self.joints[*b].at_px);
            let (along, to) = (
                [b[0] - a[0], b[1] - a[1]],
                [at_px[0] - a[0], at_px[1] - a[1]],
            );
            let length = along[0] * along[0] + along[1] * along[1];
            let t = (to[0] * along[0] + to[1] * along[1]) / length.max(f32::MIN_POSITIVE);
            let t = t.clamp(0.0, 1.0);
            let (x, y) = (to[0] - t * along[0], to[1] - t * along[1]);
            x * x + y * y
        };
        let nearest = BONES.iter().min_by(|a, b| apart(a).total_cmp(&apart(b)));
        nearest.map_or(BodyPart::Trunk, |b| b.0)
    }
}
