//! Every crate of stages. A new crate adds one word here, a new stage nothing.

use crate::kinds::KINDS;
use engine::Catalog;
use engine::Importer;
use stage::{AnyStage, Template, erase};

// What a folder has besides photos, and what capture.toml has.
pub(crate) use capture::{
    KNOWN, Known, PERSONAL, Quantity, READ, foreign, is_photo, is_plate, is_raw, is_scan, is_video,
};

// The layout of a mat from its tags.
pub(crate) use pose::ringed;

// A page that gets the name of its capture.
pub(crate) use report::titled;

/// The crates' stages, in the order in which data flows.
pub const CRATES: &[&[&dyn AnyStage]] = &[
    synth::STAGES,
    capture::STAGES,
    pose::STAGES,
    person::STAGES,
    silhouette::STAGES,
    turning::STAGES,
    hull::STAGES,
    refine::STAGES,
    measure::STAGES,
    report::STAGES,
];

/// How what programs wrote becomes artifacts: by the stages that take them from elsewhere.
pub const IMPORTERS: &[Importer] = &[
    taken(
        &erase::<capture::Load>(),
        &[
            "images/*.{jpg,jpeg,png,tif,tiff}",
            "*.{jpg,jpeg,png,tif,tiff}",
            "capture.toml",
        ],
    ),
    taken(
        &erase::<pose::Import>(),
        &["*.json", "*_par.txt", "*.txt", "*.bin"],
    ),
    taken(&erase::<pose::ImportTags>(), &["tags.json"]),
    taken(&erase::<pose::ImportTracks>(), &["tracks.json"]),
    taken(
        &erase::<silhouette::Import>(),
        &["*.{png,jpg,jpeg,tif,tiff}"],
    ),
    taken(&erase::<capture::Surface>(), &["mesh.ply"]),
    taken(&erase::<measure::ImportLandmarks>(), &["landmarks.json"]),
    taken(&erase::<measure::ImportGirths>(), &["girths.json"]),
    taken(&erase::<report::Take>(), &["*"]),
];

const fn taken(stage: &'static dyn AnyStage, files: &'static [&'static str]) -> Importer {
    Importer {
        stage,
        files,
        layout: 1,
    }
}

/// The product: its stages, and what is to be known of what flows.
pub static CATALOG: Catalog = Catalog {
    program: concat!("tailor ", env!("CARGO_PKG_VERSION")),
    stages: CRATES,
    kinds: KINDS,
    importers: IMPORTERS,
    pipelines: &[
        ("body", include_str!("../pipelines/body.toml")),
        ("own-masks", include_str!("../pipelines/own-masks.toml")),
        (
            "external-cameras",
            include_str!("../pipelines/external-cameras.toml"),
        ),
        ("any-order", include_str!("../pipelines/any-order.toml")),
        ("hull", include_str!("../pipelines/hull.toml")),
        ("surface", include_str!("../pipelines/surface.toml")),
        ("walk", include_str!("../pipelines/walk.toml")),
        (
            "walk-own-masks",
            include_str!("../pipelines/walk-own-masks.toml"),
        ),
        ("turning", include_str!("../pipelines/turning.toml")),
        (
            "turning-own-masks",
            include_str!("../pipelines/turning-own-masks.toml"),
        ),
        (
            "turning-synth",
            include_str!("../pipelines/turning-synth.toml"),
        ),
        ("phone", include_str!("../pipelines/phone.toml")),
        ("video", include_str!("../pipelines/video.toml")),
        ("raw", include_str!("../pipelines/raw.toml")),
        ("doctor", include_str!("../pipelines/doctor.toml")),
        ("evolutions", include_str!("../pipelines/evolutions.toml")),
        ("paper", include_str!("../pipelines/paper.toml")),
        ("synth", include_str!("../pipelines/synth.toml")),
        ("paper-synth", include_str!("../pipelines/paper-synth.toml")),
        ("fit-levels", include_str!("../pipelines/fit-levels.toml")),
    ],
};

/// Every kind of message, crate by crate and file by file. A list of a file's that nobody joins is code that nobody uses,
/// which does not pass the compiler.
#[cfg_attr(not(feature = "serve"), allow(dead_code))]
const KINDS_OF_MESSAGES: [&[&[Template]]; 14] = [
    command::MESSAGES,
    engine::MESSAGES,
    capture::MESSAGES,
    hull::MESSAGES,
    measure::MESSAGES,
    person::MESSAGES,
    pose::MESSAGES,
    refine::MESSAGES,
    report::MESSAGES,
    shape::MESSAGES,
    silhouette::MESSAGES,
    stage::MESSAGES,
    study::MESSAGES,
    turning::MESSAGES,
];

/// The kinds of messages of all crates, and of this one.
#[cfg_attr(not(feature = "serve"), allow(dead_code))]
pub(crate) fn kinds_of_messages() -> impl Iterator<Item = &'static Template> {
    let crates = KINDS_OF_MESSAGES.iter().chain(crate::MESSAGES);
    crates.copied().flatten().copied().flatten()
}

/// Every stage.
pub fn stages() -> impl Iterator<Item = &'static dyn AnyStage> {
    CATALOG.stages()
}

/// The stage of a name.
pub fn find(name: &str) -> Option<&'static dyn AnyStage> {
    CATALOG.find(name)
}
