//! From photos to masks: where the body is.
//!
//! # The steps of a turn
//!
//! Each folder is a step, and each step a node with a version, params and a fingerprint of its own.
//!
//! | step | reads | makes | what it is |
//! |---|---|---|---|
//! | [`Align`] (`align/`) | photos, cameras | `aligned` | how each photo is aligned with the plate or the other photos, and its levels at one exposure |
//! | [`Plate`] (`plate/`) | photos, aligned | `scene` | the empty scene by a photo of it; without one *unknown* |
//! | [`EmptyScene`] (`empty_scene/`) | photos, aligned, scene, people | `scene` | the empty scene out of all photos, where it is unknown; with it the bodies on which photos agree |
//! | [`Likelihood`] (`likelihood/`) | photos, aligned, scene, people | `evidence` | what each reduced pixel costs as background, and what is certain |
//! | [`Label`] (`label/`) | aligned, scene, evidence | `labels` | body or background of each reduced pixel, all photos together |
//! | [`Border`] (`border/`) | all of these, people | `masks` | the border again at full size |
//!
//! `scene/` is what an empty scene is (what does not move, and the disk, which turns), `cut/` the solver. [`GrabCut`]
//! runs the six in one, for pipelines that name it. [`Import`] takes masks of somebody else, [`Walk`] (`walk/`) finds
//! those of a walk, which has no empty scene.
//!
//! Without a plate the scene is known where no body is, and the body where the scene is known. So `EmptyScene` makes both,
//! and `Label` takes the bodies over.
//! Noise is measured against what a photo should show, so it belongs to `Likelihood` (reduced) and `Border` (full size).
//!
//! # The energy
//!
//! A labelling gives each pixel p of each photo a side, body or background, so that
//!
//! ```text
//! E = Σ U_p(side)  +  γ Σ C_pq [sides differ]     [nats]
//!     pixels          neighbours (8)
//! ```
//!
//! is least. It is found by least cuts, photo by photo (`cut/least_cut.rs`, `maxflow.rs`; Boykov and Kolmogorov 2004),
//! colours and labels in turns (`label/color_cut.rs`; Rother, Kolmogorov and Blake 2004).
//!
//! | term | what | file |
//! |---|---|---|
//! | U(background) | -ln p(pixel given the scene): its colour, edges that move by a part of a pixel, the light of its ground, and that of its neighbourhood | `likelihood/background.rs`, `grounds.rs`, `neighbourhoods.rs` |
//! | | … with the noise of that photo, which makes the density thinner by 3 ln σ | `likelihood/noise.rs` |
//! | | … also the grain of disk, floor and walls: what a window leaves at the best light | `likelihood/grain.rs`, `grain/in_photo.rs`, `grain/window.rs` |
//! | | … where a glossy disk mirrors the body: the less of the disk as it is, and with a share of the body's light | `likelihood/mirror.rs` |
//! | | … where nobody saw the scene: colours of the scene beside, at full size, too, of the scene and of the disk elsewhere, or a little more than any body costs | `likelihood/colors_beside.rs`, `disk_colors.rs`, `prepared.rs` (`UNSEEN`) |
//! | U(body) | -ln of the mixture of the body's colours or, one time in three, of any colour | `likelihood/body.rs`, `gmm.rs` |
//! | | ∞ below the disk's top, beside it, and beyond the user's rectangle | `likelihood/prepared.rs`, `align/rectangle.rs` |
//! | both | … and the log-odds of a learned sense of a person, on the side that they speak against | `likelihood/person.rs` |
//! | both | … and the log-odds of all other photos: how deep a pixel's ray passes into the hull of their bodies, or how far beside it, and whether the photo from the other side shows background there, worth what the photos of the capture show of such pixels; with odds, the background costs no more than what no scene foresees, by how often the photo shows such where all other photos see the background | `label/between_photos.rs` |
//! | both | … at full size, along the border: a mixture of what is on either side of a pixel, on the side that it shows more of; how wide borders are is measured of each photo | `border/mixed.rs` |
//! | γ C | (0.15 + 0.85 exp(-β d²)) / 8, d by colours, β of the photo; an edge that the scene has by itself is not one | `cut/least_cut.rs` |
//! | parts | the body is the largest part; by colours alone, without specks | `label/parts.rs` |
//!
//! Beside the energy, with its reason in its file: narrow ends of gaps are followed at full size, where a photo outweighs the rest (`border/narrow_gaps.rs`).
//! Without a plate the scene is what most photos agree on to the level (`empty_scene/recurring.rs`), and where two photos
//! agree on a colour that the body has not, if the learned sense is not sure of the body there.
//!
//! # Another algorithm
//!
//! It is one producer of evidence: a stage in a crate of its own that makes a [`shape::Evidence`] (a reduced photo, what
//! each pixel costs as background in nats, what is certain), one line in the product's catalog, and a pipeline whose node
//! `evidence` is that stage. Labels, border and all after them stay as they are. What costs the background U nats when
//! it is certain of odds L = ln p(background) - ln p(body) is 17.8 - L: the body costs 17.8 where nothing is known of its
//! colours. They are learned from pixels that cost more than 22, so some must. Where the scene is unknown the evidence of
//! colours is not asked, and bodies that were found with it are taken as they are. A program that makes masks needs no Rust: see `docs/pipelines.md`.

