//! Processes as systems have them: whether one lives, a program with its children as a group, its end.
//!
//! On Unix by process groups and signals; elsewhere by what the standard library and `taskkill` offer.

use std::process::{Child, Command};

/// Makes what a command starts the leader of a group of its own, so that all of it can be ended.
pub fn lead_group(command: &mut Command) {
    system::lead_group(command);
}

/// Ends a program with all of its group; one that has ended already is as good.
pub fn end_group(leader: u32) {
    system::end_group(leader);
}

/// Ends one process.
pub fn end(id: u32) {
    system::end(id);
}

/// Whether a process of this number lives. Where the system does not know, it is taken to live, and
/// nothing of it is cleared away.
pub fn is_alive(id: u32) -> bool {
    system::is_alive(id)
}

/// Whether a child has ended. Where the system can, its number stays taken until it is waited for.
pub fn has_ended(child: &mut Child) -> bool {
    system::has_ended(child)
}

/// The signal that ended a process, where there are signals.
pub fn signal(status: std::process::ExitStatus) -> Option<i32> {
    system::signal(status)
}

#[cfg(unix)]
mod system {
    use rustix::io::Errno;
    use rustix::process::{Pid, Signal, WaitId, WaitIdOptions};
    use rustix::process::{kill_process, kill_process_group, test_kill_process, waitid};
    use std::os::unix::process::{CommandExt, ExitStatusExt};
    use std::process::{Child, Command, ExitStatus};

    fn pid(id: u32) -> Option<Pid> {
        i32::try_from(id).ok().and_then(Pid::from_raw)
    }

    pub(super) fn lead_group(command: &mut Command) {
        command.process_group(0);
    }

    pub(super) fn end_group(leader: u32) {
        if let Some(leader) = pid(leader) {
            let _ = kill_process_group(leader, Signal::KILL);
        }
    }

    pub(super) fn end(id: u32) {
        if let Some(id) = pid(id) {
            let _ = kill_process(id, Signal::KILL);
        }
    }

    pub(super) fn is_alive(id: u32) -> bool {
        // Another user's process may not be asked, and lives.
        pid(id).is_some_and(|id| test_kill_process(id) != Err(Errno::SRCH))
    }

    pub(super) fn has_ended(child: &mut Child) -> bool {
        let options = WaitIdOptions::EXITED | WaitIdOptions::NOHANG | WaitIdOptions::NOWAIT;
        // Who cannot be waited for does not run.
        pid(child.id()).is_none_or(|id| !matches!(waitid(WaitId::Pid(id), options), Ok(None)))
    }

    pub(super) fn signal(status: ExitStatus) -> Option<i32> {
        status.signal()
    }
}

#[cfg(not(unix))]
mod system {
    use std::process::{Child, Command, ExitStatus, Stdio};

    pub(super) fn lead_group(_command: &mut Command) {}

    pub(super) fn end_group(leader: u32) {
        // `/T`: with all that it started.
        let mut kill = Command::new("taskkill");
        kill.args(["/F", "/T", "/PID", &leader.to_string()]);
        let _ = kill.stdout(Stdio::null()).stderr(Stdio::null()).status();
    }

    pub(super) fn end(id: u32) {
        end_group(id);
    }

    pub(super) fn is_alive(_id: u32) -> bool {
        true
    }

    pub(super) fn has_ended(child: &mut Child) -> bool {
        !matches!(child.try_wait(), Ok(None))
    }

    pub(super) fn signal(_status: ExitStatus) -> Option<i32> {
        None
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn a_group_ends_as_one_and_its_leader_is_known_to_have_ended() {
        assert!(is_alive(std::process::id()) && is_alive(1) && !is_alive(0));
        let mut command = Command::new("sh");
        lead_group(command.args(["-c", "sleep 60 & sleep 60"]));
        let mut child = command.spawn().unwrap();
        assert!(!has_ended(&mut child));
        end_group(child.id());
        let status = child.wait().unwrap();
        assert_eq!(signal(status), Some(9));
        assert!(!is_alive(child.id()));
    }
}
