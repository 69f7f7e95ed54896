//! What a node declares that its program reads beside what it is given (`reads`): by content in its key, and the
//! same before and after a run.

use stage::Hash;
use std::io::{Error, Read, Result};
use std::path::Path;
use system::{FileKind, Met, Stamp, nofollow};

/// What is read at most for a key: as much as a result may be. \[bytes, files\]
const MOST: (u64, usize) = (4 << 30, 100_000);

/// What is at a path: a line for each file, folder and link, in the order of their names.
fn lines(
    path: &str,
    of: &mut dyn FnMut(&Met, Option<std::fs::File>) -> Result<String>,
) -> Result<Vec<String>> {
    let path = Path::new(path).canonicalize()?;
    let (above, name) = match (path.is_dir(), path.parent(), path.file_name()) {
        (false, Some(above), Some(name)) => (above, Some(name.to_string_lossy().into_owned())),
        _ => (&*path, None),
    };
    let at = nofollow::folder(above, &[])?;
    let mut met: Vec<Met> = Vec::new();
    let mut bytes = 0u64;
    let mut more = |one: &Met| {
        bytes = bytes.saturating_add(one.stamp.size);
        met.push(one.clone());
        bytes <= MOST.0 && met.len() <= MOST.1
    };
    match &name {
        None => nofollow::walk(&at, &mut more)?,
        Some(name) => {
            let stamp = Stamp::of(&nofollow::open_file(&at, name)?.metadata()?);
            more(&Met {
                path: name.clone(),
                named: true,
                kind: Some(FileKind::File),
                link: false,
                stamp,
            });
        }
    }
    if bytes > MOST.0 || met.len() > MOST.1 {
        let most = format!("{} MB in {} files", MOST.0 / 1_000_000, MOST.1);
        return Err(Error::other(format!(
            "holds more than {most}: name what is read of it"
        )));
    }
    met.sort_by(|a, b| a.path.cmp(&b.path));
    let one = |met: &Met| {
        let reported = |why: Error| Error::new(why.kind(), format!("{}: {why}", met.path));
        let file = match (met.link, met.kind) {
            (false, Some(FileKind::File)) => {
                Some(nofollow::open_file(&at, &met.path).map_err(reported)?)
            }
            (false, None) => return Err(reported(Error::other("is a device, a pipe or a socket"))),
            _ => None,
        };
        // A file alone has the same key whatever it is called.
        let called = if name.is_some() { "" } else { &met.path };
        let what = match met.link {
            true => std::fs::read_link(above.join(&met.path))
                .map_err(reported)?
                .to_string_lossy()
                .into_owned(),
            false => of(met, file).map_err(reported)?,
        };
        Ok(format!("{called:?} {what}\n"))
    };
    let mut one = one;
    met.iter().map(&mut one).collect()
}

/// The hash of all bytes and names at a path.
pub(crate) fn content(path: &str) -> Result<Hash> {
    let lines = lines(path, &mut |_, file| {
        let mut hasher = blake3::Hasher::new();
        if let Some(file) = file {
            hasher.update_reader(file.take(MOST.0))?;
        }
        Ok(hasher.finalize().to_hex().to_string())
    })?;
    Ok(stage::hash(lines.concat().as_bytes()))
}

/// What changes when something at a path was changed, without reading it.
pub(crate) fn stamps(path: &str) -> Result<Hash> {
    let lines = lines(path, &mut |met, _| Ok(format!("{:?}", met.stamp)))?;
    Ok(stage::hash(lines.concat().as_bytes()))
}
