//! The folders within a program's own folder, and where the program sees them.

/// What it reads, a folder a job.
pub(super) const READ: &str = "read";
/// Where results go, a folder a job.
pub(super) const WRITE: &str = "write";
/// Where it works.
pub(super) const WORK: &str = "work";
/// Its `/tmp`.
pub(super) const TMP: &str = "tmp";
/// Its `/dev/shm`.
pub(super) const SHM: &str = "shm";
/// Its `/etc/passwd` and `/etc/group`.
pub(super) const ETC: &str = "etc";
/// Results of a program that stays, out of its reach.
pub(super) const TAKEN: &str = "taken";

/// All that a program may write to.
pub(super) const WRITTEN: [&str; 4] = [WRITE, WORK, TMP, SHM];

/// Where a program in the sandbox sees its folders: no run's number and no user's folder is in it.
pub(super) const INSIDE: &str = "/job";
