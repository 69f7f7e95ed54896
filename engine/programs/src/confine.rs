//! A process kept by the kernel from what it is not given, for good and with all that it starts: files by Landlock,
//! calls of the system by a filter (`calls.rs`).

mod calls;

use caps::CapSet;
use landlock::{
    ABI, Access, AccessFs, CompatLevel, Compatible, LandlockStatus, Ruleset, RulesetAttr,
    RulesetCreatedAttr, RulesetError, Scope, path_beneath_rules,
};
use std::path::PathBuf;

/// What a process is given. What is not there is left out.
#[derive(Debug, Default)]
pub(crate) struct Given {
    /// Files and folders to read, and to start programs of.
    pub(crate) read: Vec<PathBuf>,
    /// Files and folders to write, too.
    pub(crate) write: Vec<PathBuf>,
    /// The network.
    pub(crate) network: bool,
}

/// What a kernel must know: moving and cutting files, beside opening, making and removing them (Linux 6.2).
const LEAST: ABI = ABI::V3;
/// What is asked for where a kernel knows it: no orders to devices, no signals and no named sockets out of the
/// confinement (Linux 6.12).
const ALL: ABI = ABI::V6;

/// Keeps this process, which has one thread, from all else. Returns whether it is also kept from sending signals to
/// processes outside.
///
/// # Errors
///
/// The kernel cannot, in words. Then something may be kept already: the process is to end.
pub(crate) fn confine(given: &Given) -> Result<bool, String> {
    close_inherited();
    let signals = files(given).map_err(|why| format!("Landlock: {why}"))?;
    let signals = signals.ok_or("Landlock: the kernel does not know it, or it is off")?;
    calls::refuse(given.network).map_err(|why| format!("seccomp: {why}"))?;
    powerless().map_err(|why| format!("Landlock: capabilities stay: {why}"))?;
    Ok(signals)
}

/// Without the power of root, which reads of other processes what Landlock keeps from everybody else. Nobody gets it
/// back: programs that would give it give none to a process that Landlock confines.
fn powerless() -> Result<(), caps::errors::CapsError> {
    let sets = [CapSet::Inheritable, CapSet::Effective, CapSet::Permitted];
    sets.into_iter().try_for_each(|set| caps::clear(None, set))
}

/// `None` if there is no Landlock.
fn files(given: &Given) -> Result<Option<bool>, RulesetError> {
    let devices = AccessFs::MakeChar | AccessFs::MakeBlock | AccessFs::IoctlDev;
    let write = AccessFs::from_all(ALL) & !devices;
    let status = Ruleset::default()
        .set_compatibility(CompatLevel::HardRequirement)
        .handle_access(AccessFs::from_all(LEAST))?
        .set_compatibility(CompatLevel::BestEffort)
        .handle_access(AccessFs::from_all(ALL))?
        .scope(Scope::from_all(ALL))?
        .create()?
        .add_rules(path_beneath_rules(&given.read, AccessFs::from_read(ALL)))?
        .add_rules(path_beneath_rules(&given.write, write))?
        .restrict_self()?;
    Ok(match status.landlock {
        LandlockStatus::Available { effective_abi, .. } => Some(effective_abi >= ALL),
        _ => None,
    })
}

/// Closes what this process was started with beside the three usual descriptors.
fn close_inherited() {
    let open = std::fs::read_dir("/proc/self/fd").into_iter().flatten();
    let number = |entry: std::io::Result<std::fs::DirEntry>| {
        entry.ok()?.file_name().to_str()?.parse::<i32>().ok()
    };
    let open: Vec<i32> = open.filter_map(number).collect();
    for descriptor in open.into_iter().filter(|number| *number > 2) {
        // The folder that was just read is closed by now.
        let _ = nix::unistd::close(descriptor);
    }
}
