//! What is odd about the people on the photos of a turn, by photo.

use crate::same::present;
use crate::turn::Followed;
use shape::{Edge, Found, PhotoId, Photos, some_photos};
use stage::{Field, Message, Template};
use std::f32::consts::FRAC_PI_4;

stage::messages! {
    NOBODY = "warn-nobody": "nobody is seen on {names}, though the other photos show a person: is it the empty scene, or does something hide the person? Take it again, or leave it out";
    SEVERAL = "warn-several": "more than one person is seen on {names}: only the one who turns is measured; take such photos again without anybody else, mirrors, or pictures of people";
    CUT_UPPER = "warn-cut-upper": "the body is cut off at the upper edge of {names}: keep the whole person in view, with a margin above the head";
    CUT_LOWER = "warn-cut-lower": "the body is cut off at the lower edge of {names}: keep the whole person in view, with a margin below the feet";
    CUT_SIDE = "warn-cut-side": "the body is cut off at the left or right edge of {names}: keep the whole person in view, with a margin beside the arms";
    UPSIDE_DOWN = "warn-upside-down": "the person is upside down on {names}: turn such photos, or photograph the person upright";
    ON_SIDE = "warn-on-side": "the person is on the side on {names}: turn such photos, or photograph the person upright";
}

/// What the user should know of a turn that shows a person; of who is followed, the first on each photo.
pub(crate) fn odd(Followed { views, beside, .. }: &Followed, photos: &Photos) -> Vec<Message> {
    let first = |f: &[Found]| f.first().filter(|f| present(f)).cloned();
    let names = |odd: &dyn Fn(&[Found], [u32; 2]) -> bool| {
        let of = |(id, photo): (PhotoId, &shape::Photo)| {
            let found = views.get(id).map_or(&[][..], Vec::as_slice);
            odd(found, [photo.width, photo.height]).then(|| photo.name.clone())
        };
        some_photos(&photos.iter().filter_map(of).collect::<Vec<_>>())
    };
    let nobody = names(&|found, _| first(found).is_none());
    let name = |id: &PhotoId| photos.get(*id).map(|photo| photo.name.clone());
    let several = some_photos(&beside.iter().filter_map(name).collect::<Vec<_>>());
    let cut = |edge: Edge| {
        names(&|found, size| first(found).is_some_and(|f| f.edges(size).contains(&edge)))
    };
    let turned = |over: bool| {
        names(&|found, _| {
            let angle = first(found).map_or(0.0, |f| f.crop.angle.abs());
            angle > FRAC_PI_4 && (angle > 3.0 * FRAC_PI_4) == over
        })
    };
    let kinds = [
        (NOBODY, nobody),
        (SEVERAL, several),
        (CUT_UPPER, cut(Edge::Upper)),
        (CUT_LOWER, cut(Edge::Lower)),
        (CUT_SIDE, cut(Edge::Side)),
        (UPSIDE_DOWN, turned(true)),
        (ON_SIDE, turned(false)),
    ];
    let warning =
        |(kind, names): (Template, Option<Field>)| Some(Message::new(&kind, [("names", names?)]));
    kinds.into_iter().filter_map(warning).collect()
}
