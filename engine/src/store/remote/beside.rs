//! Threads that upload beside the work: nobody waits for them.

use std::thread::{Builder, JoinHandle};

thread_local! {
    /// Whether this thread uploads beside the work: nobody waits for it.
    static BESIDE: std::cell::Cell<bool> = const { std::cell::Cell::new(false) };
}

/// Marks this thread: it uploads beside the work.
pub(super) fn beside() {
    BESIDE.set(true);
}

/// So many threads that work. Where the system gives fewer, those that there are do it all.
///
/// # Errors
///
/// It gives none.
pub(super) fn threads(
    many: usize,
    work: impl FnOnce() + Clone + Send + 'static,
) -> std::io::Result<Vec<JoinHandle<()>>> {
    let mut all = Vec::new();
    while all.len() < many {
        match Builder::new().spawn(work.clone()) {
            Ok(thread) => all.push(thread),
            Err(why) if all.is_empty() => return Err(why),
            Err(_) => break,
        }
    }
    Ok(all)
}

/// As long as something is done, this thread uploads beside the work.
#[cfg(test)]
pub(crate) fn working_beside<T>(work: impl FnOnce() -> T) -> T {
    let before = BESIDE.replace(true);
    let done = work();
    BESIDE.set(before);
    done
}

/// Whether this thread does.
pub(super) fn is_beside() -> bool {
    BESIDE.get()
}
