//! The product's command line: what it adds to the engine's verbs.

pub(crate) mod cohort;
mod columns;
pub(crate) mod compare;
mod compare_replicates;
pub(crate) mod delivered;
pub(crate) mod doctor;
pub(crate) mod ending;
mod facts;
mod first;
mod folder;
pub(crate) mod follow;
pub(crate) mod init;
mod length;
mod live;
pub(crate) mod mat;
mod mat_file;
pub(crate) mod measure_args;
pub(crate) mod measure_verb;
pub(crate) mod measuring;
mod numbers;
mod pipeline;
pub(crate) mod prepared;
pub(crate) mod provenance;
pub(crate) mod repeat;
pub(crate) mod scoring;
mod screen;
mod source;
pub(crate) mod spoken;
mod stated;
pub(crate) mod words;

pub use measuring::{Measured, measured};

/// Every kind of message of these files.
#[cfg_attr(not(feature = "serve"), allow(dead_code))]
pub(crate) const MESSAGES: &[&[stage::Template]] = &[
    compare::MESSAGES,
    compare_replicates::MESSAGES,
    delivered::MESSAGES,
    doctor::MESSAGES,
    facts::MESSAGES,
    folder::MESSAGES,
    init::MESSAGES,
    length::MESSAGES,
    mat::MESSAGES,
    mat_file::MESSAGES,
    measure_verb::MESSAGES,
    measuring::MESSAGES,
    numbers::MESSAGES,
    pipeline::MESSAGES,
    scoring::MESSAGES,
    source::MESSAGES,
    stated::MESSAGES,
];
