//! What waits for the network.

use crate::objects::Trouble;
use std::time::Duration;
use tokio::io::AsyncWriteExt;
use tokio::runtime::{Builder, Runtime};

/// Threads that ask wait themselves, and one beside them looks up names of hosts.
///
/// # Errors
///
/// The system gives no thread, or no file.
pub(crate) fn network() -> Result<Runtime, Trouble> {
    let refused = |why: std::io::Error| {
        Trouble::Refused(format!(
            "the system gives no thread, or no file, to wait for the network with ({why}): end other programs, or raise the limits (ulimit -u, ulimit -n)"
        ))
    };
    made().map_err(refused)
}

/// The thread is started here and stays: by writing, since whatever else starts one panics where there is none.
fn made() -> std::io::Result<Runtime> {
    let mut runtime = Builder::new_current_thread();
    let runtime = runtime.enable_all().max_blocking_threads(1);
    let runtime = runtime.thread_keep_alive(Duration::MAX).build()?;
    let mut file = tokio::fs::File::from_std(tempfile::tempfile()?);
    runtime.block_on(async {
        file.write_all(b"\n").await?;
        file.flush().await
    })?;
    Ok(runtime)
}
