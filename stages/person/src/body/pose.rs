//! Body and joints in the square around a person: looked at once to lay the square exactly, then again.

use super::detect::Detection;
use super::place::around;
use super::sample::sampled_without;
use crate::net::{Network, Tensor};
use shape::{Crop, Found, Image, Joint, Rgb};

/// Numbers of a point: x, y, depth, visibility, presence (structural: the network's form).
const NUMBERS: usize = 5;
/// The points from which the square is laid: the middle of the hips, and one on the circle around the body.
/// It is structural: the network's form.
const HIPS: usize = 33;
/// The point on the circle (structural: the network's form).
const ABOVE: usize = 34;
/// So many joints, the first, are the face's, structural.
const FACE: usize = 11;

/// Somebody, seen from near; without those who are hidden.
pub(super) fn pose(network: &Network, photo: &Rgb, seen: &Detection, hidden: &[Found]) -> Found {
    let look = |crop: &Crop| look(network, photo, crop, hidden);
    let first = look(&seen.crop);
    let crop = around(first.point(HIPS).at_px, first.point(ABOVE).at_px);
    // A square of no size, or no number, is none.
    let sound = crop.side_px >= 1.0 && crop.side_px < 1e6 && crop.angle.is_finite();
    let near = match sound {
        true => look(&crop),
        false => first,
    };
    Found {
        score: seen.score,
        presence: logistic(near.out[1].data[0]),
        head_px: seen.head_px,
        crop: near.crop,
        body: Image {
            width: near.side,
            height: near.side,
            data: near.out[2].data.iter().map(|v| Found::kept(*v)).collect(),
        },
        joints: (0..Found::JOINTS.len()).map(|k| near.point(k)).collect(),
    }
}

/// Left, top, right and bottom of eyes, ears, nose and mouth. \[px\]
pub(super) fn around_face(joints: &[Joint]) -> [f32; 4] {
    let face = joints.iter().take(FACE).map(|joint| joint.at_px);
    let first = [f32::MAX, f32::MAX, f32::MIN, f32::MIN];
    face.fold(first, |[left, top, right, bottom], [x, y]| {
        [left.min(x), top.min(y), right.max(x), bottom.max(y)]
    })
}

/// The network's output for a square.
struct Look {
    crop: Crop,
    side: usize,
    /// Points, presence, mask.
    out: Vec<Tensor>,
}

impl Look {
    fn point(&self, k: usize) -> Joint {
        let point = &self.out[0].data[k * NUMBERS..(k + 1) * NUMBERS];
        let side = self.side as f32;
        Joint {
            at_px: self.crop.on_photo([point[0] / side, point[1] / side]),
            visibility: logistic(point[3]),
            presence: logistic(point[4]),
        }
    }
}

fn look(network: &Network, photo: &Rgb, crop: &Crop, hidden: &[Found]) -> Look {
    let side = network.input()[0];
    let mut input = sampled_without(photo, crop, side, hidden);
    input.iter_mut().for_each(|v| *v *= 1.0 / 255.0);
    Look {
        crop: *crop,
        side,
        out: network.run(&input),
    }
}

fn logistic(logit: f32) -> f32 {
    1.0 / (1.0 + libm::expf(-logit))
}
