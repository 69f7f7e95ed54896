//! ninja and make: running them, and the state that a first run would leave.

use super::{LENGTH, time};
use std::fmt::Write as _;
use std::os::unix::fs::MetadataExt;
use std::path::Path;
use std::process::Command;

/// Runs a tool; how long it took \[s\], and what it printed.
pub(crate) fn run(tool: &str, folder: &Path) -> (f64, String) {
    time(Command::new(tool).arg("-j2").current_dir(folder))
}

/// Holds that a tool finds nothing to do: else its times would be those of something else.
#[track_caller]
pub(crate) fn assert_done(tool: &str, folder: &Path) {
    let (_, printed) = run(tool, folder);
    let nothing = ["no work to do", "Nothing to be done"];
    assert!(
        nothing.iter().any(|n| printed.contains(n)),
        "{tool}: {printed:.200}"
    );
}

/// Every output with what it is copied from.
fn outputs(width: usize) -> impl Iterator<Item = (String, String)> {
    let one = |w: usize, l: usize| match l {
        0 => (format!("w{w}l0"), format!("{w}.txt")),
        _ => (format!("w{w}l{l}"), format!("w{w}l{}", l - 1)),
    };
    (0..width).flat_map(move |w| (0..LENGTH).map(move |l| one(w, l)))
}

/// Writes what a first run would: every file, and ninja's log of the commands that made them (version 5, as ninja up to
/// 1.11 writes it). [`assert_done`] holds that the tools believe it.
pub(crate) fn pretend(folder: &Path, width: usize) {
    let mut log = String::from("# ninja log v5\n");
    for (name, from) in outputs(width) {
        let path = folder.join(&name);
        std::fs::copy(folder.join(&from), &path).unwrap();
        let meta = std::fs::metadata(&path).unwrap();
        let time = meta.mtime() * 1_000_000_000 + meta.mtime_nsec();
        let hash = murmur(format!("cat {from} > {name}").as_bytes());
        let _ = writeln!(log, "0\t1\t{time}\t{name}\t{hash:x}");
    }
    std::fs::write(folder.join(".ninja_log"), log).unwrap();
}

/// MurmurHash64A (Austin Appleby, public domain) with ninja's seed.
fn murmur(text: &[u8]) -> u64 {
    const SEED: u64 = 0xDECA_FBAD_DECA_FBAD;
    const M: u64 = 0xC6A4_A793_5BD1_E995;
    let mut hash = SEED ^ (text.len() as u64).wrapping_mul(M);
    let (words, rest) = text.as_chunks::<8>();
    for word in words {
        let mut k = u64::from_le_bytes(*word).wrapping_mul(M);
        k ^= k >> 47;
        hash = (hash ^ k.wrapping_mul(M)).wrapping_mul(M);
    }
    if !rest.is_empty() {
        let mut last = [0; 8];
        last[..rest.len()].copy_from_slice(rest);
        hash = (hash ^ u64::from_le_bytes(last)).wrapping_mul(M);
    }
    hash ^= hash >> 47;
    hash = hash.wrapping_mul(M);
    hash ^ (hash >> 47)
}
