//! A turn about an upright post, and its cameras brought to millimetres by what is known.

use nalgebra::{Point3, Rotation3, Vector3};
use pose::{Frame, FrameInput, FrameParams, Ring};
use shape::{Camera, Cameras, Intrinsics, Mask, Photo, PhotoId, Photos, Rig, Scale, Tags, View};
use stage::{Ctx, Host, Stage, Stop};
use std::sync::{Arc, Mutex};

/// A turn in units of 2 mm, about an upright post 800 units tall.
pub(crate) fn turn() -> Vec<Camera> {
    let ring = Ring {
        turn: Rotation3::from_euler_angles(1.72, 0.0, 0.0),
        offset: Vector3::new(0.0, 0.0, 1400.0),
        angles: (0..12).map(|i| f64::from(i) * 30f64.to_radians()).collect(),
    };
    let lens = Intrinsics::simple(320, 480, 420.0);
    let pose = |pose| Camera { lens, pose };
    ring.poses().into_iter().map(pose).collect()
}

/// What of the post a camera sees: filled row by row between its outermost points.
pub(crate) fn seen(camera: &Camera) -> Mask {
    let (width, height) = (320, 480);
    let mut rows = vec![(f64::MAX, f64::MIN); height];
    for step in 0..=1600 {
        for side in 0..72 {
            let angle = f64::from(side) * 5f64.to_radians();
            let at = Point3::new(
                90.0 * libm::cos(angle),
                90.0 * libm::sin(angle),
                -400.0 + f64::from(step) / 2.0,
            );
            let Some(px) = camera.project(&at) else {
                continue;
            };
            if let Some(row) = rows.get_mut(px.y.round().max(0.0) as usize) {
                *row = (row.0.min(px.x), row.1.max(px.x));
            }
        }
    }
    let mut mask = Mask::filled(width, height, 0);
    for (y, (low, high)) in rows.into_iter().enumerate() {
        for x in 0..width {
            if (low..=high).contains(&(x as f64)) {
                mask.data[y * width + x] = 255;
            }
        }
    }
    mask
}

/// A photo of these levels.
pub(crate) fn photo(name: &str, gray: &shape::Image<u8>) -> Photo {
    Photo::of(name, [320, 480], shape::gray_to_png(gray))
}

/// Cameras of the turn in millimetres by what is known and what is still.
pub(crate) fn framed_with(
    rig: Rig,
    tags: Option<Tags>,
    plate: Option<Photo>,
) -> Result<Cameras, String> {
    framed_from(Scale::Nothing, rig, tags, plate)
}

/// As [`framed_with`], of cameras whose unit comes from elsewhere already.
pub(crate) fn framed_from(
    scale: Scale,
    rig: Rig,
    tags: Option<Tags>,
    plate: Option<Photo>,
) -> Result<Cameras, String> {
    framed_and_warned(scale, rig, tags, plate).0
}

/// What is warned of.
#[derive(Default)]
struct Heard(Mutex<Vec<String>>);

impl Host for Heard {
    fn warn(&self, text: &stage::Message) {
        self.0.lock().unwrap().push(text.to_string());
    }
}

/// The same, and what is warned of.
pub(crate) fn framed_and_warned(
    scale: Scale,
    rig: Rig,
    tags: Option<Tags>,
    plate: Option<Photo>,
) -> (Result<Cameras, String>, Vec<String>) {
    // On black photos is no disk: without a plate and tags nothing is lost where none is searched.
    let disk = plate.is_some() || tags.is_some();
    let cameras = turn();
    let black = shape::Image::filled(320, 480, 0);
    let photo = |i: usize| photo(&format!("{i:04}.png"), &black);
    let id = |i: usize| PhotoId(i as u32);
    let view = |(i, camera): (usize, &Camera)| {
        let view = View::of(format!("{i:04}.png"), *camera);
        (id(i), view)
    };
    let masks = cameras.iter().enumerate().map(|(i, c)| (id(i), seen(c)));
    let input = FrameInput {
        masks: Some(Arc::new(masks.collect())),
        photos: Arc::new(Photos {
            photos: (0..cameras.len()).map(photo).collect(),
            plate,
            rig,
        }),
        tags: tags.map(Arc::new),
        cameras: Arc::new(Cameras {
            views: cameras.iter().enumerate().map(view).collect(),
            scale,
            scale_sigma: None,
            disk_radius_mm: None,
            // The post's foot, where a mat gives it.
            ground_mm: if scale == Scale::Nothing { 0.0 } else { -400.0 },
            points: Vec::new(),
        }),
    };
    let params = FrameParams {
        search_px: 200,
        disk,
        ..FrameParams::default()
    };
    let (heard, nothing) = (Heard::default(), stage::hash(b""));
    let framed = Frame::run(&params, input, &Ctx::new(&heard, nothing, nothing));
    let framed = framed.map_err(|e| match e {
        Stop::Failed(why) => why.to_string(),
        Stop::Cancelled => "cancelled".into(),
    });
    (framed, heard.0.into_inner().unwrap())
}
