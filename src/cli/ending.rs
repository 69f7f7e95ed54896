//! The end of `tailor run`: the same screen as that of `tailor measure`, where girths were made.

use super::columns::wide;
use super::provenance::{called, folder, warnings};
use super::screen::{Of, screen, warned};
use crate::words::language::{Language, Words};
use command::Ran;
use shape::{Cameras, Girths, Photos};
use std::path::Path;

/// A run is reported by its nodes, whose names are English.
const ENGLISH: Words = Words {
    language: Language::En,
    inches: false,
};

/// The girths of a run with its warnings; nothing where it made none.
pub(crate) fn ending(ran: &Ran<'_>) -> Option<String> {
    let girths = ran.last::<Girths>()?;
    let cameras = ran.get::<Cameras>("cameras");
    let cameras = cameras.or_else(|| ran.last::<Cameras>());
    // Of a made body nobody took a photo.
    let photos = ran.last::<Photos>().map_or(0, |p| p.photos.len());
    let cameras = cameras.filter(|_| photos > 0);
    let pipeline = Path::new(&ran.graph.origin.pipeline);
    let name = called(folder(ran).unwrap_or(pipeline));
    let of = Of {
        name: &name,
        photos,
        cameras: cameras.as_deref(),
        girths: &girths,
    };
    let reported = screen(ENGLISH, &of, wide());
    Some(reported + &warned(ENGLISH, &warnings(ran, Some(&girths)), wide()))
}
