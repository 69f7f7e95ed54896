//! A process whose system calls are counted, and of which one fails, or is the one before which the process is killed.
//!
//! By ptrace: the thread that works and those that it starts, not the programs that it runs.

use nix::errno::Errno;
use nix::libc as c;
use nix::sys::ptrace::{self, Options};
use nix::sys::signal::{Signal, kill};
use nix::sys::wait::{WaitPidFlag, WaitStatus, waitpid};
use nix::unistd::Pid;
use std::collections::BTreeSet;
use std::io::{BufRead, BufReader, Read, Write};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread::JoinHandle;
use std::time::Duration;

/// What happens at a call.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Fault {
    /// Nothing ever does.
    None,
    /// That call fails.
    Fails(usize),
    /// Before that one the process is killed.
    Killed(usize),
    /// Whatever has that name cannot be opened.
    Shut(&'static str),
    /// No thread starts.
    #[cfg_attr(not(feature = "remote"), allow(dead_code))]
    NoThreads,
}

/// How a process ended.
#[derive(Debug)]
pub(crate) struct Ended {
    /// Its exit code; `None` if it was killed.
    pub(crate) code: Option<i32>,
    /// How many calls it made.
    pub(crate) calls: usize,
    /// The call to which something happened.
    pub(crate) call: Option<u64>,
    /// What it wrote to standard output.
    pub(crate) output: String,
    /// What it wrote to standard error: why it failed.
    pub(crate) errors: String,
}

/// Memory, threads that wait for each other, time, signals, and the end: they do not fail, or nobody can go on.
const NOT_COUNTED: [c::c_long; 27] = [
    c::SYS_mmap,
    c::SYS_munmap,
    c::SYS_mprotect,
    c::SYS_mremap,
    c::SYS_madvise,
    c::SYS_brk,
    c::SYS_futex,
    c::SYS_sched_yield,
    c::SYS_sched_getaffinity,
    c::SYS_clock_gettime,
    c::SYS_clock_nanosleep,
    c::SYS_nanosleep,
    c::SYS_getrandom,
    c::SYS_getpid,
    c::SYS_gettid,
    c::SYS_geteuid,
    c::SYS_getegid,
    c::SYS_rseq,
    c::SYS_set_robust_list,
    c::SYS_sigaltstack,
    c::SYS_rt_sigaction,
    c::SYS_rt_sigprocmask,
    c::SYS_rt_sigreturn,
    c::SYS_restart_syscall,
    c::SYS_prctl,
    c::SYS_exit,
    c::SYS_exit_group,
];

/// A process that takes longer hangs.
const LONGEST: Duration = Duration::from_secs(30);

/// Asks this test program to run a command line, with a fault.
pub(crate) fn run(words: &[String], state: &str, fault: Fault) -> Ended {
    let mut child = Command::new(std::env::current_exe().unwrap())
        .args([
            "--exact",
            "child",
            "--ignored",
            "--quiet",
            "--test-threads=1",
        ])
        .env("CALLS_WORDS", words.join("\n"))
        .env("CALLS_STATE", state)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut out = BufReader::new(child.stdout.take().unwrap());
    let worker = worker(&mut out);
    let (done, over) = channel::<()>();
    let id = Pid::from_raw(child.id() as i32);
    let dog = std::thread::spawn(move || {
        if over.recv_timeout(LONGEST) == Err(RecvTimeoutError::Timeout) {
            let _ = kill(id, Signal::SIGKILL);
            panic!("it hangs");
        }
    });
    let (output, errors) = (all(out), all(child.stderr.take().unwrap()));
    let mut ended = watched(&mut child, worker, fault);
    drop(done);
    assert!(
        dog.join().is_ok(),
        "{words:?} hangs at {fault:?} ({:?})",
        ended.call
    );
    ended.output = output.join().unwrap();
    ended.errors = errors.join().unwrap();
    ended
}

/// Reads all that comes, beside the rest.
fn all(mut from: impl Read + Send + 'static) -> JoinHandle<String> {
    std::thread::spawn(move || {
        let mut text = String::new();
        let _ = from.read_to_string(&mut text);
        text
    })
}

/// The number of the thread that works, which waits to be started.
fn worker(out: &mut impl BufRead) -> Pid {
    let mut line = String::new();
    loop {
        line.clear();
        assert!(out.read_line(&mut line).unwrap() > 0, "it has ended");
        if let Some((_, number)) = line.trim().split_once("thread ") {
            return Pid::from_raw(number.parse().unwrap());
        }
    }
}

