//! The stage that carves the visual hull and gives its surface.

use crate::contradicted::{CONTRADICTED_PERCENT, contradicted};
use crate::field::{BRICK, Lattice, evaluate};
use crate::left_out::left_out;
use crate::silhouettes::{bounds, consensus};
use crate::surface::{largest, surface};
use nalgebra::{Point3, Vector3};
use rayon::prelude::*;
use shape::{
    Cameras, DISSENT_DEPTH, Mask, MaskRuns, Masks, Mesh, Silhouette, View, coherence, seen_by_half,
};
use stage::{Cancelled, Ctx, Message, Stage, Stop, message};
use std::sync::Arc;

stage::messages! {
    EMPTY = "mask-empty": "empty";
    FULL = "mask-full": "full, or inverted";
    OTHER_SIZE = "mask-other-size": "of another size than the photo";
    ENDED = "warn-hull-cut": "the hull is cut off where the search for it ended: the photos do not see around the body, or masks and cameras do not belong together";
    CUTS_BODY = "warn-contradicted": "its mask leaves out body that all other photos show ({share:.1 %} of it): look at this mask and correct it";
}

stage::params! {
    /// How finely, and how strictly, space is carved.
    pub struct CarveParams {
        /// Edge of a cell.
        #[range(0.25..=50.0)]
        #[source(structural)]
        voxel_mm: f64 = 3.0,
        /// Share of the views that must show a point if it is to stay. Below 1, a body that sways,
        /// or a hole in a mask, does no harm.
        #[range(0.5..=1.0)]
        #[source(cited = "Laurentini 1994: a hull is in all silhouettes")]
        consensus: f64 = 1.0,
        /// Most memory that carving may take.
        #[range(64.0..=65536.0)]
        #[source(structural)]
        memory_mb: f64 = 3000.0,
        /// Height above the ground below which nothing is kept.
        #[range(-100.0..=500.0)]
        #[source(structural)]
        ground_mm: f64 = 0.0,
        /// A mask that alone leaves out body, so deep in all other masks or deeper, is warned of; 0: none
        /// is. Share of the body's height. \[%\] Single views carve wedges of up to 6 % of a limb's
        /// radius on their own; 1.2 % was chosen on good masks (`contradicted.rs`).
        #[range(0.0..=20.0)]
        #[source(by_hand = "good masks of the three cases: a wedge is up to 6 % of the radius of a limb")]
        contradicted_pct: f64 = 100.0 * DISSENT_DEPTH,
    }
}

stage::inputs! {
    /// Silhouettes, and the cameras that saw them.
    pub struct CarveInput {
        /// Photos without a camera are passed over.
        masks: Arc<Masks>,
        /// Photos without a mask are passed over.
        cameras: Arc<Cameras>,
    }
}

stage::failures! {
    /// Why there is no hull.
    pub enum CarveError {
        /// Too few views.
        TooFew(count: usize) = "fail-hull-few": "only {count} photos have both a mask and a camera, but a hull needs at least 3",
        /// A bad mask.
        Mask {
            /// The photo.
            name: String,
            /// What it is.
            what: Message,
        } = "fail-mask-empty": "the mask of {name} is {what}: correct or remove it",
        /// No cell is left.
        Nothing(share: f64) = "fail-hull-nothing": "no point of space is body on {share:.0 %} of the photos: do masks and cameras belong together? a lower `consensus` may help",
        /// Some outlines contradict those of all other photos.
        Contradicted {
            /// The photos.
            names: String,
            /// How much the first of them cuts away.
            percent: f64,
        } = "fail-hull-contradicted": "no point of space is body on all photos: the outline on {names} cuts away up to {percent:.0 %} of what nearly all other photos show; look at this mask, correct it, or leave the photo out",
        /// Too fine.
        Memory {
            /// The cell.
            voxel_mm: f64,
            /// What it needs. \[MB\]
            need: f64,
            /// What may be taken. \[MB\]
            most: f64,
            /// A cell that fits. \[mm\]
            fits: f64,
        } = "fail-hull-memory": "cells of {voxel_mm} mm would need about {need:.0 MB}, but {most:.0 MB} may be taken: {fits:.1 mm} fits, or raise `memory_mb`",
    }
}

