//! The stage that takes the photos of a turn out of a video.

use crate::folder::is_video;
use crate::names::is_plate;
use crate::video::error::VideoError;
use crate::video::ffmpeg::{Source, versions};
use crate::video::frames::{Looked, Watch, looked_at, probed, taken};
use crate::video::pick::{Picked, pick};
use crate::video::probe::Clip;
use crate::video::seen::{Seen, sharp};
use crate::video::speed::motion;
use crate::video::turn::{Turn, turn};
use shape::{Photo, Photos, Rig};
use stage::{Ctx, FileEntry, Files, Stage, Stop, message};
use std::sync::Arc;

stage::messages! {
    OPEN = "warn-video-open": "from {from:.1 s} to {to:.1 s} something turns, but at its end it does not look as at its beginning: is this a whole turn? All of it was taken; film from before the turn until after it";
    FAST = "warn-video-fast": "{empty} of {steps} steps of the turn have no frame of their own: turn more slowly";
    BLURRED = "warn-video-blurred": "no sharp frame at {times} s: turn evenly, in more light";
    STILL = "warn-video-still": "hardly anything moves: is the subject on a disk that turns, and in view?";
}

stage::params! {
    /// Which frames are taken.
    pub struct VideoParams {
        /// How far the subject turns from one photo to the next.
        #[range(1.0..=45.0)]
        #[source(structural)]
        step_deg: f64 = 10.0,
        /// From which share of each step, about its middle, the sharpest frame is taken.
        #[range(0.05..=1.0)]
        window: f64 = 0.6,
        /// Photos are no longer than this on their longer side, in pixels.
        #[range(320..=8192)]
        #[source(structural)]
        longest: u32 = 4096,
        /// Videos that are longer than so many minutes are refused.
        #[range(0.1..=120.0)]
        #[source(structural)]
        minutes: f64 = 10.0,
    }
}

stage::inputs! {
    /// The user's folder.
    pub struct VideoInput {
        /// The video, and one of the empty scene that is called `plate`.
        files: Arc<Files>,
    }
}

/// `capture.video`: files → photos.
pub struct Video;

impl Stage for Video {
    const NAME: &'static str = "capture.video";
    const VERSION: u32 = 1;
    const ABOUT: &'static str = "Takes one sharp frame a step out of the video of a turn, by ffmpeg: the turn is found by what moves.";
    type Params = VideoParams;
    type Input = VideoInput;
    type Output = Photos;
    const METRICS: &'static [&'static str] = &[
        "frames",
        "taken",
        "steps without a frame",
        "blurred",
        "turn from",
        "turn to",
    ];

    fn programs() -> Vec<(&'static str, String)> {
        versions()
    }

    /// What is seen of each frame, and one frame at full size in the program and here. \[bytes\]
    fn memory(_: &VideoParams, _: &VideoInput) -> u64 {
        800 << 20
    }

    fn run(p: &VideoParams, input: VideoInput, ctx: &Ctx<'_>) -> Result<Photos, Stop> {
        let files = &input.files;
        let videos: Vec<&FileEntry> = files.entries.iter().filter(|e| is_video(&e.name)).collect();
        let (empty, turns): (Vec<&FileEntry>, Vec<_>) =
            videos.into_iter().partition(|e| is_plate(&e.name));
        let [entry] = turns.as_slice() else {
            let found = turns.iter().map(|e| e.name.clone()).collect();
            return Err(VideoError::count(found).into());
        };
        let path = files.path(entry)?;
        let source = Source {
            path: &path,
            name: base(&entry.name),
        };
        let (clip, Looked { all, times, .. }) = looked(p, &source, ctx)?;
        let (turn, picked, moves) = chosen(p, &source, &all, &times)?;
        let found = reported(&source, &all, &times, &turn, &picked, &moves, ctx);
        let photos = full(p, &source, &clip, &found, &times, ctx)?;
        // It was not another one meanwhile.
        files.path(entry)?;
        let plate = empty.first().map(|e| plate(p, files, e, ctx)).transpose()?;
        Ok(Photos {
            photos,
            plate,
            rig: Rig::default(),
        })
    }
}

fn base(name: &str) -> &str {
    name.rsplit('/').next().unwrap_or(name)
}

