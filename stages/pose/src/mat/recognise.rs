//! The layout of a mat from its tags in photos alone: how many there are, and how wide their ring is against a
//! tag's size.
//!
//! Two tags of one photo show, by the homography of the one, how far the other is turned against it and how
//! far away it is: 360° by the first is the count, the second over twice the sine of half of it the radius.
//! The radius that fits all tags of all photos best refines it; a mat of `tailor mat` has a ring of whole
//! millimetres and, as a rule, tags of whole fives of them.

use crate::mat::bloom::outward;
use crate::mat::layout::mat_for;
use crate::mat::planar::homography;
use nalgebra::{Matrix3, Vector2, Vector3};
use shape::{Mat, Tag, Tags, upper_median};
use stage::{Message, message};
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;

stage::messages! {
    FOUND = "warn-mat-known": "the mat was recognised: {count} tags, numbers {first} to {last}, on a ring with a radius of {radius:.1 mm}";
    ABOUT = "warn-mat-about": "the mat was recognised: {count} tags, numbers {first} to {last}, on a ring with a radius of {radius:.1 mm}, to within {open:.0 mm} ({share:.2 %} of all lengths): measure it from the middle to a tag's middle and give --mat-ring and --mat-ids {first}-{last}, or hand over the mat's file with --mat";
    ODD_RING = "warn-mat-odd": "the tags are on a ring with a radius of {radius:.1 mm} if they are {tag} mm wide, and `tailor mat` lays out none like that: measure a printed tag again, or describe the mat in `[mat]` of capture.toml; the tags are not used";
    OTHER = "warn-mat-other": "the tags in the photos are those of another mat than is given: {count} go around, numbers {first} to {last}, on a ring of {ring:.2} times a tag's size; given are {given}, from number {from}, on {wide:.2} times";
    NO_RING = "warn-mat-no-ring": "the tags in the photos are not on a ring as a mat of `tailor mat` has them: describe the mat in `[mat]` of capture.toml; the tags are not used";
}

/// A ring of tags.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ringed {
    /// The least number seen.
    pub first_id: u32,
    /// How many tags go around.
    pub count: u32,
    /// Radius of the ring through their centres, in edge lengths of a tag.
    pub ring: f64,
}

/// A tag's corners in its own plane, its edge 1, y outward: as [`Tag::corners`] (structural).
const SQUARE: [[f64; 2]; 4] = [[-0.5, 0.5], [0.5, 0.5], [0.5, -0.5], [-0.5, -0.5]];
/// Pixels are brought to the order of 1 by this (structural: a unit).
const PX: f64 = 1e-3;
/// What photos show of ring against tag is within this of what was printed. By hand: looked at on rendered captures
/// through a lens that distorts, where it is 0.6 to 1.9 ‰ off.
const RING_SHARE: f64 = 0.0025;
/// Nominal and printed size of a tag agree within this: printers shrink pages. By hand: looked at three captures,
/// halved and doubled: nothing changes, for all have the mat that was given (docs/lab/numbers.md).
const PRINTED_SHARE: f64 = 0.03;
/// Most photos that are looked at for the ring's radius (structural: more of them only take longer).
const PHOTOS: usize = 12;
/// Sides of tags are shifted by ink and light less than this (structural: where a search ends; what is looked for is
/// within). \[px\]
const BLOOM_PX: f64 = 0.5;

/// The plane's place that a homography from a picture gives for a pixel.
fn place(h: &Matrix3<f64>, px: [f64; 2]) -> Vector2<f64> {
    let p = h * Vector3::new(px[0] * PX, px[1] * PX, 1.0);
    Vector2::new(p.x / p.z, p.y / p.z)
}

/// Angle and distance of the next tag as a tag sees it. \[rad, edge lengths\]
fn next(tag: &Tag, other: &Tag) -> Option<(f64, f64)> {
    let seen = tag.corners.map(|c| c.map(|x| x * PX));
    let pairs: Vec<_> = SQUARE.into_iter().zip(seen).collect();
    let back = homography(&pairs)?.try_inverse()?;
    let at = other.corners.map(|c| place(&back, c));
    let right = at[1] - at[0] + at[2] - at[3];
    let middle = (at[0] + at[1] + at[2] + at[3]) / 4.0;
    Some((libm::atan2(right.y, right.x), middle.norm()))
}

