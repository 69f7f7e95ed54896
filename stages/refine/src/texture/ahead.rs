//! Photos decoded on all threads, a few ahead of who asks for one after the other.

use rayon::prelude::*;
use shape::{PhotoError, PhotoId, Photos, Rgb};

/// Photos decoded a few ahead, one a thread.
pub(crate) struct Ahead<'a> {
    photos: &'a Photos,
    ids: Vec<Option<PhotoId>>,
    /// Those that were decoded last, and the first of them.
    group: Vec<Option<Rgb>>,
    first: usize,
}

impl<'a> Ahead<'a> {
    /// None is decoded yet.
    pub(crate) fn new(photos: &'a Photos, ids: Vec<Option<PhotoId>>) -> Self {
        Ahead {
            photos,
            ids,
            group: vec![],
            first: 0,
        }
    }

    /// The photo of place `k`; places are asked for in their order.
    ///
    /// # Errors
    /// It cannot be decoded.
    pub(crate) fn photo(&mut self, k: usize) -> Result<Option<Rgb>, PhotoError> {
        if k == self.first + self.group.len() {
            self.first = k;
            let end = (k + rayon::current_num_threads()).min(self.ids.len());
            let photo = |id: &Option<PhotoId>| id.and_then(|id| self.photos.get(id));
            let decoded = |id| photo(id).map(|photo| photo.decode()).transpose();
            self.group = self.ids[k..end]
                .par_iter()
                .map(decoded)
                .collect::<Result<_, _>>()?;
        }
        Ok(self.group[k - self.first].take())
    }
}
