//! Who starts a verb: who hears how it goes on, and what stops it.

use super::speech::CANCEL;
pub use super::telling::Telling;
use engine::walk::Watch;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Who starts a verb. By default the command line: lines on standard error, and Ctrl-C.
#[derive(Clone, Default)]
pub struct Host {
    /// Who hears how it goes on.
    pub watch: Option<Arc<dyn Watch + Send + Sync>>,
    /// How the run is reported on standard error, in place of a line a node.
    pub telling: Option<Arc<dyn Telling>>,
    /// Who hears the same beside it.
    pub beside: Option<Arc<dyn Watch + Send + Sync>>,
    /// Set when it shall stop.
    pub stop: Option<Arc<AtomicBool>>,
}

impl Host {
    /// Set when it shall stop.
    pub fn cancel(&self) -> &AtomicBool {
        self.stop.as_deref().unwrap_or(&CANCEL)
    }
}
