//! A program with all that it started: found by a variable of the environment that they inherit and by the
//! sandbox that they are in, ended together.

use crate::sandbox::boxed;
use stage::process;
use std::collections::BTreeMap;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::time::Duration;
use system::resident_bytes;

/// The variable by which the family of a program is known: its folder.
pub(crate) const MARK: &str = "STAGE_EXEC_FOLDER";

/// Programs that run now: number, folder.
static RUNNING: Mutex<BTreeMap<u32, PathBuf>> = Mutex::new(BTreeMap::new());

/// Takes down that a program runs, until it is dropped.
pub(crate) struct Running {
    leader: u32,
    /// Its folder.
    pub(crate) folder: PathBuf,
}

impl Running {
    pub(crate) fn new(leader: u32, folder: &Path) -> Running {
        let mut running = RUNNING.lock().expect("bug: poisoned");
        running.insert(leader, folder.into());
        let folder = folder.into();
        Running { leader, folder }
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        RUNNING.lock().expect("bug: poisoned").remove(&self.leader);
    }
}

/// Ends all programs that run now: for a process that is about to end.
pub fn end_all() {
    let running = RUNNING.lock().map(|running| running.clone());
    for (leader, folder) in running.unwrap_or_default() {
        end(&folder, Some(leader));
        let _ = std::fs::remove_dir_all(&folder);
    }
}

/// A process of the family.
pub(crate) struct Member {
    pub(crate) id: u32,
    pub(crate) name: String,
}

/// All that inherited the folder of a program, and all that run in the same sandbox as one of them, whatever
/// became of their environment; without the leader and those that have ended. Children of
/// a leader have numbers after its own, unless the system has come round to small ones again.
pub(crate) fn members(folder: &Path, leader: Option<u32>) -> Vec<Member> {
    met(folder, leader, &mut vec![])
}

/// The same, with all that run in one of these sandboxes; those that are met are added. Once the first process
/// of a sandbox is killed, nothing shows any more whose the rest are, which end a moment later.
fn met(folder: &Path, leader: Option<u32>, sandboxes: &mut Vec<PathBuf>) -> Vec<Member> {
    let mark = [MARK.as_bytes(), b"=", folder.as_os_str().as_encoded_bytes()].concat();
    let least = leader.filter(|leader| last_number().is_some_and(|last| last >= *leader));
    let entries = std::fs::read_dir("/proc").into_iter().flatten().flatten();
    let mut buffer = vec![0; LARGEST_ENVIRONMENT];
    let ours = space(Path::new("/proc/self"));
    // Of a program of this process in bubblewrap all but the leader are in a space of their own.
    let apart = leader.is_some() && boxed();
    let mut look = |entry: std::fs::DirEntry| {
        let id: u32 = entry.file_name().to_str()?.parse().ok()?;
        if leader == Some(id) || least.is_some_and(|least| id < least) {
            return None;
        }
        let space = space(&entry.path());
        if apart && space == ours {
            return None;
        }
        let environment = environment(&entry.path(), &mut buffer);
        let marked = |environment: &[u8]| environment.split(|byte| *byte == 0).any(|v| v == mark);
        let marked = environment.is_some_and(marked);
        Some((id, marked, space))
    };
    let all: Vec<(u32, bool, Option<PathBuf>)> = entries.filter_map(&mut look).collect();
    let marked = all
        .iter()
        .filter(|(_, marked, space)| *marked && *space != ours);
    for space in marked.filter_map(|(.., space)| space.as_ref()) {
        if !sandboxes.contains(space) {
            sandboxes.push(space.clone());
        }
    }
    let of_family = |(id, marked, space): &(u32, bool, Option<PathBuf>)| {
        let comm = || std::fs::read_to_string(format!("/proc/{id}/comm")).unwrap_or_default();
        let boxed = space
            .as_ref()
            .is_some_and(|space| sandboxes.contains(space));
        (*marked || boxed).then(|| Member {
            id: *id,
            name: comm().trim().escape_default().to_string(),
        })
    };
    all.iter().filter_map(of_family).collect()
}

/// The processes among which one counts: those of a sandbox are a space of their own.
fn space(process: &Path) -> Option<PathBuf> {
    std::fs::read_link(process.join("ns/pid")).ok()
}

/// More than any environment that we give. \[bytes\]
const LARGEST_ENVIRONMENT: usize = 256 * 1024;

/// How often a process that has no environment at the moment is asked again, each time after twice as long.
const ASKED_AGAIN: u32 = 6;
/// After how long for the first time.
const ASKED_AFTER: Duration = Duration::from_micros(100);

/// The environment that a process was started with. One that is just becoming another program has none
/// for a moment, and is asked again.
fn environment<'a>(process: &Path, buffer: &'a mut [u8]) -> Option<&'a [u8]> {
    let mut length = read(&process.join("environ"), buffer)?;
    for time in 0..ASKED_AGAIN {
        if length > 0 || !may_have_one(process) {
            break;
        }
        std::thread::sleep(ASKED_AFTER * (1 << time));
        length = read(&process.join("environ"), buffer)?;
    }
    Some(&buffer[..length])
}

/// Whether a process can have an environment: it has not ended, and is none of the kernel's (children of 2).
fn may_have_one(process: &Path) -> bool {
    let stat = std::fs::read_to_string(process.join("stat")).unwrap_or_default();
    let mut fields = stat
        .rsplit(')')
        .next()
        .unwrap_or_default()
        .split_whitespace();
    let ended = fields
        .next()
        .is_none_or(|state| ["Z", "X"].contains(&state));
    !ended && fields.next() != Some("2")
}

/// Reads a file of the system's whole: few and large reads, since each costs. How much there was.
fn read(file: &Path, buffer: &mut [u8]) -> Option<usize> {
    let mut file = File::open(file).ok()?;
    let mut length = 0;
    loop {
        match file.read(&mut buffer[length..]).ok()? {
            0 => return Some(length),
            more => length += more,
        }
    }
}

/// The number of the process that was started last.
fn last_number() -> Option<u32> {
    let text = std::fs::read_to_string("/proc/loadavg").ok()?;
    text.split_whitespace().last()?.parse().ok()
}

/// What a family holds in memory. \[MB\]
pub(crate) fn memory_mb(folder: &Path) -> u64 {
    let of_one = |member: Member| resident_bytes(&member.id.to_string());
    let bytes: u64 = members(folder, None).into_iter().filter_map(of_one).sum();
    bytes >> 20
}

/// How often what comes up anew is ended.
const ROUNDS: usize = 200;

/// Ends a program (`leader`, whose end nobody has fetched yet) with all that it started.
pub(crate) fn end(folder: &Path, leader: Option<u32>) {
    let mut sandboxes = Vec::new();
    met(folder, leader, &mut sandboxes);
    for round in 0..ROUNDS {
        if let Some(leader) = leader {
            process::end_group(leader);
        }
        let left = met(folder, leader, &mut sandboxes);
        for member in &left {
            process::end(member.id);
        }
        if left.is_empty() {
            return;
        }
        std::thread::sleep(Duration::from_millis(round.min(5) as u64));
    }
}