/// The ring that most neighbours agree on; tags that belong to none, such as those of a strip on the rim, take
/// no part. `None` where no four neighbours give one.
pub fn ringed(tags: &Tags) -> Option<Ringed> {
    let mut by_tag: BTreeMap<u32, Vec<(f64, f64)>> = BTreeMap::new();
    for seen in tags.views.values() {
        for pair in seen.windows(2).filter(|w| w[1].id == w[0].id + 1) {
            by_tag
                .entry(pair[0].id)
                .or_default()
                .extend(next(&pair[0], &pair[1]));
        }
    }
    // Of each pair of neighbours: the count that it leads to, and the radius.
    let mut votes: BTreeMap<u32, Vec<(u32, f64)>> = BTreeMap::new();
    for (id, seen) in by_tag.iter().filter(|(_, seen)| seen.len() > 1) {
        let turn = upper_median(seen.iter().map(|s| s.0)).unwrap_or_default();
        let far = upper_median(seen.iter().map(|s| s.1)).unwrap_or_default();
        let count = TAU / turn;
        if (3.0..100.0).contains(&count) && (count - count.round()).abs() < 0.3 {
            let ring = far / (2.0 * libm::sin(turn / 2.0));
            votes
                .entry(count.round() as u32)
                .or_default()
                .push((*id, ring));
        }
    }
    let (count, agreed) = votes.into_iter().max_by_key(|(_, v)| v.len())?;
    let ids: BTreeSet<u32> = agreed.iter().flat_map(|(id, _)| [*id, id + 1]).collect();
    let (first, last) = (*ids.first()?, *ids.last()?);
    if agreed.len() < 3 || last - first >= count {
        return None;
    }
    let rough = upper_median(agreed.into_iter().map(|(_, ring)| ring)).unwrap_or_default();
    let ring = fitted(tags, first, count, rough)?;
    Some(Ringed {
        first_id: first,
        count,
        ring,
    })
}

/// Tags of one photo: which, their corners, and how these move when each side moves outward by a pixel. \[px\]
type Seen = Vec<(u32, [Vector2<f64>; 4], [Vector2<f64>; 4])>;

/// How far the tags of some photos are from where a ring of this radius has them, homographies fitted to
/// each, all sides brought in by `bloom_px`. \[1000 px, squared\]
fn misfit(photos: &[Seen], count: u32, ring: f64, bloom_px: f64) -> Option<f64> {
    let mut squares = 0.0;
    for tags in photos {
        let mut pairs = Vec::new();
        for (place, corners, out) in tags {
            let (sin, cos) = libm::sincos(f64::from(*place) * TAU / f64::from(count));
            for (([x, y], px), out) in SQUARE.into_iter().zip(corners).zip(out) {
                let far = ring + y;
                let on_mat = [far * cos + x * sin, far * sin - x * cos];
                pairs.push((on_mat, ((px - out * bloom_px) * PX).into()));
            }
        }
        let h = homography(&pairs)?;
        let off = |(plane, px): &([f64; 2], [f64; 2])| {
            let p = h * Vector3::new(plane[0], plane[1], 1.0);
            (p.x / p.z - px[0]).powi(2) + (p.y / p.z - px[1]).powi(2)
        };
        squares += pairs.iter().map(off).sum::<f64>() / pairs.len() as f64;
    }
    Some(squares)
}

/// The least of a function between two places, to a part of their distance: golden section.
fn least(
    low: f64,
    high: f64,
    part: f64,
    mut cost: impl FnMut(f64) -> Option<f64>,
) -> Option<(f64, f64)> {
    let share = (5f64.sqrt() - 1.0) / 2.0;
    let (mut low, mut high, near) = (low, high, part * (high - low));
    while high - low > near {
        let (a, b) = (high - share * (high - low), low + share * (high - low));
        match cost(a)? < cost(b)? {
            true => high = b,
            false => low = a,
        }
    }
    let at = (low + high) / 2.0;
    Some((at, cost(at)?))
}

/// What the photos show where it is another mat than the given one.
pub(crate) fn another(tags: &Tags, given: &Mat) -> Option<Message> {
    let seen = ringed(tags)?;
    let wide = given.ring_mm / given.tag_mm;
    let ids = given.first_id..given.first_id + given.count;
    let same = seen.count == given.count
        && ids.contains(&seen.first_id)
        && (seen.ring / wide - 1.0).abs() < PRINTED_SHARE;
    if same {
        return None;
    }
    let last = tags.views.values().flatten().map(|tag| tag.id).max()?;
    Some(message!(
        OTHER,
        count = seen.count,
        first = seen.first_id,
        last = last,
        ring = seen.ring,
        given = given.count,
        from = given.first_id,
        wide = wide
    ))
}

