//! Which store a record was made in: a mark that a copy of the store does not have, so that what came with a download
//! does not pass for made here.
//!
//! `origin`: a random word, then the number and the time of change of the file `format` in this folder, as the system
//! gives them. In a folder that was copied, unpacked or cloned they differ, and the mark is made anew. Where the
//! system keeps no numbers of files (Windows) only the time speaks.

use super::files::{self, Care};
use super::folder::Store;
use super::record::{Origin, Record};
use system::Stamp;

const NAME: &str = "origin";

impl Store {
    /// The mark of this store; none if it cannot be written.
    pub(super) fn mark(&self) -> Option<&str> {
        self.mark.get_or_init(|| self.found_mark()).as_deref()
    }

    fn found_mark(&self) -> Option<String> {
        let path = self.root().join(NAME);
        let stamp = Stamp::of(&std::fs::metadata(self.root().join("format")).ok()?);
        let stamp = format!("{} {}", stamp.inode, stamp.changed_ns);
        let read = || {
            let text = std::fs::read_to_string(&path).ok()?;
            let (mark, of) = text.trim_end().split_once(' ')?;
            (of == stamp).then(|| mark.to_owned())
        };
        if let Some(mark) = read() {
            return Some(mark);
        }
        let text = format!("{} {stamp}\n", &super::remote::fresh().to_hex()[..32]);
        let (tmp, care) = (self.fresh(), Care::Cheap);
        let new = files::publish_new(self.disk(), &tmp, &path, text.as_bytes(), care);
        if matches!(new, Ok(false)) && read().is_none() {
            // Of another folder, or torn.
            self.write(NAME, text.as_bytes()).ok()?;
        }
        read()
    }

    /// The file of a record that was made here.
    pub(super) fn file_here(&self, record: &Record) -> String {
        record.file_of(self.mark().map(|mark| Origin::Here(mark.to_owned())))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_store_has_one_mark_and_its_copy_another() {
        let place = tempfile::tempdir().unwrap();
        let mark = |name: &str| {
            let store = Store::open(&place.path().join(name)).unwrap();
            store.mark().unwrap().to_owned()
        };
        let first = mark("a");
        assert_eq!((first.len(), mark("a")), (32, first.clone()));
        std::fs::create_dir(place.path().join("b")).unwrap();
        for file in ["format", NAME] {
            let path = |name: &str| place.path().join(name).join(file);
            std::fs::copy(path("a"), path("b")).unwrap();
        }
        assert_ne!(mark("b"), first);
        assert_eq!(mark("b"), mark("b"));
    }
}
