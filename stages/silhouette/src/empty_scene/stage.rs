//! The stage that finds the empty scene out of all photos of a turn, or mends a plate by them.

use crate::align::rectangle::Rectangle;
use crate::empty_scene::doubtful_patches::doubtful;
use crate::empty_scene::full_size::{Views, at_full_size, shots};
use crate::empty_scene::mended::mended;
use crate::empty_scene::without_plate::without_plate;
use crate::label::color_cut::Settings;
use crate::likelihood::person::sense;
use crate::params::{CutError, CutParams, DISK_SIDE_MM};
use crate::scene::backdrop::still;
use crate::scene::still_and_disk::Shot;
use shape::{Aligned, Cameras, Image, InPhoto, People, Photo, PhotoId, Photos, Rgb, Scene};
use stage::{Ctx, Message, Stage, Stop, message};
use std::sync::Arc;

stage::messages! {
    BY_COLOURS = "warn-by-colour": "{why}; so photos are cut by colours alone";
    NO_PLATE = "warn-no-plate": "there is no plate: the empty scene is guessed from what does not move, and may cost parts of the body; look at the masks, or take one photo without the subject and call it plate.jpg";
    PATCH = "warn-patch": "a patch of a colour that the body has nowhere else counts as body where no photo shows the empty scene: is it a bit of wall beside arm or trunk? girths there may be too large; look at these masks";
}

stage::params! {
    /// How the empty scene is found together with the body.
    pub struct EmptySceneParams {
        /// How photos are cut.
        #[group(flat)]
        cut: CutParams = CutParams::default(),
        /// Height of the side of the disk below its top that is not body.
        #[range(0.0..=500.0)]
        #[source(derived = "as wherever the disk is known")]
        disk_side_mm: f64 = DISK_SIDE_MM,
    }
}

stage::inputs! {
    /// Photos of a turn.
    pub struct EmptySceneInput {
        /// The photos.
        photos: Arc<Photos>,
        /// How they are aligned with each other, with their cameras.
        aligned: Arc<Aligned>,
        /// The scene as far as it is known already, such as by a plate: it is mended where photos agree on something else and nobody is.
        known: Option<Arc<Scene>>,
        /// Where a person is, by a learned sense of one.
        people: Option<Arc<People>>,
    }
}

/// `silhouette.room`: photos, aligned, scene → scene.
pub struct EmptyScene;

/// Least share of the photos that must be still.
/// By hand: looked at three scenes (158 with a plate, 160 and 170 without), at 0.7 and 1.4 of it: nothing changes. \[%\]
const MIN_STILL_PERCENT: f64 = 15.0;

/// A patch that nothing vouches for is named when it takes more of its mask than this.
/// By hand: looked at three scenes (158 with a plate, 160 and 170 without), at 0.7 and 1.4 of it: nothing changes. \[%\]
const MAX_DOUBTFUL_PERCENT: f64 = 0.5;

impl Stage for EmptyScene {
    const NAME: &'static str = "silhouette.room";
    const VERSION: u32 = 18;
    const ABOUT: &'static str = "Finds the empty scene out of all photos of the turn where no plate shows it: what most of them share, and the body's outlines on which they agree. A plate is mended where photos agree on something else and nobody is.";
    type Params = EmptySceneParams;
    type Input = EmptySceneInput;
    type Output = Scene;
    const METRICS: &'static [&'static str] = &["stands still"];

    fn run(p: &EmptySceneParams, input: EmptySceneInput, ctx: &Ctx<'_>) -> Result<Scene, Stop> {
        let aligned = &*input.aligned;
        let photos = &aligned.photos(&input.photos);
        if let Some(known) = input.known.as_ref().filter(|known| !known.is_unknown()) {
            let people = input.people.as_deref();
            let people = people.map(|people| people.of_photos(&input.photos, photos));
            let brought = |id: PhotoId| -> Result<Option<Rgb>, Stop> {
                ctx.check()?;
                let pixels = photos.get(id).map(Photo::decode).transpose()?;
                Ok(pixels.map(|pixels| aligned.of(id).brought(pixels)))
            };
            return mended(known, aligned, people.as_ref(), brought);
        }
        let boxed = !aligned.box_px.is_empty();
        let Some(cameras) = &aligned.cameras else {
            return match boxed {
                true => Ok(Scene::unknown()),
                false => Err(CutError::NoPlate.into()),
            };
        };
        let shots = shots(aligned, &seen(photos, cameras), || {
            ctx.check().map_err(Stop::from)
        })?;
        ctx.check()?;
        let smalls: Vec<&Rgb> = shots.iter().map(|s| &s.small).collect();
        let still = still(&smalls);
        let count = still.iter().filter(|still| **still).count();
        let percent = 100.0 * (count as f64 / still.len().max(1) as f64);
        if percent < MIN_STILL_PERCENT {
            let why = CutError::Moves(percent);
            if !boxed {
                return Err(why.into());
            }
            ctx.warn(message!(BY_COLOURS, why = why.to_string()));
            return Ok(Scene::unknown());
        }
        let people = input.people.as_deref();
        let people = people.map(|people| people.of_photos(&input.photos, photos));
        let people = people.as_ref();
        let (scene, doubted) = found(p, photos, aligned, cameras, (&shots, &still, people), ctx)?;
        ctx.metric("stands still", percent, "%");
        warnings(&doubted, photos)
            .into_iter()
            .for_each(|w| ctx.warn(w));
        Ok(scene)
    }
}

