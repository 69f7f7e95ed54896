//! What the engine asks of a system, each with a portable way: files for the owner only, folders that are
//! entered without going through a link, memory, the one clock; beside it patterns of file names and texts for people.
//! Processes are in `stage::process`.

pub mod clock;
mod entries;
mod files;
#[cfg(unix)]
#[path = "nofollow.rs"]
pub mod nofollow;
#[cfg(not(unix))]
#[path = "nofollow_portable.rs"]
pub mod nofollow;
pub mod pattern;
mod plain;
mod state;
pub mod text;

use entries::WRITING;
pub use entries::{FileKind, Met, is_numbered, numbered};
pub use files::{
    Stamp, Use, can_start, is_mine, is_private, may_write, permit, private_file, private_folder,
    read_exact_at, shared_file, shared_folders, user,
};
pub use nofollow::Folder;
pub use plain::{bounded, plain_file};
pub use state::user_state;

/// Removes what killed processes were writing into a folder.
pub fn tidy(at: &Folder) {
    let dead = |name: &str| {
        let process = name.strip_prefix(WRITING).and_then(|n| n.split('-').next());
        is_writing(name) && !process.is_some_and(is_alive)
    };
    for name in nofollow::inside(at, FileKind::File, dead).unwrap_or_default() {
        nofollow::remove(at, &name);
    }
}

/// Whether a name is of a file that is being written into a folder of results.
pub fn is_writing(name: &str) -> bool {
    name.strip_prefix(WRITING).is_some_and(is_numbered)
}

/// Whether the process that a name begins with lives.
pub fn is_alive(id: &str) -> bool {
    id.parse().is_ok_and(stage::process::is_alive)
}

/// What a process may take on this machine without pushing other processes out; none if the system does not report it.
/// \[bytes\]
pub fn free_memory() -> Option<u64> {
    let number = |text: &str| text.split_whitespace().next()?.parse::<u64>().ok();
    let read = |path: &str| std::fs::read_to_string(path).unwrap_or_default();
    let info = read("/proc/meminfo");
    let line = info.lines().find_map(|l| l.strip_prefix("MemAvailable:"));
    let machine = line.and_then(number).map(|kib| kib * 1024);
    let group = |file: &str| number(&read(&format!("/sys/fs/cgroup/{file}")));
    let group = match (group("memory.max"), group("memory.current")) {
        (Some(most), Some(now)) => Some(most.saturating_sub(now)),
        _ => None,
    };
    [machine, group].into_iter().flatten().min()
}

/// What this process and those that it waited for had of the processor; none if the system gives no such number. \[s\]
pub fn processor_seconds() -> Option<f64> {
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    // Behind the name, which may have anything in it: user, system, and both of children, the twelfth to the fifteenth.
    let mut ticks = stat.rsplit_once(')')?.1.split_whitespace().skip(11);
    let mut next = || ticks.next()?.parse::<u64>().ok();
    let all: [u64; 4] = [next()?, next()?, next()?, next()?];
    Some(all.iter().sum::<u64>() as f64 / TICKS)
}

/// Linux counts times of processes in hundredths of a second for everybody who reads them (proc(5), USER_HZ). \[1/s\]
const TICKS: f64 = 100.0;

/// Memory that a process has now, by its number or `self`; none if the system does not report it. \[bytes\]
pub fn resident_bytes(process: &str) -> Option<u64> {
    let status = std::fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let line = status.lines().find_map(|l| l.strip_prefix("VmRSS:"))?;
    let kib: u64 = line.split_whitespace().next()?.parse().ok()?;
    Some(1024 * kib)
}
