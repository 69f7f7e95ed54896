//! Names that a user gives to runs: what a named run made or found stays when the store is swept.

use super::error::StoreError;
use super::files::at;
use super::folder::Store;
use crate::own;
use std::io::ErrorKind;

/// Why a run cannot be pinned.
#[derive(Debug, thiserror::Error)]
pub enum PinError {
    /// The name.
    #[error(
        "`{0}` is no name for a pin: use letters, digits, `-`, `_` and `.`, and begin with a letter or digit; \
         `last` is the last run's already"
    )]
    Name(String),
    /// The store.
    #[error(transparent)]
    Store(#[from] StoreError),
}

impl Store {
    /// Gives a run a name, over what had it before.
    ///
    /// # Errors
    ///
    /// There is no such run, the name is no name, or the disk refuses.
    pub fn pin(&self, name: &str, run: &str) -> Result<(), PinError> {
        if !own::is_pin(name) {
            return Err(PinError::Name(name.into()));
        }
        Ok(self.write(&format!("pins/{name}"), format!("{run}\n").as_bytes())?)
    }

    /// Takes a name away; whether there was one.
    pub fn unpin(&self, name: &str) -> bool {
        own::is_pin(name) && own::remove(self.root(), &["pins"], name)
    }

    /// All names with their runs, in the order of the names.
    ///
    /// # Errors
    ///
    /// The disk refuses: then nobody knows what is pinned.
    pub fn pins(&self) -> Result<Vec<(String, String)>, StoreError> {
        let folder = self.root().join("pins");
        let mut pins = Vec::new();
        for name in self.files("pins", own::is_pin)? {
            match std::fs::read(folder.join(&name)) {
                Err(why) if why.kind() == ErrorKind::NotFound => {}
                run => {
                    let run = run.map_err(at(&folder))?;
                    let run = String::from_utf8_lossy(&run).trim().to_owned();
                    pins.push((name, run));
                }
            }
        }
        Ok(pins)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_given_and_taken_and_none_leaves_the_folder() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(folder.path()).unwrap();
        store.pin("talk", "007-1").unwrap();
        store.pin("a-2.b", "008-1").unwrap();
        store.pin("talk", "009-1").unwrap();
        let pins = [("a-2.b", "008-1"), ("talk", "009-1")];
        assert_eq!(
            store.pins().unwrap(),
            pins.map(|(a, b)| (a.into(), b.into()))
        );
        for name in [
            "",
            "../format",
            ".x",
            "a/b",
            "last",
            "last~1",
            "ä",
            &"x".repeat(65),
        ] {
            assert!(store.pin(name, "1").is_err(), "{name}");
            assert!(!store.unpin(name), "{name}");
        }
        assert!(store.unpin("talk") && !store.unpin("talk"));
        assert_eq!(store.pins().unwrap().len(), 1);
    }
}
