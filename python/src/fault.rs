//! Faults as `tailor.Error`; a panic is one, too.

use command::Fault;
use pyo3::prelude::*;
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// `tailor.Error` with a text, the exit code that the command would end with, and what `--json` prints.
fn error(py: Python<'_>, text: &str, code: u8, more: &str) -> PyErr {
    let made = py
        .import("tailor._errors")
        .and_then(|module| module.getattr("Error"))
        .and_then(|class| class.call1((text, code, more)));
    match made {
        Ok(error) => PyErr::from_value(error),
        Err(why) => why,
    }
}

/// A fault.
pub(crate) fn raised(py: Python<'_>, fault: Fault) -> PyErr {
    let (text, code) = (fault.text().to_owned(), fault.code());
    error(py, &text, code, &fault.json().to_string())
}

/// Something that is wrong with what was handed over.
pub(crate) fn wrong(py: Python<'_>, why: impl ToString) -> PyErr {
    raised(py, Fault::input(why))
}

/// A panic's message, as a fault.
pub(crate) fn bug(panic: &(dyn Any + Send)) -> Fault {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    let text = text.or(panic.downcast_ref::<&str>().copied());
    let text = text.unwrap_or("no message");
    Fault::stage(format!("bug: {text}; please report it"))
}

/// Does what needs no Python, without the interpreter's lock; a panic is a fault.
pub(crate) fn guarded<T: Send>(
    py: Python<'_>,
    work: impl FnOnce() -> Result<T, Fault> + Send,
) -> PyResult<T> {
    let done = py.detach(|| catch_unwind(AssertUnwindSafe(work)));
    let done = done.unwrap_or_else(|panic| Err(bug(&*panic)));
    done.map_err(|fault| raised(py, fault))
}
