//! The stage that takes cameras that somebody else calibrated.

use crate::frame::circle::{camera_circle, in_ring_frame, moved};
use crate::import::colmap::{from_colmap_binary, from_colmap_text};
use crate::import::foreign::{Foreign, ForeignError, Model};
use crate::import::text::{from_json, from_middlebury};
use nalgebra::{Point2, Point3, Rotation3, Vector3};
use shape::{Camera, Cameras, Intrinsics, Photos, Scale, View};
use stage::{Ctx, Files, FilesError, Stage, Stop, message};
use std::sync::Arc;

stage::messages! {
    NO_CAMERA = "warn-no-camera": "{count} {count|photo has|photos have} no camera in the file and {count|is|are} left out";
    NO_CIRCLE = "warn-no-circle": "the cameras are on no circle: the file's world was kept; if they are of one turn, check the file";
    NO_UNIT = "warn-no-unit": "the file names no unit and `unit_mm` is 0: lengths are relative";
}

stage::choice! {
    /// Which world the cameras come out in.
    pub enum World {
        /// The file's, where it is marked as the turntable frame; else the ring's.
        Auto = "auto",
        /// The file's.
        File = "file",
        /// The ring's: z along the axis of the circle through the cameras.
        Ring = "ring",
    }
}

stage::params! {
    /// How to read the file.
    pub struct ImportParams {
        /// Millimetres of the file's unit; 0 for the file's own, if it has one.
        #[range(0.0..=1e9)]
        #[source(structural)]
        unit_mm: f64 = 0.0,
        /// Which world the cameras come out in.
        world: World = World::Auto,
    }
}

stage::inputs! {
    /// Somebody's cameras.
    pub struct ImportInput {
        /// A COLMAP model (text or binary), a Middlebury `_par.txt`, or a `cameras.json`.
        files: Arc<Files>,
        /// The photos they belong to.
        photos: Arc<Photos>,
    }
}

/// Why there are no cameras.
#[derive(Debug, thiserror::Error)]
pub enum ImportError {
    /// No file is known.
    #[error(
        "no cameras among the files: give `cameras.json`, a `*_par.txt`, or COLMAP's `cameras`, `images` and `points3D` (.txt or .bin)"
    )]
    Nothing,
    /// No photo is named.
    #[error(
        "none of the {0} cameras in the file belongs to a photo: their names are those of other files, such as {1}"
    )]
    Strangers(usize, String),
    /// A camera of another shape than its photo.
    #[error(
        "{0}: its camera is for {1}×{2} pixels, which is not the photo's shape: give the photos that were calibrated"
    )]
    Shape(String, u32, u32),
    /// A file that is not what it should be.
    #[error(transparent)]
    Foreign(#[from] ForeignError),
    /// A file that cannot be read.
    #[error(transparent)]
    Files(#[from] FilesError),
}

/// `pose.import`: files, photos → cameras.
pub struct Import;

impl Stage for Import {
    const NAME: &'static str = "pose.import";
    const VERSION: u32 = 2;
    const ABOUT: &'static str =
        "Takes cameras from a COLMAP model, a Middlebury _par.txt or a cameras.json.";
    type Params = ImportParams;
    type Input = ImportInput;
    type Output = Cameras;
    const METRICS: &'static [&'static str] = &["off the circle", "cameras"];

    fn run(p: &ImportParams, input: ImportInput, ctx: &Ctx<'_>) -> Result<Cameras, Stop> {
        let model = read(&input.files)?;
        let unit = if p.unit_mm > 0.0 {
            Some(p.unit_mm)
        } else {
            model.unit_mm
        };
        let cameras = placed(&model, &input.photos, unit)?;
        let missing = input.photos.photos.len() - cameras.views.len();
        if missing > 0 {
            ctx.warn(message!(NO_CAMERA, count = missing));
        }
        let keep = match p.world {
            World::Auto => model.ground.is_some(),
            World::File => true,
            World::Ring => false,
        };
        let cameras = if keep {
            cameras
        } else {
            match camera_circle(&cameras) {
                None => {
                    ctx.warn(message!(NO_CIRCLE));
                    cameras
                }
                Some(circle) => {
                    let size = if unit.is_some() {
                        circle.radius
                    } else {
                        1000.0
                    };
                    ctx.metric("off the circle", circle.rms / circle.radius * 100.0, "%");
                    on_the_subject(&in_ring_frame(&cameras, size))
                }
            }
        };
        if unit.is_none() {
            ctx.warn(message!(NO_UNIT));
        }
        ctx.metric("cameras", cameras.views.len() as f64, "");
        Ok(cameras)
    }
}

