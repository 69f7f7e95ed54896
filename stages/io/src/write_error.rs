//! Why something cannot be written as a file.

use std::error::Error;

/// Why an artifact cannot be written.
pub type WriteError = Box<dyn Error + Send + Sync>;
