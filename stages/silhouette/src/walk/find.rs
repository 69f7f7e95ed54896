//! The subject amid the cameras: colours and cells in turn, from what all cameras look at.

use crate::cells::Block;
use crate::raster::as_mask;
use crate::scene::still_and_disk::Shot;
use crate::walk::colors::{Colors, Samples};
use crate::walk::features::free;
use crate::walk::space::{SEEN_SHARES, Scene};
use crate::walk::voxels::{Belief, evidence, solid};
use nalgebra::Point3;
use rayon::prelude::*;
use shape::Image;
use stage::Cancelled;

/// How the subject is looked for.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Search {
    /// Cells along the block's greatest side.
    pub(crate) cells: usize,
    /// Rounds of colours and cells.
    pub(crate) rounds: usize,
    /// Clusters of the mixture of the subject's colours.
    pub(crate) clusters: usize,
    /// Price of parting two cells.
    pub(crate) smooth: f32,
}

/// The subject as cells.
#[derive(Debug, Clone)]
pub(crate) struct Subject {
    /// The block.
    pub(crate) block: Block,
    /// Which of its cells.
    pub(crate) solid: Vec<bool>,
    /// Colours, by shot.
    pub(crate) colors: Vec<Colors>,
}

/// Finds the subject. `None` where there is none.
pub(crate) fn find(
    scene: &Scene<'_>,
    search: &Search,
    tick: &(dyn Fn() -> Result<(), Cancelled> + Sync),
) -> Result<Option<Subject>, Cancelled> {
    let (r, [low, high]) = (scene.space.reach, scene.space.heights);
    let coarse = search.cells * 2 / 3;
    let mut block = Block::between([-r, -r, low], [r, r, high], coarse);
    let Some(mut colors) = first_colors(scene, search) else {
        return Ok(None);
    };
    let mut solid = vec![];
    for round in 0..search.rounds.max(1) {
        let late = round + 2 >= search.rounds;
        let belief = Belief {
            misled: if late { 0.02 } else { 0.06 },
            behind: 0.5,
        };
        let reported: Vec<Image<f32>> = scene
            .shots
            .par_iter()
            .zip(&colors)
            .map(|(s, c)| c.favours(&s.small).map(|f| belief.reported(*f)))
            .collect();
        solid = cells(&block, scene, &reported, search);
        tick()?;
        let next = next_colors(&block, &solid, scene, search);
        let (Some(next), Some(around)) = (next, block.around(&solid, 4.0)) else {
            return Ok(None);
        };
        colors = next;
        if !late {
            let (mut lo, mut hi) = around;
            (lo[0], lo[1], lo[2]) = (lo[0].max(-r), lo[1].max(-r), lo[2].max(low));
            (hi[0], hi[1], hi[2]) = (hi[0].min(r), hi[1].min(r), hi[2].min(high));
            block = Block::between(lo, hi, search.cells);
        }
    }
    Ok(Some(Subject {
        block,
        solid,
        colors,
    }))
}

/// The evidence against a cell of one ray to a feature behind it, and how many count. By hand: looked at the walk of a
/// test, none counted: mean IoU −0.0144. \[nats\]
const FREE: (f32, u16) = (4.0, 5);

/// The evidence for its cell of one feature amid the cameras. By hand: looked at the walk of a test, none counted: mean
/// IoU −0.0035. \[nats\]
const AMID_NATS: f32 = 6.0;

/// The cells that are the subject by what is known of each pixel.
pub(crate) fn cells(
    block: &Block,
    scene: &Scene<'_>,
    reported: &[Image<f32>],
    search: &Search,
) -> Vec<bool> {
    let shots = scene.shots;
    let least = (SEEN_SHARES[1] * shots.len() as f64).ceil().max(3.0) as u16;
    let closed: Vec<bool> = block
        .seen(shots)
        .iter()
        .enumerate()
        .map(|(i, seen)| *seen < least || scene.space.without(&block.centre(i)))
        .collect();
    let mut evidence = evidence(block, shots, reported, &closed);
    let free = free(block, scene.spots, shots);
    for (e, free) in evidence.iter_mut().zip(&free) {
        *e -= FREE.0 * f32::from((*free).min(FREE.1));
    }
    for spot in scene.spots.iter().filter(|s| scene.space.amid(&s.at)) {
        if let Some(i) = block.cell_of(&spot.at) {
            evidence[i] += AMID_NATS;
        }
    }
    block.largest(&solid(block, &evidence, search.smooth))
}