/// The model among the files.
fn read(files: &Files) -> Result<Model, ImportError> {
    let base = |name: &str| name.rsplit('/').next().unwrap_or(name).to_owned();
    let bytes = |wanted: &str| -> Result<Option<Vec<u8>>, FilesError> {
        let entry = files.entries.iter().find(|e| base(&e.name) == wanted);
        entry.map(|e| files.read(e)).transpose()
    };
    let text = |b: Vec<u8>| String::from_utf8_lossy(&b).into_owned();
    if let (Some(cameras), Some(images)) = (bytes("cameras.bin")?, bytes("images.bin")?) {
        let points = bytes("points3D.bin")?.unwrap_or_default();
        return Ok(from_colmap_binary(&cameras, &images, &points)?);
    }
    if let (Some(cameras), Some(images)) = (bytes("cameras.txt")?, bytes("images.txt")?) {
        let points = bytes("points3D.txt")?.unwrap_or_default();
        return Ok(from_colmap_text(
            &text(cameras),
            &text(images),
            &text(points),
        )?);
    }
    if let Some(json) = bytes("cameras.json")? {
        return Ok(from_json("cameras.json", &text(json))?);
    }
    let par = files.entries.iter().find(|e| e.name.ends_with("_par.txt"));
    let par = par.ok_or(ImportError::Nothing)?;
    Ok(from_middlebury(&par.name, &text(files.read(par)?))?)
}

/// The cameras of the photos that are there, by file name, else by name without its ending.
fn placed(model: &Model, photos: &Photos, unit: Option<f64>) -> Result<Cameras, ImportError> {
    let base = |name: &str| name.rsplit(['/', '\\']).next().unwrap_or(name).to_owned();
    let stem = |name: &str| {
        base(name)
            .rsplit_once('.')
            .map_or(base(name), |s| s.0.to_owned())
    };
    let size = unit.unwrap_or(1.0);
    let mut views = Vec::new();
    for (id, photo) in photos.iter() {
        let exact = model.cameras.iter().find(|c| base(&c.name) == photo.name);
        let near = || {
            model
                .cameras
                .iter()
                .find(|c| stem(&c.name) == stem(&photo.name))
        };
        let Some(found) = exact.or_else(near) else {
            continue;
        };
        let mut pose = found.pose;
        pose.translation *= size;
        let camera = Camera {
            lens: lens(found, photo.width, photo.height)?,
            pose,
        };
        let view = View::of(photo.name.clone(), camera);
        views.push((id, view));
    }
    if views.is_empty() {
        let first = model
            .cameras
            .first()
            .map_or(String::new(), |c| c.name.clone());
        return Err(ImportError::Strangers(model.cameras.len(), first));
    }
    Ok(Cameras {
        views: views.into_iter().collect(),
        scale: if unit.is_some() {
            Scale::Given
        } else {
            Scale::Nothing
        },
        scale_sigma: None,
        disk_radius_mm: None,
        ground_mm: model.ground.unwrap_or(0.0) * size,
        points: model
            .points
            .iter()
            .map(|p| p.map(|x| (x * size) as f32))
            .collect(),
    })
}

/// The lens for a photo of its size.
fn lens(found: &Foreign, width: u32, height: u32) -> Result<Intrinsics, ImportError> {
    let [w, h] = found.size.unwrap_or([width, height]);
    let lens = Intrinsics {
        width: w,
        height: h,
        focal: found.focal,
        centre: found.centre,
        radial: found.radial,
    };
    let ratio = (f64::from(w) * f64::from(height)) / (f64::from(h) * f64::from(width)).max(1.0);
    if w == 0 || h == 0 || (ratio - 1.0).abs() > 0.01 {
        return Err(ImportError::Shape(found.name.clone(), w, h));
    }
    Ok(lens.resized(width, height))
}

/// The origin where the cameras look at the axis, and the ground where the lowest of them stops to see it.
fn on_the_subject(cameras: &Cameras) -> Cameras {
    let at_axis = |view: &View, y: f64| {
        let centre = view.camera.centre();
        let out = Vector3::new(centre.x, centre.y, 0.0).normalize();
        let ray = view.camera.ray(Point2::new(view.camera.lens.centre[0], y));
        centre.z - ray.z * centre.coords.dot(&out) / ray.dot(&out)
    };
    let middles = cameras
        .views
        .values()
        .map(|v| at_axis(v, v.camera.lens.centre[1]));
    let middle = middles.sum::<f64>() / cameras.views.len().max(1) as f64;
    let origin = Point3::new(0.0, 0.0, middle);
    let mut there = moved(cameras, &Rotation3::identity(), &origin, 1.0);
    let corner = |v: &View| {
        let (w, h) = (
            f64::from(v.camera.lens.width),
            f64::from(v.camera.lens.height),
        );
        let reach = w.max(h) / 2.0 / v.camera.lens.focal[0].min(v.camera.lens.focal[1]);
        -v.camera.centre().coords.norm() * reach
    };
    let lowest = there.views.values().map(corner).fold(f64::MAX, f64::min);
    there.ground_mm = lowest;
    there
}
