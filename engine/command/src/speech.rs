//! What is printed, and whether it got anywhere; and whether the user asked to stop.

use super::text::plain;
use std::io::Write;
use std::sync::atomic::{AtomicBool, Ordering};

/// Set when an answer could not be written.
pub(super) static LOST: AtomicBool = AtomicBool::new(false);

/// Set when the user asks to stop.
pub static CANCEL: AtomicBool = AtomicBool::new(false);

/// Notes whether what was printed got anywhere.
fn printed(result: std::io::Result<()>) {
    let lost = |e: std::io::Error| e.kind() != std::io::ErrorKind::BrokenPipe;
    if result.is_err_and(lost) {
        LOST.store(true, Ordering::Relaxed);
    }
}

/// For `out!`.
pub fn answer(text: String) {
    printed(write!(std::io::stdout(), "{}", plain(text)));
}

/// For `outln!`.
pub fn answer_line(text: String) {
    printed(writeln!(std::io::stdout(), "{}", plain(text)));
}

/// A file in place of text: its bytes as they are.
pub(super) fn answer_bytes(bytes: &[u8]) {
    printed(std::io::stdout().write_all(bytes));
}

/// For `errln!`.
pub fn error_line(text: String) {
    let _ = writeln!(std::io::stderr(), "{}", plain(text));
}

/// All that was answered gets out.
pub(super) fn flush() {
    printed(std::io::stdout().flush());
}
