//! What is odd about a capture, and what would mend it.

use crate::empty::absent;
use crate::glance::Glance;
use crate::sharpness::blurred;
use crate::verdict::{Finding, Findings, Grade, Seen, camera_is_fixed, lengths};
use shape::upper_median;
use stage::message;
use std::collections::BTreeSet;

stage::messages! {
    MOVED_CAMERA = "find-moved": "only {still:.0 %} of the picture stay still: the camera, or all behind the subject, moved between the photos";
    MOVED_MEND = "find-moved-mend": "a turn wants one camera on a tripod and the subject on a disk; is this a walk around somebody who does not move? Then give --walk";
    OUT_OF_ORDER = "find-shuffled": "photos side by side in order are no more alike than any two by chance: they are not in turning order";
    SHUFFLED_MEND = "find-shuffled-mend": "name photos in turning order, or list them with `images = [...]`; `tailor run pipelines/any-order.toml` finds cameras without an order";
    SAME = "find-same": "nothing turned between these photos and the next";
    SAME_MEND = "find-same-mend": "leave one of each two out";
    GAP = "find-gap": "the next photo differs by far more than other photos do";
    GAP_MEND = "find-gap-mend": "look whether a photo is missing there";
    BLURRED_PHOTO = "find-blurred": "blurred compared with the other photos";
    BLURRED_MEND = "find-blurred-mend": "take them again, or leave them out";
    BURNT = "find-burnt": "overexposed over a tenth of the picture or more";
    BLACK = "find-black": "black over a tenth of the picture or more";
    LOST_MEND = "find-lost-mend": "take them again with a fixed exposure";
    UNEVEN = "find-uneven": "exposed from {low:+.2 EV} to {high:+.2 EV} against the middle";
    UNEVEN_MEND = "find-uneven-mend": "fix exposure and white balance (on phones: press and hold until AE/AF lock shows)";
    PIXELS = "find-pixels": "photos of {width}×{height} pixels are small";
    PIXELS_MEND = "find-pixels-mend": "hand over the camera's own files";
    HEAD = "find-head": "what moves reaches the upper border: its top may be cut off";
    HEAD_MEND = "find-head-mend": "leave space above it";
    ARMS = "find-arms": "what moves reaches both sides: it may be cut off, or people walk behind it";
    ARMS_MEND = "find-arms-mend": "step back, and keep the background still";
    FEW_PHOTOS = "find-few": "{count} photos are few: without a mat features are followed over steps of 30° at most";
    FEW_MEND = "find-few-mend": "take 18 to 36 photos of a full turn, or lay a mat on the disk";
    FOCAL = "find-focal": "the focal length is unknown";
    FOCAL_MEND = "find-focal-mend": "keep EXIF in the photos, or give --focal";
    LENGTH = "find-length": "no length is known: lengths will be relative";
    LENGTH_MEND = "find-length-mend": "give --stature, or --disk-diameter, or lay a mat on the disk";
    PLATE = "find-plate": "there is no photo of the empty scene";
    PLATE_MEND = "find-plate-mend": "take one without the subject and call it plate.jpg: silhouettes become surer";
    MAT = "find-mat": "a mat is given, but none of its tags was found";
    MAT_MEND = "find-mat-mend": "is it in view, in good light, and flat?";
    TAGS = "find-tags": "of the mat's {all} tags only {read} can be read on a photo";
    TAGS_MEND = "find-tags-mend": "they are too small in the picture, blurred or hidden: hand over the camera's own files, come nearer, or print a mat with fewer, larger tags";
}

/// Less than this of the picture does not move: nothing will come of it without a mat. By hand: not on record.
const LEAST_STILL_SHARE: f64 = 0.03;
/// The places of neighbours are a chance's unless they are nearer by so many standard deviations (derived: of a thousand
/// shuffled turns one is taken for an order).
const ORDER_SIGMAS: f64 = 3.0;
/// Exposures are uneven that differ by more than this. By hand: not on record. \[EV\]
const UNEVEN_EV: f64 = 0.25;
/// A photo is burnt, or drowned, by more than this share of it. By hand: not on record.
const LOST_SHARE: f64 = 0.1;
/// A step is a gap, or none, where it is so many times the middle one. By hand: not on record.
const STEP_FACTORS: (f64, f64) = (0.2, 2.2);
/// Photos of a full turn without a mat are at least so many. By hand: not on record.
const FEWEST_PHOTOS: usize = 12;
/// Fewer pixels than these show little. By hand: not on record. \[px\]
const LEAST_PIXELS: f64 = 0.7e6;

