//! Photos as messages name them.

use stage::{Field, message};

stage::messages! {
    SOME = "some-photos": "{names}, … ({count} photos)";
}

/// How many are named one by one.
const ALL_OF: usize = 5;
/// How many of more are named.
const FIRST_OF: usize = 3;

/// Names of photos in a message: all of a few, the first of many; nothing where there are none.
pub fn some_photos(names: &[String]) -> Option<Field> {
    match names.len() {
        0 => None,
        1..=ALL_OF => Some(names.into()),
        count => {
            let first = &names[..FIRST_OF];
            Some(message!(SOME, names = first, count = count).into())
        }
    }
}
