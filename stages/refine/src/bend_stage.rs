//! The stage that finds how the body bent between photos.

use crate::bend::{Stiff, Ties, seen_off};
use crate::need::Need;
use crate::patch::{Pairing, Window};
use crate::remesh::remesh;
use crate::rims::pulls;
use crate::scene::{check, footprint, pictures, taken};
use crate::sights::{Sighting, Sights};
use shape::{Adjacency, Cameras, Masks, Mesh, Photos, Warp, Warps};
use stage::{Ctx, Stage, Stop};
use std::sync::Arc;

stage::params! {
    /// How the bending is found; pixels are those of the level.
    pub struct BendParams {
        /// Level of the Gaussian pyramid: photos are halved so many times, 500 pixels left.
        #[range(0..=6)]
        level: u32 = 1,
        /// Photos are halved first until they have at most so many million pixels.
        #[range(0.1..=100.0)]
        most_mpx: f64 = 6.0,
        /// Edge of the mesh that is looked at, in pixels of the level on the surface.
        #[range(1.0..=50.0)]
        edge_px: f64 = 4.0,
        /// Points of a patch from its middle to its side.
        #[range(1..=5)]
        patch: u32 = 4,
        /// Whether a linear change of brightness across a patch is taken out, as shade is.
        level_patch: bool = true,
        /// Greatest angle between the surface's normal and a line of sight.
        #[range(10.0..=85.0)]
        tilt_deg: f64 = 60.0,
        /// Texture counts in full from this many times the noise's variance.
        #[range(0.0..=1000.0)]
        noise_gain: f64 = 4.0,
        /// Weight of a point of the silhouettes' rim, against one that is known to a pixel.
        #[range(0.0..=100.0)]
        rim: f64 = 0.2,
        /// Distance of the field's nodes, in pixels of the level.
        #[range(4.0..=500.0)]
        cell_px: f64 = 24.0,
        /// Offset that is expected, one standard deviation, in pixels of the level.
        #[range(0.01..=50.0)]
        shift_px: f64 = 2.0,
        /// Difference of neighbouring nodes that is expected, one standard deviation, in pixels of the level.
        #[range(0.001..=50.0)]
        differ_px: f64 = 0.3,
        /// Rounds.
        #[range(1..=100)]
        rounds: u32 = 8,
    }
}

stage::inputs! {
    /// A body and the photos of it.
    pub struct BendInput {
        /// Closed; settled, so that what is left is not its shape.
        mesh: Arc<Mesh>,
        /// Those without a camera are passed over.
        photos: Arc<Photos>,
        /// Where they were taken, the body standing still as a whole.
        cameras: Arc<Cameras>,
        /// Silhouettes.
        masks: Option<Arc<Masks>>,
    }
}

/// `refine.bend`: mesh, photos, cameras, masks → warps.
pub struct Bend;

impl Stage for Bend {
    const NAME: &'static str = "refine.bend";
    const VERSION: u32 = 1;
    const ABOUT: &'static str = "Finds how arms, head and chest moved against the rest of the body: a smooth field of offsets a photo.";
    type Params = BendParams;
    type Input = BendInput;
    type Output = Warps;
    const METRICS: &'static [&'static str] = &["bending"];

    /// The pictures, and what hangs on the vertices.
    fn memory(p: &BendParams, input: &BendInput) -> u64 {
        let (photos, cameras) = (&input.photos, &input.cameras);
        let masks = input.masks.as_deref();
        let need = Need::new(photos, cameras, masks, p.level, p.most_mpx);
        (need.pictures(2) + need.surface(p.edge_px, &input.mesh)) as u64
    }

    fn run(p: &BendParams, input: BendInput, ctx: &Ctx<'_>) -> Result<Warps, Stop> {
        check(&input.mesh)?;
        let taken = taken(&input.photos, &input.cameras);
        let bent = pictures(
            &input.photos,
            &input.cameras,
            input.masks.as_deref(),
            p.level,
            p.most_mpx,
            || ctx.check().map_err(Stop::from),
        )?;
        let footprint = footprint(&input.mesh, &bent);
        let mesh = remesh(&input.mesh, p.edge_px * footprint, 3);
        let (around, normals) = (Adjacency::new(&mesh), mesh.normals());
        let stiff = Stiff {
            shift_px: p.shift_px,
            differ_px: p.differ_px,
            rim: p.rim,
        };
        let window = Window::new(p.patch as usize, p.level_patch);
        let rules = Sighting::new(p.tilt_deg, Pairing::ALL, p.noise_gain);
        let none =
            |p: &crate::picture::Picture, cell| Warp::none(p.gray.width, p.gray.height, cell);
        let mut warps: Vec<Warp> = bent.iter().map(|b| none(b, p.cell_px)).collect();
        let steps = ctx.steps("rounds", p.rounds as usize);
        for _ in 0..p.rounds {
            let unbent: Vec<_> = bent
                .iter()
                .zip(&warps)
                .map(|(b, w)| b.unbent(w, b.gray.width as u32))
                .collect();
            let sights = Sights::new(&mesh, &around, &unbent, &window, &rules);
            let rims = pulls(&mesh, &around, &normals, &unbent, 6.0);
            let ties = Ties::new(&mesh, &unbent, &sights, &rims, &window, &stiff, footprint);
            warps = ties.solve(&warps, &stiff);
            steps.tick()?;
        }
        let stride = (mesh.positions.len() / 2000).max(1);
        let some = (0..mesh.positions.len() as u32).step_by(stride);
        let off: Vec<f64> = some
            .map(|v| seen_off(&warps, &bent, &mesh.point(v)))
            .collect();
        let rms = (off.iter().map(|o| o * o).sum::<f64>() / off.len().max(1) as f64).sqrt();
        ctx.metric("bending", rms * footprint, "mm");
        let whole = taken
            .iter()
            .zip(warps)
            .zip(&bent)
            .map(|(((id, view), w), b)| {
                let scale = f64::from(view.camera.lens.width) / b.gray.width as f64;
                let offsets = w.offsets.iter().map(|o| o.map(|o| o * scale as f32));
                let warp = Warp {
                    cell_px: w.cell_px * scale,
                    columns: w.columns,
                    offsets: offsets.collect(),
                };
                (*id, warp)
            });
        Ok(Warps {
            views: whole.collect(),
        })
    }
}