/// `hull.carve`: masks, cameras → mesh.
pub struct Carve;

impl Stage for Carve {
    const NAME: &'static str = "hull.carve";
    const VERSION: u32 = 4;
    const ABOUT: &'static str =
        "Carves the visual hull (Laurentini 1994) and gives its surface by marching cubes.";
    type Params = CarveParams;
    type Input = CarveInput;
    type Output = Mesh;
    const METRICS: &'static [&'static str] = &["volume", "cells looked into", "contradicted"];

    /// The distances of all silhouettes, and the lattice over a standing body with its arms out.
    fn memory(p: &CarveParams, input: &CarveInput) -> u64 {
        let pixels = input.masks.views.iter().map(|(_, mask)| mask.count());
        let lattice = need_mb(BODY_BOX_MM2, p.voxel_mm).min(p.memory_mb);
        pixels.sum::<usize>() as u64 * 4 + (lattice * 1e6) as u64
    }

    fn run(p: &CarveParams, input: CarveInput, ctx: &Ctx<'_>) -> Result<Mesh, Stop> {
        let views: Vec<_> = input.masks.views.join(&input.cameras.views).collect();
        if views.len() < 3 {
            return Err(CarveError::TooFew(views.len()).into());
        }
        for (_, mask, view) in &views {
            sound(mask, view)?;
        }
        let prepared: Vec<Silhouette> = views
            .par_iter()
            .map(|(_, mask, view)| {
                ctx.check()?;
                Ok(Silhouette::of(&mask.pixels(), &view.camera))
            })
            .collect::<Result<_, Cancelled>>()?;
        let dissent = ((1.0 - p.consensus) * prepared.len() as f64 + 1e-9).floor() as usize;
        let ground = input.cameras.ground_mm + p.ground_mm;
        let nothing = || nothing(p, &input);
        let cylinder = seen_by_half(&input.cameras).ok_or_else(nothing)?;
        let (lo, hi) = bounds(&prepared, dissent, &cylinder, ground).ok_or_else(nothing)?;
        if p.contradicted_pct > 0.0 {
            // Also where one photo shows nothing of it.
            let whole = bounds(&prepared, dissent.max(1), &cylinder, ground);
            let names: Vec<&str> = views.iter().map(|(.., view)| view.name.as_str()).collect();
            let within = whole.unwrap_or((lo, hi));
            warn_of_contradicted(
                &names,
                &contradicted(&prepared, within, p.contradicted_pct),
                ctx,
            );
        }
        let lattice = Lattice::over(lo, hi, p.voxel_mm);
        fits(p, &(hi - lo))?;
        // Beyond the lattice nothing is solid: half a cell within, the solid ends.
        let [first, last] = [[0; 3], lattice.bricks.map(|b| b * BRICK)];
        let [first, last] = [first, last].map(|[x, y, z]| lattice.corner(x, y, z));
        let inward = |x: &Point3<f64>| (x - first).inf(&(last - x)).min() - p.voxel_mm / 2.0;
        let value = |x: &Point3<f64>| {
            let ends = (x.z - ground).min(inward(x)) as f32;
            consensus(&prepared, x, dissent).min(ends)
        };
        let steps = ctx.steps("layers", lattice.bricks[2]);
        let bricks = evaluate(&lattice, &value, &|| steps.tick())?;
        drop(prepared);
        let cells = bricks.iter().flatten().count() * BRICK.pow(3);
        let (mesh, rest) = largest(&surface(&lattice, &bricks));
        if mesh.faces.is_empty() {
            return Err(nothing().into());
        }
        let ended = (0..mesh.positions.len() as u32).any(|v| inward(&mesh.point(v)) < p.voxel_mm);
        if ended {
            ctx.warn(message!(ENDED));
        }
        if let Some(word) = left_out(mesh.volume(), &rest) {
            ctx.warn(word);
        }
        let (volume, unit) = input.cameras.scale.unit().volume(mesh.volume());
        ctx.metric("volume", volume, unit);
        ctx.metric("cells looked into", cells as f64 / 1e6, "million");
        Ok(Mesh {
            unit: input.cameras.scale.unit(),
            ..mesh
        })
    }
}

