//! All masks of a turn on one picture: at a glance a person sees which one went wrong, and where.

use crate::lettering::{text_size, write_on};
use crate::odd_masks::odd;
use shape::{Mask, MaskRuns, Masks, PhotoError, Photos, Rgb};

/// Width of a photo on the sheet (structural: layout). \[px\]
const TILE: usize = 320;
/// Photos side by side (structural: layout).
const ACROSS: usize = 6;
/// Pixels along the side of a letter's dot (structural: layout).
const DOT: usize = 3;
/// Width of the frame around a photo with something odd (structural: layout). \[px\]
const FRAME: usize = 5;
/// What is odd (structural: a colour). \[sRGB\]
const ODD: [u8; 3] = [255, 70, 70];
/// The mask's border (structural: a colour). \[sRGB\]
const LINE: [u8; 3] = [255, 64, 32];

/// The photos in turning order, six a row, 320 px wide each: what the mask leaves out is darkened,
/// its border drawn. A photo without a mask is all dark. Each bears its name; where a mask is odd
/// (`odd`) it is framed and named.
///
/// # Errors
/// A photo that cannot be decoded.
pub fn masks_to_sheet(masks: &Masks, photos: &Photos) -> Result<Rgb, PhotoError> {
    let mut tiles = Vec::new();
    let all: Vec<Option<&MaskRuns>> = photos.iter().map(|(id, _)| masks.views.get(id)).collect();
    for (((_, photo), mask), odd) in photos.iter().zip(&all).zip(odd(&all)) {
        let mut tile = mask_on_photo(&photo.decode()?, mask.map(MaskRuns::pixels).as_ref(), TILE);
        if !odd.is_empty() {
            framed(&mut tile);
        }
        write_on(&mut tile, (0, 0), DOT, [255; 3], &photo.name);
        for (line, what) in odd.iter().enumerate() {
            let top = (line + 1) * text_size("", DOT).1;
            write_on(&mut tile, (0, top), DOT, ODD, what);
        }
        tiles.push(tile);
    }
    let tall = tiles.iter().map(|t| t.height).max().unwrap_or(1);
    let rows = tiles.len().div_ceil(ACROSS).max(1);
    let mut sheet = Rgb::filled(TILE * ACROSS.min(tiles.len().max(1)), tall * rows, [0; 3]);
    for (i, tile) in tiles.iter().enumerate() {
        let (left, top) = (i % ACROSS * TILE, i / ACROSS * tall);
        for y in 0..tile.height {
            let at = (top + y) * sheet.width + left;
            sheet.data[at..at + TILE].copy_from_slice(tile.row(y));
        }
    }
    Ok(sheet)
}

fn framed(tile: &mut Rgb) {
    let (w, h) = (tile.width, tile.height);
    for (i, pixel) in tile.data.iter_mut().enumerate() {
        let (x, y) = (i % w, i / w);
        if x.min(w - 1 - x).min(y).min(h - 1 - y) < FRAME {
            *pixel = ODD;
        }
    }
}

/// A photo, so many pixels wide: what the mask leaves out is darkened, its border drawn.
pub fn mask_on_photo(photo: &Rgb, mask: Option<&Mask>, across: usize) -> Rgb {
    let height = (photo.height * across).div_ceil(photo.width.max(1)).max(1);
    // The pixel of the photo that a pixel of the tile shows.
    let from =
        |v: usize, tile: usize, whole: usize| ((2 * v + 1) * whole / (2 * tile)).min(whole - 1);
    let body = |x: usize, y: usize| {
        mask.is_some_and(|m| {
            let (mx, my) = (from(x, across, m.width), from(y, height, m.height));
            m.at(mx, my) > 127
        })
    };
    let mut tile = Rgb::filled(across, height, [0; 3]);
    for y in 0..height {
        for x in 0..across {
            let here = body(x, y);
            let edge = [(x + 1, y), (x, y + 1)]
                .iter()
                .any(|(nx, ny)| *nx < across && *ny < height && body(*nx, *ny) != here);
            let color = photo.at(from(x, across, photo.width), from(y, height, photo.height));
            *tile.at_mut(x, y) = match (edge, here) {
                (true, _) => LINE,
                (false, true) => color,
                (false, false) => color.map(|c| c / 3),
            };
        }
    }
    tile
}

#[cfg(test)]
mod tests {
    use super::*;
    use shape::{Photo, PhotoId, rgb_to_png};

    #[test]
    fn a_sheet_darkens_what_is_no_body_and_draws_the_border() {
        let photo = |name: &str| {
            Photo::of(
                name,
                [640, 320],
                rgb_to_png(&Rgb::filled(640, 320, [90, 120, 150])),
            )
        };
        let photos = Photos {
            photos: (0..7).map(|i| photo(&format!("{i}.png"))).collect(),
            ..Photos::default()
        };
        let mut mask = Mask::filled(640, 320, 0);
        (0..640 * 160).for_each(|i| mask.data[i] = 255);
        let masks = Masks::from_iter([(PhotoId(6), mask)]);
        let sheet = masks_to_sheet(&masks, &photos).unwrap();
        assert_eq!((sheet.width, sheet.height), (6 * 320, 2 * 160));
        assert_eq!(sheet.at(90, 90), [30, 40, 50], "a photo without a mask");
        assert_eq!(sheet.at(1, 90), ODD, "framed");
        assert_eq!(sheet.at(290, 160 + 60), [90, 120, 150], "body");
        assert_eq!(sheet.at(290, 160 + 79), LINE);
        assert_eq!(sheet.at(290, 160 + 140), [30, 40, 50], "background");
        // Names are in the corner.
        let lit = (0..20 * 20).filter(|i| sheet.at(i % 20, i / 20) == [255; 3]);
        assert!(lit.count() > 20);
    }
}
