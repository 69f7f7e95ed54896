//! Images side by side: silhouettes on their photos, surfaces as the cameras saw them, and what
//! is different between them.

use super::render::render;
use super::side::Side;
use super::views::View;
use base64::prelude::{BASE64_STANDARD, Engine as _};
use io::mask_on_photo;
use serde_json::{Value, json};
use shape::{Camera, Mask, Mesh, Rgb, rgb_to_jpeg};
use std::collections::BTreeMap;

/// Most photos on the page, evenly spaced over the turn.
const MOST_PHOTOS: usize = 12;
/// Width of a picture. \[px\]
const ACROSS: usize = 300;
/// Inside and outside, as in the view of the surfaces. \[sRGB\]
const BLUE: [u8; 3] = [26, 89, 217];
const ORANGE: [u8; 3] = [224, 89, 13];

/// A surface for pictures, and how far each vertex is from the first side's. \[mm\]
pub(super) struct Surface<'a> {
    pub(super) side: &'a str,
    pub(super) mesh: Mesh,
    pub(super) distances: Vec<f64>,
}

/// Pictures of a page: each once, however often it is shown.
#[derive(Default)]
struct Album {
    uris: Vec<String>,
    known: BTreeMap<Vec<u8>, usize>,
}

impl Album {
    fn add(&mut self, picture: &Rgb) -> usize {
        let jpeg = rgb_to_jpeg(picture, 78);
        let next = self.uris.len();
        *self.known.entry(jpeg).or_insert_with_key(|jpeg| {
            self.uris.push(format!(
                "data:image/jpeg;base64,{}",
                BASE64_STANDARD.encode(jpeg)
            ));
            next
        })
    }
}

