//! Files that are whole or not there, for the owner only.

use super::disk::Disk;
use super::error::StoreError;
use std::fs::File;
use std::io::{ErrorKind, Result};
use std::path::Path;
use system::nofollow;

/// Whether a file must outlive a loss of power. A file that need not is found torn or missing
/// after one, which is a miss. The syncs of a result and its record cost some 30 ms: they are worth
/// it for what took a hundred times as long, so that the engine stays below a hundredth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Care {
    /// Synced before it gets its name, and the names down to it after.
    Durable,
    /// Left to the system.
    Cheap,
}

impl Care {
    /// For what took so long to make. \[s\]
    pub(super) fn worth(seconds: f64) -> Care {
        if seconds < 3.0 {
            Care::Cheap
        } else {
            Care::Durable
        }
    }
}

pub(super) fn at(path: &Path) -> impl FnOnce(std::io::Error) -> StoreError + '_ {
    move |why| StoreError::Disk {
        path: path.into(),
        why,
    }
}

/// The bytes of a file; `None` if there is none.
pub(super) fn read(path: &Path) -> std::result::Result<Option<Vec<u8>>, StoreError> {
    match std::fs::read(path) {
        Err(why) if nofollow::is_absent(&why) => Ok(None),
        bytes => bytes.map(Some).map_err(at(path)),
    }
}

/// Makes a folder with all above it, mode 0700.
pub(super) fn folder(disk: &dyn Disk, path: &Path) -> std::result::Result<(), StoreError> {
    made(disk, path).map_err(at(path))
}

fn made(disk: &dyn Disk, path: &Path) -> Result<()> {
    if path.as_os_str().is_empty() {
        return Ok(());
    }
    match disk.folder(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => {
            path.parent().map_or(Ok(()), |above| made(disk, above))?;
            disk.folder(path)
        }
        done => done,
    }
}

fn above(disk: &dyn Disk, path: &Path) -> Result<()> {
    path.parent().map_or(Ok(()), |folder| made(disk, folder))
}

/// A file to be written, locked as long as it is open; the folder that it is to be in is made when it is missed, which
/// is rare.
pub(super) fn create(disk: &dyn Disk, path: &Path) -> Result<File> {
    let created = match disk.create(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => {
            above(disk, path)?;
            disk.create(path)
        }
        created => created,
    };
    // Where the disk knows no locks, the process's number in the name has to do.
    created.inspect(|file| _ = file.try_lock())
}

/// Gives a file a name whose folder is made when it is missed.
pub(super) fn rename(disk: &dyn Disk, from: &Path, to: &Path) -> Result<()> {
    match disk.rename(from, to) {
        Err(error) if error.kind() == ErrorKind::NotFound => {
            above(disk, to)?;
            disk.rename(from, to)
        }
        renamed => renamed,
    }
}

/// The names that lead from a folder down to a file outlive a loss of power. Each of them may be new,
/// made by somebody who did not care.
fn sync_way(disk: &dyn Disk, root: &Path, path: &Path) -> Result<()> {
    let folders = path.ancestors().skip(1);
    let mut below = folders.take_while(|folder| folder.starts_with(root));
    below.try_for_each(|folder| disk.sync_names(folder))
}

/// Writes a file that nobody reads yet. Keep it open until it has its name: as long as it is locked, nobody takes it
/// for what a killed process left.
fn write(disk: &dyn Disk, tmp: &Path, bytes: &[u8], care: Care) -> std::io::Result<File> {
    let mut file = create(disk, tmp)?;
    disk.write(&mut file, tmp, bytes)?;
    if care == Care::Durable {
        disk.sync(&file, tmp)?;
    }
    Ok(file)
}

/// Writes a file of the store at `root` under another name and renames it: whole or not at all. Mode
/// 0600.
pub(super) fn publish(
    (disk, root): (&dyn Disk, &Path),
    tmp: &Path,
    path: &Path,
    bytes: &[u8],
    care: Care,
) -> std::result::Result<(), StoreError> {
    let written = (|| {
        let _file = write(disk, tmp, bytes, care)?;
        rename(disk, tmp, path)?;
        match care {
            Care::Durable => sync_way(disk, root, path),
            Care::Cheap => Ok(()),
        }
    })();
    written.map_err(|why| {
        let _ = disk.remove(tmp);
        at(path)(why)
    })
}

/// As [`publish`], if nothing has the name; whether nothing had. A disk that knows no second names writes
/// over what is there.
pub(super) fn publish_new(
    (disk, root): (&dyn Disk, &Path),
    tmp: &Path,
    path: &Path,
    bytes: &[u8],
    care: Care,
) -> std::result::Result<bool, StoreError> {
    let written = (|| {
        let _file = write(disk, tmp, bytes, care)?;
        let linked = match disk.link(tmp, path) {
            Err(error) if error.kind() == ErrorKind::NotFound => {
                above(disk, path)?;
                disk.link(tmp, path)
            }
            linked => linked,
        };
        match linked {
            Ok(()) => disk.remove(tmp)?,
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {
                disk.remove(tmp)?;
                return Ok(false);
            }
            Err(error) if knows_no_links(&error) => rename(disk, tmp, path)?,
            Err(error) => return Err(error),
        }
        if care == Care::Durable {
            sync_way(disk, root, path)?;
        }
        Ok(true)
    })();
    written.map_err(|why| {
        let _ = disk.remove(tmp);
        at(path)(why)
    })
}

/// The errors of disks without second names: FAT, some that are elsewhere.
fn knows_no_links(error: &std::io::Error) -> bool {
    matches!(
        error.kind(),
        ErrorKind::Unsupported | ErrorKind::PermissionDenied | ErrorKind::TooManyLinks
    )
}

/// Makes a whole file of the store that was published without care as safe as one with it.
pub(super) fn secure(
    (disk, root): (&dyn Disk, &Path),
    path: &Path,
) -> std::result::Result<(), StoreError> {
    let synced = File::open(path).and_then(|file| disk.sync(&file, path));
    let synced = synced.and_then(|()| sync_way(disk, root, path));
    synced.map_err(at(path))
}