/// Why nothing is body on all photos: outlines that contradict those of nearly all other photos, where there are some.
fn nothing(p: &CarveParams, input: &CarveInput) -> CarveError {
    let found = coherence(&input.cameras, &input.masks);
    let cut: Vec<_> = found
        .iter()
        .flat_map(|found| found.contradicting())
        .collect();
    let Some((_, most)) = cut.first() else {
        return CarveError::Nothing(p.consensus * 100.0);
    };
    let name = |(id, _): &(_, f64)| input.cameras.views.get(*id).map(|v| v.name.as_str());
    let names: Vec<&str> = cut.iter().filter_map(name).collect();
    CarveError::Contradicted {
        names: names.join(", "),
        percent: 100.0 * most,
    }
}

/// Warns of each mask that is contradicted, by its share. \[%\]
fn warn_of_contradicted(names: &[&str], shares: &[f64], ctx: &Ctx<'_>) {
    let worst = shares.iter().copied().reduce(f64::max);
    worst
        .iter()
        .for_each(|w| ctx.metric("contradicted", *w, "%"));
    for (name, share) in names.iter().zip(shares) {
        if *share >= CONTRADICTED_PERCENT {
            ctx.warn(message!(CUTS_BODY, share = *share).of_what(*name));
        }
    }
}

/// Whether a mask can be one of a subject before a background.
fn sound(mask: &MaskRuns, view: &View) -> Result<(), CarveError> {
    let share = mask.share();
    let lens = &view.camera.lens;
    let what = if share < 1e-4 {
        message!(EMPTY)
    } else if share > 0.95 || framed(&mask.pixels()) > 0.9 {
        message!(FULL)
    } else if (mask.width as u32, mask.height as u32) != (lens.width, lens.height) {
        message!(OTHER_SIZE)
    } else {
        return Ok(());
    };
    Err(CarveError::Mask {
        name: view.name.clone(),
        what,
    })
}

/// Whether the lattice of a box of this size fits into memory. \[mm\]
fn fits(p: &CarveParams, size: &Vector3<f64>) -> Result<(), CarveError> {
    let surface = 2.0 * (size.x * size.y + size.y * size.z + size.z * size.x);
    let need = need_mb(surface, p.voxel_mm);
    if need <= p.memory_mb {
        return Ok(());
    }
    Err(CarveError::Memory {
        voxel_mm: p.voxel_mm,
        need,
        most: p.memory_mb,
        // Rounded up to what is printed, so that the size that is named fits.
        fits: (p.voxel_mm * (need / p.memory_mb).sqrt() * 10.2).ceil() / 10.0,
    })
}

/// Share of the outermost pixels that are body. A subject never fills the frame all around.
fn framed(mask: &Mask) -> f64 {
    let (w, h) = (mask.width, mask.height);
    let rows = (0..w).flat_map(|x| [(x, 0), (x, h - 1)]);
    let sides = (0..h).flat_map(|y| [(0, y), (w - 1, y)]);
    let body = rows.chain(sides).filter(|(x, y)| mask.at(*x, *y) > 127);
    body.count() as f64 / (2 * (w + h)) as f64
}

/// Surface of a box of 1.0 × 1.8 × 2.0 m (structural: what the memory is planned by). \[mm²\]
const BODY_BOX_MM2: f64 = 2.0 * (1.0 * 1.8 + 1.8 * 2.0 + 1.0 * 2.0) * 1e6;

/// What carving takes, from the area of the box around the solid. \[MB\]
fn need_mb(area_mm2: f64, voxel_mm: f64) -> f64 {
    let bricks = area_mm2 / (voxel_mm * BRICK as f64).powi(2) * 2.0;
    bricks * 17f64.powi(3) * 4.0 / 1e6 + area_mm2 / (voxel_mm * voxel_mm) * 150.0 / 1e6
}