/// What is odd about the pictures, the worst first.
pub(crate) fn seen_in_pictures(seen: &Seen<'_>) -> Vec<Finding> {
    let mut findings = Findings {
        photos: seen.photos,
        all: vec![],
    };
    absent(seen, &mut findings);
    pictures(seen, &mut findings);
    order(seen, &mut findings);
    frame(seen, &mut findings);
    findings.all.sort_by_key(|f| f.grade as u8);
    findings.all
}

/// What is odd about what is known, the worst first.
pub(crate) fn seen_in_facts(seen: &Seen<'_>) -> Vec<Finding> {
    let mut findings = Findings {
        photos: seen.photos,
        all: vec![],
    };
    facts(seen, &mut findings);
    findings.all.sort_by_key(|f| f.grade as u8);
    findings.all
}

/// Whether photos follow each other around a turn.
fn order(seen: &Seen<'_>, findings: &mut Findings<'_>) {
    let (together, count) = (seen.together, seen.photos.photos.len());
    let tagged = seen.photos.rig.tagged();
    if !camera_is_fixed(together) {
        let grade = match together.still < LEAST_STILL_SHARE && !tagged {
            true => Grade::Hopeless,
            false => Grade::Doubt,
        };
        findings.put(
            grade,
            message!(MOVED_CAMERA, still = 100.0 * together.still),
            message!(MOVED_MEND),
            &[],
        );
        return;
    }
    if shuffled(together.neighbours, count) {
        let grade = if tagged {
            Grade::Doubt
        } else {
            Grade::Hopeless
        };
        let [top, _, left, right] = together.reached;
        // The whole picture moves: not the body turned by chance, but the camera was in a hand.
        let (what, mend) = match top && left && right {
            true => (
                message!(MOVED_CAMERA, still = 100.0 * together.still),
                message!(MOVED_MEND),
            ),
            false => (message!(OUT_OF_ORDER), message!(SHUFFLED_MEND)),
        };
        findings.put(grade, what, mend, &[]);
        return;
    }
    let inner = &together.steps[..count - 1];
    let usual = upper_median(inner).unwrap_or_default();
    let of = |f: &dyn Fn(f64) -> bool| -> Vec<usize> {
        (0..inner.len())
            .filter(|i| f(inner[*i] / usual.max(1e-9)))
            .collect()
    };
    let same = of(&|r| r < STEP_FACTORS.0);
    if !same.is_empty() {
        findings.put(Grade::Doubt, message!(SAME), message!(SAME_MEND), &same);
    }
    let wide = of(&|r| r > STEP_FACTORS.1);
    if !wide.is_empty() {
        findings.put(Grade::Doubt, message!(GAP), message!(GAP_MEND), &wide);
    }
}

/// Whether neighbours in order are no more alike than photos by chance: each of 2 (n - 1) places is then even between 0 and 1, with a
/// variance of a twelfth. Of fewer photos than a turn has, neighbours are hardly more alike than the rest.
fn shuffled(neighbours: f64, photos: usize) -> bool {
    let sigma = (1.0 / (24.0 * (photos as f64 - 1.0))).sqrt();
    photos >= FEWEST_PHOTOS && neighbours > 0.5 - ORDER_SIGMAS * sigma
}

