//! With which code the program ends, and what it prints last.

use super::fault::Fault;
use super::program::GlobalArgs;
use super::speech::LOST;
use std::sync::atomic::Ordering;

/// Prints what is wrong last of all, and gives the code with which the program ends.
pub(super) fn ended(done: Result<(), Fault>, global: &GlobalArgs) -> u8 {
    match done {
        Ok(()) if LOST.load(Ordering::Relaxed) => {
            crate::errln!("the answer could not be written to standard output: is the disk full?");
            1
        }
        Ok(()) => 0,
        Err(fault) => {
            let code = fault.code;
            if fault.text.is_empty() {
                // The answer itself has reported it.
            } else if global.json {
                crate::outln!("{}", fault.json());
            } else {
                crate::errln!("{}", fault.text);
            }
            code
        }
    }
}
