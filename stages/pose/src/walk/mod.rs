//! Cameras of a walk around a subject that is as still as its background: features followed over photos
//! in any order (`link`, a stage → `pairs` → `nearest`, `guided`; `chains`), then cameras (`walk`, a stage →
//! `grow` → `begin`, `next` → `register`, `points`; `finish`; `world` → `floor`).

pub(crate) mod begin;
pub(crate) mod chains;
pub(crate) mod error;
pub(crate) mod finish;
pub(crate) mod floor;
pub(crate) mod groups;
pub(crate) mod grow;
pub(crate) mod guided;
pub(crate) mod link;
pub(crate) mod nearest;
pub(crate) mod next;
pub(crate) mod p3p;
pub(crate) mod pairs;
pub(crate) mod points;
pub(crate) mod register;
pub(crate) mod rules;
pub(crate) mod seen;
pub(crate) mod stage;
pub(crate) mod world;
