//! The stage that takes points that another program followed from photo to photo.

use crate::import::found::{At, FoundError, json};
use shape::{Observation, Photos, Tracks};
use stage::{Ctx, Files, Stage, Stop};
use std::sync::Arc;

stage::inputs! {
    /// Somebody's tracks.
    pub struct TracksFileInput {
        /// One `tracks.json`: a list of points, each a list of `{"photo": P, "at_px": [x, y], "scale_px": S}`
        /// on two photos or more; `P` is a photo's place in the turn, from 0, or its file's name.
        files: Arc<Files>,
        /// The photos they are on.
        photos: Arc<Photos>,
    }
}

/// `pose.import_tracks`: files, photos → tracks.
pub struct ImportTracks;

impl Stage for ImportTracks {
    const NAME: &'static str = "pose.import_tracks";
    const VERSION: u32 = 1;
    const ABOUT: &'static str =
        "Takes points that were followed from photo to photo from a tracks.json.";
    type Params = ();
    type Input = TracksFileInput;
    type Output = Tracks;
    const METRICS: &'static [&'static str] = &["points"];

    fn run(_: &(), input: TracksFileInput, ctx: &Ctx<'_>) -> Result<Tracks, Stop> {
        let (file, value) = json(&input.files, "tracks.json")?;
        let tracks = read(At::top(&file, &value), &input.photos)?;
        ctx.metric("points", tracks.points.len() as f64, "");
        Ok(tracks)
    }
}

/// Points with their observations by photo.
fn read(top: At<'_>, photos: &Photos) -> Result<Tracks, FoundError> {
    let points = top.each("a list of points", |point| {
        let mut seen = point.each("a list of observations", |seen| {
            let (id, photo) = seen.key("photo", |at| at.photo(photos))?;
            let [x, y] = seen.key("at_px", |at| at.place(photo))?;
            let scale = seen.key("scale_px", |at| match at.number()? {
                scale if scale > 0.0 && scale <= f64::from(photo.width) => Ok(scale),
                _ => Err(at.wrong("a size in pixels")),
            })?;
            Ok(Observation {
                photo: id,
                at_px: [x as f32, y as f32],
                scale_px: scale as f32,
            })
        })?;
        seen.sort_by_key(|s| s.photo);
        let twice = seen.windows(2).any(|w| w[0].photo == w[1].photo);
        match seen.len() >= 2 && !twice {
            true => Ok(seen),
            false => Err(point.wrong("observations on two photos or more, one on each")),
        }
    })?;
    Ok(Tracks { points })
}
