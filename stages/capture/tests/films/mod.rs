//! Small films made for tests by ffmpeg.

#![allow(dead_code)]

use capture::{Video, VideoInput, VideoParams};
use shape::Photos;
use stage::{Ctx, FileEntry, Files, Hash, Host, Stage, Stop, hash};
use std::f64::consts::TAU;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::{Arc, Mutex};

/// Whether ffmpeg is there; a note where it is not.
pub(crate) fn ffmpeg() -> bool {
    proof::program("ffmpeg", "ffmpeg") && proof::program("ffprobe", "ffmpeg")
}

pub(crate) const WIDTH: usize = 216;
pub(crate) const HEIGHT: usize = 384;

/// A patterned column on a disk that has turned by so many turns, before a still wall; 8-bit RGB.
pub(crate) fn frame(turns: f64) -> Vec<u8> {
    let mut pixels = Vec::with_capacity(WIDTH * HEIGHT * 3);
    // What is the same all the way down the column.
    let waves = (0..WIDTH).map(|x| {
        let across = (x as f64 - 108.0) / 50.0;
        let a = libm::asin(across) + TAU * turns;
        let wave = 0.6 * libm::cos(2.0 * a) + libm::sin(a);
        (across.abs() < 1.0).then_some((a, wave))
    });
    let waves: Vec<Option<(f64, f64)>> = waves.collect();
    for y in 0..HEIGHT {
        for (x, wave) in waves.iter().enumerate() {
            let level = match wave.filter(|_| y > 40) {
                Some((a, wave)) => {
                    125.0 + 45.0 * (wave + 0.5 * libm::sin(7.0 * a + y as f64 * 0.08))
                }
                None => 70.0 + ((x / 6 + y / 9) % 7) as f64 * 15.0,
            };
            let level = level.clamp(0.0, 255.0);
            pixels.extend([level as u8, (0.9 * level) as u8, (0.8 * level) as u8]);
        }
    }
    pixels
}

/// Turns at each frame: still, then `turned` turns in `turning` frames, then still.
pub(crate) fn angles(before: usize, turning: usize, after: usize, turned: f64) -> Vec<f64> {
    let at = |i: usize| (i as f64 - before as f64) / turning as f64;
    (0..before + turning + after)
        .map(|i| turned * at(i).clamp(0.0, 1.0))
        .collect()
}

/// A film of frames, 30 a second, with more options of ffmpeg behind its input.
pub(crate) fn film(file: &Path, frames: impl Iterator<Item = Vec<u8>>, more: &[&str]) {
    let size = format!("{WIDTH}x{HEIGHT}");
    let mut command = Command::new("ffmpeg");
    command.args([
        "-v", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24", "-r", "30",
    ]);
    command
        .args(["-s", &size, "-i", "pipe:0"])
        .args(more)
        .arg(file);
    let mut child = command.stdin(Stdio::piped()).spawn().unwrap();
    let mut to = child.stdin.take().unwrap();
    for frame in frames {
        to.write_all(&frame).unwrap();
    }
    drop(to);
    assert!(child.wait().unwrap().success(), "{more:?}");
}

/// As phones code it.
pub(crate) const PHONE: [&str; 10] = [
    "-vf",
    "scale=out_color_matrix=bt709:flags=accurate_rnd,format=yuv420p",
    "-colorspace",
    "bt709",
    "-c:v",
    "libx264",
    "-b:v",
    "3M",
    "-preset",
    "veryfast",
];

/// Files of a folder, as a stage is given them.
pub(crate) fn files(folder: &Path, names: &[&str]) -> Arc<Files> {
    let entry = |name: &&str| {
        let bytes = std::fs::read(folder.join(name)).unwrap();
        FileEntry {
            name: (*name).into(),
            content: hash(&bytes),
            size: bytes.len() as u64,
        }
    };
    Arc::new(Files {
        root: folder.canonicalize().unwrap(),
        entries: names.iter().map(entry).collect(),
    })
}

/// A host that collects warnings.
#[derive(Default)]
pub(crate) struct Collected {
    pub(crate) warnings: Mutex<Vec<String>>,
    pub(crate) cancelled: bool,
}

impl Host for Collected {
    fn warn(&self, text: &stage::Message) {
        self.warnings.lock().unwrap().push(text.into());
    }
    fn cancelled(&self) -> bool {
        self.cancelled
    }
}

/// What the stage makes of videos, and what it warns of.
pub(crate) fn read(
    folder: &Path,
    names: &[&str],
    p: &VideoParams,
) -> Result<(Photos, Vec<String>), String> {
    let host = Collected::default();
    let none = Hash::from_bytes([0; 32]);
    let ctx = Ctx::new(&host, none, none);
    let files = files(folder, names);
    match Video::run(p, VideoInput { files }, &ctx) {
        Ok(photos) => Ok((photos, host.warnings.into_inner().unwrap())),
        Err(Stop::Failed(error)) => Err(error.to_string()),
        Err(Stop::Cancelled) => panic!("nobody asked to stop"),
    }
}
