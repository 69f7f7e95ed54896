//! What other programs found on photos, as JSON: whose photo, where; impossible values are refused.

use serde_json::Value;
use shape::{Photo, PhotoId, Photos};
use stage::{Files, FilesError};

/// Why nothing was taken from a file.
#[derive(Debug, thiserror::Error)]
pub enum FoundError {
    /// None or several.
    #[error("one file `{0}` is wanted, but {1} files are there")]
    Count(&'static str, usize),
    /// Not JSON.
    #[error("{0} is not JSON: {1}")]
    Json(String, serde_json::Error),
    /// JSON of another shape.
    #[error("{file}: {place}: {want} is wanted, not {got}")]
    Shape {
        /// The file.
        file: String,
        /// Where in it.
        place: String,
        /// What would fit.
        want: &'static str,
        /// What is there.
        got: String,
    },
    /// A file that cannot be read.
    #[error(transparent)]
    Files(#[from] FilesError),
}

/// A value of a file, with the way to it.
#[derive(Clone, Copy)]
pub(crate) struct At<'a> {
    pub(crate) value: &'a Value,
    way: Way<'a>,
}

/// The way from a file's top to a value.
#[derive(Clone, Copy)]
enum Way<'a> {
    Top(&'a str),
    In(&'a Way<'a>, usize),
    Key(&'a Way<'a>, &'a str),
}

impl Way<'_> {
    fn text(&self) -> (String, String) {
        match self {
            Way::Top(file) => ((*file).into(), "$".into()),
            Way::In(above, i) => {
                let (file, place) = above.text();
                (file, format!("{place}[{i}]"))
            }
            Way::Key(above, key) => {
                let (file, place) = above.text();
                (file, format!("{place}.{key}"))
            }
        }
    }
}

/// The one JSON file that is there.
pub(crate) fn json(files: &Files, name: &'static str) -> Result<(String, Value), FoundError> {
    let [entry] = &files.entries[..] else {
        return Err(FoundError::Count(name, files.entries.len()));
    };
    let value = serde_json::from_slice(&files.read(entry)?);
    let value = value.map_err(|why| FoundError::Json(entry.name.clone(), why))?;
    Ok((entry.name.clone(), value))
}

impl<'a> At<'a> {
    /// The whole of a file.
    pub(crate) fn top(file: &'a str, value: &'a Value) -> At<'a> {
        let way = Way::Top(file);
        At { value, way }
    }

    /// What is wrong with it.
    pub(crate) fn wrong(&self, want: &'static str) -> FoundError {
        let (file, place) = self.way.text();
        let got: String = self.value.to_string().chars().take(60).collect();
        FoundError::Shape {
            file,
            place,
            want,
            got,
        }
    }

    /// Each element of a list.
    pub(crate) fn each<T>(
        &self,
        want: &'static str,
        mut take: impl FnMut(At<'_>) -> Result<T, FoundError>,
    ) -> Result<Vec<T>, FoundError> {
        let list = self.value.as_array().ok_or_else(|| self.wrong(want))?;
        let one = |(i, value)| {
            let way = Way::In(&self.way, i);
            take(At { value, way })
        };
        list.iter().enumerate().map(one).collect()
    }

    /// A key of an object.
    pub(crate) fn key<T>(
        &self,
        key: &'static str,
        take: impl FnOnce(At<'_>) -> Result<T, FoundError>,
    ) -> Result<T, FoundError> {
        let value = self.value.get(key).unwrap_or(&Value::Null);
        let way = Way::Key(&self.way, key);
        take(At { value, way })
    }

    /// A number that is finite.
    pub(crate) fn number(&self) -> Result<f64, FoundError> {
        let number = self.value.as_f64().filter(|x| x.is_finite());
        number.ok_or_else(|| self.wrong("a number"))
    }

    /// A place on a photo: no farther beyond its border than it is wide. \[px\]
    pub(crate) fn place(&self, photo: &Photo) -> Result<[f64; 2], FoundError> {
        let want = "[x, y] on the photo, in pixels";
        let at = self.each(want, |at| at.number())?;
        let [x, y] = at[..] else {
            return Err(self.wrong(want));
        };
        let near = |v: f64, size: u32| (-f64::from(size)..2.0 * f64::from(size)).contains(&v);
        match near(x, photo.width) && near(y, photo.height) {
            true => Ok([x, y]),
            false => Err(self.wrong(want)),
        }
    }

    /// A photo, by its place in the turn or its file's name.
    pub(crate) fn photo<'p>(&self, photos: &'p Photos) -> Result<(PhotoId, &'p Photo), FoundError> {
        let found = match self.value {
            Value::String(name) => photos.iter().find(|(_, photo)| photo.name == *name),
            number => {
                let id = number.as_u64().and_then(|id| u32::try_from(id).ok());
                let id = id.map(PhotoId);
                id.and_then(|id| photos.get(id).map(|photo| (id, photo)))
            }
        };
        found.ok_or_else(|| self.wrong("a photo's place in the turn, from 0, or its file's name"))
    }
}
