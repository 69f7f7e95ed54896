//! What all requests share.

use super::guard::Guard;
use super::home::Home;
use super::jobs::Jobs;
use command::GlobalArgs;
use std::sync::Mutex;
use tokio::sync::Semaphore;

/// The server's own.
pub(super) struct App {
    /// Where captures are.
    pub(super) home: Home,
    /// What is being measured.
    pub(super) jobs: Jobs,
    /// Who may ask.
    pub(super) guard: Guard,
    /// What every verb takes.
    pub(super) global: GlobalArgs,
    /// One capture is looked at at a time.
    pub(super) looking: Mutex<()>,
    /// So many photos are decoded at a time.
    pub(super) decoding: Semaphore,
    /// The address for a phone, where there is one.
    pub(super) lan: Option<String>,
}

impl App {
    /// For what answers through the page alone.
    pub(super) fn quiet(&self) -> GlobalArgs {
        GlobalArgs {
            quiet: true,
            json: false,
            ..self.global.clone()
        }
    }
}
