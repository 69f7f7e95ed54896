//! The stage that makes the report: one self-contained page.

use crate::answer::Answer;
use crate::face::{self, HeadBox};
use crate::lengths::{Lengths, ShownIn};
use crate::overlay::{self, Shown};
use crate::page::{self, Content};
use crate::paint::Paint;
use rayon::prelude::*;
use shape::{
    Cameras, Document, Girths, Landmarks, MaskRuns, Masks, Mesh, Photo, PhotoId, Photos, Textured,
};
use stage::{Ctx, Stage, Stop, message};
use std::sync::Arc;

stage::messages! {
    HEAVY = "warn-page-weight": "the page has {size:.1 MB}, more than {most:.0 MB}: lower photo_px, most_faces or atlas_px";
    NO_FACE = "warn-no-face": "left out, for its face could not be placed";
}

/// Of a pixel: its colours as they are decoded, and as they are (structural: what the buffers hold). \[bytes\]
const PHOTO_PIXEL: u64 = 6;
/// What a page may weigh (structural: a bound of a file). \[MB\]
const MOST_MB: f64 = 15.0;
/// So many photos are shown at full height; more are shown smaller (structural: layout).
const PHOTOS_AT_FULL_HEIGHT: f64 = 40.0;

stage::params! {
    /// What the page shows.
    pub struct HtmlParams {
        /// Whether the photos are in it. Without them it shows no picture of the person but
        /// outlines and the uncoloured surface.
        photos: bool = true,
        /// Whether faces are made unrecognisable, on the photos and in the colours of surfaces.
        blur_face: bool = false,
        /// Greatest height of a photo on the page; less where there are more than forty.
        #[range(100..=2000)]
        #[source(structural)]
        photo_px: u32 = 900,
        /// Greatest number of faces of a surface without an atlas; finer ones are simplified.
        #[range(1000..=1000000)]
        #[source(structural)]
        most_faces: u32 = 100000,
        /// Whether a body without an atlas takes its colours from the photos.
        paint: bool = true,
        /// Longest side of the atlas on the page; longer ones are halved.
        #[range(256..=16384)]
        #[source(structural)]
        atlas_px: u32 = 4096,
        /// What lengths are shown in.
        unit: ShownIn = ShownIn::Cm,
        /// Which answer it shows: a first one has a heading for that.
        answer: Answer = Answer::Full,
    }
}

stage::inputs! {
    /// All that was found out.
    pub struct HtmlInput {
        /// The photos; with their masks and cameras, or none of the three: a scan has none.
        photos: Option<Arc<Photos>>,
        /// Their silhouettes.
        masks: Option<Arc<Masks>>,
        /// Their cameras.
        cameras: Option<Arc<Cameras>>,
        /// The surface that was measured.
        body: Arc<Mesh>,
        /// That surface with its colours.
        textured: Option<Arc<Textured>>,
        /// The visual hull, to switch to.
        hull: Option<Arc<Mesh>>,
        /// The surface of the rigid evolution, to switch to.
        rigid: Option<Arc<Mesh>>,
        /// The surface of the weighted-median evolution, to switch to.
        weighted_median: Option<Arc<Mesh>>,
        /// Any other surface, to switch to.
        other: Option<Arc<Mesh>>,
        /// Where the girths were taken.
        landmarks: Option<Arc<Landmarks>>,
        /// The girths.
        girths: Arc<Girths>,
    }
}

/// Photos without their masks or cameras, or the other way round.
#[derive(Debug, thiserror::Error)]
#[error("report.html takes photos, masks and cameras together, or none of them: give it all three")]
pub struct TurnError;

/// Photos, masks and cameras.
type Turn = (Arc<Photos>, Arc<Masks>, Arc<Cameras>);

fn turn(input: &HtmlInput) -> Result<Option<Turn>, TurnError> {
    match (&input.photos, &input.masks, &input.cameras) {
        (Some(p), Some(m), Some(c)) => Ok(Some((p.clone(), m.clone(), c.clone()))),
        (None, None, None) => Ok(None),
        _ => Err(TurnError),
    }
}

/// `report.html`: everything → document (HTML).
pub struct Html;

impl Stage for Html {
    const NAME: &'static str = "report.html";
    const VERSION: u32 = 20;
    const ABOUT: &'static str = "Makes one self-contained page: 3D view, girths, photos, cameras.";
    type Params = HtmlParams;
    type Input = HtmlInput;
    type Output = Document;
    const METRICS: &'static [&'static str] = &["size"];

    /// A photo a thread.
    fn memory(_: &HtmlParams, input: &HtmlInput) -> u64 {
        let most = input
            .photos
            .as_ref()
            .map_or(0, |photos| photos.most_pixels());
        most * PHOTO_PIXEL * rayon::current_num_threads() as u64
    }

    fn run(p: &HtmlParams, input: HtmlInput, ctx: &Ctx<'_>) -> Result<Document, Stop> {
        let turn = turn(&input)?;
        let head = face::head(&input.body, input.landmarks.as_deref());
        let small = shape::thinned(&input.body, p.most_faces as usize);
        let plain = input.textured.is_none() && small.colors.is_empty();
        let mut paint =
            (p.photos && p.paint && plain && turn.is_some()).then(|| Paint::new(&small));
        let figures = match &turn {
            Some(turn) => figures(p, turn, &input.girths, (&head, &mut paint), ctx)?,
            None => String::new(),
        };
        let hidden = p.blur_face.then(|| HeadBox::new(&head));
        let colors = paint.map(Paint::colors);
        let painted = colors.map(|colors| Mesh {
            colors,
            ..small.clone()
        });
        let surfaces = surfaces(p, &input, painted, hidden.as_ref());
        let page = page::page(&Content {
            turn: turn
                .as_ref()
                .map(|(photos, _, cameras)| (&**photos, &**cameras)),
            girths: &input.girths,
            landmarks: input.landmarks.as_deref(),
            body: &input.body,
            surfaces,
            figures,
            without_photos: !p.photos,
            answer: p.answer,
            lengths: Lengths::of(input.girths.unit, p.unit),
        });
        let size = page.len() as f64 / 1e6;
        ctx.metric("size", size, "MB");
        if size > MOST_MB {
            ctx.warn(message!(HEAVY, size = size, most = MOST_MB));
        }
        Ok(Document {
            media: "text/html".into(),
            bytes: page.into_bytes(),
        })
    }
}

