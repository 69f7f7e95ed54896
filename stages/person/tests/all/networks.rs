//! The networks of `models/person/` against LiteRT, on a painted figure (`models/person/reference.py`).

use person::{Network, Tensor};

const DETECTOR: &[u8] = include_bytes!("../../../../models/person/detector.net");
const LANDMARKS: &[u8] = include_bytes!("../../../../models/person/landmarks.net");

/// Boxes of a figure on a side of 64: left, top, right, bottom, colour.
const FIGURE: [([usize; 4], [u8; 3]); 12] = [
    ([0, 0, 64, 48], [176, 180, 184]),
    ([0, 48, 64, 64], [120, 104, 90]),
    ([28, 6, 36, 15], [214, 170, 140]),
    ([28, 5, 36, 7], [60, 44, 36]),
    ([30, 15, 34, 17], [205, 160, 130]),
    ([25, 17, 39, 33], [60, 90, 160]),
    ([21, 18, 25, 34], [214, 170, 140]),
    ([39, 18, 43, 34], [214, 170, 140]),
    ([25, 33, 31, 56], [50, 50, 60]),
    ([33, 33, 39, 56], [50, 50, 60]),
    ([24, 56, 31, 59], [30, 30, 30]),
    ([33, 56, 40, 59], [30, 30, 30]),
];

/// The figure with a grain, 0 to 255 or a little more, each number through `scaled`.
fn figure(side: usize, scaled: impl Fn(f32) -> f32) -> Vec<f32> {
    let mut picture = vec![0.0; side * side * 3];
    for ([left, top, right, bottom], colour) in FIGURE {
        for y in top * side / 64..bottom * side / 64 {
            for x in left * side / 64..right * side / 64 {
                for (c, value) in colour.into_iter().enumerate() {
                    let grain = ((x * 7 + y * 13) % 11) as f32;
                    picture[(y * side + x) * 3 + c] = scaled(f32::from(value) + grain);
                }
            }
        }
    }
    picture
}

/// The reference's numbers of an output: place and value.
fn reference(name: &str) -> Vec<(usize, f32)> {
    let text = include_str!("../reference.txt").lines();
    let of_name = text.filter_map(|line| line.strip_prefix(name)?.trim().split_once(' '));
    let all: Vec<_> = of_name
        .map(|(at, value)| (at.parse().unwrap(), value.parse().unwrap()))
        .collect();
    assert!(!all.is_empty(), "{name}");
    all
}

/// The largest difference to the reference; several images are one row of numbers.
fn off(name: &str, images: &[Tensor]) -> f32 {
    let all: Vec<f32> = images.iter().flat_map(|t| t.data.iter().copied()).collect();
    let off = |(at, value): (usize, f32)| (all[at] - value).abs();
    let most = reference(name).into_iter().map(off).fold(0.0, f32::max);
    println!("{name}: {most:e}");
    most
}

#[test]
fn both_networks_equal_the_reference() {
    let seen = Network::read(DETECTOR)
        .unwrap()
        .run(&figure(224, |v| v * (2.0 / 255.0) - 1.0));
    let (boxes, scores) = seen.split_at(3);
    // Pixels of 224; a score's logit.
    assert!(off("boxes", boxes) < 2e-3 && off("scores", scores) < 2e-3);
    let pose = Network::read(LANDMARKS)
        .unwrap()
        .run(&figure(256, |v| v * (1.0 / 255.0)));
    // Pixels of 256; a mask's logit.
    assert!(off("landmarks", &pose[..1]) < 1e-3);
    assert!(off("mask", &pose[2..]) < 0.03);
    let presence = 1.0 / (1.0 + libm::expf(-pose[1].data[0]));
    assert!((presence - reference("presence")[0].1).abs() < 1e-5);
}
