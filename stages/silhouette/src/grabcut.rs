//! All steps from photos to masks as one stage, for pipelines that name it: the same bytes as the nodes.

use crate::align::stage::{Align, AlignInput, AlignParams};
use crate::border::stage::{Border, BorderInput, BorderParams};
use crate::empty_scene::stage::{EmptyScene, EmptySceneInput, EmptySceneParams};
use crate::label::stage::{Label, LabelInput, LabelParams};
use crate::likelihood::stage::{Likelihood, LikelihoodInput, LikelihoodParams};
use crate::params::GrabCutParams;
use crate::plate::stage::{Plate, PlateInput};
use shape::{Cameras, Masks, People, Photos};
use stage::{Ctx, Stage, Stop};
use std::sync::Arc;

stage::inputs! {
    /// Photos, with a plate or without.
    pub struct GrabCutInput {
        /// The photos.
        photos: Arc<Photos>,
        /// Their cameras: where the disk is, and where the body cannot be. Without a plate they are needed.
        cameras: Option<Arc<Cameras>>,
        /// Where a person is, by a learned sense of one.
        people: Option<Arc<People>>,
    }
}

/// `silhouette.grabcut`: photos, cameras → masks.
pub struct GrabCut;

impl Stage for GrabCut {
    const NAME: &'static str = "silhouette.grabcut";
    const VERSION: u32 = 50;
    const ABOUT: &'static str = "Cuts the body out of each photo by graph cuts, seeded by the plate, or by what does not move, and the disk: silhouette.align, plate, room, likelihood, label and border in one.";
    type Params = GrabCutParams;
    type Input = GrabCutInput;
    type Output = Masks;
    const METRICS: &'static [&'static str] = EmptyScene::METRICS;

    fn run(p: &GrabCutParams, input: GrabCutInput, ctx: &Ctx<'_>) -> Result<Masks, Stop> {
        let GrabCutInput {
            photos,
            cameras,
            people,
        } = input;
        let params = AlignParams {
            most_mpx: p.most_mpx,
            coarse_px: p.coarse_px,
            box_px: p.box_px.clone(),
        };
        let sources = AlignInput {
            photos: Arc::clone(&photos),
            cameras,
        };
        let aligned = Arc::new(Align::run(&params, sources, ctx)?);
        let sources = PlateInput {
            photos: Arc::clone(&photos),
            aligned: Arc::clone(&aligned),
        };
        let known = Some(Arc::new(Plate::run(&(), sources, ctx)?));
        let params = EmptySceneParams {
            cut: p.cut.clone(),
            disk_side_mm: p.disk_side_mm,
        };
        let sources = EmptySceneInput {
            photos: Arc::clone(&photos),
            aligned: Arc::clone(&aligned),
            known,
            people: people.clone(),
        };
        let scene = Arc::new(EmptyScene::run(&params, sources, ctx)?);
        let params = LikelihoodParams {
            disk_side_mm: p.disk_side_mm,
        };
        let sources = LikelihoodInput {
            photos: Arc::clone(&photos),
            aligned: Arc::clone(&aligned),
            scene: Arc::clone(&scene),
            people: people.clone(),
        };
        let evidence = Arc::new(Likelihood::run(&params, sources, ctx)?);
        let params = LabelParams {
            cut: p.cut.clone(),
            coherence: p.coherence,
        };
        let sources = LabelInput {
            photos: Arc::clone(&photos),
            aligned: Arc::clone(&aligned),
            scene: Arc::clone(&scene),
            evidence: Arc::clone(&evidence),
        };
        let labels = Arc::new(Label::run(&params, sources, ctx)?);
        let params = BorderParams { gamma: p.cut.gamma };
        let sources = BorderInput {
            photos,
            aligned,
            scene,
            evidence,
            labels,
            people,
        };
        Border::run(&params, sources, ctx)
    }
}
