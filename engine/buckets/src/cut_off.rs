//! What uploads that were cut off left in a folder that machines share: `NAME#1` beside the object, which no list has.

use crate::objects::FOLDERS;
use stage::Hash;
use std::io::{Error, Result};
use std::path::Path;
use std::time::SystemTime;
use system::{FileKind, nofollow};

/// Which object a file is a part of.
fn whole(part: &str) -> Option<&str> {
    part.split_once('#').map(|(name, _)| name)
}

/// Whether it is a part of an object of ours.
fn is_ours(part: &str) -> bool {
    whole(part).is_some_and(|name| {
        let hash = name.strip_suffix(".seal").unwrap_or(name);
        name == "format" || Hash::from_hex(hash).is_ok_and(|known| *known.to_hex() == *hash)
    })
}

/// A folder there, if there is one.
fn entered(root: &Path, names: &[&str]) -> Result<Option<nofollow::Folder>> {
    match nofollow::folder(root, names) {
        Err(why) if nofollow::is_absent(&why) => Ok(None),
        at => at.map(Some),
    }
}

fn remove(at: &nofollow::Folder, part: &str) -> Result<()> {
    match nofollow::remove(at, part) {
        true => Ok(()),
        false => Err(Error::other(format!("{part} cannot be removed"))),
    }
}

/// Removes what is left of an object.
pub(crate) fn remove_of(root: &Path, object: &str) -> Result<()> {
    let mut folders: Vec<&str> = object.split('/').collect();
    let name = folders.pop().unwrap_or_default();
    let Some(at) = entered(root, &folders)? else {
        return Ok(());
    };
    let parts = nofollow::inside(&at, FileKind::File, |file| whole(file) == Some(name))?;
    parts.iter().try_for_each(|part| remove(&at, part))
}

/// Removes what was last written before a time, or only looks for it: how many, and their size. \[bytes\]
pub(crate) fn sweep(root: &Path, before: SystemTime, looks: bool) -> Result<(usize, u64)> {
    let (mut count, mut bytes) = (0, 0);
    let mut open = vec![String::new()];
    open.extend(FOLDERS.map(str::to_owned));
    while let Some(folder) = open.pop() {
        let names: Vec<&str> = folder.split('/').filter(|name| !name.is_empty()).collect();
        let Some(at) = entered(root, &names)? else {
            continue;
        };
        if !names.is_empty() {
            let inner = |name: &str| !name.starts_with('.');
            let inner = nofollow::inside(&at, FileKind::Folder, inner)?;
            open.extend(inner.iter().map(|inner| format!("{folder}/{inner}")));
        }
        for part in nofollow::inside(&at, FileKind::File, is_ours)? {
            let meta = match root.join(&folder).join(&part).symlink_metadata() {
                Err(why) if nofollow::is_absent(&why) => continue,
                meta => meta?,
            };
            if meta.modified()? >= before {
                continue;
            }
            if !looks {
                remove(&at, &part)?;
            }
            count += 1;
            bytes += meta.len();
        }
    }
    Ok((count, bytes))
}
