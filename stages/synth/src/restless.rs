//! A living body in one photo: arms and head are elsewhere than at rest, and the chest is fuller.

use crate::dice::Dice;
use shape::Mesh;

/// Heights by which a body is parted, as shares of it: where the head begins and is one with the neck; where arms hang;
/// where the chest breathes.
const HEAD: [f64; 2] = [0.83, 0.87];
const ARMS: [f64; 2] = [0.40, 0.80];
const CHEST: [f64; 2] = [0.60, 0.80];
/// How far from the middle arms begin, and are one with the trunk no more, as shares of height.
const BESIDE: [f64; 2] = [0.12, 0.20];
/// What the head moves, and what a breath lifts, against hands.
const HEAD_SHARE: f64 = 0.5;
const BREATH_SHARE: f64 = 0.25;

/// The body in a photo: hands moved by about so much. \[mm\]
pub(crate) fn restless(mesh: &Mesh, amount_mm: f64, seed: u32, photo: u32) -> Mesh {
    let Some((lo, hi)) = mesh.bounds().filter(|_| amount_mm > 0.0) else {
        return mesh.clone();
    };
    let (tall, middle) = (hi.z - lo.z, nalgebra::center(&lo, &hi));
    let mut dice = Dice::new(seed, 1000 + photo);
    let mut go = |share: f64| [0, 1].map(|_| share * amount_mm * dice.normal());
    let (head, left, right) = (go(HEAD_SHARE), go(1.0), go(1.0));
    let breath = go(BREATH_SHARE)[0];
    let mut moved = mesh.clone();
    for p in &mut moved.positions {
        let [x, y, z] = p.map(f64::from);
        let (height, beside) = ((z - lo.z) / tall, (x - middle.x) / tall);
        let hanging = 1.0 - risen(ARMS, height);
        let arm = risen(BESIDE, beside.abs()) * hanging;
        let by = if beside > 0.0 { left } else { right };
        let on_head = risen(HEAD, height);
        let bump = libm::sin(std::f64::consts::PI * clamped(CHEST, height));
        let front = clamped([0.0, 0.08], (middle.y - y) / tall) * (1.0 - arm);
        let at = [
            x + arm * by[0] + on_head * head[0],
            y + arm * by[1] + on_head * head[1] - bump * front * breath,
        ];
        (p[0], p[1]) = (at[0] as f32, at[1] as f32);
    }
    moved
}

/// How far a number is between two, 0 to 1.
fn clamped([from, to]: [f64; 2], x: f64) -> f64 {
    ((x - from) / (to - from)).clamp(0.0, 1.0)
}

/// The same without corners.
fn risen(ends: [f64; 2], x: f64) -> f64 {
    let t = clamped(ends, x);
    t * t * (3.0 - 2.0 * t)
}
