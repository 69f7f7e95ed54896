//! The stage that reads the photos of a turn.

use crate::alike::{not_one_turn, one_size};
use crate::date::day_of;
use crate::enough::{as_many_as_promised, enough, one_of_each, thinned};
use crate::error::CaptureError;
use crate::facts::Facts;
use crate::glance::{Glance, glance, together};
use crate::names::{Sorted, names, plate_of, sorted, twins};
use crate::noise::{noisy, of_photos};
use crate::odd::seen_in_pictures;
use crate::ordered::in_order;
use crate::photo::{header, photo};
use crate::rig::{RigFile, read_rig};
use crate::sharpness::{Sharpness, against_the_middle, best, sharpness};
use crate::smaller::{factor, on_smaller, plate_too, smaller};
use crate::verdict::{Grade, Seen};
use rayon::prelude::*;
use shape::{Photo, Photos};
use stage::{Ctx, FileEntry, Files, Stage, Stop, message};
use std::sync::Arc;

stage::messages! {
    TOML = "warn-capture-toml": "capture.toml: {what}";
    NO_DAY = "warn-no-day": "the photos have no date, so the day of the capture is unknown: give it in place of `date = \"exif\"`";
    UNEVEN_STEPS = "warn-video-steps": "frames of a video are not at even steps: `step_deg` was passed over (how many are taken: --set frames.step_deg=)";
    SAME_FILE = "warn-same-file": "{copy} is the same file as {first} and was left out: if another photo should be in its place, put it there";
    OTHER_PLATE = "warn-video-plate": "{name} is {size} pixels, unlike the turn, and was left out: film the empty scene as the turn, and call that plate.mp4";
    TOO_MANY = "warn-too-many": "{count} photos are more than are of use: the sharpest of each of {most} even stretches are taken (`most`); steps between them are no longer even";
}

stage::params! {
    /// What may be a turn.
    pub struct LoadParams {
        /// Fewest photos that are taken for a turn.
        #[range(3..=1000)]
        #[source(derived = "three views are the fewest that carve a body from all sides")]
        fewest: u32 = 3,
        /// Of each so many photos in turning order, the first `keep` are taken: what would fewer
        /// views have done?
        #[range(1..=100)]
        #[source(structural)]
        of: u32 = 1,
        /// How many of each `of` are taken.
        #[range(1..=100)]
        #[source(structural)]
        keep: u32 = 1,
        /// Of a turn of n times so many photos one of each n is taken; 0 takes all.
        #[range(0..=5000)]
        #[source(structural)]
        keep_about: u32 = 0,
        /// Of more photos than this the sharpest of as many even stretches are taken.
        #[range(3..=5000)]
        #[source(structural)]
        most: u32 = 200,
        /// Photos are reduced by the greatest whole factor that leaves their longest side so long at least. 0 leaves them as
        /// they are.
        #[range(0..=100000)]
        #[source(structural)]
        least_px: u32 = 0,
        /// Whether photos of which nothing will come as a turn are an error, and what is odd about them
        /// a warning.
        stop: bool = false,
        /// Whether photos may be of several sizes and cameras and in any order, as those of a walk.
        mixed: bool = false,
        /// Whether steps between photos are even where a step is given; those between frames of a video
        /// are not.
        even: bool = true,
        /// What is known of the capture, by the keys of `capture.toml`, over what the file has:
        /// `facts.subject.height_cm`.
        facts: Facts = Facts::default(),
    }
}

stage::inputs! {
    /// The user's folder.
    pub struct LoadInput {
        /// The photos, `capture.toml` and the plate.
        files: Arc<Files>,
        /// The turn as another stage made it of files that are no photos: of a video, of raw photos.
        frames: Option<Arc<Photos>>,
    }
}

/// `capture.load`: files → photos.
pub struct Load;