/// Follows a process to its end.
fn watched(child: &mut Child, worker: Pid, fault: Fault) -> Ended {
    let options =
        Options::PTRACE_O_TRACESYSGOOD | Options::PTRACE_O_TRACECLONE | Options::PTRACE_O_EXITKILL;
    ptrace::seize(worker, options).unwrap();
    ptrace::interrupt(worker).unwrap();
    let mut ended = Ended {
        code: None,
        calls: 0,
        call: None,
        output: String::new(),
        errors: String::new(),
    };
    // Threads that are in a call, and whether it is to fail.
    let (mut inside, mut fails): (BTreeSet<Pid>, BTreeSet<Pid>) = Default::default();
    let mut started = false;
    // Those that other tests started are theirs.
    let own = WaitPidFlag::__WALL | WaitPidFlag::__WNOTHREAD;
    let main = Pid::from_raw(child.id() as i32);
    loop {
        let status = match waitpid(None, Some(own)) {
            Err(Errno::EINTR) => continue,
            status => status.unwrap(),
        };
        match status {
            WaitStatus::Exited(id, code) if id == main => {
                ended.code = Some(code);
                return ended;
            }
            WaitStatus::Signaled(id, ..) if id == main => return ended,
            WaitStatus::PtraceSyscall(id) if inside.remove(&id) => {
                if fails.remove(&id) {
                    let _ = answer(id, |regs| regs.rax = -i64::from(c::EIO) as u64);
                }
                let _ = ptrace::syscall(id, None);
            }
            WaitStatus::PtraceSyscall(id) => {
                inside.insert(id);
                let Ok(regs) = ptrace::getregs(id) else {
                    continue;
                };
                if strikes(fault, id, &regs) {
                    ended.call = Some(regs.orig_rax);
                    fails.insert(id);
                    let _ = answer(id, |regs| regs.orig_rax = u64::MAX);
                }
                if !NOT_COUNTED.contains(&(regs.orig_rax as c::c_long)) {
                    let number = ended.calls;
                    ended.calls += 1;
                    if fault == Fault::Killed(number) {
                        ended.call = Some(regs.orig_rax);
                        let _ = kill(main, Signal::SIGKILL);
                        continue;
                    }
                    if fault == Fault::Fails(number) {
                        ended.call = Some(regs.orig_rax);
                        fails.insert(id);
                        // What fails to close is closed all the same.
                        if regs.orig_rax != c::SYS_close as u64 {
                            let _ = answer(id, |regs| regs.orig_rax = u64::MAX);
                        }
                    }
                }
                let _ = ptrace::syscall(id, None);
            }
            WaitStatus::PtraceEvent(id, ..) => {
                let _ = ptrace::syscall(id, None);
                if !started {
                    started = true;
                    child.stdin.take().unwrap().write_all(b"\n").unwrap();
                }
            }
            WaitStatus::Stopped(id, signal) => _ = ptrace::syscall(id, Some(signal)),
            _ => {}
        }
    }
}

/// Changes the registers of a thread that is stopped.
fn answer(id: Pid, change: impl FnOnce(&mut c::user_regs_struct)) -> nix::Result<()> {
    let mut regs = ptrace::getregs(id)?;
    change(&mut regs);
    ptrace::setregs(id, regs)
}

/// Whether what a thread that is stopped is about to do never works.
fn strikes(fault: Fault, id: Pid, regs: &c::user_regs_struct) -> bool {
    match fault {
        Fault::Shut(name) => regs.orig_rax == c::SYS_openat as u64 && opens(id, regs.rsi, name),
        Fault::NoThreads => starts_thread(id, regs),
        _ => false,
    }
}

/// Whether a thread that is stopped is about to start another one of its process.
fn starts_thread(id: Pid, regs: &c::user_regs_struct) -> bool {
    let flags = match regs.orig_rax as c::c_long {
        c::SYS_clone => regs.rdi as i64,
        // The first of what it points to.
        c::SYS_clone3 => ptrace::read(id, regs.rdi as ptrace::AddressType).unwrap_or(0),
        _ => 0,
    };
    flags & i64::from(c::CLONE_THREAD) != 0
}

/// Whether the path at an address of a thread that is stopped ends with a name.
fn opens(id: Pid, mut address: u64, name: &str) -> bool {
    let mut path = Vec::new();
    while !path.contains(&0) && path.len() < c::PATH_MAX as usize {
        let Ok(word) = ptrace::read(id, address as ptrace::AddressType) else {
            return false;
        };
        path.extend(word.to_ne_bytes());
        address += size_of_val(&word) as u64;
    }
    let path = path.split(|byte| *byte == 0).next().unwrap_or_default();
    path.rsplit(|byte| *byte == b'/').next() == Some(name.as_bytes())
}
