//! The folders within a program's own folder, and where the program sees them.

/// What it reads, a folder a job.
pub(crate) const READ: &str = "read";
/// Where results go, a folder a job.
pub(crate) const WRITE: &str = "write";
/// Where it works.
pub(crate) const WORK: &str = "work";
/// Its `/tmp`.
pub(crate) const TMP: &str = "tmp";
/// Its `/dev/shm`.
pub(crate) const SHM: &str = "shm";
/// Its `/etc/passwd` and `/etc/group`.
pub(crate) const ETC: &str = "etc";
/// Results of a program that stays, out of its reach.
pub(crate) const TAKEN: &str = "taken";

/// All that a program may write to.
pub(crate) const WRITTEN: [&str; 4] = [WRITE, WORK, TMP, SHM];

/// Where a program in the sandbox sees its folders: no run's number and no user's folder is in it.
pub(crate) const INSIDE: &str = "/job";
