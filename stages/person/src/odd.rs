//! What is odd about the people on the photos of a turn, by photo.

use crate::same::present;
use crate::turn::Followed;
use shape::{Edge, Found, PhotoId, Photos};
use std::f32::consts::FRAC_PI_4;

/// What the user should know of a turn that shows a person; of who is followed, the first on each photo.
pub(crate) fn odd(Followed { views, beside, .. }: &Followed, photos: &Photos) -> Vec<String> {
    let first = |f: &[Found]| f.first().filter(|f| present(f)).cloned();
    let names = |odd: &dyn Fn(&[Found], [u32; 2]) -> bool| {
        let of = |(id, photo): (PhotoId, &shape::Photo)| {
            let found = views.get(id).map_or(&[][..], Vec::as_slice);
            odd(found, [photo.width, photo.height]).then(|| photo.name.clone())
        };
        some(photos.iter().filter_map(of).collect())
    };
    let nobody = names(&|found, _| first(found).is_none());
    let name = |id: &PhotoId| photos.get(*id).map(|photo| photo.name.clone());
    let several = some(beside.iter().filter_map(name).collect());
    let cut = |edge: Edge| {
        names(&|found, size| first(found).is_some_and(|f| f.edges(size).contains(&edge)))
    };
    let turned = |over: bool| {
        names(&|found, _| {
            let angle = first(found).map_or(0.0, |f| f.crop.angle.abs());
            angle > FRAC_PI_4 && (angle > 3.0 * FRAC_PI_4) == over
        })
    };
    let mut told = Vec::new();
    if let Some(names) = nobody {
        told.push(format!("nobody is seen on {names}, though the other photos show a person: is it the empty scene, or does something hide the person? Take it again, or leave it out"));
    }
    if let Some(names) = several {
        told.push(format!("more than one person is seen on {names}: only the one who turns is measured; take such photos again without anybody else, mirrors, or pictures of people"));
    }
    if let Some(names) = cut(Edge::Upper) {
        told.push(format!("the body is cut off at the upper edge of {names}: keep the whole person in view, with a margin above the head"));
    }
    if let Some(names) = cut(Edge::Lower) {
        told.push(format!("the body is cut off at the lower edge of {names}: keep the whole person in view, with a margin below the feet"));
    }
    if let Some(names) = cut(Edge::Side) {
        told.push(format!("the body is cut off at the left or right edge of {names}: keep the whole person in view, with a margin beside the arms"));
    }
    if let Some(names) = turned(true) {
        told.push(format!(
            "the person is upside down on {names}: turn such photos, or stand upright"
        ));
    }
    if let Some(names) = turned(false) {
        told.push(format!(
            "the person lies on the side on {names}: turn such photos, or stand upright"
        ));
    }
    told
}

/// Names of photos, the first few.
pub(crate) fn some(names: Vec<String>) -> Option<String> {
    match names.len() {
        0 => None,
        1..=5 => Some(names.join(", ")),
        more => Some(format!("{}, … ({more} photos)", names[..3].join(", "))),
    }
}
