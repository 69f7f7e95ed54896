//! What programs call, and the page's scripts: JSON in, JSON out.

use super::answer::{Answer, Wrong, aside};
use super::app::App;
use super::body::{Object, means, tag};
use super::facts::{Facts, Plate};
use super::home::Place;
use super::keeping::{keep, merged};
use super::pages::plain;
use super::{delete, masks, show, small, spoken, upload, work};
use crate::words::language::Words;
use axum::Extension;
use axum::Json;
use axum::body::Body;
use axum::extract::{Path, Query, State};
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::IntoResponse;
use serde::Deserialize;
use serde_json::{Value, json};
use std::sync::Arc;
use std::sync::atomic::Ordering;

/// The capture of an ID.
///
/// # Errors
///
/// There is none.
pub(super) fn place(app: &App, id: &str) -> Result<Place, Wrong> {
    app.home.place(id).ok_or_else(Wrong::missing)
}

type Shared = State<Arc<App>>;
type Reader = Extension<Words>;

/// What there is.
fn capture(app: &App, place: &Place, words: Words) -> Result<Value, Wrong> {
    let record = place.record()?;
    let progress = app.jobs.progress(place);
    let girths = place.girths(progress.state);
    let progress = spoken::progress(words, &record, progress);
    let look = place.look().map(|look| spoken::look(words, &record, look));
    Ok(json!({
        "id": place.id, "name": record.name, "begun": record.begun, "files": record.files,
        "facts": record.facts, "version": record.version, "plate": record.plate().map(|(number, _)| number),
        "look": look, "measuring": progress, "girths": girths,
    }))
}

/// Every capture, the newest first.
pub(super) async fn list(State(app): Shared) -> Answer {
    let all = app.home.all().into_iter().map(|(place, record)| {
        let state = app.jobs.progress(&place).state;
        let girths = place.girths(state);
        let measured = girths.and_then(|g| Some(g["girths"].as_array()?.len()));
        json!({ "id": place.id, "name": record.name, "begun": record.begun,
                "files": record.files.len(), "state": state, "girths": measured })
    });
    Ok(Json(json!({ "captures": all.collect::<Value>() })).into_response())
}

/// What a new capture is called.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct New {
    #[serde(default)]
    name: String,
}

/// A new capture.
pub(super) async fn create(State(app): Shared, Object(new): Object<New>) -> Answer {
    let place = app.home.create(&new.name)?;
    let at = format!("/api/captures/{}", place.id);
    let answer = Json(json!({ "id": place.id }));
    Ok((StatusCode::CREATED, [(header::LOCATION, at)], answer).into_response())
}

/// One capture.
pub(super) async fn read(
    State(app): Shared,
    Extension(words): Reader,
    Path(id): Path<String>,
) -> Answer {
    let place = place(&app, &id)?;
    let json = capture(&app, &place, words)?;
    let version = tag(json["version"].as_u64().unwrap_or_default());
    Ok(([(header::ETAG, version)], Json(json)).into_response())
}

/// What a file is called.
#[derive(Deserialize)]
pub(super) struct Named {
    #[serde(default)]
    name: String,
}

/// A file of a capture.
pub(super) async fn put_file(
    State(app): Shared,
    Path((id, number)): Path<(String, u32)>,
    Query(named): Query<Named>,
    headers: HeaderMap,
    body: Body,
) -> Answer {
    let place = place(&app, &id)?;
    let length = headers.get(header::CONTENT_LENGTH);
    let length = length.and_then(|l| l.to_str().ok()?.parse().ok());
    let kept = upload::keep(&app, &place, number, &named.name, length, body).await?;
    Ok(Json(json!(kept)).into_response())
}

/// Takes a file out of a capture.
pub(super) async fn delete_file(
    State(app): Shared,
    Path((id, number)): Path<(String, u32)>,
) -> Answer {
    let place = place(&app, &id)?;
    if app.jobs.progress(&place).goes_on() {
        return Err(Wrong::new(StatusCode::CONFLICT, "wrong-busy"));
    }
    let gone = app.home.change(&place, |record| {
        if record.facts.plate == Plate::Photo(number) {
            record.facts.plate = Plate::ByName;
        }
        record.files.remove(&number)
    })?;
    let gone = gone.ok_or_else(Wrong::missing)?;
    std::fs::remove_file(place.photos().join(gone.file))?;
    place.outdated();
    Ok(StatusCode::NO_CONTENT.into_response())
}

/// The sides of small photos. \[px\]
const SIDES: [u32; 2] = [320, 1280];