/// The figures of all photos, as HTML; each photo paints the body on its way.
fn figures(
    p: &HtmlParams,
    (photos, masks, cameras): &Turn,
    girths: &Girths,
    (head, paint): (&[nalgebra::Point3<f64>], &mut Option<Paint<'_>>),
    ctx: &Ctx<'_>,
) -> Result<String, Stop> {
    let count = photos.photos.len();
    let crowd = (PHOTOS_AT_FULL_HEIGHT / count.max(1) as f64)
        .sqrt()
        .min(1.0);
    let most_px = (f64::from(p.photo_px) * crowd) as usize;
    let steps = ctx.steps("photos", count);
    let faced = |(id, photo): (PhotoId, &'_ Photo)| {
        let camera = cameras.views.get(id).map(|view| &view.camera);
        let face = camera.map(|c| face::on_photo(head, c)).unwrap_or_default();
        if p.photos && p.blur_face && face.is_empty() {
            ctx.warn(message!(NO_FACE).of_what(&photo.name));
        }
        face
    };
    let faces: Vec<_> = photos.iter().map(faced).collect();
    let one = |k: usize, paint: Option<&mut Paint<'_>>| -> Result<String, Stop> {
        let (id, photo) = (PhotoId(k as u32), &photos.photos[k]);
        let size = [photo.width as usize, photo.height as usize];
        let factor = overlay::factor(size[1], most_px);
        let mask = masks.views.get(id).map(MaskRuns::pixels);
        let mut shown = Shown {
            index: k,
            name: &photo.name,
            size,
            factor,
            photo: None,
            mask: mask.as_ref(),
            camera: cameras.views.get(id).map(|view| &view.camera),
        };
        if p.photos && !(p.blur_face && faces[k].is_empty()) {
            let mut pixels = photo.decode()?;
            if p.blur_face {
                face::blur(&mut pixels, &faces[k]);
            }
            if let (Some(paint), Some(mask), Some(camera)) = (paint, shown.mask, shown.camera) {
                paint.add(&pixels, mask, camera);
            }
            shown.photo = Some(overlay::reduced(&pixels, factor));
        }
        steps.tick()?;
        Ok(overlay::figure(&shown, girths))
    };
    match paint {
        // What is painted by one photo is painted on by the next.
        Some(paint) => (0..count).map(|k| one(k, Some(&mut *paint))).collect(),
        None => {
            let all = (0..count).into_par_iter().map(|k| one(k, None));
            Ok(all.collect::<Result<Vec<_>, Stop>>()?.concat())
        }
    }
}

/// The surfaces to switch between, the best first; equal ones once.
fn surfaces(
    p: &HtmlParams,
    input: &HtmlInput,
    painted: Option<Mesh>,
    hidden: Option<&HeadBox>,
) -> Vec<page::Surface> {
    let mut surfaces = Vec::new();
    if let Some(textured) = input.textured.as_ref().filter(|_| p.photos) {
        let shown = match hidden {
            Some(head) => head.without_atlas(textured),
            None => (**textured).clone(),
        };
        let atlas_px = p.atlas_px as usize;
        surfaces.push(page::Surface::Textured("body in colours", shown, atlas_px));
    }
    let gray = |mesh: Mesh| match hidden {
        Some(head) => head.without_colors(&mesh),
        None => mesh,
    };
    if let Some(painted) = painted {
        surfaces.push(page::Surface::Plain(
            "body in colours".into(),
            gray(painted),
        ));
    }
    let named = [
        ("body", Some(&input.body)),
        ("rigid", input.rigid.as_ref()),
        ("weighted median", input.weighted_median.as_ref()),
        ("other", input.other.as_ref()),
        ("visual hull", input.hull.as_ref()),
    ];
    let mut kept: Vec<(String, &Arc<Mesh>)> = Vec::new();
    for (label, mesh) in named {
        let Some(mesh) = mesh else { continue };
        match kept.iter_mut().find(|(_, other)| **other == *mesh) {
            Some((known, _)) => *known = format!("{known} = {label}"),
            None => kept.push((label.into(), mesh)),
        }
    }
    for (label, mesh) in kept {
        let mut small = shape::thinned(mesh, p.most_faces as usize);
        if !p.photos {
            small.colors.clear();
        }
        surfaces.push(page::Surface::Plain(label, gray(small)));
    }
    surfaces
}
