//! From files to photos: reads what the user has, in turning order.
//!
//! `files` → [`Load`] → `photos`; videos and raw photos go through [`Video`] or [`Raw`] before.

mod alike;
mod bare;
mod cut_off;
mod date;
mod draw;
mod empty;
mod enough;
mod error;
mod exif;
mod facts;
mod facts_param;
mod folder;
mod glance;
mod heic;
mod installed;
mod keys;
mod known;
mod load;
mod look;
mod names;
mod netpbm;
mod noise;
mod odd;
mod ordered;
mod person;
mod person_keys;
mod photo;
mod program;
mod raw;
mod rig;
mod rig_tags;
mod scan;
mod sharpness;
mod smaller;
mod surface;
mod verdict;
mod video;
mod whole;

pub use draw::{Draw, DrawInput, DrawParams};
pub use error::CaptureError;
pub use facts::Facts;
pub use folder::{Foreign, RAWS, READ, VIDEOS, foreign, is_photo, is_raw, is_video};
pub use glance::{Glance, Together, glance, together};
pub use keys::RigError;
pub use known::{KNOWN, Known, Quantity};
pub use load::{Load, LoadInput, LoadParams};
pub use look::{Look, LookInput, LookParams};
pub use names::is_plate;
pub use noise::{Against, noise};
pub use person::{Personal, PersonalInput, PersonalParams};
pub use person_keys::PERSONAL;
pub use program::ProgramError;
pub use raw::{Raw, RawError, RawInput, RawParams};
pub use rig::{RigFile, read_rig};
pub use scan::{SCANS, is_scan};
pub use surface::{Surface, SurfaceError, SurfaceInput, SurfaceParams, Unit, Up};
pub use verdict::{Finding, Grade};
pub use video::{Video, VideoError, VideoInput, VideoParams};

/// Every kind of message of this crate.
pub const MESSAGES: &[&[stage::Template]] = &[
    alike::MESSAGES,
    cut_off::MESSAGES,
    date::MESSAGES,
    empty::MESSAGES,
    folder::MESSAGES,
    keys::MESSAGES,
    load::MESSAGES,
    noise::MESSAGES,
    odd::MESSAGES,
    person_keys::MESSAGES,
    raw::MESSAGES,
    rig::MESSAGES,
    rig_tags::MESSAGES,
    surface::MESSAGES,
    verdict::MESSAGES,
    video::frames::MESSAGES,
    video::stage::MESSAGES,
    error::MESSAGES,
    facts_param::MESSAGES,
    CaptureError::MESSAGES,
    ProgramError::MESSAGES,
    RawError::MESSAGES,
    SurfaceError::MESSAGES,
    VideoError::MESSAGES,
];

/// Every stage of this crate, in the order in which data flows through it.
pub const STAGES: &[&dyn stage::AnyStage] = &[
    &stage::erase::<Video>().failing(CODED),
    &stage::erase::<Raw>().failing(CODED),
    &stage::erase::<Load>().failing(CODED),
    &stage::erase::<Draw>().failing(CODED),
    &stage::erase::<Look>().failing(CODED),
    &stage::erase::<Personal>().failing(CODED),
    &stage::erase::<Surface>().failing(CODED),
];

/// The errors that have codes.
const CODED: &[stage::Recognise] = &[
    stage::recognise::<CaptureError>,
    stage::recognise::<ProgramError>,
    stage::recognise::<RawError>,
    stage::recognise::<RigError>,
    stage::recognise::<SurfaceError>,
    stage::recognise::<VideoError>,
    stage::recognise::<shape::PhotoError>,
];
