//! The end of `tailor run`: the same screen as that of `tailor measure`, where girths were made.

use super::delivered::{called, folder};
use super::provenance::warnings;
use super::screen::{screen, warned};
use engine::cli::Ran;
use shape::{Cameras, Girths, Photos};
use std::path::Path;

/// The girths of a run with its warnings; nothing where it made none.
pub(super) fn ending(ran: &Ran<'_>) -> Option<String> {
    let girths = ran.last::<Girths>()?;
    let cameras = ran.get::<Cameras>("cameras");
    let cameras = cameras.or_else(|| ran.last::<Cameras>());
    // Of a made body nobody took a photo.
    let photos = ran.last::<Photos>().map_or(0, |p| p.photos.len());
    let cameras = cameras.filter(|_| photos > 0);
    let pipeline = Path::new(&ran.graph.origin.pipeline);
    let name = called(folder(ran).unwrap_or(pipeline));
    let told = screen(&name, photos, cameras.as_deref(), &girths, false);
    Some(told + &warned(&warnings(ran, Some(&girths))))
}
