//! What is asked of a place that many machines share: objects by name, each whole or not there.

use std::time::SystemTime;

/// The folders of what the engine keeps in such a place, in the order of a sweep: a record never outlives its blob for long.
pub const FOLDERS: [&str; 4] = ["ac", "cas", "plans", "probe"];

/// Results up to this size ride in their record; in tests less, where only that there are larger ones counts. \[bytes\]
pub const SMALL_BYTES: usize = if cfg!(test) { 1 << 10 } else { 64 << 10 };

/// An object as a listing gives it.
#[derive(Debug, Clone, PartialEq)]
pub struct Object {
    /// Its name below the store's prefix: `ac/ab/abcdef…`.
    pub name: String,
    /// Its size. \[bytes\]
    pub bytes: u64,
    /// When it was written, by the clock of the place.
    pub modified: SystemTime,
}

/// What came of creating an object.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Created {
    /// It was not there.
    New,
    /// Something has that name already; or another request for it was under way.
    There,
}

/// What came of reading an object.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Got {
    /// It was read to its end.
    Whole,
    /// There is none.
    Absent,
    /// The reader took no more.
    Stopped,
}

/// Why a place does not do what it is asked.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Trouble {
    /// It may answer later: the network, a server that is overloaded or gone.
    #[error("it does not answer: {0}")]
    Down(String),
    /// It will answer the same again: rights, no such bucket, a full quota.
    #[error("{0}")]
    Refused(String),
}

/// A place of objects. Names are relative, their parts separated by `/`; nothing secret is in a text
/// that it gives.
pub trait Objects: Send + Sync {
    /// What the user calls it: `s3://bucket/prefix`.
    fn name(&self) -> &str;

    /// Hands over the bytes of an object as they come, until `take` returns `false`.
    ///
    /// # Errors
    ///
    /// The place does not answer, was cut off, or refuses.
    fn get(&self, name: &str, take: &mut dyn FnMut(&[u8]) -> bool) -> Result<Got, Trouble>;

    /// Writes an object, over what was there.
    ///
    /// # Errors
    ///
    /// The place does not answer, or refuses. The object may be written all the same.
    fn put(&self, name: &str, bytes: &[u8]) -> Result<(), Trouble>;

    /// Writes an object if nothing has its name.
    ///
    /// # Errors
    ///
    /// As [`Objects::put`].
    fn create(&self, name: &str, bytes: &[u8]) -> Result<Created, Trouble>;

    /// The size of an object, if there is one. \[bytes\]
    ///
    /// # Errors
    ///
    /// The place does not answer, or refuses.
    fn size(&self, name: &str) -> Result<Option<u64>, Trouble>;

    /// All objects below a folder (`""`: all there are), some at a time, until `take` returns `false`.
    ///
    /// # Errors
    ///
    /// The place does not answer, or refuses.
    fn list(&self, folder: &str, take: &mut dyn FnMut(Vec<Object>) -> bool) -> Result<(), Trouble>;

    /// Removes an object; one that is not there is as good.
    ///
    /// # Errors
    ///
    /// The place does not answer, or refuses.
    fn remove(&self, name: &str) -> Result<(), Trouble>;

    /// What uploads that were cut off before some time left, which no list has: how many, and their size. \[bytes\]
    /// It goes, unless it is only looked for. Where objects are whole or not there, there is none.
    ///
    /// # Errors
    ///
    /// It is still there.
    fn sweep_cut_off(&self, _: SystemTime, _looks: bool) -> Result<(usize, u64), Trouble> {
        Ok((0, 0))
    }
}

/// The bytes of an object of so many at most; `None` if there is none.
///
/// # Errors
///
/// As [`Objects::get`]; and it is larger.
pub fn whole(objects: &dyn Objects, name: &str, most: usize) -> Result<Option<Vec<u8>>, Trouble> {
    match at_most(objects, name, most)? {
        (Got::Whole, bytes) => Ok(Some(bytes)),
        (Got::Absent, _) => Ok(None),
        (Got::Stopped, _) => Err(Trouble::Refused(format!(
            "{name} is larger than {most} bytes: nobody of ours wrote it"
        ))),
    }
}

/// An object's bytes as far as they came: stopped where they are more than `most`.
///
/// # Errors
///
/// As [`Objects::get`].
pub fn at_most(objects: &dyn Objects, name: &str, most: usize) -> Result<(Got, Vec<u8>), Trouble> {
    let mut bytes = Vec::new();
    let got = objects.get(name, &mut |part| {
        bytes.extend_from_slice(part);
        bytes.len() <= most
    })?;
    Ok((got, bytes))
}
