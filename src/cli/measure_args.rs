//! Arguments of `tailor measure`.

use super::facts::Facts;
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

/// Arguments of `tailor measure`.
#[derive(Args)]
pub(crate) struct Measure {
    /// Folders with the photos or the video of one turn each, or videos; masks in a folder's `masks` are taken instead of own ones
    #[arg(required = true)]
    pub(super) folders: Vec<PathBuf>,
    /// Where to write; here, the folder's name with `-out`, if not said. Of several folders each gets its own in it
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
    /// The camera was walked around somebody who stood still; masks in the folder's `masks` are taken instead of own ones
    #[arg(long)]
    pub(super) walk: bool,
    /// Take the photos in folders below, too, in the order of their paths
    #[arg(long)]
    pub(super) recursive: bool,
    /// Take the folder's video, though there are photos, too
    #[arg(long)]
    pub(super) video: bool,
    /// Show what each node and loop took of clock, processor and memory, and write a trace of it into this file
    #[arg(long, value_name = "FILE")]
    pub(super) profile: Option<PathBuf>,
    #[command(flatten)]
    pub(super) facts: Facts,
}

impl Measure {
    /// Whether lengths are shown in inches.
    pub(super) fn inches(&self) -> bool {
        self.unit == Shown::In
    }
}