/// The photos that have a camera.
fn seen<'a>(photos: &'a Photos, cameras: &Cameras) -> Vec<(PhotoId, &'a Photo)> {
    let all = photos.iter();
    all.filter(|(id, _)| cameras.views.get(*id).is_some())
        .collect()
}

/// The scene, and photos whose mask holds a patch that nothing vouches for.
fn found(
    p: &EmptySceneParams,
    photos: &Photos,
    aligned: &Aligned,
    cameras: &Cameras,
    (shots, still, people): (&[Shot], &[bool], Option<&People>),
    ctx: &Ctx<'_>,
) -> Result<(Scene, Vec<PhotoId>), Stop> {
    let known = seen(photos, cameras);
    let (wide, tall) = known
        .first()
        .map_or((0, 0), |(_, photo)| (photo.width, photo.height));
    let rectangle = Rectangle::read(&aligned.box_px, wide, tall).map_err(CutError::from)?;
    let factor = shots.first().map_or(1, |s| wide as usize / s.small.width);
    let within = rectangle.map(|r| (r, factor));
    let settings = Settings::of(&p.cut);
    let cuts = without_plate(
        shots,
        still,
        cameras,
        &settings,
        p.disk_side_mm,
        within,
        &people_on(shots, people, factor),
    );
    let radius = cameras.disk_radius_mm.unwrap_or(0.0);
    let shares = doubtful(shots, &cuts, radius);
    let doubted = shots
        .iter()
        .zip(shares)
        .filter(|(_, s)| *s > MAX_DOUBTFUL_PERCENT);
    let doubted = doubted.map(|(shot, _)| shot.id).collect();
    let cut = |(cut, (_, photo)): (Option<Image<bool>>, &(PhotoId, &Photo))| {
        cut.ok_or_else(|| CutError::Empty(photo.name.clone()))
    };
    let cuts: Vec<Image<bool>> = cuts
        .into_iter()
        .zip(&known)
        .map(cut)
        .collect::<Result<_, _>>()?;
    let views = Views {
        aligned,
        known: &known,
        cuts: &cuts,
        radius,
    };
    let (still, disk) = at_full_size(&views, || ctx.check().map_err(Stop::from))?;
    let ids = || known.iter().map(|(id, _)| *id);
    let scene = Scene {
        still,
        disk,
        views: ids().map(|id| (id, InPhoto::default())).collect(),
        bodies: ids().zip(cuts).collect(),
    };
    Ok((scene, doubted))
}

/// Log-odds of the body by a person's sense on each photo; nothing where the turn shows no person. \[nats\]
fn people_on(shots: &[Shot], people: Option<&People>, factor: usize) -> Vec<Vec<f32>> {
    let on = |s: &Shot| sense(people, s.id, [s.small.width, s.small.height], factor);
    let all: Vec<Vec<f32>> = shots.iter().map(on).collect();
    match all.iter().all(Vec::is_empty) {
        true => vec![],
        false => all,
    }
}

/// What to look at, photos by name.
fn warnings(doubted: &[PhotoId], photos: &Photos) -> Vec<Message> {
    let name = |id: &PhotoId| photos.get(*id).map(|p| p.name.as_str());
    let names: Vec<&str> = doubted.iter().filter_map(name).collect();
    let mut warnings = vec![message!(NO_PLATE)];
    if !names.is_empty() {
        warnings.push(message!(PATCH).of_what(names));
    }
    warnings
}
