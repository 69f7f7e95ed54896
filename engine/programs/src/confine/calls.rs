//! Calls of the system that a confined process has no use for or that would get around Landlock, filtered by seccomp.
//! What Landlock does not look at: modes, owners and times of files, sockets, other processes, namespaces, mounts.

use nix::libc as c;
use seccompiler::{
    BpfProgram, SeccompAction, SeccompCmpArgLen as Len, SeccompCmpOp as Op, SeccompCondition,
    SeccompFilter, SeccompRule, TargetArch, apply_filter,
};
use std::collections::BTreeMap;

/// The rules of some calls; a call without any is met always.
type Rules = BTreeMap<i64, Vec<SeccompRule>>;
type Failed = Box<dyn std::error::Error>;

/// Numbers from 424 on are the same on every architecture; not every C library names them.
mod new {
    pub(super) const IO_URING: [i64; 3] = [425, 426, 427];
    /// `open_tree`, `move_mount`, `fsopen`, `fsconfig`, `fsmount`, `fspick`, `mount_setattr`, `open_tree_attr`.
    pub(super) const MOUNTS: [i64; 8] = [428, 429, 430, 431, 432, 433, 442, 467];
    pub(super) const CLONE3: i64 = 435;
    pub(super) const PIDFD_GETFD: i64 = 438;
    pub(super) const FCHMODAT2: i64 = 452;
    /// `setxattrat`, `removexattrat`, `file_setattr`.
    pub(super) const ATTRIBUTES: [i64; 3] = [463, 466, 469];
}

/// Refused, whatever their arguments.
const REFUSED: [i64; 44] = [
    c::SYS_ptrace,
    c::SYS_process_vm_readv,
    c::SYS_process_vm_writev,
    c::SYS_kcmp,
    new::PIDFD_GETFD,
    c::SYS_mount,
    c::SYS_umount2,
    c::SYS_pivot_root,
    c::SYS_chroot,
    c::SYS_unshare,
    c::SYS_setns,
    c::SYS_bpf,
    c::SYS_perf_event_open,
    c::SYS_userfaultfd,
    c::SYS_add_key,
    c::SYS_request_key,
    c::SYS_keyctl,
    c::SYS_inotify_add_watch,
    c::SYS_fanotify_init,
    c::SYS_name_to_handle_at,
    c::SYS_open_by_handle_at,
    c::SYS_shmget,
    c::SYS_semget,
    c::SYS_msgget,
    c::SYS_mq_open,
    c::SYS_mq_unlink,
    c::SYS_quotactl,
    c::SYS_acct,
    c::SYS_syslog,
    c::SYS_reboot,
    c::SYS_swapon,
    c::SYS_swapoff,
    c::SYS_kexec_load,
    c::SYS_init_module,
    c::SYS_finit_module,
    c::SYS_delete_module,
    c::SYS_settimeofday,
    c::SYS_clock_settime,
    c::SYS_adjtimex,
    c::SYS_clock_adjtime,
    c::SYS_sethostname,
    c::SYS_setdomainname,
    c::SYS_vhangup,
    c::SYS_ioprio_set,
];

/// Reported as done, and not done: programs set modes, owners and times of what they copy, and could set those of any
/// file. Results are known by content alone.
const IGNORED: [i64; 11] = [
    c::SYS_fchmod,
    c::SYS_fchmodat,
    new::FCHMODAT2,
    c::SYS_fchown,
    c::SYS_fchownat,
    c::SYS_setxattr,
    c::SYS_lsetxattr,
    c::SYS_fsetxattr,
    c::SYS_removexattr,
    c::SYS_lremovexattr,
    c::SYS_fremovexattr,
];
/// Older names of the same.
#[cfg(target_arch = "x86_64")]
const IGNORED_OLD: [i64; 6] = [
    c::SYS_chmod,
    c::SYS_chown,
    c::SYS_lchown,
    c::SYS_utime,
    c::SYS_utimes,
    c::SYS_futimesat,
];
#[cfg(not(target_arch = "x86_64"))]
const IGNORED_OLD: [i64; 0] = [];