/// Light and sharpness, photo by photo.
fn pictures(seen: &Seen<'_>, findings: &mut Findings<'_>) {
    let places = |of: &dyn Fn(usize) -> bool| -> Vec<usize> {
        (0..seen.glances.len()).filter(|i| of(*i)).collect()
    };
    // What shows no subject has fewer edges.
    let named = |i: &usize| {
        findings
            .all
            .iter()
            .any(|f| f.photos.contains(&seen.photos.photos[*i].name))
    };
    let mut blurred = blurred(seen.sharpness);
    blurred.retain(|i| !named(i));
    if !blurred.is_empty() {
        findings.put(
            Grade::Doubt,
            message!(BLURRED_PHOTO),
            message!(BLURRED_MEND),
            &blurred,
        );
    }
    for (what, share) in [
        (message!(BURNT), (|g| g.burnt) as fn(&Glance) -> f64),
        (message!(BLACK), |g| g.black),
    ] {
        // A background that is white or black by design is in all of them.
        let lost = places(&|i| share(&seen.glances[i]) > LOST_SHARE);
        if !lost.is_empty() && lost.len() < seen.glances.len() {
            findings.put(Grade::Doubt, what, message!(LOST_MEND), &lost);
        }
    }
    let ev = &seen.together.exposure_ev;
    let uneven = places(&|i| ev.get(i).is_some_and(|ev| ev.abs() > UNEVEN_EV));
    if !uneven.is_empty() && camera_is_fixed(seen.together) {
        let span = |pick: fn(f64, f64) -> f64| ev.iter().copied().reduce(pick).unwrap_or(0.0);
        findings.put(
            Grade::Doubt,
            message!(UNEVEN, low = span(f64::min), high = span(f64::max)),
            message!(UNEVEN_MEND),
            &uneven,
        );
    }
    let first = &seen.photos.photos[0];
    if f64::from(first.width) * f64::from(first.height) < LEAST_PIXELS {
        findings.put(
            Grade::Hint,
            message!(PIXELS, width = first.width, height = first.height),
            message!(PIXELS_MEND),
            &[],
        );
    }
}

/// Whether a subject that is no person is within the picture: what cuts off a person is seen photo by photo
/// (`silhouette.person`).
fn frame(seen: &Seen<'_>, findings: &mut Findings<'_>) {
    let thing = seen.people.is_some_and(|people| !people.person);
    if !thing || !camera_is_fixed(seen.together) {
        return;
    }
    let [top, _, left, right] = seen.together.reached;
    if top {
        findings.put(Grade::Doubt, message!(HEAD), message!(HEAD_MEND), &[]);
    }
    if left && right {
        findings.put(Grade::Doubt, message!(ARMS), message!(ARMS_MEND), &[]);
    }
}

/// What is known, and what would help.
fn facts(seen: &Seen<'_>, findings: &mut Findings<'_>) {
    let (rig, count) = (&seen.photos.rig, seen.photos.photos.len());
    mat(seen, findings);
    if count < FEWEST_PHOTOS && !rig.tagged() && rig.step.is_none() {
        findings.put(
            Grade::Doubt,
            message!(FEW_PHOTOS, count = count),
            message!(FEW_MEND),
            &[],
        );
    }
    if rig.focal_35mm.is_none() && rig.focal_px.is_none() && !rig.tagged() {
        findings.put(Grade::Doubt, message!(FOCAL), message!(FOCAL_MEND), &[]);
    }
    if lengths(rig).is_none() {
        findings.put(Grade::Doubt, message!(LENGTH), message!(LENGTH_MEND), &[]);
    }
    if seen.photos.plate.is_none() && camera_is_fixed(seen.together) {
        findings.put(Grade::Hint, message!(PLATE), message!(PLATE_MEND), &[]);
    }
}

/// Whether the given mat can be read.
fn mat(seen: &Seen<'_>, findings: &mut Findings<'_>) {
    let rig = &seen.photos.rig;
    let Some(tags) = seen.tags.filter(|_| rig.tagged()) else {
        return;
    };
    let mut read: Vec<usize> = tags.views.values().map(Vec::len).collect();
    read.sort_unstable();
    let read = read.get(read.len() / 2).copied().unwrap_or(0);
    let ids: BTreeSet<u32> = tags.views.values().flatten().map(|t| t.id).collect();
    let all = rig.mat.map_or(ids.len(), |mat| mat.count as usize);
    if ids.is_empty() {
        findings.put(Grade::Doubt, message!(MAT), message!(MAT_MEND), &[]);
    } else if 2 * read < all {
        // Feet hide some; where most cannot be read it is not the feet.
        findings.put(
            Grade::Doubt,
            message!(TAGS, all = all, read = read),
            message!(TAGS_MEND),
            &[],
        );
    }
}

#[cfg(test)]
#[path = "odd_tests.rs"]
mod tests;