impl Stage for Load {
    const NAME: &'static str = "capture.load";
    const VERSION: u32 = 16;
    const ABOUT: &'static str =
        "Reads the photos of one turn, their EXIF, capture.toml and the plate.";
    type Params = LoadParams;
    type Input = LoadInput;
    type Output = Photos;
    const METRICS: &'static [&'static str] = &["photos", "width", "height"];

    fn run(p: &LoadParams, input: LoadInput, ctx: &Ctx<'_>) -> Result<Photos, Stop> {
        let files = &input.files;
        let known = known(files, p)?;
        let warn = |what: &stage::Message| ctx.warn(message!(TOML, what = what.clone()));
        known.unknown.iter().for_each(warn);
        crate::rig_tags::doubts(&known.rig)
            .iter()
            .for_each(|w| ctx.warn(w));
        let Turn {
            photos,
            plate,
            even,
        } = match &input.frames {
            Some(frames) => of_frames(p, files, frames, &known, ctx)?,
            None => of_files(p, files, &known, ctx)?,
        };
        if !p.mixed {
            one_size(&photos, plate.as_ref())?;
        }
        let steps = ctx.steps("photos", photos.len());
        let longest = photos.first().map_or(0, |p| p.width.max(p.height));
        let read = |head: Photo| -> Result<(Photo, Option<(Glance, Sharpness)>), Stop> {
            let (photo, pixels) = photo(head)?;
            let seen = p.stop.then(|| (glance(&pixels), sharpness(&pixels)));
            steps.tick()?;
            Ok((smaller(photo, &pixels, p.least_px), seen))
        };
        let read: Vec<_> = in_order(photos.into_par_iter().map(read))?;
        let (mut photos, seen): (Vec<Photo>, Vec<_>) = read.into_iter().unzip();
        let times = photos.iter().filter_map(|p| p.time_s);
        let start = times.fold(f64::MAX, f64::min);
        let day = (start < f64::MAX).then(|| day_of(start));
        photos
            .iter_mut()
            .for_each(|p| p.time_s = p.time_s.map(|t| t - start));
        if !p.mixed {
            not_one_turn(&photos).iter().for_each(|w| ctx.warn(w));
        }
        let mut rig = known.rig;
        if known.by_exif {
            rig.date = day;
            if rig.date.is_none() {
                ctx.warn(message!(NO_DAY));
            }
        }
        if !p.even && rig.step.take().is_some() {
            ctx.warn(message!(UNEVEN_STEPS));
        }
        // Steps are equal only where one of each so many is left.
        rig.step = rig.step.zip(even).map(|(step, of)| step * of as f64);
        rig.focal_35mm = rig.focal_35mm.or(photos[0].focal_35mm);
        let plate = plate
            .map(|plate| plate_too(plate, p.least_px))
            .transpose()?;
        on_smaller(&mut rig, factor(longest, p.least_px));
        ctx.metric("photos", photos.len() as f64, "");
        ctx.metric("width", f64::from(photos[0].width), "px");
        ctx.metric("height", f64::from(photos[0].height), "px");
        let photos = Photos { photos, plate, rig };
        if let Some(seen) = seen.into_iter().collect::<Option<Vec<_>>>() {
            looked_at(&photos, seen, ctx)?;
        }
        Ok(photos)
    }
}

/// Warns of what is odd about photos; fails where nothing will come of them.
fn looked_at(
    photos: &Photos,
    seen: Vec<(Glance, Sharpness)>,
    ctx: &Ctx<'_>,
) -> Result<(), CaptureError> {
    let (glances, sharp): (Vec<Glance>, Vec<_>) = seen.into_iter().unzip();
    let together = together(&glances);
    let mut findings = seen_in_pictures(&Seen {
        photos,
        glances: &glances,
        together: &together,
        sharpness: &sharp,
        tags: None,
        people: None,
    });
    // A plate that cannot be decoded is refused where it is used.
    let noise = of_photos(photos, &together).ok().flatten();
    findings.extend(noise.and_then(|(levels, _)| noisy(levels)));
    let of = |grade: Grade| findings.iter().filter(move |f| f.grade == grade);
    of(Grade::Doubt).for_each(|f| ctx.warn(f.message()));
    match of(Grade::Hopeless).next() {
        Some(f) => Err(CaptureError::Hopeless(f.message())),
        None => Ok(()),
    }
}

/// What the user knows: the file, and over it what is given beside it.
fn known(files: &Files, p: &LoadParams) -> Result<RigFile, Stop> {
    let entry = files.entries.iter().find(|e| e.name == "capture.toml");
    let bytes = entry.map(|e| files.read(e)).transpose()?;
    let text = bytes.unwrap_or_default();
    Ok(read_rig(&String::from_utf8_lossy(&text), &p.facts)?)
}