/// For the page: `uris`, and for each photo the number of the picture of each side and of what
/// is different about each side but the first; null where there is none. Photos stay off the page
/// if they are not to be shown; surfaces are coloured fully at `full_mm`.
pub(super) fn pictures(
    sides: &[Side],
    surfaces: &[Surface<'_>],
    show_photos: bool,
    full_mm: f64,
) -> Value {
    let mut names: Vec<&String> = sides.iter().flat_map(|s| s.views.keys()).collect();
    names.sort();
    names.dedup();
    let most = names.len().min(MOST_PHOTOS);
    let chosen = (0..most).map(|i| names[i * names.len() / most]);
    let mut album = Album::default();
    let mut rows = Vec::new();
    for name in chosen {
        let views: Vec<Option<&View>> = sides.iter().map(|s| s.views.get(name)).collect();
        let masks: Vec<Option<&Mask>> = views.iter().map(|v| v.as_ref()?.mask.as_ref()).collect();
        let mut row = json!({ "name": name, "masks": [], "masks_apart": [], "surfaces": [], "surfaces_apart": [] });
        for (i, (side, view)) in sides.iter().zip(&views).enumerate() {
            let cut = view.and_then(|view| cut_out(view, show_photos));
            push(&mut row["masks"], cut.map(|p| album.add(&p)));
            let surface = surfaces.iter().find(|s| s.side == side.name);
            let camera = view.and_then(|v| v.camera).map(|c| small(&c));
            let seen = surface.zip(camera);
            let plain = seen.map(|(s, c)| render(&s.mesh, &c, &|_| [0.80, 0.74, 0.68]));
            push(&mut row["surfaces"], plain.map(|p| album.add(&p)));
            if i == 0 {
                continue;
            }
            let apart = masks[0].zip(masks[i]).and_then(|(a, b)| apart(a, b));
            let row_of = apart.map(|(p, iou)| json!({ "picture": album.add(&p), "iou": iou }));
            push(&mut row["masks_apart"], row_of);
            let colored =
                seen.map(|(s, c)| render(&s.mesh, &c, &|v| color(s.distances[v], full_mm)));
            push(&mut row["surfaces_apart"], colored.map(|p| album.add(&p)));
        }
        rows.push(row);
    }
    json!({ "uris": album.uris, "photos": rows, "sides": sides.iter().map(|s| &s.name).collect::<Vec<_>>() })
}

fn push(list: &mut Value, item: Option<impl Into<Value>>) {
    let list = list.as_array_mut().expect("bug: no list");
    list.push(item.map_or(Value::Null, Into::into));
}

/// The camera of a picture.
fn small(camera: &Camera) -> Camera {
    let (w, h) = (camera.lens.width.max(1), camera.lens.height);
    let height = (u64::from(h) * ACROSS as u64).div_ceil(u64::from(w)).max(1);
    camera.resized(ACROSS as u32, height as u32)
}

/// The silhouette on its photo; on gray where there is no photo, or none is to be shown. A photo
/// that cannot be decoded is none.
fn cut_out(view: &View, show_photos: bool) -> Option<Rgb> {
    let photo = view.photo.as_ref().filter(|_| show_photos);
    let photo = photo.and_then(|p| p.decode().ok());
    let gray = |m: &Mask| Rgb::filled(m.width, m.height, [210; 3]);
    let photo = photo.or_else(|| view.mask.as_ref().map(gray))?;
    // Without a silhouette nothing is darkened.
    let whole = Mask::filled(photo.width, photo.height, 255);
    let mask = view.mask.as_ref().unwrap_or(&whole);
    Some(mask_on_photo(&photo, Some(mask), ACROSS))
}

/// Where two silhouettes differ, orange outside of the first, blue inside; and their overlap, as
/// a share of what either covers. `None` if they are not of one size.
fn apart(a: &Mask, b: &Mask) -> Option<(Rgb, f64)> {
    if (a.width, a.height) != (b.width, b.height) || a.width == 0 || a.height == 0 {
        return None;
    }
    let inside = |m: &Mask, i: usize| m.data[i] > 127;
    let count = |f: &dyn Fn(bool, bool) -> bool| {
        (0..a.data.len())
            .filter(|i| f(inside(a, *i), inside(b, *i)))
            .count()
    };
    let (both, either) = (count(&|a, b| a && b), count(&|a, b| a || b));
    let height = (a.height * ACROSS).div_ceil(a.width).max(1);
    let mut picture = Rgb::filled(ACROSS, height, [233, 234, 236]);
    // A picture's pixel shows a difference if any pixel below it has one.
    for (i, _) in a.data.iter().enumerate() {
        let (x, y) = (
            i % a.width * ACROSS / a.width,
            i / a.width * height / a.height,
        );
        let pixel = picture.at_mut(x, y);
        match (inside(a, i), inside(b, i)) {
            (false, true) => *pixel = ORANGE,
            (true, false) => *pixel = BLUE,
            (true, true) if *pixel != ORANGE && *pixel != BLUE => *pixel = [190, 190, 194],
            _ => {}
        }
    }
    Some((picture, both as f64 / either.max(1) as f64))
}

/// White where nothing is different, orange outside, blue inside, as in the view.
fn color(distance: f64, full_mm: f64) -> [f32; 3] {
    let t = (distance / full_mm).clamp(-1.0, 1.0) as f32;
    let full = if t < 0.0 { BLUE } else { ORANGE };
    full.map(|c| 0.93 + (f32::from(c) / 255.0 - 0.93) * t.abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_two_silhouettes_do_not_share_is_coloured_and_counted() {
        let mut a = Mask::filled(600, 300, 0);
        let mut b = a.clone();
        for y in 0..300 {
            (100..300).for_each(|x| *a.at_mut(x, y) = 255);
            (200..400).for_each(|x| *b.at_mut(x, y) = 255);
        }
        let (picture, iou) = apart(&a, &b).unwrap();
        assert_eq!((picture.width, picture.height), (300, 150));
        proof::near(iou, 1.0 / 3.0, 1e-12);
        let at = |x: usize| picture.at(x, 70);
        assert_eq!([at(75), at(125), at(175)], [BLUE, [190, 190, 194], ORANGE]);
        assert!(apart(&a, &Mask::filled(300, 600, 0)).is_none());
        assert_eq!(color(0.0, 3.0), [0.93; 3]);
        assert!(color(9.0, 3.0)[0] > 0.8 && color(-9.0, 3.0)[2] > 0.8);
    }
}
