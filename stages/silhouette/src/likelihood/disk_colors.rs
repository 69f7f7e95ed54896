//! Body or background, by colour alone: a first guess where the disk turns below the feet, or nobody saw the scene.

use crate::likelihood::gmm::Gmm;
use crate::likelihood::prepared::UNSEEN;
use crate::scene::backdrop::Backdrop;
use crate::scene::disk_map::point;
use crate::scene::still_and_disk::{Shot, scene};
use rayon::prelude::*;
use shape::Image;

/// What it costs to find a colour of the scene or the disk at another place than there. By hand: looked at seven scenes
/// without a plate, at 1 and 2: mean IoU −0.0006 and −0.0001 (docs/lab/masks.md). \[nats\]
pub(crate) const ELSEWHERE_NATS: f32 = 3.0;
/// Clusters of each mixture of colours. By hand: looked at three scenes (158 with a plate, 160 and 170 without), at 0.7
/// and 1.4 of it: mean IoU +0.0003 and +0.0002 at most.
const CLUSTERS: usize = 12;
/// Where on its radius the disk is mostly free of feet. By hand: looked at three scenes (158 with a plate, 160 and 170
/// without), at 0.7 and 1.4 of it: mean IoU −0.0032 and +0.0003 at most.
const RIM_SHARE: f64 = 0.6;
/// A pixel that is off the background by so much in all channels together is not the background. By hand: looked
/// at three scenes (158 with a plate, 160 and 170 without), at 0.7 and 1.4 of it: mean IoU +0.0003 and +0.0005 at most. \[levels\]
const OFF_LEVELS: u32 = 90;

/// What a colour costs as the disk's or the scene's where nobody saw them: as one of their colours elsewhere.
pub(crate) fn cost_elsewhere(seen: Option<&Gmm>, color: [u8; 3]) -> f32 {
    seen.map_or(UNSEEN, |seen| seen.cost(color) as f32 + ELSEWHERE_NATS)
}

/// The colours of a scene where it was seen.
pub(crate) fn colors_of(scene: &Backdrop) -> Option<Gmm> {
    colors_where(scene, |_| true)
}

/// The same of some of its pixels.
fn colors_where(scene: &Backdrop, counts: impl Fn(usize) -> bool) -> Option<Gmm> {
    let pixels = 0..scene.image.data.len();
    let seen = pixels.filter(|i| scene.seen.data[*i] && counts(*i));
    mixture(&seen.map(|i| scene.image.data[i]).collect::<Vec<_>>())
}

/// Some colours at most, spread evenly, as a mixture.
pub(crate) fn mixture(colors: &[[u8; 3]]) -> Option<Gmm> {
    let some: Vec<[u8; 3]> = colors
        .iter()
        .copied()
        .step_by(colors.len() / 8000 + 1)
        .collect();
    Gmm::fit(&some, CLUSTERS)
}

/// The colours of what is surely not the background.
pub(crate) fn body_colors(shots: &[Shot], still: &Backdrop, radius: f64) -> Option<Gmm> {
    let mut colors = Vec::new();
    for shot in shots {
        for (i, c) in shot.small.data.iter().enumerate().step_by(5) {
            let off: u32 = (0..3)
                .map(|k| u32::from(c[k].abs_diff(still.image.data[i][k])))
                .sum();
            if still.seen.data[i] && off > OFF_LEVELS && !shot.shows_disk(i, radius) {
                colors.push(*c);
            }
        }
    }
    mixture(&colors)
}

/// The colours of the disk beyond a share of its radius, where it was seen.
pub(crate) fn disk_colors(disk: &Backdrop, beyond: f64) -> Option<Gmm> {
    colors_where(disk, |i| {
        let at = point(i, 1.0, disk.image.width);
        at.is_some_and(|x| libm::hypot(x.x, x.y) > beyond)
    })
}

/// Pixels on the disk whose colour is the body's rather than the disk's.
pub(crate) fn on_the_disk(
    shots: &[Shot],
    still: &Backdrop,
    body: Option<&Gmm>,
    radius: f64,
) -> Vec<Image<bool>> {
    let open: Vec<Image<bool>> = shots.iter().map(|s| s.small.map(|_| false)).collect();
    let Some(body) = body.filter(|_| radius > 0.0) else {
        return open;
    };
    // Feet are in the middle, and legs hide what is behind them in some photos only.
    let outer = scene(shots, still.clone(), radius, &open).disk;
    let Some(disk) = disk_colors(&outer, RIM_SHARE) else {
        return open;
    };
    let covers = |shot: &Shot| {
        let (top, width) = (shot.top(radius), shot.small.width);
        let one = |i: usize| {
            let c = shot.small.data[i];
            top.at(i % width, i / width).is_some() && body.cost(c) < disk.cost(c)
        };
        let data = (0..shot.small.data.len()).map(one).collect();
        Image {
            data,
            ..shot.small.map(|_| false)
        }
    };
    shots.par_iter().map(covers).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::likelihood::body::ANY_COLOR;
    use shape::Rgb;

    #[test]
    fn a_wall_that_is_seen_elsewhere_explains_its_colour_and_no_other() {
        let mut dice = proof::Dice(5);
        let mut noisy = |color: [f64; 3]| color.map(|v| (v + dice.normal()).round() as u8);
        let (wall, painting) = ([160.0, 160.0, 158.0], [40.0, 90.0, 160.0]);
        let mut image = Rgb::filled(50, 40, [0; 3]);
        let painted = |i: usize| i % 50 >= 20;
        for (i, p) in image.data.iter_mut().enumerate() {
            *p = noisy(if painted(i) { painting } else { wall });
        }
        let mut scene = Backdrop::whole(image);
        // All that is beside a gap in the painting is painting.
        (0..2000)
            .filter(|i| i % 50 >= 40)
            .for_each(|i| scene.seen.data[i] = false);
        let seen = colors_of(&scene);
        let cost =
            |color: [f64; 3]| f64::from(cost_elsewhere(seen.as_ref(), color.map(|v| v as u8)));
        assert!(cost(wall) < ANY_COLOR - 5.0 && cost(painting) < ANY_COLOR - 5.0);
        assert!(cost([150.0, 100.0, 80.0]) > ANY_COLOR);
        scene.seen.data.fill(false);
        assert_eq!(cost_elsewhere(colors_of(&scene).as_ref(), [160; 3]), UNSEEN);
    }
}
