//! The stage that develops raw photos.

use crate::error::CaptureError;
use crate::exif;
use crate::folder::is_raw;
use crate::heic::QUALITY;
use crate::installed::{found, linked, version};
use crate::names::{sorted, twins};
use crate::netpbm::{self, Netpbm};
use crate::ordered::in_order;
use crate::photo::as_jpeg;
use crate::program::{Program, ProgramError, Run};
use crate::rig::RigFile;
use rayon::prelude::*;
use shape::{Photo, Photos, Rgb, Rig, rgb_to_jpeg};
use stage::{Ctx, FileEntry, Files, Stage, Stop, message};
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

stage::messages! {
    SAME_RAW = "warn-same-raw": "{copy} is the same file as {first} and was left out";
}

stage::params! {
    /// How they are developed.
    pub struct RawParams {
        /// By how much all photos are brightened.
        #[range(0.1..=16.0)]
        #[source(structural)]
        brightness: f64 = 1.0,
    }
}

stage::inputs! {
    /// The user's folder.
    pub struct RawInput {
        /// Raw photos, the plate among them.
        files: Arc<Files>,
    }
}

stage::failures! {
    /// What is wrong with a raw photo.
    pub enum RawError {
        /// It cannot be developed.
        Unreadable {
            /// The file.
            name: String,
            /// The program's message.
            why: String,
        } = "fail-raw-unreadable": "{name} is no raw photo that dcraw_emu can read ({why}): hand over JPEGs of the camera instead, or remove it",
    }
    passes {
        /// The program.
        Program(ProgramError),
    }
}

/// `capture.raw`: files → photos.
pub struct Raw;

const DCRAW: Program = Program {
    name: "dcraw_emu",
    package: "libraw-bin",
};
/// Nobody's photo takes longer. \[s\]
const LIMIT: Duration = Duration::from_secs(300);

impl Stage for Raw {
    const NAME: &'static str = "capture.raw";
    const VERSION: u32 = 1;
    const ABOUT: &'static str =
        "Develops raw photos (DNG, CR2, NEF, …) by dcraw_emu: all alike, to sRGB, at full size.";
    type Params = RawParams;
    type Input = RawInput;
    type Output = Photos;
    const METRICS: &'static [&'static str] = &["photos"];

    fn programs() -> Vec<(&'static str, String)> {
        let found = program().unwrap_or_else(|| "not installed".into());
        vec![(DCRAW.name, found)]
    }

    fn run(p: &RawParams, input: RawInput, ctx: &Ctx<'_>) -> Result<Photos, Stop> {
        let raw = input.files.entries.iter().filter(|e| is_raw(&e.name));
        let files = Files {
            root: input.files.root.clone(),
            entries: raw.cloned().collect(),
        };
        let plate = files
            .entries
            .iter()
            .find(|e| crate::names::is_plate(&e.name));
        let (mut turn, _) = sorted(&files, &RigFile::default())?;
        for (copy, first) in twins(&mut turn) {
            ctx.warn(message!(SAME_RAW, copy = copy, first = first));
        }
        if turn.is_empty() {
            return Err(CaptureError::TooFew { found: 0, least: 3 }.into());
        }
        let steps = ctx.steps("photos", turn.len());
        let one = |entry: &&FileEntry| -> Result<Photo, Stop> {
            let photo = developed(p, &files, entry, ctx)?;
            steps.tick()?;
            Ok(photo)
        };
        let photos: Vec<Photo> = in_order(turn.par_iter().map(one))?;
        ctx.metric("photos", photos.len() as f64, "");
        Ok(Photos {
            photos,
            plate: plate.map(|e| developed(p, &files, e, ctx)).transpose()?,
            rig: Rig::default(),
        })
    }
}

/// Which `dcraw_emu` is installed. It has no version: it, and the library that does its work, by their
/// content.
fn program() -> Option<String> {
    version(DCRAW.name, &[], |_| {
        let program = found(DCRAW.name)?;
        let library = linked(&program, "libraw");
        let content = |file: PathBuf| {
            let hash = stage::hash(&std::fs::read(file).ok()?).to_hex();
            Some(hash[..16].to_owned())
        };
        let library = library.and_then(content).unwrap_or_default();
        Some(
            format!("{} {library}", content(program)?)
                .trim_end()
                .to_owned(),
        )
    })
}

/// A raw photo, developed; upright.
fn developed(
    p: &RawParams,
    files: &Files,
    entry: &FileEntry,
    ctx: &Ctx<'_>,
) -> Result<Photo, Stop> {
    let name = entry.name.rsplit('/').next().unwrap_or(&entry.name);
    let exif = exif::read(&files.read(entry)?);
    let path = files.path(entry)?;
    let run = Run {
        program: DCRAW,
        args: arguments(p, &path),
        what: name,
        limit: LIMIT,
    };
    let (mut picture, mut message) = (None, String::new());
    run.run(
        netpbm::read,
        |now: Netpbm| -> Result<(), Halt> {
            picture = Some(now);
            Ok(())
        },
        |line| {
            if !line.is_empty() {
                message = line.replace(&*path.to_string_lossy(), name);
            }
        },
        || ctx.check().map_err(|c| Halt(c.into())),
    )
    .map_err(|Halt(why)| why)?;
    files.path(entry)?;
    let unreadable = |why: String| RawError::Unreadable {
        name: entry.name.clone(),
        why,
    };
    let Some(Netpbm {
        width,
        height,
        depth: 3,
        data,
    }) = picture
    else {
        let why = if message.is_empty() {
            "it gives no picture".into()
        } else {
            message
        };
        return Err(unreadable(why).into());
    };
    let rgb = Rgb {
        width,
        height,
        data: data.chunks_exact(3).map(|p| [p[0], p[1], p[2]]).collect(),
    };
    Ok(Photo {
        focal_35mm: exif.focal_35mm,
        device: exif.device,
        time_s: exif.time_s,
        ..Photo::of(
            as_jpeg(name),
            [width as u32, height as u32],
            rgb_to_jpeg(&rgb, QUALITY),
        )
    })
}

/// White as the camera saw it, one brightness for all, sRGB with its own curve, AHD.
fn arguments(p: &RawParams, path: &Path) -> Vec<OsString> {
    let brightness = p.brightness.to_string();
    let mut args: Vec<OsString> = ["-w", "-W", "-b", &brightness, "-o", "1"]
        .iter()
        .map(Into::into)
        .collect();
    args.extend(["-g", "2.4", "12.92", "-q", "3", "-Z", "-"].map(Into::into));
    args.push(path.into());
    args
}

/// Why a run stopped.
struct Halt(Stop);

impl From<ProgramError> for Halt {
    fn from(error: ProgramError) -> Self {
        Halt(RawError::from(error).into())
    }
}