/// All frames at a glance.
fn looked(p: &VideoParams, source: &Source<'_>, ctx: &Ctx<'_>) -> Result<(Clip, Looked), Stop> {
    let go_on = || Ok::<_, Stop>(ctx.check()?);
    let clip = probed(
        p.minutes,
        source,
        &Watch {
            go_on: &go_on,
            tick: &go_on,
        },
    )?;
    let steps = ctx.steps("frames", clip.frames.unwrap_or(0) as usize);
    let tick = || Ok::<_, Stop>(steps.tick()?);
    let watch = Watch {
        go_on: &go_on,
        tick: &tick,
    };
    let looked = looked_at(p.minutes, source, &clip, &watch)?;
    looked.wrong.iter().for_each(|wrong| ctx.warn(wrong));
    Ok((clip, looked))
}

/// Some frames at full size.
fn full(
    p: &VideoParams,
    source: &Source<'_>,
    clip: &Clip,
    which: &[usize],
    times: &[f64],
    ctx: &Ctx<'_>,
) -> Result<Vec<Photo>, Stop> {
    let steps = ctx.steps("photos", which.len());
    let (go_on, tick) = (
        || Ok::<_, Stop>(ctx.check()?),
        || Ok::<_, Stop>(steps.tick()?),
    );
    let watch = Watch {
        go_on: &go_on,
        tick: &tick,
    };
    taken(p.longest, source, clip, which, times, &watch)
}

/// The turn, the frames that are picked from it, and what moves.
fn chosen(
    p: &VideoParams,
    source: &Source<'_>,
    all: &[Seen],
    times: &[f64],
) -> Result<(Turn, Picked, Vec<bool>), VideoError> {
    let small: Vec<&[u8]> = all.iter().map(|s| s.small.as_slice()).collect();
    let motion = motion(&small);
    let still = || VideoError::Still {
        name: source.name.to_owned(),
        frames: all.len(),
    };
    let turn = turn(&motion, times).ok_or_else(still)?;
    let sharp: Vec<f64> = all.iter().map(|s| sharp(s, &motion.moves)).collect();
    let steps = (360.0 / p.step_deg).round().max(3.0) as usize;
    let picked = pick(&turn.come, &sharp, steps, p.window);
    match picked.frames.len() {
        0..3 => Err(still()),
        _ => Ok((turn, picked, motion.moves)),
    }
}

/// Reports what was found; the frames' numbers.
fn reported(
    source: &Source<'_>,
    all: &[Seen],
    times: &[f64],
    turn: &Turn,
    picked: &Picked,
    moves: &[bool],
    ctx: &Ctx<'_>,
) -> Vec<usize> {
    let within = |i: &usize| turn.come[*i].is_some_and(|c| (0.0..1.0).contains(&c));
    let turning: Vec<usize> = (0..all.len()).filter(within).collect();
    let (from, to) = (turning.first(), turning.last());
    let at = |i: Option<&usize>| i.map_or(0.0, |i| times[*i]);
    let name = source.name;
    ctx.metric("frames", all.len() as f64, "");
    ctx.metric("taken", picked.frames.len() as f64, "");
    ctx.metric("steps without a frame", picked.empty.len() as f64, "");
    ctx.metric("blurred", picked.blurred.len() as f64, "");
    ctx.metric("turn from", at(from), "s");
    ctx.metric("turn to", at(to), "s");
    if !turn.closed {
        let (from, to) = (at(from), at(to));
        ctx.warn(message!(OPEN, from = from, to = to).of_what(name));
    }
    if !picked.empty.is_empty() {
        let steps = picked.empty.len() + picked.frames.len();
        ctx.warn(message!(FAST, empty = picked.empty.len(), steps = steps).of_what(name));
    }
    if !picked.blurred.is_empty() {
        let times: Vec<f64> = picked
            .blurred
            .iter()
            .map(|i| (10.0 * times[*i]).round() / 10.0)
            .collect();
        ctx.warn(message!(BLURRED, times = times).of_what(name));
    }
    if !moves.iter().any(|m| *m) {
        ctx.warn(message!(STILL).of_what(name));
    }
    picked.frames.clone()
}

/// The sharpest frame of a video of the empty scene.
fn plate(p: &VideoParams, files: &Files, entry: &FileEntry, ctx: &Ctx<'_>) -> Result<Photo, Stop> {
    let path = files.path(entry)?;
    let source = Source {
        path: &path,
        name: base(&entry.name),
    };
    let (clip, Looked { all, times, .. }) = looked(p, &source, ctx)?;
    let of = |i: &usize| sharp(&all[*i], &[]);
    // The first of equals.
    let best = (0..all.len()).rev().max_by(|a, b| of(a).total_cmp(&of(b)));
    let best = best.expect("bug: no frame");
    let mut photos = full(p, &source, &clip, &[best], &times, ctx)?;
    files.path(entry)?;
    let mut photo = photos.remove(0);
    photo.time_s = None;
    Ok(photo)
}