mod align;
mod border;
mod cells;
mod consensus;
mod cut;
mod empty_scene;
mod grabcut;
mod import;
mod label;
mod likelihood;
mod params;
mod plate;
mod raster;
mod scene;
mod walk;

pub use align::exposure::exposure;
pub use align::rectangle::{Rectangle, RectangleError};
pub use align::stage::{Align, AlignInput, AlignParams};
pub use border::full_size::fine;
pub use border::stage::{Border, BorderInput, BorderParams};
pub use cut::least_cut::Known;
pub use cut::maxflow::{Grid, STEPS};
pub use empty_scene::recurring::Recurring;
pub use empty_scene::stage::{EmptyScene, EmptySceneInput, EmptySceneParams};
pub use empty_scene::without_plate::without_plate;
pub use grabcut::{GrabCut, GrabCutInput};
pub use import::{Body, Import, ImportError, ImportInput, ImportParams};
pub use label::color_cut::{Settings, coarse};
pub use label::stage::{Label, LabelInput, LabelParams};
pub use likelihood::background::Noise;
pub use likelihood::prepared::{Prepared, prepare};
pub use likelihood::stage::{Likelihood, LikelihoodInput, LikelihoodParams};
pub use params::{CutError, CutParams, GrabCutParams};
pub use plate::stage::{Plate, PlateInput};
pub use scene::backdrop::{Backdrop, still};
pub use scene::still_and_disk::Shot;
pub use walk::{Walk, WalkCutError, WalkInput, WalkParams};

/// Every stage of this crate, in the order in which data flows through it.
pub const STAGES: &[&dyn stage::AnyStage] = &[
    &stage::erase::<Align>().failing(CODED),
    &stage::erase::<Plate>().failing(CODED),
    &stage::erase::<EmptyScene>().failing(CODED),
    &stage::erase::<Likelihood>().failing(CODED),
    &stage::erase::<Label>().failing(CODED),
    &stage::erase::<Border>().failing(CODED),
    &stage::erase::<GrabCut>().failing(CODED),
    &stage::erase::<Import>().failing(CODED),
    &stage::erase::<Walk>().failing(CODED),
];

/// Every kind of message of this crate.
pub const MESSAGES: &[&[stage::Template]] = &[
    import::MESSAGES,
    empty_scene::stage::MESSAGES,
    walk::MESSAGES,
    CutError::MESSAGES,
    ImportError::MESSAGES,
    walk::WalkCutError::MESSAGES,
];

/// The errors that have codes.
const CODED: &[stage::Recognise] = &[
    stage::recognise::<CutError>,
    stage::recognise::<ImportError>,
    stage::recognise::<walk::WalkCutError>,
    stage::recognise::<shape::PhotoError>,
];
