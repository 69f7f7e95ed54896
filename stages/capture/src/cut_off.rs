//! Whether the photos cut off the feet.

use crate::verdict::{Finding, Grade};
use shape::{People, Photos};
use stage::message;

stage::messages! {
    FEET = "find-feet": "the body is cut off at the lower edge";
    KEEP_FEET = "find-feet-mend": "keep the whole person in view, with a margin below the feet: without feet heights are unknown, and no girth is given";
}

/// Feet that most photos cut off: nothing tells heights then, and no girth is given.
pub(crate) fn cut_off(photos: &Photos, people: &People) -> Option<Finding> {
    people.without_feet(photos).map(|photos| Finding {
        grade: Grade::Hopeless,
        what: message!(FEET),
        mend: message!(KEEP_FEET),
        photos,
    })
}
