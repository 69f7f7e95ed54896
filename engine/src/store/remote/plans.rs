//! Plans in a shared store: `plans/NAME`, named by their hash.

use super::objects::{Created, Trouble, whole};
use crate::own;
use crate::store::{Store, StoreError};
use stage::Hash;

const FOLDER: &str = "plans";

/// No plan is larger. \[bytes\]
const MOST: usize = 1 << 30;

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
        let object = format!("{FOLDER}/{name}");
        let put = || match link.objects.create(&object, bytes)? {
            Created::New => Ok(()),
            Created::There => match whole(&*link.objects, &object, MOST)? {
                Some(there) if there == bytes => Ok(()),
                // Cut, corrupt or not there: its name is its hash.
                _ => link.objects.put(&object, bytes),
            },
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
    /// The shared store does not answer, or refuses.
    pub(crate) fn bring_plan(&self, begins: &str) -> Result<(), StoreError> {
        let fits = |name: &str| own::is_hash(name) && name.starts_with(begins);
        let Some(link) = &self.link else {
            return Ok(());
        };
        if begins.is_empty() || !own::files(self.root(), FOLDER, fits).is_empty() {
            return Ok(());
        }
        let shared = |why: Trouble| StoreError::Shared {
            name: link.name().to_owned(),
            why: why.to_string(),
        };
        let listed = || {
            let mut names = Vec::new();
            link.objects.list(FOLDER, &mut |page| {
                names.extend(page.into_iter().filter_map(|o| {
                    let (_, name) = o.name.rsplit_once('/')?;
                    fits(name).then(|| name.to_owned())
                }));
                true
            })?;
            Ok(names)
        };
        let names = match own::is_hash(begins) {
            true => vec![begins.to_owned()],
            false => link.ask(&listed).map_err(shared)?,
        };
        for name in names {
            let object = format!("{FOLDER}/{name}");
            let found = link
                .ask(&|| whole(&*link.objects, &object, MOST))
                .map_err(shared)?;
            // One that is not what its name says is none.
            let right = |bytes: &Vec<u8>| Hash::from_hex(&name).ok() == Some(stage::hash(bytes));
            if let Some(bytes) = found.filter(right) {
                self.write(&object, &bytes)?;
            }
        }
        Ok(())
    }
}