/// Colours of a neighbourhood of 3 × 3.
fn near(shot: &Shot, px: [f64; 2], to: &mut Samples) {
    let (w, h) = (shot.small.width as i64, shot.small.height as i64);
    let (cx, cy) = (px[0].round() as i64, px[1].round() as i64);
    for (y, x) in (cy - 1..cy + 2).flat_map(|y| (cx - 1..cx + 2).map(move |x| (y, x))) {
        if x >= 0 && y >= 0 && x < w && y < h {
            to.push((y as u32, shot.small.at(x as usize, y as usize)));
        }
    }
}

/// Colours before anything is known: what is near the axis is the subject's, what is beyond the
/// space, or is seen past it, the background's.
fn first_colors(scene: &Scene<'_>, search: &Search) -> Option<Vec<Colors>> {
    let (shots, space) = (scene.shots, &scene.space);
    let mut bodies = vec![Samples::new(); shots.len()];
    let mut backgrounds = vec![Samples::new(); shots.len()];
    for spot in scene.spots {
        let aside = spot.at.coords.xy().norm() > space.reach;
        let to = match (space.amid(&spot.at), aside || space.low(&spot.at)) {
            (true, _) => &mut bodies,
            (false, true) => &mut backgrounds,
            (false, false) => continue,
        };
        for (k, px) in &spot.sights {
            near(&shots[*k], *px, &mut to[*k]);
        }
    }
    let one = |(k, shot): (usize, &Shot)| {
        let (mut body, mut background) = (bodies[k].clone(), backgrounds[k].clone());
        let (centre, c) = (shot.camera.centre().coords, &shot.camera);
        let middle = c.project(&Point3::new(0.0, 0.0, space.middle))?;
        let disc = 0.08 * space.reach * c.lens.focal[0] / centre.norm();
        for i in (0..shot.small.data.len()).step_by(3) {
            let at = [(i % shot.small.width) as f64, (i / shot.small.width) as f64];
            if libm::hypot(at[0] - middle.x, at[1] - middle.y) < disc {
                body.push((at[1] as u32, shot.small.data[i]));
            }
            let ray = c.ray(at.into());
            let aside = centre.xy().perp(&ray.xy()).abs() / ray.xy().norm().max(1e-9);
            if aside > 0.5 * space.reach {
                background.push((at[1] as u32, shot.small.data[i]));
            }
        }
        Colors::fit(&body, &background, shot.small.height, search.clusters)
    };
    shots.par_iter().enumerate().map(one).collect()
}

/// The subject's colours are learned so deep within what cells cover, as a share of its size. By hand: looked at the
/// walk of a test, a cell deep: mean IoU −0.0232.
const DEEP_SHARE: f64 = 0.06;

/// Colours as the cells part them.
pub(crate) fn next_colors(
    block: &Block,
    solid: &[bool],
    scene: &Scene<'_>,
    search: &Search,
) -> Option<Vec<Colors>> {
    let shots = scene.shots;
    let mut bodies = vec![Samples::new(); shots.len()];
    for spot in scene.spots.iter().filter(|s| scene.space.amid(&s.at)) {
        for (k, px) in &spot.sights {
            near(&shots[*k], *px, &mut bodies[*k]);
        }
    }
    let one = |(k, shot): (usize, &Shot)| {
        let (w, h) = (shot.small.width, shot.small.height);
        let shown = block.shown(solid, &shot.camera, w, h);
        let depth = shot.camera.centre().coords.norm();
        let px = (block.cell * shot.camera.lens.focal[0] / depth).ceil() as i64;
        let area = shown.data.iter().filter(|s| **s).count() as f64;
        let deep = (px as f64).max(DEEP_SHARE * area.sqrt());
        let far = shape::signed_distance(&as_mask(&shown));
        let (mut body, mut background) = (bodies[k].clone(), Samples::new());
        for (i, (far, color)) in far.data.iter().zip(&shot.small.data).enumerate() {
            let row = (i / w) as u32;
            if f64::from(*far) > deep {
                body.push((row, *color));
            } else if *far < -2.0 * px as f32 {
                background.push((row, *color));
            }
        }
        Colors::fit(&body, &background, shot.small.height, search.clusters)
    };
    shots.par_iter().enumerate().map(one).collect()
}
