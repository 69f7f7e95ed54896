//! Frames of a video: all at a glance, and some at full size as photos.

use crate::heic::QUALITY;
use crate::netpbm::Netpbm;
use crate::video::error::VideoError;
use crate::video::ffmpeg::Source;
use crate::video::filters::Wanted;
use crate::video::probe::Clip;
use crate::video::seen::{Seen, seen};
use shape::{Photo, Rgb, rgb_to_jpeg};
use stage::{Message, message};

stage::messages! {
    CUT_SHORT = "warn-video-cut": "{name}: {read} of {promised} frames can be read: was it copied whole?";
    CUT_SHORT_FOR = "warn-video-cut-for": "{name}: {read} of {promised} frames can be read ({why}): was it copied whole?";
    DAMAGED = "warn-video-damaged": "{name} is damaged somewhere: {why}";
}

/// Frames are looked at on so many pixels on the longer side (structural: samples). \[px\]
const LOOKED_AT: u32 = 960;
/// More frames than these are no turn (structural: a limit of time, ten minutes of 60 frames a second).
const MOST: usize = 40_000;
/// A file is cut short that has less than this share of the frames that its head names. By hand: not on record.
const WHOLE_SHARE: f64 = 0.98;

/// Who follows the work, and may end it.
pub(crate) struct Watch<'a, E> {
    /// Whether to go on; asked many times.
    pub(crate) go_on: &'a dyn Fn() -> Result<(), E>,
    /// One more frame is done.
    pub(crate) tick: &'a dyn Fn() -> Result<(), E>,
}

/// All frames of a video.
pub(crate) struct Looked {
    /// At a glance.
    pub(crate) all: Vec<Seen>,
    /// When they were taken; none before the one in front of it. \[s\]
    pub(crate) times: Vec<f64>,
    /// What is wrong with the file, if anything.
    pub(crate) wrong: Option<Message>,
}

/// What the file's head names, if it is not too long.
pub(crate) fn probed<E: From<VideoError>>(
    most_minutes: f64,
    source: &Source<'_>,
    watch: &Watch<'_, E>,
) -> Result<Clip, E> {
    let clip = source.probe(watch.go_on)?;
    match clip.seconds.filter(|s| *s > 60.0 * most_minutes) {
        Some(seconds) => Err(VideoError::Long {
            name: source.name.to_owned(),
            minutes: (seconds / 60.0).ceil(),
            most: most_minutes,
        }
        .into()),
        None => Ok(clip),
    }
}

/// Looks at all frames.
pub(crate) fn looked_at<E: From<VideoError>>(
    most_minutes: f64,
    source: &Source<'_>,
    clip: &Clip,
    watch: &Watch<'_, E>,
) -> Result<Looked, E> {
    let wanted = Wanted {
        which: None,
        longest: LOOKED_AT,
        grey: true,
    };
    let mut all: Vec<Seen> = Vec::new();
    let name = || source.name.to_owned();
    let take = |picture: Netpbm| -> Result<(), E> {
        let now = seen(&picture);
        if all
            .first()
            .is_some_and(|f| (f.width, f.small.len()) != (now.width, now.small.len()))
        {
            let frame = all.len();
            return Err(VideoError::Changes {
                name: name(),
                frame,
            }
            .into());
        }
        all.push(now);
        if all.len() > MOST {
            let seconds = clip.seconds.unwrap_or(all.len() as f64 / 30.0);
            let most = most_minutes;
            return Err(VideoError::Long {
                name: name(),
                minutes: (seconds / 60.0).ceil(),
                most,
            }
            .into());
        }
        (watch.tick)()
    };
    let (mut times, wrong) = source.frames(clip, &wanted, take, watch.go_on)?;
    let frames = all.len();
    if frames < 3 {
        return Err(VideoError::Short {
            name: name(),
            frames,
        }
        .into());
    }
    let missing = clip
        .frames
        .filter(|f| (frames as f64) < WHOLE_SHARE * *f as f64);
    let name = source.name;
    let wrong = match (missing, wrong) {
        (Some(promised), None) => Some(message!(
            CUT_SHORT,
            name = name,
            read = frames,
            promised = promised
        )),
        (Some(promised), Some(why)) => Some(message!(
            CUT_SHORT_FOR,
            name = name,
            read = frames,
            promised = promised,
            why = why
        )),
        (None, why) => why.map(|why| message!(DAMAGED, name = name, why = why)),
    };
    // Frames without a time, or with the one before, follow each other evenly.
    times.truncate(frames);
    let rate = frames as f64 / clip.seconds.unwrap_or(frames as f64 / 30.0);
    while times.len() < frames {
        times.push(times.last().map_or(0.0, |t| t + 1.0 / rate));
    }
    for i in 1..frames {
        times[i] = times[i].max(times[i - 1]);
    }
    Ok(Looked { all, times, wrong })
}

/// Frames at full size, as photos called after the video and their number.
pub(crate) fn taken<E: From<VideoError>>(
    longest: u32,
    source: &Source<'_>,
    clip: &Clip,
    which: &[usize],
    times: &[f64],
    watch: &Watch<'_, E>,
) -> Result<Vec<Photo>, E> {
    let wanted = Wanted {
        which: Some(which),
        longest,
        grey: false,
    };
    let mut photos: Vec<Photo> = Vec::new();
    let take = |picture: Netpbm| -> Result<(), E> {
        if let Some(frame) = which.get(photos.len()) {
            let name = format!("{}#{frame:06}.jpg", source.name);
            photos.push(photo(name, picture, times[*frame]));
        }
        (watch.tick)()
    };
    source.frames(clip, &wanted, take, watch.go_on)?;
    match photos.len() == which.len() {
        true => Ok(photos),
        false => Err(VideoError::Unreadable {
            name: source.name.to_owned(),
            why: format!("of {} frames {} came back", which.len(), photos.len()),
        }
        .into()),
    }
}

fn photo(name: String, picture: Netpbm, time_s: f64) -> Photo {
    let pixels = picture.data.chunks_exact(3).map(|p| [p[0], p[1], p[2]]);
    let rgb = Rgb {
        width: picture.width,
        height: picture.height,
        data: pixels.collect(),
    };
    Photo {
        time_s: Some(time_s),
        ..Photo::of(
            name,
            [picture.width as u32, picture.height as u32],
            rgb_to_jpeg(&rgb, QUALITY),
        )
    }
}
