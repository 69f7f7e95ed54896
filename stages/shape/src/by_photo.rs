//! Values keyed by photo, so that a mask can never meet another photo's camera.

use serde::{Deserialize, Serialize};

/// A photo of the turn: its place in turning order, from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct PhotoId(pub u32);

/// One value a photo, for some of the photos, in turning order.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ByPhoto<T>(Vec<(PhotoId, T)>);

impl<T> Default for ByPhoto<T> {
    fn default() -> Self {
        ByPhoto(Vec::new())
    }
}

impl<T> FromIterator<(PhotoId, T)> for ByPhoto<T> {
    fn from_iter<I: IntoIterator<Item = (PhotoId, T)>>(pairs: I) -> Self {
        let mut pairs: Vec<_> = pairs.into_iter().collect();
        pairs.sort_by_key(|(id, _)| *id);
        pairs.dedup_by_key(|(id, _)| *id);
        ByPhoto(pairs)
    }
}

impl<T> ByPhoto<T> {
    /// How many photos have a value.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether no photo has one.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The photo's value.
    pub fn get(&self, id: PhotoId) -> Option<&T> {
        let at = self.0.binary_search_by_key(&id, |(id, _)| *id).ok()?;
        Some(&self.0[at].1)
    }

    /// The photo's value, to be changed.
    pub fn get_mut(&mut self, id: PhotoId) -> Option<&mut T> {
        let at = self.0.binary_search_by_key(&id, |(id, _)| *id).ok()?;
        Some(&mut self.0[at].1)
    }

    /// In turning order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (PhotoId, &T)> + Clone {
        self.0.iter().map(|(id, value)| (*id, value))
    }

    /// In turning order, as a slice: for parallel loops.
    pub fn as_slice(&self) -> &[(PhotoId, T)] {
        &self.0
    }

    /// The values alone, in turning order.
    pub fn values(&self) -> impl ExactSizeIterator<Item = &T> + Clone {
        self.0.iter().map(|(_, value)| value)
    }

    /// The photos that have a value in both.
    pub fn join<'a, U>(
        &'a self,
        other: &'a ByPhoto<U>,
    ) -> impl Iterator<Item = (PhotoId, &'a T, &'a U)> {
        self.iter()
            .filter_map(|(id, a)| Some((id, a, other.get(id)?)))
    }

    /// Another value for each photo.
    pub fn map<U>(&self, mut f: impl FnMut(PhotoId, &T) -> U) -> ByPhoto<U> {
        ByPhoto(
            self.0
                .iter()
                .map(|(id, value)| (*id, f(*id, value)))
                .collect(),
        )
    }
}
