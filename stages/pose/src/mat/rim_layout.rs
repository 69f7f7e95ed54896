//! What is printed for the disk's rim: a strip of upright tags, cut into pieces that fit a page.

use crate::mat::layout::{LayoutError, Mark, black};
use shape::Rim;
use shape::tag36h11::TAGS;

/// White to each side of a tag, at least, as a share of its size: one module (structural: one of eight modules).
const MARGIN: f64 = 0.125;
/// A tag spans at most this share of the disk's radius, so that it is not seen too round (structural: a print's
/// layout). Its middle is then 1.5 % of the radius before its edges (derived: 1 − cos 0.175).
const WIDEST_TAG_SHARE: f64 = 0.35;
/// Most tags that are chosen where no number is given (structural: the print's layout).
const ENOUGH: u32 = 48;
/// What is left of paper behind a piece, to glue the next one on (structural: the print's layout). \[mm\]
const TAB: f64 = 8.0;

/// A piece of the strip; its lower left corner at (0, 0).
#[derive(Debug, Clone, PartialEq)]
pub struct Piece {
    /// What is printed.
    pub marks: Vec<Mark>,
    /// Width, with the tab at its right, and height, with the words above. \[mm\]
    pub size_mm: [f64; 2],
}

/// The strip for a disk: tags as tall as its rim allows, as many as go around it. A tag size or
/// count of 0 is chosen.
///
/// # Errors
///
/// Tags under 5 mm, taller than the rim or wider than its roundness allows; fewer than three or more than go around it; numbers
/// beyond the family.
pub fn rim_for(
    disk_mm: f64,
    thick_mm: f64,
    tag_mm: f64,
    count: u32,
    first_id: u32,
) -> Result<Rim, LayoutError> {
    let radius_mm = disk_mm / 2.0;
    let tallest = thick_mm / (1.0 + 2.0 * MARGIN);
    let chosen = (tallest.min(WIDEST_TAG_SHARE * radius_mm) * 2.0).floor() / 2.0;
    let tag_mm = if tag_mm > 0.0 { tag_mm } else { chosen };
    if tag_mm < 5.0 || tag_mm > tallest + 1e-9 || tag_mm > WIDEST_TAG_SHARE * radius_mm {
        return Err(LayoutError::Thin { tag_mm, thick_mm });
    }
    let around = std::f64::consts::TAU * radius_mm;
    let most = (around / (tag_mm * (1.0 + 2.0 * MARGIN))).floor() as u32;
    let left = TAGS.saturating_sub(first_id);
    let count = if count > 0 {
        count
    } else {
        most.min(ENOUGH).min(left)
    };
    if count < 3 || count > most {
        return Err(LayoutError::CrowdedRim { count, most });
    }
    if count > left {
        return Err(LayoutError::Beyond(first_id + count - 1));
    }
    Ok(Rim {
        tag_mm,
        first_id,
        count,
        radius_mm,
    })
}

/// `capture.toml` on a strip.
pub fn rim_toml(rim: &Rim) -> String {
    let last = rim.first_id + rim.count - 1;
    format!(
        "[rim]\nfamily = \"tag36h11\"\ntag_size_mm = {:.1}\nids = [{}, {last}]\ncount = {}\nradius_mm = {:.1}\n",
        rim.tag_mm, rim.first_id, rim.count, rim.radius_mm
    )
}

/// The strip in pieces of at most this width; each is cut along its outline, and the next is glued
/// onto its tab.
pub fn rim_pieces(rim: &Rim, thick_mm: f64, widest_mm: f64) -> Vec<Piece> {
    let pitch = std::f64::consts::TAU * rim.radius_mm / f64::from(rim.count);
    let a_piece = (((widest_mm - TAB) / pitch) as u32).max(1);
    let of = rim.count.div_ceil(a_piece);
    let words = (pitch * 0.1).clamp(2.0, 3.5);
    let piece = |k: u32| {
        let (from, to) = (k * a_piece, ((k + 1) * a_piece).min(rim.count));
        let width = f64::from(to - from) * pitch;
        let whole = width + TAB;
        let mut marks = vec![
            Mark::Line(vec![
                [0.0, 0.0],
                [whole, 0.0],
                [whole, thick_mm],
                [0.0, thick_mm],
                [0.0, 0.0],
            ]),
            Mark::Line(vec![[width, 0.0], [width, thick_mm]]),
            Mark::Words(
                [0.0, thick_mm + 1.0],
                words,
                format!(
                    "rim, piece {} of {of}, this edge up: tags {} to {}; cut along the line, glue the next piece onto the tab at the right",
                    k + 1,
                    rim.first_id + from,
                    rim.first_id + to - 1
                ),
            ),
        ];
        for i in from..to {
            let left = (f64::from(i - from) + 0.5) * pitch - rim.tag_mm / 2.0;
            let low = (thick_mm - rim.tag_mm) / 2.0;
            marks.extend(tag(rim.first_id + i, [left, low], rim.tag_mm));
        }
        Piece {
            marks,
            size_mm: [whole, thick_mm + 1.5 + words],
        }
    };
    (0..of).map(piece).collect()
}

/// An upright tag's black modules.
fn tag(id: u32, [left, low]: [f64; 2], size_mm: f64) -> Vec<Mark> {
    let module = size_mm / 8.0;
    let corner = |[c, r]: [usize; 2]| [left + c as f64 * module, low + (8 - r) as f64 * module];
    let fill = |around: [[usize; 2]; 4]| Mark::Fill(around.map(corner).into(), 0.0);
    black(id)
        .unwrap_or_default()
        .into_iter()
        .map(fill)
        .collect()
}
