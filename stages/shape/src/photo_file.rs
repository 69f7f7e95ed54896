//! The file of a photo, and beside it what somebody made of its pixels, for who asks for the same next.

use stage::Hash;
use std::any::Any;
use std::fmt;
use std::ops::Deref;
use std::sync::{Arc, Mutex};

/// The bytes of a photo's file. Copies of it are the same file, and share what is kept beside it.
#[derive(Clone)]
pub struct PhotoFile {
    bytes: Arc<[u8]>,
    /// The size of its picture, upright, where it is looked at smaller. \[px\]
    pub(crate) larger: Option<[u32; 2]>,
    /// Whether its smaller picture is kept once it is decoded.
    pub(crate) keeps: bool,
    kept: Arc<Mutex<Option<Kept>>>,
}

/// What was made of a photo, by the hash of all that it was made by.
type Kept = (Hash, Arc<dyn Any + Send + Sync>);

impl PhotoFile {
    /// What was kept last, if it was made by this. It goes with the last copy of the file, so that a run may share it
    /// and no run leaves it behind.
    pub fn kept<T: Any + Send + Sync>(&self, by: Hash) -> Option<Arc<T>> {
        let kept = self.kept.lock().unwrap_or_else(|e| e.into_inner());
        let (_, made) = kept.as_ref().filter(|kept| kept.0 == by)?;
        Arc::clone(made).downcast().ok()
    }

    /// Keeps nothing of this kind any longer.
    pub fn drop_kept<T: Any + Send + Sync>(&self) {
        let mut kept = self.kept.lock().unwrap_or_else(|e| e.into_inner());
        kept.take_if(|(_, made)| made.is::<T>());
    }

    /// Keeps what was made of the photo by this, in place of what was kept before.
    pub fn keep<T: Any + Send + Sync>(&self, by: Hash, made: &Arc<T>) {
        let made: Arc<dyn Any + Send + Sync> = made.clone();
        *self.kept.lock().unwrap_or_else(|e| e.into_inner()) = Some((by, made));
    }
}

impl Deref for PhotoFile {
    type Target = [u8];
    fn deref(&self) -> &[u8] {
        &self.bytes
    }
}

impl From<Vec<u8>> for PhotoFile {
    fn from(bytes: Vec<u8>) -> Self {
        PhotoFile {
            bytes: bytes.into(),
            larger: None,
            keeps: false,
            kept: Arc::default(),
        }
    }
}

impl PartialEq for PhotoFile {
    fn eq(&self, other: &Self) -> bool {
        self.bytes == other.bytes
    }
}

impl fmt::Debug for PhotoFile {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.bytes.fmt(to)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_made_of_a_photo_is_found_by_all_that_it_was_made_by_and_replaced() {
        let file = PhotoFile::from(vec![1, 2, 3]);
        let copy = file.clone();
        let [one, other] = [b"one", b"two"].map(|by| stage::hash(by));
        file.keep(one, &Arc::new(7u32));
        assert_eq!(copy.kept::<u32>(one).as_deref(), Some(&7));
        assert_eq!(copy.kept::<u64>(one), None, "of another kind");
        assert_eq!(copy.kept::<u32>(other), None);
        let weak = Arc::downgrade(&file.kept::<u32>(one).unwrap());
        copy.keep(other, &Arc::new(8u32));
        assert!(weak.upgrade().is_none(), "one at a time");
        file.drop_kept::<u64>();
        assert_eq!(file.kept::<u32>(other).as_deref(), Some(&8));
        file.drop_kept::<u32>();
        assert_eq!(copy.kept::<u32>(other), None);
        assert_eq!(
            PhotoFile::from(vec![1, 2, 3]),
            file,
            "what is kept is none of the file"
        );
    }
}
