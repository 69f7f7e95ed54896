//! A run of a foreign program that is bounded and leaves nothing behind.
//!
//! A program is a group of processes of its own. It is killed with all its children when it takes too
//! long, when its answer is not taken, and when the user asks to stop.

use stage::process;
use std::ffi::OsString;
use std::io::{BufRead, BufReader, Read};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::time::{Duration, Instant};

/// A program and where it comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Program {
    /// What it is called by.
    pub(crate) name: &'static str,
    /// The package of Debian and Ubuntu that it is in.
    pub(crate) package: &'static str,
}

stage::failures! {
    /// Why a program gave nothing.
    pub enum ProgramError {
        /// It is not there.
        Missing {
            /// The program.
            name: &'static str,
            /// The package that it is in.
            package: &'static str,
            /// What it was to read.
            what: String,
        } = "fail-not-installed": "{name} is not installed, and {what} cannot be read without it: apt install {package}",
        /// It cannot be started, or its answer cannot be read.
        Broken {
            /// The program.
            name: &'static str,
            /// The system's message.
            why: String,
        } = "fail-not-run": "{name} cannot be run: {why}",
        /// It takes too long.
        TooLong {
            /// The program.
            name: &'static str,
            /// How long it was let run. \[s\]
            seconds: u64,
            /// What it was reading.
            what: String,
        } = "fail-program-long": "{name} was ended after {seconds:.0 s} with {what}: is the file far longer than one turn, or damaged?",
    }
}

/// A process with all its children: killed when nobody holds it any more.
struct Group(Child);

impl Drop for Group {
    fn drop(&mut self) {
        if let Ok(None) = self.0.try_wait() {
            process::end_group(self.0.id());
            let _ = self.0.wait();
        }
    }
}

/// What comes out of a running program.
enum Event<T> {
    Item(T),
    Line(String),
    Broken(std::io::Error),
}

/// One run of a program.
pub(crate) struct Run<'a> {
    /// The program.
    pub(crate) program: Program,
    /// Its arguments.
    pub(crate) args: Vec<OsString>,
    /// What it reads, for people.
    pub(crate) what: &'a str,
    /// How long it may run.
    pub(crate) limit: Duration,
}

impl Run<'_> {
    /// Runs it. `read` takes the next item off its output, `item` is given it, `line` each line that
    /// it writes beside its output; `go_on` is asked ten times a second whether to go on.
    pub(crate) fn run<T: Send, E: From<ProgramError>>(
        &self,
        mut read: impl FnMut(&mut dyn BufRead) -> std::io::Result<Option<T>> + Send,
        mut item: impl FnMut(T) -> Result<(), E>,
        mut line: impl FnMut(&str),
        go_on: impl Fn() -> Result<(), E>,
    ) -> Result<ExitStatus, E> {
        let mut group = self.start()?;
        let stdout = group.0.stdout.take().expect("bug: no pipe");
        let stderr = group.0.stderr.take().expect("bug: no pipe");
        let (to, from) = sync_channel(4);
        let beside = to.clone();
        std::thread::scope(|scope| {
            scope.spawn(move || {
                let mut stdout = BufReader::with_capacity(1 << 18, stdout);
                loop {
                    let event = match read(&mut stdout) {
                        Ok(Some(next)) => Event::Item(next),
                        Ok(None) => return,
                        Err(why) => Event::Broken(why),
                    };
                    let last = matches!(event, Event::Broken(_));
                    if to.send(event).is_err() || last {
                        return;
                    }
                }
            });
            scope.spawn(move || lines(stderr, &beside));
            // Moved in, so that the threads' sending ends when this does; the program before them.
            let (from, mut group) = (from, group);
            let start = Instant::now();
            let on = || go_on().and_then(|()| self.in_time(start).map_err(E::from));
            let heard = self::listen(&from, &mut item, &mut line, &on);
            drop(from);
            heard.map_err(|why| why.unwrap_or_else(|why| self.broken(&why).into()))?;
            // Its pipes are closed; as a rule it is gone.
            loop {
                match group.0.try_wait() {
                    Ok(Some(status)) => return Ok(status),
                    Ok(None) => on()?,
                    Err(why) => return Err(self.broken(&why).into()),
                }
                std::thread::sleep(Duration::from_millis(5));
            }
        })
    }

    fn broken(&self, why: &std::io::Error) -> ProgramError {
        ProgramError::Broken {
            name: self.program.name,
            why: why.to_string(),
        }
    }

    fn start(&self) -> Result<Group, ProgramError> {
        let Program { name, package } = self.program;
        let mut command = Command::new(name);
        command
            .args(&self.args)
            .env("LC_ALL", "C")
            // It would write a report into the current folder.
            .env_remove("FFREPORT")
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        process::lead_group(&mut command);
        match command.spawn() {
            Ok(child) => Ok(Group(child)),
            Err(why) if why.kind() == std::io::ErrorKind::NotFound => Err(ProgramError::Missing {
                name,
                package,
                what: self.what.to_owned(),
            }),
            Err(why) => Err(self.broken(&why)),
        }
    }

    fn in_time(&self, start: Instant) -> Result<(), ProgramError> {
        match start.elapsed() > self.limit {
            true => Err(ProgramError::TooLong {
                name: self.program.name,
                seconds: self.limit.as_secs(),
                what: self.what.to_owned(),
            }),
            false => Ok(()),
        }
    }
}

/// Takes all that comes until both pipes are closed; fails with the taker's error, or the pipe's.
fn listen<T, E>(
    from: &Receiver<Event<T>>,
    item: &mut impl FnMut(T) -> Result<(), E>,
    line: &mut impl FnMut(&str),
    on: &impl Fn() -> Result<(), E>,
) -> Result<(), Result<E, std::io::Error>> {
    loop {
        on().map_err(Ok)?;
        match from.recv_timeout(Duration::from_millis(100)) {
            Ok(Event::Item(next)) => item(next).map_err(Ok)?,
            Ok(Event::Line(text)) => line(&text),
            Ok(Event::Broken(why)) => return Err(Err(why)),
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => return Ok(()),
        }
    }
}

/// Sends each line; one that never ends is cut.
fn lines<T>(from: impl Read, to: &SyncSender<Event<T>>) {
    /// Longest text (structural: what is shown of a program's own words).
    const LONGEST: u64 = 4096;
    let mut from = BufReader::new(from);
    loop {
        let mut bytes = Vec::new();
        let read = (&mut from).take(LONGEST).read_until(b'\n', &mut bytes);
        if !matches!(read, Ok(1..)) {
            return;
        }
        let text = String::from_utf8_lossy(&bytes).trim_end().to_owned();
        if to.send(Event::Line(text)).is_err() {
            return;
        }
    }
}

/// All that a program answers, if it is no more than `most` bytes.
pub(crate) fn whole(most: u64) -> impl FnMut(&mut dyn BufRead) -> std::io::Result<Option<Vec<u8>>> {
    let mut done = false;
    move |from| {
        if std::mem::replace(&mut done, true) {
            return Ok(None);
        }
        let mut bytes = Vec::new();
        from.take(most + 1).read_to_end(&mut bytes)?;
        match bytes.len() as u64 > most {
            true => Err(std::io::Error::other(format!(
                "its answer is longer than {most} bytes"
            ))),
            false => Ok(Some(bytes)),
        }
    }
}

#[cfg(test)]
#[path = "program_tests.rs"]
mod tests;
