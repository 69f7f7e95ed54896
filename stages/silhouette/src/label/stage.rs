//! The stage that labels reduced photos: body or background, all photos together.

use crate::align::cameras::aligned_alike;
use crate::label::between_photos::Agreement;
use crate::label::by_colors::by_colors;
use crate::label::color_cut::{Settings, coarse};
use crate::likelihood::gmm::Gmm;
use crate::likelihood::prepared::Prepared;
use crate::params::{CutError, CutParams};
use crate::raster::{as_mask, only};
use rayon::prelude::*;
use shape::{
    Aligned, Evidence, Image, Label as Labelled, Labels, MaskRuns, Masks, PhotoEvidence, PhotoId,
    Photos, Scene,
};
use stage::{Ctx, Stage, Stop};
use std::sync::Arc;

stage::params! {
    /// How photos are labelled.
    pub struct LabelParams {
        /// How photos are cut.
        #[group(flat)]
        cut: CutParams = CutParams::default(),
        /// Whether what the other photos show decides where one alone is in doubt. Needs cameras.
        coherence: bool = true,
    }
}

stage::inputs! {
    /// Evidence of photos.
    pub struct LabelInput {
        /// The photos, for their names.
        photos: Arc<Photos>,
        /// Their cameras.
        aligned: Arc<Aligned>,
        /// The scene, with the bodies that were found with it.
        scene: Arc<Scene>,
        /// What speaks for body or background.
        evidence: Arc<Evidence>,
    }
}

/// `silhouette.label`: photos, aligned, scene, evidence → labels.
pub struct Label;

/// A body takes so much of its photo at least, and at most. By hand: looked at scene 131 with a plate, each at 0.7 and
/// 1.4 of it: equal masks.
const BODY_SHARES: (f64, f64) = (0.002, 0.9);

impl Stage for Label {
    const NAME: &'static str = "silhouette.label";
    const VERSION: u32 = 7;
    const ABOUT: &'static str = "Parts body and background on the reduced photos by least cuts: each alone, then again with what all photos have in common.";
    type Params = LabelParams;
    type Input = LabelInput;
    type Output = Labels;

    fn run(p: &LabelParams, input: LabelInput, ctx: &Ctx<'_>) -> Result<Labels, Stop> {
        let settings = Settings::of(&p.cut);
        let scene = &*input.scene;
        let agreeing = scene.bodies.is_empty() && !scene.is_unknown() && p.coherence;
        let cameras = aligned_alike(&input.aligned).filter(|_| agreeing);
        let views = input.evidence.views.as_slice();
        let passes = if cameras.is_some() { 3 } else { 1 };
        let steps = ctx.steps("photos", views.len() * passes);
        let contents: Vec<_> = views.par_iter().map(|(_, e)| e.content()).collect();
        let jobs: Vec<_> = views.iter().zip(contents).collect();
        let name = |id: PhotoId| {
            input
                .photos
                .get(id)
                .map_or(String::new(), |p| p.name.clone())
        };
        // First a cut of each photo alone, then twice again with what all of them show together.
        let alone = |((id, evidence), content): &(&(PhotoId, PhotoEvidence), stage::Hash)| {
            let cut = || {
                let ready = Prepared::of(evidence, None);
                let (sides, _) = checked(coarse(&ready, &settings), &name(*id))?;
                Ok(Masks::from_iter([(PhotoId(0), as_mask(&sides))]))
            };
            let masks: Masks = ctx.part("alone", &[*content], cut)?;
            steps.tick()?;
            let mask = masks.views.get(PhotoId(0)).map(MaskRuns::pixels);
            Ok((*id, mask.ok_or_else(|| CutError::Empty(name(*id)))?))
        };
        let mut agreement = Agreement::default();
        if let Some(cameras) = &cameras {
            let first: Vec<_> = jobs.par_iter().map(alone).collect::<Result<_, Stop>>()?;
            agreement = Agreement::of(&first, cameras);
            // What bit into one photo bit into what it showed of all the rest, too.
            let again = |((id, evidence), _): &(&(PhotoId, PhotoEvidence), stage::Hash)| {
                let label = with_all(*id, evidence, &agreement, &settings, &name(*id))?;
                steps.tick()?;
                Ok((*id, as_mask(&label.body)))
            };
            let second: Vec<_> = jobs.par_iter().map(again).collect::<Result<_, Stop>>()?;
            agreement = Agreement::of(&second, cameras);
        }
        let unknown = stage::hash(&[u8::from(scene.is_unknown())]);
        let label = |((id, evidence), content): &(&(PhotoId, PhotoEvidence), stage::Hash)| {
            let found = scene.bodies.get(*id);
            let depends = [
                *content,
                agreement.content(*id),
                scene.content_for(unknown, *id),
            ];
            let label = || {
                let label = match found {
                    _ if scene.is_unknown() => colors_alone(evidence, &settings, &name(*id))?,
                    Some(found) => as_found(evidence, found, &settings, &name(*id))?,
                    None => with_all(*id, evidence, &agreement, &settings, &name(*id))?,
                };
                let views = only(label);
                Ok(Labels { views })
            };
            let labels: Labels = ctx.part("label", &depends, label)?;
            steps.tick()?;
            let label = labels.views.get(PhotoId(0)).cloned();
            Ok((*id, label.ok_or_else(|| CutError::Empty(name(*id)))?))
        };
        let views = jobs
            .par_iter()
            .map(label)
            .collect::<Result<Vec<_>, Stop>>()?;
        Ok(Labels {
            views: views.into_iter().collect(),
        })
    }
}

