//! Photos as messages name them.

use stage::{Field, message};

stage::messages! {
    SOME = "some-photos": "{names}, … ({count} photos)";
}

/// Names of photos in a message: all of up to five, the first three of more; nothing where there are none.
pub fn some_photos(names: &[String]) -> Option<Field> {
    match names.len() {
        0 => None,
        1..=5 => Some(names.into()),
        count => {
            let first = &names[..3];
            Some(message!(SOME, names = first, count = count).into())
        }
    }
}
