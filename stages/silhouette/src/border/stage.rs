//! The stage that cuts the border of the labels again at full size.

use crate::align::cameras::aligned_alike;
use crate::border::by_colors::fine_by_colors;
use crate::border::full_size::fine;
use crate::border::returned::returned;
use crate::label::between_photos::Agreement;
use crate::label::by_colors::ByColors;
use crate::label::color_cut::Settings;
use crate::likelihood::behind::Behind;
use crate::likelihood::gmm::Gmm;
use crate::likelihood::prepared::Prepared;
use crate::params::{CutError, GAMMA};
use crate::raster::{as_mask, only};
use rayon::prelude::*;
use shape::{
    Aligned, Evidence, Label, Labels, Mask, MaskRuns, Masks, People, Photo, PhotoEvidence, PhotoId,
    Photos, Scene,
};
use stage::{Ctx, Hash, Stage, Stop};
use std::sync::Arc;

stage::params! {
    /// How the border is cut.
    pub struct BorderParams {
        /// Weight of the border's length against colours (γ).
        #[range(0.0..=1000.0)]
        #[source(derived = "γ of every cut")]
        gamma: f64 = GAMMA,
    }
}

stage::inputs! {
    /// Labels of reduced photos, and all they came from.
    pub struct BorderInput {
        /// The photos.
        photos: Arc<Photos>,
        /// How they are aligned, with their cameras.
        aligned: Arc<Aligned>,
        /// The scene without the body.
        scene: Arc<Scene>,
        /// What speaks for body or background.
        evidence: Arc<Evidence>,
        /// Body or background of each reduced pixel.
        labels: Arc<Labels>,
        /// Where a person is, by a learned sense of one: it tells where the floor is.
        people: Option<Arc<People>>,
    }
}

/// `silhouette.border`: photos, aligned, scene, evidence, labels, people → masks.
pub struct Border;

impl Stage for Border {
    const NAME: &'static str = "silhouette.border";
    const VERSION: u32 = 18;
    const ABOUT: &'static str = "Cuts the border of the labels again at full size, follows narrow gaps, and gives how much of each border pixel is body.";
    type Params = BorderParams;
    type Input = BorderInput;
    type Output = Masks;

    fn run(p: &BorderParams, input: BorderInput, ctx: &Ctx<'_>) -> Result<Masks, Stop> {
        let photos = &input.aligned.photos(&input.photos);
        let people = input.people.as_deref();
        let people = people.map(|people| people.of_photos(&input.photos, photos));
        let behind = Behind::of(&input.scene, &input.aligned, people.as_ref());
        let all = Turn {
            settings: Settings::of_border(p.gamma),
            agreement: agreement(&input),
            picture: input.scene.picture_content(),
            behind,
            input: &input,
        };
        let labels = input.labels.views.as_slice();
        let steps = ctx.steps("photos", labels.len());
        let one = |(id, label): &(PhotoId, Label)| -> Result<Option<(PhotoId, MaskRuns)>, Stop> {
            let both = photos.get(*id).zip(input.evidence.views.get(*id));
            let Some((photo, evidence)) = both else {
                return Ok(None);
            };
            let depends = all.depends(*id, photo, evidence, label);
            let mask = || {
                let mask = all.mask(*id, photo, evidence, label)?;
                Ok(Masks::from_iter([(PhotoId(0), mask)]))
            };
            let masks: Masks = ctx.part("mask", &depends, mask)?;
            steps.tick()?;
            let mask = masks.views.get(PhotoId(0));
            let mask = mask.ok_or_else(|| CutError::Empty(photo.name.clone()))?;
            let whole = input.photos.get(*id).unwrap_or(photo);
            let [width, height] = [whole.width, whole.height].map(|n| n as usize);
            Ok(Some((*id, mask.pixels().resized(width, height).into())))
        };
        let views = labels.par_iter().map(one).collect::<Result<Vec<_>, _>>()?;
        Ok(views.into_iter().flatten().collect())
    }
}

/// What all photos share.
struct Turn<'a> {
    settings: Settings,
    /// What the labels of all photos show together of each.
    agreement: Agreement,
    /// Of the scene's picture.
    picture: Hash,
    behind: Behind<'a>,
    input: &'a BorderInput,
}

impl Turn<'_> {
    /// All that a photo's mask depends on.
    fn depends(
        &self,
        id: PhotoId,
        photo: &Photo,
        evidence: &PhotoEvidence,
        label: &Label,
    ) -> [Hash; 6] {
        let aligned = &self.input.aligned;
        let alignment = format!(
            "{:?} {:?} {:?}",
            aligned.of(id),
            aligned.taken(id),
            self.behind.floor(id),
        );
        let labels = Labels {
            views: only(label.clone()),
        };
        [
            photo.content(),
            self.agreement.content(id),
            stage::hash(alignment.as_bytes()),
            self.input.scene.content_for(self.picture, id),
            evidence.content(),
            stage::content(&labels),
        ]
    }

    /// The mask at full size.
    fn mask(
        &self,
        id: PhotoId,
        photo: &Photo,
        evidence: &PhotoEvidence,
        label: &Label,
    ) -> Result<Mask, Stop> {
        let own = Gmm::from_rows(&label.body_colors);
        let scene = &self.input.scene;
        if scene.is_unknown() {
            let coarse = ByColors {
                sides: label.body.clone(),
                ground: Gmm::from_rows(&label.background_colors),
                own,
            };
            let (pixels, factor) = (photo.decode()?, evidence.factor as usize);
            return Ok(fine_by_colors(
                &pixels,
                &coarse,
                &label.known,
                factor,
                &self.settings,
            ));
        }
        let alignment = self.input.aligned.of(id);
        let pixels = alignment.brought(photo.decode()?);
        let without = self.behind.of_photo(id, &pixels);
        let (width, height) = (evidence.photo.width, evidence.photo.height);
        let floor = self.behind.floor(id);
        let floor = floor.map(|floor| floor.resized(width, height));
        let mut ready = Prepared::of(evidence, floor);
        ready.known.clone_from(&label.known);
        ready.add_odds(self.agreement.odds(id));
        let mask = fine(&pixels, &without, &ready, &label.body, &own, &self.settings);
        Ok(returned(alignment, mask))
    }
}

/// What the labels of all photos show of each other, where cameras are known.
fn agreement(input: &BorderInput) -> Agreement {
    let known = Some(&input.aligned).filter(|_| !input.scene.is_unknown());
    let Some(cameras) = known.and_then(|aligned| aligned_alike(aligned)) else {
        return Agreement::default();
    };
    let mask = |(id, label): (PhotoId, &Label)| (id, as_mask(&label.body));
    let masks: Vec<(PhotoId, Mask)> = input.labels.views.iter().map(mask).collect();
    Agreement::of(&masks, &cameras)
}
