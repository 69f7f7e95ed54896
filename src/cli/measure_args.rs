//! Arguments of `tailor measure`.

use super::facts::Facts;
use super::spoken::Spoken;
use crate::words::language::Words;
use clap::Args;
use std::path::PathBuf;

/// What lengths are shown in.
#[derive(Clone, Copy, PartialEq, clap::ValueEnum)]
pub(super) enum Shown {
    /// Centimetres
    Cm,
    /// Inches
    In,
}

/// What a scan's numbers are in.
#[derive(Clone, Copy, PartialEq, clap::ValueEnum)]
pub(super) enum FileUnit {
    /// Millimetres
    Mm,
    /// Centimetres
    Cm,
    /// Metres
    M,
    /// Inches
    In,
}

/// The axis of a scan that points up.
#[derive(Clone, Copy, PartialEq, clap::ValueEnum)]
pub(super) enum Up {
    /// x
    X,
    /// y
    Y,
    /// z
    Z,
}

/// A word of the command line as a param has it; `auto` where none was given.
fn word(stated: Option<&impl clap::ValueEnum>) -> String {
    let value = stated.and_then(clap::ValueEnum::to_possible_value);
    value.map_or("auto".to_owned(), |value| value.get_name().to_owned())
}

/// Arguments of `tailor measure`.
#[derive(Args)]
pub(crate) struct Measure {
    /// Folders with the photos or the video of one turn each, videos, or scans (PLY, OBJ, STL, OFF, GLB, 3MF); masks in a folder's `masks` are taken instead of own ones
    #[arg(required = true)]
    pub(super) folders: Vec<PathBuf>,
    /// Where to write; here, the folder's name with `-out`, if not given. Of several folders each gets its own in it
    #[arg(long)]
    pub(super) out: Option<PathBuf>,
    /// Remove from that folder what an earlier run wrote there and this one does not
    #[arg(long)]
    pub(super) clean: bool,
    /// Keep nothing in the cache: what is made goes when the results are written
    #[arg(long)]
    pub(super) private: bool,
    /// A variant of the pipeline
    #[arg(long)]
    pub(super) variant: Option<String>,
    /// A first answer: waist and hip from the coarse surface, with wider intervals; the rest of the work is left out
    #[arg(long, conflicts_with = "variant")]
    pub(super) fast: bool,
    /// Another value for a param: NODE.PARAM=VALUE
    #[arg(long)]
    pub(super) set: Vec<String>,
    /// Leave the photos out of the report
    #[arg(long)]
    pub(super) no_photos: bool,
    /// Make faces on the report's photos unrecognisable
    #[arg(long)]
    pub(super) blur_face: bool,
    /// What the screen and the report show lengths in; files stay in centimetres
    #[arg(long, value_enum, default_value = "cm")]
    pub(super) unit: Shown,
    #[command(flatten)]
    pub(super) spoken: Spoken,
    /// A line for each node of the pipeline while it runs
    #[arg(long)]
    pub(super) verbose: bool,
    /// The camera was walked around somebody who stood still; masks in the folder's `masks` are taken instead of own ones
    #[arg(long)]
    pub(super) walk: bool,
    /// Somebody turned on the spot before a standing camera, without a disk: waist and hip, scaled by --stature
    #[arg(long, conflicts_with_all = ["walk", "fast"])]
    pub(super) turning: bool,
    /// Take the photos in folders below, too, in the order of their paths
    #[arg(long)]
    pub(super) recursive: bool,
    /// Take the folder's video, though there are photos, too
    #[arg(long)]
    pub(super) video: bool,
    /// What a scan's numbers are in, where it is not recognised
    #[arg(long, value_enum)]
    pub(super) unit_of_file: Option<FileUnit>,
    /// The axis of a scan that points up, where it is not recognised
    #[arg(long, value_enum)]
    pub(super) up: Option<Up>,
    /// Show what each node and loop took of clock, processor and memory, and write a trace of it into this file
    #[arg(long, value_name = "FILE")]
    pub(super) profile: Option<PathBuf>,
    #[command(flatten)]
    pub(super) facts: Facts,
}

impl Measure {
    /// How a scan is read, as params of the stage that does.
    pub(super) fn scan(&self) -> [String; 3] {
        [
            format!("body.unit={}", word(self.unit_of_file.as_ref())),
            format!("body.up={}", word(self.up.as_ref())),
            "body.scan=true".to_owned(),
        ]
    }

    /// What the reader wants to read.
    pub(super) fn words(&self) -> Words {
        Words {
            inches: self.inches(),
            ..self.spoken.words()
        }
    }

    /// Whether lengths are shown in inches.
    pub(super) fn inches(&self) -> bool {
        self.unit == Shown::In
    }
}
