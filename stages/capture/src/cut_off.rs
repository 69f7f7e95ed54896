//! Whether the photos cut off the feet.

use crate::verdict::{Finding, Grade};
use shape::{Edge, People, Photos};
use stage::message;

stage::messages! {
    FEET = "find-feet": "the body is cut off at the lower edge";
    KEEP_FEET = "find-feet-mend": "keep the whole person in view, with a margin below the feet: without feet heights are unknown, and no girth is given";
}

/// Feet that most photos cut off: nothing tells heights then, and no girth is given.
pub(crate) fn cut_off(photos: &Photos, people: &People) -> Option<Finding> {
    let cut = photos.iter().filter(|(id, photo)| {
        let subject = people.subject(*id);
        subject.is_some_and(|f| f.edges([photo.width, photo.height]).contains(&Edge::Lower))
    });
    let names: Vec<String> = cut.map(|(_, photo)| photo.name.clone()).collect();
    (2 * names.len() > photos.photos.len()).then(|| Finding {
        grade: Grade::Hopeless,
        what: message!(FEET),
        mend: message!(KEEP_FEET),
        photos: names,
    })
}
