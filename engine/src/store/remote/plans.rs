//! Plans in a shared store: `plans/NAME`, named by their hash, and `plans/NAME.seal`, who vouches for them.

use super::link::Link;
use crate::own;
use crate::store::{Store, StoreError};
use buckets::{Created, Trouble, whole};
use stage::Hash;

const FOLDER: &str = "plans";

/// No plan is larger. \[bytes\]
pub(super) const MOST: usize = 1 << 30;

/// No signature is larger. \[bytes\]
const MOST_SEAL: usize = 4096;

/// Where a plan is.
pub(super) fn object(name: &str) -> String {
    format!("{FOLDER}/{name}")
}

/// Where its signature is.
pub(super) fn seal(name: &str) -> String {
    format!("{FOLDER}/{name}.seal")
}

/// The names of plans there that fit.
pub(super) fn listed(link: &Link, fits: impl Fn(&str) -> bool) -> Result<Vec<String>, Trouble> {
    let mut names = Vec::new();
    link.objects.list(FOLDER, &mut |page| {
        names.extend(page.into_iter().filter_map(|o| {
            let (_, name) = o.name.rsplit_once('/')?;
            (own::is_hash(name) && fits(name)).then(|| name.to_owned())
        }));
        true
    })?;
    Ok(names)
}

impl Link {
    /// Signs a plan, if somebody signs, unless somebody who is believed has.
    fn seal_plan(&self, name: &str) -> Result<(), Trouble> {
        let Some(signature) = self.sign_plan(name) else {
            return Ok(());
        };
        let object = seal(name);
        match self.objects.create(&object, signature.as_bytes())? {
            Created::New => Ok(()),
            Created::There if self.is_sealed(name)? => Ok(()),
            Created::There => self.objects.put(&object, signature.as_bytes()),
        }
    }

    /// Whether somebody who is believed signed a plan.
    fn is_sealed(&self, name: &str) -> Result<bool, Trouble> {
        let found = whole(&*self.objects, &seal(name), MOST_SEAL)?;
        let text = found.and_then(|bytes| String::from_utf8(bytes).ok());
        Ok(text.is_some_and(|word| self.believes_plan(name, word.trim())))
    }
}

impl Store {
    /// Puts a file of the folder `plans`, named by its hash, into the shared store, if there is one.
    ///
    /// # Errors
    ///
    /// It does not answer, or refuses: nobody elsewhere could work on the plan.
    pub(crate) fn publish_plan(&self, name: &str, bytes: &[u8]) -> Result<(), StoreError> {
        let Some(link) = self.link.as_ref().filter(|link| !link.is_read_only()) else {
            return Ok(());
        };
        let object = object(name);
        let put = || {
            match link.objects.create(&object, bytes)? {
                Created::New => {}
                Created::There => match whole(&*link.objects, &object, MOST)? {
                    Some(there) if there == bytes => {}
                    // Cut, corrupt or not there: its name is its hash.
                    _ => link.objects.put(&object, bytes)?,
                },
            }
            link.seal_plan(name)
        };
        link.ask(&put).map_err(|why| StoreError::Shared {
            name: link.name().to_owned(),
            why: format!("the plan could not be put there: {why}"),
        })
    }

    /// Brings the plans here whose names begin so, if none is here.
    ///
    /// # Errors
    ///
    /// The shared store does not answer, or refuses; or nobody who is trusted signed any of them.
    pub(crate) fn bring_plan(&self, begins: &str) -> Result<(), StoreError> {
        let fits = |name: &str| own::is_hash(name) && name.starts_with(begins);
        let Some(link) = &self.link else {
            return Ok(());
        };
        if begins.is_empty() || !self.files(FOLDER, fits)?.is_empty() {
            return Ok(());
        }
        let shared = |why: String| StoreError::Shared {
            name: link.name().to_owned(),
            why,
        };
        let trouble = |why: Trouble| shared(why.to_string());
        let names = match own::is_hash(begins) {
            true => vec![begins.to_owned()],
            false => link.ask(&|| listed(link, fits)).map_err(trouble)?,
        };
        let (mut brought, mut stranger) = (0, None);
        for name in names {
            let object = object(&name);
            let found = link.ask(&|| whole(&*link.objects, &object, MOST));
            // One that is not what its name promises is none.
            let right = |bytes: &Vec<u8>| Hash::from_hex(&name).ok() == Some(stage::hash(bytes));
            let Some(bytes) = found.map_err(trouble)?.filter(right) else {
                continue;
            };
            if link.is_strict() && !link.ask(&|| link.is_sealed(&name)).map_err(trouble)? {
                stranger = Some(name);
                continue;
            }
            self.write(&object, &bytes)?;
            brought += 1;
        }
        match stranger {
            Some(name) if brought == 0 => Err(shared(format!(
                "the plan {} is not signed by anybody in the list of --trust: make it again with --sign-key, or leave --trust out",
                &name[..12]
            ))),
            _ => Ok(()),
        }
    }
}
