//! Heads, and from them hips and size of everybody on a photo.

use super::place::around;
use super::sample::sampled_without;
use crate::net::{Network, Tensor};
use shape::{Crop, Found, Rgb};

/// Whoever scores less is nobody (MediaPipe).
const LEAST_SCORE: f32 = 0.5;
/// Boxes that share so much of their union are one person's (MediaPipe).
const ONE_PERSON: f32 = 0.3;
/// Scores' logits stay within this (MediaPipe).
const LOGIT: f32 = 100.0;
/// Numbers of a box: middle, size, four points (structural: the network's form).
const NUMBERS: usize = 12;

/// Somebody's head, and the square around the body.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Detection {
    /// 0 to 1.
    pub(super) score: f32,
    /// Left, top, right, bottom. \[px\]
    pub(super) head_px: [f32; 4],
    /// Where the body is.
    pub(super) crop: Crop,
}

/// A box with its points, in shares of the square that the network sees.
#[derive(Debug, Clone, PartialEq)]
struct Guess {
    score: f32,
    /// Left, top, right, bottom; x and y of the middle of the hips; of a point on the circle around the body.
    numbers: [f32; 8],
}

/// Everybody on a photo but those who are hidden, the surest first. Where nobody is, it is turned to its sides and over:
/// photos lose the note of how the camera was turned.
pub(super) fn detections(network: &Network, photo: &Rgb, hidden: &[Found]) -> Vec<Detection> {
    if !hidden.is_empty() {
        return turned(network, photo, 0.0, hidden);
    }
    let turns = [0.0, 1.0, -1.0, 2.0].map(|turn| turn * std::f32::consts::FRAC_PI_2);
    let mut seen = turns
        .iter()
        .map(|angle| turned(network, photo, *angle, &[]));
    seen.find(|seen| !seen.is_empty()).unwrap_or_default()
}

/// Everybody on a photo that is looked at turned.
fn turned(network: &Network, photo: &Rgb, angle: f32, hidden: &[Found]) -> Vec<Detection> {
    let side = network.input()[0];
    let whole = Crop {
        centre_px: [photo.width, photo.height].map(|n| (n as f32 - 1.0) / 2.0),
        side_px: photo.width.max(photo.height) as f32,
        angle,
    };
    let mut input = sampled_without(photo, &whole, side, hidden);
    input.iter_mut().for_each(|v| *v = *v * (2.0 / 255.0) - 1.0);
    let out = network.run(&input);
    let (boxes, scores) = out.split_at(out.len() / 2);
    let guesses = guesses(boxes, scores, side as f32);
    let people = one_each(guesses);
    let people = people.into_iter().map(|guess| {
        let [left, top, right, bottom, hip_x, hip_y, above_x, above_y] = guess.numbers;
        let (a, b) = (whole.on_photo([left, top]), whole.on_photo([right, bottom]));
        Detection {
            score: guess.score,
            head_px: [
                a[0].min(b[0]),
                a[1].min(b[1]),
                a[0].max(b[0]),
                a[1].max(b[1]),
            ],
            crop: around(
                whole.on_photo([hip_x, hip_y]),
                whole.on_photo([above_x, above_y]),
            ),
        }
    });
    people.filter(|d| d.crop.side_px >= 1.0).collect()
}

/// What scores enough, in the order of the network's grids: each a regular one over the square.
fn guesses(boxes: &[Tensor], scores: &[Tensor], side: f32) -> Vec<Guess> {
    let mut all = Vec::new();
    for (boxes, scores) in boxes.iter().zip(scores) {
        let a_cell = scores.channels;
        for (i, logit) in scores.data.iter().enumerate() {
            let score = 1.0 / (1.0 + libm::expf(-logit.clamp(-LOGIT, LOGIT)));
            if score < LEAST_SCORE {
                continue;
            }
            let cell = i / a_cell;
            let (column, row) = (cell % scores.width, cell / scores.width);
            let middle_x = (column as f32 + 0.5) / scores.width as f32;
            let middle_y = (row as f32 + 0.5) / scores.height as f32;
            let raw = &boxes.data[i * NUMBERS..(i + 1) * NUMBERS];
            let (x, y) = (raw[0] / side + middle_x, raw[1] / side + middle_y);
            let (w, h) = (raw[2] / side, raw[3] / side);
            let point = |k: usize| {
                let at = 4 + 2 * k;
                [raw[at] / side + middle_x, raw[at + 1] / side + middle_y]
            };
            let (hips, above) = (point(0), point(1));
            let [left, top] = [x - w / 2.0, y - h / 2.0];
            let numbers = [
                left,
                top,
                left + w,
                top + h,
                hips[0],
                hips[1],
                above[0],
                above[1],
            ];
            all.push(Guess { score, numbers });
        }
    }
    all
}

/// Boxes that overlap a surer one are one person's: their mean by score.
fn one_each(mut open: Vec<Guess>) -> Vec<Guess> {
    open.sort_by(|a, b| b.score.total_cmp(&a.score));
    let mut people = Vec::new();
    while let Some(best) = open.first().cloned() {
        let (same, different): (Vec<Guess>, Vec<Guess>) = open
            .into_iter()
            .partition(|g| *g == best || overlap(&g.numbers, &best.numbers) >= ONE_PERSON);
        let weight: f32 = same.iter().map(|g| g.score).sum();
        let mean = |k: usize| same.iter().map(|g| g.score * g.numbers[k]).sum::<f32>() / weight;
        people.push(Guess {
            score: best.score,
            numbers: std::array::from_fn(mean),
        });
        open = different;
    }
    people
}

/// What two boxes share of their union.
fn overlap(a: &[f32; 8], b: &[f32; 8]) -> f32 {
    let area = |b: &[f32; 8]| (b[2] - b[0]).max(0.0) * (b[3] - b[1]).max(0.0);
    let width = (a[2].min(b[2]) - a[0].max(b[0])).max(0.0);
    let height = (a[3].min(b[3]) - a[1].max(b[1])).max(0.0);
    let shared = width * height;
    match area(a) + area(b) - shared {
        all if all > 0.0 => shared / all,
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_of_one_person_become_one() {
        let guess = |score: f32, left: f32| Guess {
            score,
            numbers: [left, 0.1, left + 0.1, 0.2, 0.5, 0.5, 0.5, 0.2],
        };
        let people = one_each(vec![guess(0.6, 0.11), guess(0.9, 0.1), guess(0.7, 0.6)]);
        assert_eq!(people.len(), 2);
        assert_eq!((people[0].score, people[1].score), (0.9, 0.7));
        assert!((people[0].numbers[0] - 0.104).abs() < 1e-6);
    }
}
