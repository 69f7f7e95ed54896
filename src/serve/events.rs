//! Progress as server-sent events: the whole state each time, so that whoever comes late, or comes back after
//! his lid was closed, misses nothing.

use super::answer::{Answer, Wrong};
use super::api::place;
use super::app::App;
use super::pages::progress;
use super::progress::Progress;
use super::record::Record;
use super::spoken;
use crate::words::language::Words;
use axum::Extension;
use axum::extract::{Path, State};
use axum::response::IntoResponse;
use axum::response::sse::{Event, KeepAlive, Sse};
use futures_util::stream::unfold;
use serde_json::json;
use std::convert::Infallible;
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::watch::Receiver;

/// Events are no closer together than this.
const PACE: Duration = Duration::from_millis(250);

/// What a page shows of it: `sentence` for who hears it, `steps` and `pictures` as HTML.
fn event(id: &str, words: Words, now: &Progress, record: &Record) -> Event {
    let measuring = spoken::progress(words, record, now.clone());
    let data = json!({
        "state": now.state,
        "measuring": measuring,
        "sentence": progress::sentence(words, now, false),
        "steps": progress::steps(words, now).into_string(),
        "pictures": progress::pictures(words, id, now).into_string(),
    });
    Event::default().event("progress").data(data.to_string())
}

/// Tells until the measuring is over.
pub(super) async fn events(
    State(app): State<Arc<App>>,
    Path(id): Path<String>,
    Extension(words): Extension<Words>,
) -> Answer {
    let place = place(&app, &id)?;
    let job = app.jobs.of(&place.id).ok_or_else(Wrong::missing)?;
    let receiver = job.sender.subscribe();
    // A capture that is being measured keeps its files.
    let record = Arc::new(place.record()?);
    let next = move |state: Option<(Receiver<Progress>, bool)>| {
        let (id, record) = (id.clone(), Arc::clone(&record));
        async move {
            let (mut receiver, first) = state?;
            if !first {
                tokio::time::sleep(PACE).await;
                receiver.changed().await.ok()?;
            }
            let now = receiver.borrow_and_update().clone();
            let event = event(&id, words, &now, &record);
            let rest = now.goes_on().then_some((receiver, false));
            Some((Ok::<_, Infallible>(event), rest))
        }
    };
    let stream = unfold(Some((receiver, true)), next);
    Ok(Sse::new(stream)
        .keep_alive(KeepAlive::default())
        .into_response())
}