/// Flags by which a process would get namespaces of its own.
const NAMESPACES: [i32; 7] = [
    c::CLONE_NEWNS,
    c::CLONE_NEWCGROUP,
    c::CLONE_NEWUTS,
    c::CLONE_NEWIPC,
    c::CLONE_NEWUSER,
    c::CLONE_NEWPID,
    c::CLONE_NEWNET,
];
/// Orders to a terminal that type into it.
const TYPING: [u64; 2] = [0x5412, 0x541c];
/// Sockets that reach the network and nothing on this machine beside it.
const NETWORK: [i32; 3] = [c::AF_INET, c::AF_INET6, c::AF_NETLINK];

/// All that must hold of a call's arguments.
fn rule(conditions: &[(u8, Len, Op, u64)]) -> Result<SeccompRule, seccompiler::BackendError> {
    let one = |(at, len, op, value): &(u8, Len, Op, u64)| {
        SeccompCondition::new(*at, len.clone(), op.clone(), *value)
    };
    SeccompRule::new(conditions.iter().map(one).collect::<Result<_, _>>()?)
}

/// Calls that are met by their arguments, and refused.
fn refused(network: bool) -> Result<Rules, seccompiler::BackendError> {
    let mut rules: Rules = REFUSED.iter().map(|call| (*call, vec![])).collect();
    rules.extend(new::MOUNTS.map(|call| (call, vec![])));
    let other = |family: &i32| (0, Len::Dword, Op::Ne, *family as u64);
    let sockets: Vec<_> = NETWORK.iter().map(other).collect();
    let sockets = match network {
        true => vec![rule(&sockets)?],
        false => vec![],
    };
    rules.insert(c::SYS_socket, sockets);
    let flag = |flag: &i32| {
        let flag = *flag as u64;
        rule(&[(0, Len::Qword, Op::MaskedEq(flag), flag)])
    };
    rules.insert(
        c::SYS_clone,
        NAMESPACES.iter().map(flag).collect::<Result<_, _>>()?,
    );
    let typing = |order: &u64| rule(&[(1, Len::Dword, Op::Eq, *order)]);
    rules.insert(
        c::SYS_ioctl,
        TYPING.iter().map(typing).collect::<Result<_, _>>()?,
    );
    // Limits and priorities of other processes.
    let other = |at| Ok(vec![rule(&[(at, Len::Dword, Op::Ne, 0)])?]);
    rules.insert(c::SYS_prlimit64, other(0)?);
    rules.insert(c::SYS_setpriority, other(1)?);
    Ok(rules)
}

fn ignored() -> Result<Rules, seccompiler::BackendError> {
    let calls = IGNORED.iter().chain(&IGNORED_OLD).chain(&new::ATTRIBUTES);
    let mut rules: Rules = calls.map(|call| (*call, vec![])).collect();
    // By a name; of an open file, as `touch` does, it is let through.
    let named = rule(&[(1, Len::Qword, Op::Ne, 0)])?;
    rules.insert(c::SYS_utimensat, vec![named]);
    Ok(rules)
}

/// Other ways to the same, which programs do without where a kernel does not know them.
fn unknown() -> Rules {
    let calls = new::IO_URING.into_iter().chain([new::CLONE3]);
    calls.map(|call| (call, vec![])).collect()
}

/// The same calls in the other numbering that kernels of x86-64 may take.
fn twice(rules: Rules) -> Rules {
    let mut all = rules.clone();
    if cfg!(target_arch = "x86_64") {
        all.extend(
            rules
                .into_iter()
                .map(|(call, rules)| (call | 0x4000_0000, rules)),
        );
    }
    all
}

/// Filters the calls of this process from now on.
///
/// # Errors
///
/// The kernel has no filters, or does not take these.
pub(super) fn refuse(network: bool) -> Result<(), Failed> {
    let errno = |number: i32| SeccompAction::Errno(number as u32);
    let arch: TargetArch = std::env::consts::ARCH.try_into()?;
    for (rules, action) in [
        (ignored()?, errno(0)),
        (unknown(), errno(c::ENOSYS)),
        (refused(network)?, errno(c::EPERM)),
    ] {
        let filter = SeccompFilter::new(twice(rules), SeccompAction::Allow, action, arch)?;
        apply_filter(&BpfProgram::try_from(filter)?)?;
    }
    Ok(())
}
