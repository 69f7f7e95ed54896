//! Uploads of this process rest while it sweeps: what is forgotten is not put there again by who has read it before.

use super::link::Link;
use std::sync::Arc;
use std::time::Duration;
use system::clock;

/// As long as it is there, nothing of this process is uploaded.
pub(in crate::store) struct Paused(Arc<Link>);

impl std::fmt::Debug for Paused {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Paused")
    }
}

impl Paused {
    /// Begins no upload any more, and waits for those under way for as long as an answer may take.
    pub(in crate::store) fn new(link: &Arc<Link>) -> Paused {
        let (begun, answer) = (clock::instant(), link.patience().of_an_answer());
        let mut queue = link.queue();
        queue.paused += 1;
        while queue.running > 0 && clock::since(begun) < answer {
            let step = Duration::from_millis(50);
            let waited = link.bell.wait_timeout(queue, step);
            queue = waited.expect("bug: poisoned").0;
        }
        drop(queue);
        Paused(link.clone())
    }
}

impl Drop for Paused {
    fn drop(&mut self) {
        self.0.queue().paused -= 1;
        self.0.bell.notify_all();
    }
}
