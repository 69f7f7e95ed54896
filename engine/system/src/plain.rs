//! Plain files of a size that is expected: no device, no pipe, nothing without an end.

use std::fs::{File, OpenOptions};
use std::io::{Error, ErrorKind, Read, Result};
use std::path::Path;

/// The bytes of a plain file of at most so many. What is none, or larger, is refused at once: opening a pipe
/// waits for nobody.
///
/// # Errors
///
/// It is no plain file, is larger, or cannot be read.
pub fn plain_file(path: &Path, most_bytes: u64) -> Result<Vec<u8>> {
    let mut open = OpenOptions::new();
    unwaiting(open.read(true));
    let file = open.open(path)?;
    let meta = file.metadata()?;
    if meta.is_dir() {
        return Err(refused("is a folder"));
    }
    if !meta.is_file() {
        return Err(refused(
            "is a device, a pipe or a socket, and no plain file",
        ));
    }
    if meta.len() > most_bytes {
        return Err(too_large(most_bytes));
    }
    bounded(file, most_bytes)
}

/// All that is read, if that is at most so many bytes.
///
/// # Errors
///
/// There is more, or it cannot be read.
pub fn bounded(file: File, most_bytes: u64) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    file.take(most_bytes + 1).read_to_end(&mut bytes)?;
    match bytes.len() as u64 > most_bytes {
        true => Err(too_large(most_bytes)),
        false => Ok(bytes),
    }
}

fn refused(why: &str) -> Error {
    Error::new(ErrorKind::InvalidInput, why)
}

fn too_large(most_bytes: u64) -> Error {
    refused(&format!("is larger than {} MB", most_bytes / 1_000_000))
}

#[cfg(unix)]
fn unwaiting(open: &mut OpenOptions) {
    use std::os::unix::fs::OpenOptionsExt;
    open.custom_flags(rustix::fs::OFlags::NONBLOCK.bits() as i32);
}

#[cfg(not(unix))]
fn unwaiting(_open: &mut OpenOptions) {}
