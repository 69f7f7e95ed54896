//! The stage that cuts a subject out of the photos of a walk around it.

use crate::scene::still_and_disk::Shot;
use crate::walk::doubt::widest_gap;
use crate::walk::features::spots;
use crate::walk::find::{Search, Subject, find};
use crate::walk::floor_cut::{FloorCut, lowest_seen};
use crate::walk::full_size::at_full_size;
use crate::walk::judged::{Judged, judged};
use crate::walk::params::{WalkCutError, WalkParams};
use crate::walk::passes::{Outlines, agreed};
use crate::walk::space::{Scene, Space};
use rayon::prelude::*;
use shape::{Cameras, Image, MaskRuns, Masks, PhotoId, Photos, Tracks};
use stage::{Ctx, Stage, Stop};
use std::sync::Arc;

stage::inputs! {
    /// A walk, with its cameras.
    pub struct WalkInput {
        /// The photos.
        photos: Arc<Photos>,
        /// Their cameras, z up, the subject about the z axis.
        cameras: Arc<Cameras>,
        /// Features followed over the photos: they tell what is behind the subject.
        tracks: Option<Arc<Tracks>>,
    }
}

/// `silhouette.walk`: photos, cameras, tracks → masks.
pub struct Walk;

/// Fewest photos that distinguish a subject from its background.
/// By hand: looked at a walk (asclepius) of 25 photos, at 4 and 8: nothing changes.
const FEWEST_PHOTOS: usize = 6;

impl Stage for Walk {
    const NAME: &'static str = "silhouette.walk";
    const VERSION: u32 = 8;
    const ABOUT: &'static str = "Cuts a subject out of photos of a walk around it: what all cameras look at, by colours, cells and graph cuts (Campbell, Vogiatzis, Hernández and Cipolla 2010), or reports why it would be a guess.";
    type Params = WalkParams;
    type Input = WalkInput;
    type Output = Masks;
    const METRICS: &'static [&'static str] = &[
        "right by colour",
        "settled",
        "agree",
        "bottom",
        "features",
        "features lacking",
    ];

    fn run(p: &WalkParams, input: WalkInput, ctx: &Ctx<'_>) -> Result<Masks, Stop> {
        let (photos, cameras) = (&*input.photos, &*input.cameras);
        let (shots, full) = shots(p, photos, cameras, ctx)?;
        if shots.len() < FEWEST_PHOTOS {
            return Err(WalkCutError::Few(shots.len(), FEWEST_PHOTOS).into());
        }
        let gap = widest_gap(&shots);
        if gap > p.most_gap_deg {
            return Err(WalkCutError::OneSide(gap).into());
        }
        let tracks = input.tracks.as_deref();
        let spots = tracks.map_or(vec![], |tracks| spots(tracks, &shots, &full));
        ctx.metric("features", spots.len() as f64, "");
        let space = Space::of(&shots, cameras.ground_mm).ok_or(WalkCutError::NoMiddle)?;
        let search = Search {
            cells: p.cells as usize,
            rounds: p.rounds as usize,
            clusters: p.clusters as usize,
            smooth: p.smooth as f32,
        };
        let scene = Scene {
            shots: &shots,
            spots: &spots,
            space,
        };
        let steps = ctx.steps("rounds", (p.rounds + p.passes) as usize);
        let tick = || steps.tick();
        let mut subject = find(&scene, &search, &tick)?.ok_or(WalkCutError::Nothing)?;
        let passes = p.passes as usize;
        let Outlines { sides, settled } =
            agreed(&scene, &mut subject, &search, p.gamma, passes, &tick)?
                .ok_or(WalkCutError::Nothing)?;
        let cutter = cutter(p, &shots, &subject);
        let standing: Vec<Image<bool>> = shots
            .par_iter()
            .map(|s| cutter.shown(&subject.block, s))
            .collect();
        let judge = Judged {
            photos,
            scene: &scene,
            subject: &subject,
            cutter: &cutter,
            sides: &sides,
            standing: &standing,
            settled: &settled,
        };
        let judgement = judged(p, &judge)?;
        for (name, value) in judgement.metrics {
            ctx.metric(name, value, "%");
        }
        judgement.warnings.into_iter().for_each(|w| ctx.warn(w));
        ctx.metric("bottom", cutter.height, "mm");
        let steps = ctx.steps("photos", shots.len());
        let one = |(k, shot): (usize, &Shot)| -> Result<(PhotoId, MaskRuns), Stop> {
            let photo = photo(photos, shot.id)?;
            let pixels = photo.decode()?;
            let factor = factor(p, photo.width, photo.height);
            let camera = cameras.views.get(shot.id).map_or(shot.camera, |v| v.camera);
            let ends = cutter.ends(&subject, &standing[k], camera, factor);
            let colors = &subject.colors[k];
            let mask = at_full_size(&pixels, factor, &sides[k], colors, p.gamma, &ends);
            steps.tick()?;
            Ok((shot.id, mask.into()))
        };
        let views = shots
            .par_iter()
            .enumerate()
            .map(one)
            .collect::<Result<Vec<_>, Stop>>()?;
        Ok(views.into_iter().collect())
    }
}

/// Where the subject ends below.
fn cutter(p: &WalkParams, shots: &[Shot], subject: &Subject) -> FloorCut {
    let Subject { block, solid, .. } = subject;
    let least = (p.whole * shots.len() as f64 - 1e-9).ceil() as u16;
    let lowest = lowest_seen(block, solid, &block.seen(shots), least);
    FloorCut::at(lowest.max(p.bottom_mm), block, solid)
}

/// How many pixels along a side become one.
fn factor(p: &WalkParams, width: u32, height: u32) -> usize {
    width.max(height).div_ceil(p.coarse_px.max(1)).max(1) as usize
}

fn photo(photos: &Photos, id: PhotoId) -> Result<&shape::Photo, WalkCutError> {
    photos
        .get(id)
        .ok_or(WalkCutError::Few(photos.photos.len(), id.0 as usize + 1))
}

/// Reduced photos with their cameras, and the sizes of the photos.
fn shots(
    p: &WalkParams,
    photos: &Photos,
    cameras: &Cameras,
    ctx: &Ctx<'_>,
) -> Result<(Vec<Shot>, Vec<[f64; 2]>), Stop> {
    let views: Vec<_> = cameras
        .views
        .iter()
        .filter(|(id, _)| photos.get(*id).is_some())
        .collect();
    let one = |(id, view): &(PhotoId, &shape::View)| -> Result<(Shot, [f64; 2]), Stop> {
        ctx.check()?;
        let photo = photo(photos, *id)?;
        let small = photo
            .decode()?
            .reduced(factor(p, photo.width, photo.height));
        let camera = view.camera.resized(small.width as u32, small.height as u32);
        let shot = Shot {
            id: *id,
            small,
            camera,
        };
        Ok((shot, [f64::from(photo.width), f64::from(photo.height)]))
    };
    let all = views
        .par_iter()
        .map(one)
        .collect::<Result<Vec<_>, Stop>>()?;
    Ok(all.into_iter().unzip())
}
