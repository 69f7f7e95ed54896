//! `tailor serve`: a page on this machine. Drop photos, look, measure.
//!
//! | file | what |
//! |---|---|
//! | `guard.rs` | who may ask |
//! | `routes.rs` | every call, and what all of them pass |
//! | `visits.rs`, `pages/`, `handed.rs` | pages and their forms, files handed out; `typed.rs` reads what was typed; texts are those of `src/words/`, `spoken.rs` has them for programs |
//! | `api.rs`, `body.rs`, `events.rs` | calls of programs and scripts, their bodies; progress as it happens |
//! | `upload.rs`, `sniff.rs` | files that come in |
//! | `home.rs`, `record.rs`, `facts.rs`, `keeping.rs`, `delete.rs` | captures on the disk, what is known of them, and who changes it |
//! | `jobs.rs`, `work.rs`, `progress.rs` | what is being measured |
//! | `show.rs`, `small.rs` | pictures to look at |
//! | `masks.rs` | outlines corrected with a brush |
//! | `batch.rs`, `lan.rs` | many captures; a phone in the same network |

mod answer;
mod api;
mod app;
mod batch;
mod body;
mod delete;
mod events;
mod facts;
mod guard;
mod handed;
mod home;
mod jobs;
mod keeping;
mod lan;
mod masks;
mod pages;
mod progress;
mod record;
mod routes;
mod show;
mod small;
mod sniff;
mod spoken;
mod typed;
mod upload;
mod visits;
mod work;

pub use handed::OPENAPI;
pub use routes::paths;
pub(crate) use work::MESSAGES;

use app::App;
use clap::Args;
use command::{CANCEL, Fault, GlobalArgs};
use guard::Guard;
use std::net::{IpAddr, Ipv4Addr, SocketAddr};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

/// Arguments of `tailor serve`.
#[derive(Args)]
pub(crate) struct Serve {
    /// The port; a free one if not given
    #[arg(long, default_value = "0")]
    port: u16,
    /// Let other machines of the local network in that have the address with its token: a phone with photos on it
    #[arg(long)]
    lan: bool,
    /// Where captures and their results are kept
    #[arg(long, default_value = "tailor-captures")]
    dir: PathBuf,
}

/// Bytes of the token.
const TOKEN: usize = 16;
/// Photos that are decoded at a time, to look at: each may need hundreds of megabytes.
const DECODERS: usize = 2;
/// How often it is looked whether the user asked to stop.
const LOOK: Duration = Duration::from_millis(100);
/// How long open answers may still take then.
const LAST: Duration = Duration::from_millis(500);

/// `tailor serve`: until the user asks to stop.
pub(crate) fn serve(serve: &Serve, global: &GlobalArgs) -> Result<(), Fault> {
    let runtime = tokio::runtime::Builder::new_multi_thread()
        .enable_all()
        .build();
    let runtime = runtime.map_err(Fault::stage)?;
    let ended = runtime.block_on(run(serve, global));
    runtime.shutdown_timeout(LAST);
    ended
}

async fn run(serve: &Serve, global: &GlobalArgs) -> Result<(), Fault> {
    let lan = serve.lan.then(lan::address).transpose();
    let lan = lan.map_err(|why| Fault::input(format!("--lan: {why}")))?;
    let own = IpAddr::V4(Ipv4Addr::LOCALHOST);
    let all = lan.map_or(own, |_| IpAddr::V4(Ipv4Addr::UNSPECIFIED));
    let listener = tokio::net::TcpListener::bind(SocketAddr::new(all, serve.port)).await;
    let taken = |why| {
        Fault::input(format!(
            "port {}: {why}; give another with --port, or none",
            serve.port
        ))
    };
    let listener = listener.map_err(taken)?;
    let port = listener.local_addr().map_err(Fault::stage)?.port();
    let names = [own.to_string(), "localhost".to_owned()];
    let names: Vec<String> = names
        .into_iter()
        .chain(lan.map(|ip| ip.to_string()))
        .collect();
    let token = guard::random(TOKEN).map_err(Fault::stage)?;
    let at = |name: &str| format!("http://{name}:{port}/?token={token}");
    let home = home::Home::open(&serve.dir);
    let home = home.map_err(|why| Fault::input(format!("--dir {}: {why}", serve.dir.display())))?;
    let app = Arc::new(App {
        home,
        jobs: jobs::Jobs::default(),
        guard: Guard::new(token.clone(), &names, port),
        global: global.clone(),
        looking: std::sync::Mutex::new(()),
        decoding: tokio::sync::Semaphore::new(DECODERS),
        lan: lan.map(|ip| at(&ip.to_string())),
    });
    print_address(&at(&own.to_string()), app.lan.as_deref(), serve, global);
    let served = axum::serve(listener, routes::router(Arc::clone(&app)));
    let ended = tokio::select! {
        ended = async { served.await } => ended.map_err(Fault::stage),
        () = asked_to_stop() => Ok(()),
    };
    let stopped = tokio::task::spawn_blocking(move || app.jobs.stop()).await;
    stopped.map_err(Fault::stage)?;
    ended
}

async fn asked_to_stop() {
    while !CANCEL.load(Ordering::Relaxed) {
        tokio::time::sleep(LOOK).await;
    }
}

/// Prints where the page is: standard output has its address, for programs too.
fn print_address(url: &str, lan: Option<&str>, serve: &Serve, global: &GlobalArgs) {
    if global.json {
        command::outln!("{}", serde_json::json!({ "url": url, "lan": lan }));
    } else {
        command::outln!("{url}");
        if let Some(lan) = lan {
            command::outln!("{lan}");
        }
    }
    use std::io::Write;
    let _ = std::io::stdout().flush();
    if global.quiet || global.json {
        return;
    }
    command::errln!(
        "open this address in a browser; Ctrl-C ends it. Captures are kept in {}",
        serve.dir.display()
    );
    if let Some(lan) = lan {
        command::errln!(
            "{}\nwhoever has the second address may use this page; what is sent can be read in this network",
            lan::letters(lan)
        );
    }
}
