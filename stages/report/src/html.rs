//! The stage that makes the report: one self-contained page.

use crate::cluster::simplified;
use crate::{overlay, profile, ring, scene, tables};
use nalgebra::Point2;
use shape::{
    Camera, Cameras, Document, Girths, Landmarks, Masks, Mesh, Part, PhotoId, Photos, Textured,
};
use stage::{Ctx, Stage, Stop};
use std::sync::Arc;

stage::params! {
    /// What the page shows.
    pub struct HtmlParams {
        /// Whether the photos are in it. Without them it shows no picture of the person but the
        /// surface, uncoloured.
        photos: bool = true,
        /// Whether faces on the photos are made unrecognisable.
        blur_face: bool = false,
        /// Greatest height of a photo on the page.
        #[range(100..=2000)]
        photo_px: u32 = 600,
        /// Greatest number of faces of a mesh without colours; finer ones are simplified.
        #[range(1000..=1000000)]
        most_faces: u32 = 100000,
    }
}

stage::inputs! {
    /// All that was found out.
    pub struct HtmlInput {
        /// The photos.
        photos: Arc<Photos>,
        /// Their silhouettes.
        masks: Arc<Masks>,
        /// Their cameras.
        cameras: Arc<Cameras>,
        /// The visual hull.
        hull: Arc<Mesh>,
        /// The refined surface.
        body: Arc<Mesh>,
        /// The refined surface with its colours.
        textured: Option<Arc<Textured>>,
        /// Another surface to switch to, such as that of the other evolution.
        other: Option<Arc<Mesh>>,
        /// Where the girths were taken.
        landmarks: Option<Arc<Landmarks>>,
        /// The girths.
        girths: Arc<Girths>,
    }
}

/// `report.html`: everything → document (HTML).
pub struct Html;

impl Stage for Html {
    const NAME: &'static str = "report.html";
    const VERSION: u32 = 2;
    const ABOUT: &'static str = "Makes one self-contained page: 3D view, girths, photos, cameras.";
    type Params = HtmlParams;
    type Input = HtmlInput;
    type Output = Document;

    fn run(p: &HtmlParams, input: HtmlInput, ctx: &Ctx<'_>) -> Result<Document, Stop> {
        let mut photos = String::new();
        if p.photos {
            let steps = ctx.steps("photos", input.photos.photos.len());
            for (id, photo) in input.photos.iter() {
                let mut pixels = photo.decode()?;
                let camera = input.cameras.views.get(id).map(|view| &view.camera);
                if p.blur_face {
                    match head(camera, &input) {
                        Some(at_px) => overlay::blur(&mut pixels, &at_px),
                        None => {
                            ctx.warn(format!("{}: left out, no head found to blur", photo.name));
                            continue;
                        }
                    }
                }
                let small = overlay::reduced(&pixels, p.photo_px as usize);
                let mask = input.masks.views.get(id);
                photos += &overlay::figure(&photo.name, &small, mask, camera, &input.girths);
                steps.tick()?;
            }
        }
        let page = page(p, &input, &photos);
        ctx.metric("size", page.len() as f64 / 1e6, "MB");
        Ok(Document {
            media: "text/html".into(),
            bytes: page.into_bytes(),
        })
    }
}

/// Where the head is on a photo: the projections of its vertices.
fn head(camera: Option<&Camera>, input: &HtmlInput) -> Option<Vec<Point2<f64>>> {
    let (camera, landmarks) = (camera?, input.landmarks.as_ref()?);
    let vertices = (0u32..)
        .zip(&landmarks.parts)
        .filter(|(_, part)| **part == Part::Head as u8);
    let known = |v: &u32| (*v as usize) < input.body.positions.len();
    let at_px: Vec<_> = vertices
        .map(|(v, _)| v)
        .filter(known)
        .filter_map(|v| camera.project(&input.body.point(v)))
        .collect();
    (!at_px.is_empty()).then_some(at_px)
}

/// The page itself.
fn page(p: &HtmlParams, input: &HtmlInput, photos: &str) -> String {
    let most = p.most_faces as usize;
    let mut meshes = Vec::new();
    if let Some(textured) = input.textured.as_ref().filter(|_| p.photos && !p.blur_face) {
        meshes.push(scene::textured("body in colours", textured));
    }
    meshes.push(scene::mesh("body", &simplified(&input.body, most)));
    if let Some(other) = &input.other {
        meshes.push(scene::mesh("other evolution", &simplified(other, most)));
    }
    meshes.push(scene::mesh("visual hull", &simplified(&input.hull, most)));
    let scene = serde_json::json!({ "meshes": meshes, "tapes": scene::tapes(&input.girths) });
    let name = input.photos.rig.name.as_deref().unwrap_or("one turn");
    let missing: Vec<_> = (0..input.photos.photos.len() as u32)
        .filter(|i| input.cameras.views.get(PhotoId(*i)).is_none())
        .map(|i| input.photos.photos[i as usize].name.clone())
        .collect();
    let unplaced = match missing.is_empty() {
        true => String::new(),
        false => format!(
            "<p class=\"warn\">Photos without a camera: {}</p>",
            missing.join(", ")
        ),
    };
    let gallery = match photos.is_empty() {
        true => "<p class=\"note\">The photos were left out.</p>".into(),
        false => format!("<div class=\"photos\">{photos}</div>"),
    };
    let parts = [
        ("{{title}}", tables::escaped(name)),
        ("{{style}}", include_str!("page.css").into()),
        ("{{girths}}", tables::girths(&input.girths)),
        ("{{derived}}", tables::derived(&input.girths)),
        ("{{scale}}", tables::scale(&input.cameras) + &unplaced),
        ("{{profile}}", profile::svg(&input.girths)),
        ("{{ring}}", ring::svg(&input.cameras)),
        ("{{photos}}", gallery),
        ("{{scene}}", scene.to_string().replace('<', "\\u003c")),
        ("{{viewer}}", include_str!("viewer.js").into()),
    ];
    let mut page = String::from(include_str!("page.html"));
    for (slot, text) in parts {
        page = page.replace(slot, &text);
    }
    page
}