/// By the evidence of a photo, and of all photos together.
fn with_all(
    id: PhotoId,
    evidence: &PhotoEvidence,
    agreement: &Agreement,
    settings: &Settings,
    name: &str,
) -> Result<Labelled, CutError> {
    let mut ready = Prepared::of(evidence, None);
    ready.add_odds(agreement.odds(id));
    let (body, colors) = checked(coarse(&ready, settings), name)?;
    Ok(Labelled {
        body,
        known: ready.known,
        body_colors: colors.rows(),
        background_colors: vec![],
    })
}

/// As all photos agreed while the scene was found.
fn as_found(
    evidence: &PhotoEvidence,
    found: &Image<bool>,
    settings: &Settings,
    name: &str,
) -> Result<Labelled, CutError> {
    let sides = found.clone();
    let of_body = sides.data.iter().zip(&evidence.photo.data);
    let of_body = of_body.filter(|(b, _)| **b);
    let colors: Vec<[u8; 3]> = of_body.map(|(_, c)| *c).step_by(7).collect();
    let fitted = Gmm::fit(&colors, settings.clusters);
    let (body, colors) = checked(fitted.map(|colors| (sides, colors)), name)?;
    Ok(Labelled {
        body,
        known: evidence.known.clone(),
        body_colors: colors.rows(),
        background_colors: vec![],
    })
}

/// By colours alone, where nothing is known of the scene.
fn colors_alone(
    evidence: &PhotoEvidence,
    settings: &Settings,
    name: &str,
) -> Result<Labelled, CutError> {
    let found = by_colors(&evidence.photo, &evidence.known, settings);
    let found = found.ok_or_else(|| CutError::Empty(name.to_owned()))?;
    Ok(Labelled {
        body: found.sides,
        known: evidence.known.clone(),
        body_colors: found.own.rows(),
        background_colors: found.ground.rows(),
    })
}

/// A cut that is neither empty nor full.
fn checked<T>(cut: Option<(Image<bool>, T)>, name: &str) -> Result<(Image<bool>, T), CutError> {
    let (sides, more) = cut.ok_or_else(|| CutError::Empty(name.to_owned()))?;
    let share = sides.data.iter().filter(|b| **b).count() as f64 / sides.data.len() as f64;
    match share {
        s if s < BODY_SHARES.0 => Err(CutError::Empty(name.to_owned())),
        s if s > BODY_SHARES.1 => Err(CutError::Full(name.to_owned())),
        _ => Ok((sides, more)),
    }
}