/// The radius that fits best near a rough one, together with how far ink and light shift the sides of all
/// tags: tags seen at a slant are too tall by it more than too wide.
fn fitted(tags: &Tags, first: u32, count: u32, rough: f64) -> Option<f64> {
    let one = |t: &Tag| {
        let place = t.id.checked_sub(first).filter(|p| *p < count)?;
        Some((place, t.corners.map(Vector2::from), outward(&t.corners)))
    };
    let views = tags.views.values();
    let photos = views.map(|v| v.iter().filter_map(one).collect::<Seen>());
    let photos: Vec<_> = photos.filter(|v| v.len() >= 3).take(PHOTOS).collect();
    if photos.is_empty() {
        return None;
    }
    let best = |bloom_px: f64| {
        least(0.95 * rough, 1.05 * rough, 1e-3, |ring| {
            misfit(&photos, count, ring, bloom_px)
        })
    };
    let bloom = least(-BLOOM_PX, BLOOM_PX, 5e-3, |b| Some(best(b)?.1))?.0;
    Some(best(bloom)?.0)
}

/// The mat of `tailor mat` that a ring is, its tags' edge as measured on the print, and how far its radius may be
/// off \[mm\]. `None` where it is none.
fn as_printed(ring: &Ringed, tag_mm: f64, disk_mm: Option<f64>) -> Option<(Mat, f64)> {
    // As it was laid out: tags of whole fives of millimetres, or of a size that was asked for.
    let fives = (tag_mm / 5.0).round() * 5.0;
    let near = |nominal: &f64| *nominal > 0.0 && (tag_mm / nominal - 1.0).abs() < PRINTED_SHARE;
    let nominals = [fives, tag_mm.round(), tag_mm].into_iter().filter(near);
    let fits =
        |ring_mm: f64, nominal: f64| (ring_mm / nominal / ring.ring - 1.0).abs() < RING_SHARE;
    let mat = |ring_mm: f64, nominal: f64| Mat {
        tag_mm,
        first_id: ring.first_id,
        count: ring.count,
        ring_mm: ring_mm * tag_mm / nominal,
    };
    for nominal in nominals.clone() {
        // The disk that it was laid out for gives the radius.
        let laid = disk_mm.and_then(|d| mat_for(d, nominal, ring.count, ring.first_id).ok());
        if let Some(laid) = laid.filter(|m| fits(m.ring_mm, nominal)) {
            return Some((mat(laid.ring_mm, nominal), 0.0));
        }
    }
    for nominal in nominals {
        let ring_mm = (ring.ring * nominal).round();
        if fits(ring_mm, nominal) {
            // Neighbouring millimetres may fit as well.
            let open = if RING_SHARE * ring_mm > 0.5 { 1.0 } else { 0.0 };
            return Some((mat(ring_mm, nominal), open));
        }
    }
    None
}

/// The mat of `tailor mat` in the photos, by its tags' size and perhaps the disk's diameter.
pub(crate) fn printed(tags: &Tags, tag_mm: f64, disk_mm: Option<f64>) -> Option<Mat> {
    Some(as_printed(&ringed(tags)?, tag_mm, disk_mm)?.0)
}

/// The mat in the photos, where nothing but its tags' size is known, and perhaps the disk's diameter; reports what was
/// recognised, or why not.
pub fn recognised(
    tags: &Tags,
    tag_mm: f64,
    disk_mm: Option<f64>,
    report: impl Fn(Message),
) -> Option<Mat> {
    let ring = ringed(tags);
    let mat = ring.and_then(|ring| as_printed(&ring, tag_mm, disk_mm));
    match (ring, mat) {
        (_, Some((mat, open_mm))) => {
            let last = mat.first_id + mat.count - 1;
            let (count, first, radius) = (mat.count, mat.first_id, mat.ring_mm);
            report(match open_mm > 0.0 {
                true => message!(
                    ABOUT,
                    count = count,
                    first = first,
                    last = last,
                    radius = radius,
                    open = open_mm,
                    share = 100.0 * open_mm / mat.ring_mm
                ),
                false => message!(
                    FOUND,
                    count = count,
                    first = first,
                    last = last,
                    radius = radius
                ),
            });
        }
        (Some(ring), None) => {
            let radius = ring.ring * tag_mm;
            report(message!(ODD_RING, radius = radius, tag = tag_mm));
        }
        (None, None) => report(message!(NO_RING)),
    }
    mat.map(|(mat, _)| mat)
}