/// A photo made small.
pub(super) async fn photo(
    State(app): Shared,
    Path((id, number, side)): Path<(String, u32, u32)>,
) -> Answer {
    let place = place(&app, &id)?;
    let side = SIDES
        .into_iter()
        .find(|s| *s == side)
        .ok_or_else(Wrong::missing)?;
    let record = place.record()?;
    let kept = record.files.get(&number).filter(|kept| kept.size.is_some());
    let file = place.photos().join(&kept.ok_or_else(Wrong::missing)?.file);
    let _turn = app.decoding.acquire().await.map_err(Wrong::broken)?;
    let folder = place.folder.join("small");
    let bytes = aside(move || small::small(&file, &folder, side).map_err(Wrong::unfit)).await?;
    Ok(([(header::CONTENT_TYPE, "image/jpeg")], bytes).into_response())
}

/// Sets what is known of a capture: all of it.
pub(super) async fn put_facts(
    State(app): Shared,
    Path(id): Path<String>,
    headers: HeaderMap,
    Object(facts): Object<Facts>,
) -> Answer {
    change(&app, &id, &headers, |_| Ok(facts))
}

/// Sets some of what is known; the rest stays.
pub(super) async fn patch_facts(
    State(app): Shared,
    Path(id): Path<String>,
    headers: HeaderMap,
    Object(some): Object<Value>,
) -> Answer {
    change(&app, &id, &headers, |known| merged(known, &some))
}

fn change(
    app: &App,
    id: &str,
    headers: &HeaderMap,
    how: impl FnOnce(&Facts) -> Result<Facts, Wrong>,
) -> Answer {
    let place = place(app, id)?;
    keep(app, &place, |record| {
        means(headers, record.version)?;
        how(&record.facts)
    })?;
    let version = tag(place.record()?.version);
    Ok((StatusCode::NO_CONTENT, [(header::ETAG, version)]).into_response())
}

/// Looks at the photos, as `tailor doctor` does.
pub(super) async fn look(
    State(app): Shared,
    Extension(words): Reader,
    Path(id): Path<String>,
) -> Answer {
    let place = place(&app, &id)?;
    let found = aside(move || {
        let look = work::look(&app, &place)?;
        Ok(spoken::look(words, &place.record()?, look))
    });
    Ok(Json(found.await?).into_response())
}

/// Measures, as `tailor measure` does; who asks while it runs joins.
pub(super) async fn measure(
    State(app): Shared,
    Extension(words): Reader,
    Path(id): Path<String>,
) -> Answer {
    let place = place(&app, &id)?;
    let new = aside(move || {
        let record = place.record()?;
        work::measure(&app, &place).map_err(|why| {
            let lines: Vec<String> = why.iter().map(|w| plain(words, &record, w)).collect();
            Wrong::unfit(lines.join("\n"))
        })
    });
    let new = new.await?;
    let status = if new {
        StatusCode::ACCEPTED
    } else {
        StatusCode::OK
    };
    Ok((status, Json(json!({ "joined": !new }))).into_response())
}

/// Stops a measuring; what is done is kept.
pub(super) async fn stop(State(app): Shared, Path(id): Path<String>) -> Answer {
    let place = place(&app, &id)?;
    if let Some(job) = app.jobs.of(&place.id) {
        job.cancel.store(true, Ordering::Relaxed);
    }
    Ok(StatusCode::NO_CONTENT.into_response())
}

/// A picture of a result on the way.
pub(super) async fn picture(
    State(app): Shared,
    Path((id, node)): Path<(String, String)>,
) -> Answer {
    let place = place(&app, &id)?;
    let results = app.jobs.progress(&place).pictures;
    let _turn = app.decoding.acquire().await.map_err(Wrong::broken)?;
    let shared = Arc::clone(&app);
    let made =
        aside(move || show::picture(&shared, &place, &results, &node).ok_or_else(Wrong::missing));
    let (media, bytes) = made.await?;
    Ok(([(header::CONTENT_TYPE, media)], bytes).into_response())
}

/// The outline of a photo as it is now.
pub(super) async fn mask(State(app): Shared, Path((id, number)): Path<(String, u32)>) -> Answer {
    let place = place(&app, &id)?;
    let bytes = aside(move || masks::mask(&place, number)).await?;
    Ok(([(header::CONTENT_TYPE, "image/png")], bytes).into_response())
}

/// Lays what was painted over the outline of a photo.
pub(super) async fn put_mask(
    State(app): Shared,
    Path((id, number)): Path<(String, u32)>,
    body: Body,
) -> Answer {
    let place = place(&app, &id)?;
    masks::paint(&app, &place, number, body).await?;
    Ok(StatusCode::NO_CONTENT.into_response())
}

/// Takes all corrections of outlines back.
pub(super) async fn delete_masks(State(app): Shared, Path(id): Path<String>) -> Answer {
    let place = place(&app, &id)?;
    aside(move || masks::forget(&app, &place)).await?;
    Ok(StatusCode::NO_CONTENT.into_response())
}

/// Removes a capture for good.
pub(super) async fn delete(State(app): Shared, Path(id): Path<String>) -> Answer {
    let place = place(&app, &id)?;
    let gone = aside(move || delete::delete(&app, &place)).await?;
    Ok(Json(json!(gone)).into_response())
}