/// What is taken for the turn.
struct Turn {
    /// The photos, in turning order; nobody has looked at their pixels yet.
    photos: Vec<Photo>,
    plate: Option<Photo>,
    /// Of how many even steps each is one, where they are even.
    even: Option<usize>,
}

/// The turn as files.
fn of_files(p: &LoadParams, files: &Files, known: &RigFile, ctx: &Ctx<'_>) -> Result<Turn, Stop> {
    let (mut turn, plate): Sorted<'_> = sorted(files, known)?;
    let copies = twins(&mut turn);
    for (copy, first) in &copies {
        ctx.warn(message!(SAME_FILE, copy = copy, first = first));
    }
    let sharp = |entry: &&FileEntry| -> Result<Sharpness, Stop> {
        let photo = header(&entry.name, &entry.name, files.read(entry)?)?;
        Ok(sharpness(&photo.decode()?))
    };
    let (turn, even) = chosen(p, turn, &copies, known, sharp, ctx)?;
    let names = names(&turn);
    let places: Vec<(&FileEntry, &String)> = turn.iter().copied().zip(&names).collect();
    let heads = |(entry, name): &(&FileEntry, &String)| -> Result<Photo, Stop> {
        Ok(header(&entry.name, name, files.read(entry)?)?)
    };
    Ok(Turn {
        photos: in_order(places.par_iter().map(heads))?,
        plate: plate.map(|entry| empty(files, entry)).transpose()?,
        even,
    })
}

/// The turn as another stage made it, with the plate that it made, or a file.
fn of_frames(
    p: &LoadParams,
    files: &Files,
    frames: &Photos,
    known: &RigFile,
    ctx: &Ctx<'_>,
) -> Result<Turn, Stop> {
    let sharp = |photo: &Photo| -> Result<Sharpness, Stop> { Ok(sharpness(&photo.decode()?)) };
    let (photos, even) = chosen(p, frames.photos.clone(), &[], known, sharp, ctx)?;
    let file = plate_of(files, known)?;
    let file = file.map(|entry| empty(files, entry)).transpose()?;
    let size = |photo: &Photo| (photo.width, photo.height);
    let plate = match file {
        // Phones film less of the scene than their photos show.
        Some(plate) if photos.first().is_some_and(|f| size(f) != size(&plate)) => {
            let size = format!("{}×{}", plate.width, plate.height);
            ctx.warn(message!(OTHER_PLATE, name = plate.name, size = size));
            frames.plate.clone()
        }
        Some(plate) => Some(plate),
        None => frames.plate.clone(),
    };
    Ok(Turn {
        photos,
        plate,
        even,
    })
}

/// The photo of the empty scene.
fn empty(files: &Files, entry: &FileEntry) -> Result<Photo, Stop> {
    let name = entry.name.rsplit('/').next().unwrap_or(&entry.name);
    Ok(photo(header(&entry.name, name, files.read(entry)?)?)?.0)
}

/// Those that are taken, in turning order; and of how many even steps each is one, where they are even.
fn chosen<T: Sync>(
    p: &LoadParams,
    turn: Vec<T>,
    copies: &[(String, String)],
    known: &RigFile,
    sharp: impl Fn(&T) -> Result<Sharpness, Stop> + Sync,
    ctx: &Ctx<'_>,
) -> Result<(Vec<T>, Option<usize>), Stop> {
    as_many_as_promised(turn.len(), copies, known.views)?;
    let (turn, even) = thinned(turn, [p.keep, p.of].map(|n| n as usize));
    let (turn, each) = one_of_each(turn, p.keep_about as usize);
    let even = even.map(|steps| steps * each);
    enough(turn.len(), copies, p.fewest)?;
    let most = p.most as usize;
    if turn.len() <= most {
        return Ok((turn, even));
    }
    let steps = ctx.steps("sharpness", turn.len());
    let sharp = |one: &T| -> Result<Sharpness, Stop> {
        let sharp = sharp(one)?;
        steps.tick()?;
        Ok(sharp)
    };
    let sharp: Vec<Sharpness> = in_order(turn.par_iter().map(sharp))?;
    let places = best(&against_the_middle(&sharp), most);
    ctx.warn(message!(TOO_MANY, count = turn.len(), most = most));
    let taken = turn.into_iter().enumerate();
    let taken = taken
        .filter(|(i, _)| places.contains(i))
        .map(|(_, one)| one);
    Ok((taken.collect(), None))
}
