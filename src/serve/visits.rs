//! What people visit: pages, and what their forms send.

use super::answer::{Answer, Wrong, aside};
use super::api::place;
use super::app::App;
use super::home::Place;
use super::keeping::{self, Unkept};
use super::pages::{self, detail, facts::Slips, home};
use super::{batch, delete, masks, work};
use crate::words::language::{Language, Words};
use axum::Extension;
use axum::extract::{Form, Path, State};
use axum::http::{HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Redirect, Response};
use std::collections::HashMap;
use std::sync::Arc;
use std::sync::atomic::Ordering;

type Shared = State<Arc<App>>;
type Reader = Extension<Words>;
/// What a form sends.
type Sent = Form<HashMap<String, String>>;

fn html(markup: maud::Markup) -> Response {
    let media = [(header::CONTENT_TYPE, "text/html; charset=utf-8")];
    (media, markup.into_string()).into_response()
}

fn back(place: &Place) -> Response {
    Redirect::to(&format!("/captures/{}", place.id)).into_response()
}

/// The first page.
pub(super) async fn start(State(app): Shared, Extension(words): Reader) -> Answer {
    Ok(html(home::home(&app, words, &batch::lines(&app))))
}

/// The table of captures alone.
pub(super) async fn rows(State(app): Shared, Extension(words): Reader) -> Answer {
    Ok(html(home::rows(words, &batch::lines(&app))))
}

/// Measures every capture that was not.
pub(super) async fn measure_all(State(app): Shared) -> Answer {
    aside(move || {
        batch::measure(&app);
        Ok(())
    })
    .await?;
    Ok(Redirect::to("/").into_response())
}

/// The girths of every capture as a table.
pub(super) async fn girths(State(app): Shared) -> Answer {
    let media = [(header::CONTENT_TYPE, "text/csv; charset=utf-8")];
    Ok((media, batch::csv(&batch::lines(&app))).into_response())
}

/// Another language or unit.
pub(super) async fn settings(Form(sent): Sent) -> Answer {
    let field = |key: &str| sent.get(key).map(String::as_str).unwrap_or_default();
    let cookie = match (field("set"), Language::of(field("set"))) {
        (unit @ ("cm" | "in"), _) => format!("unit={unit}"),
        (_, Some(language)) => format!("lang={}", language.code()),
        _ => return Err(Wrong::unfit("set")),
    };
    let cookie = format!("{cookie}; Path=/; SameSite=Strict; HttpOnly; Max-Age=31536000");
    let cookie = HeaderValue::from_str(&cookie).map_err(Wrong::broken)?;
    // To a page of ours, whatever was sent.
    let to = Some(field("back"))
        .filter(|b| b.starts_with("/captures/") && !b.contains(['\\', '\n', '\r']));
    Ok((
        [(header::SET_COOKIE, cookie)],
        Redirect::to(to.unwrap_or("/")),
    )
        .into_response())
}

fn content(
    app: &App,
    place: Place,
    slips: Slips,
    alert: Option<String>,
) -> Result<detail::Content, Wrong> {
    let (record, look, progress) = (place.record()?, place.look(), app.jobs.progress(&place));
    let girths = place.girths(progress.state);
    Ok(detail::Content {
        place,
        record,
        look,
        progress,
        girths,
        slips,
        alert,
    })
}

/// A capture.
pub(super) async fn visit(
    State(app): Shared,
    Extension(words): Reader,
    Path(id): Path<String>,
) -> Answer {
    let content = content(&app, place(&app, &id)?, Slips::default(), None)?;
    Ok(html(detail::detail(words, &content)))
}

/// Looks at the photos.
pub(super) async fn look(State(app): Shared, Path(id): Path<String>) -> Answer {
    let place = place(&app, &id)?;
    let to = back(&place);
    aside(move || Ok(work::look(&app, &place)?)).await?;
    Ok(to)
}

/// Keeps what is known, or names the field that is wrong.
pub(super) async fn facts(
    State(app): Shared,
    Extension(words): Reader,
    Path(id): Path<String>,
    Form(sent): Sent,
) -> Answer {
    let place = place(&app, &id)?;
    // The unit may have been changed in another window since the form was shown.
    let inches = sent.get("unit").map_or(words.inches, |unit| {
        unit == Words {
            inches: true,
            ..words
        }
        .unit()
    });
    let words = Words { inches, ..words };
    match keeping::keep(&app, &place, |record| keeping::asked(words, record, &sent)) {
        Ok(()) => Ok(back(&place)),
        Err(Unkept::Wrong(wrong)) => Err(wrong),
        Err(Unkept::Slips(slips)) => {
            let (status, alert) = match slips.stale {
                true => (StatusCode::CONFLICT, stale(words, &slips)),
                false => (StatusCode::UNPROCESSABLE_ENTITY, words.text("facts-wrong")),
            };
            let page = detail::detail(words, &content(&app, place, slips, Some(alert))?);
            Ok((status, html(page)).into_response())
        }
    }
}

/// Which fields another window changed meanwhile.
fn stale(words: Words, slips: &Slips) -> String {
    let name = |field: &&str| words.text(&format!("fact-{}", field.replace('_', "-")));
    let fields: Vec<String> = slips.why.keys().map(name).collect();
    words.with("facts-stale", &[("fields", fields.join(", ").into())])
}

/// Measures; the report is in the unit that the reader reads.
pub(super) async fn measure(
    State(app): Shared,
    Extension(words): Reader,
    Path(id): Path<String>,
) -> Answer {
    let place = place(&app, &id)?;
    let to = back(&place);
    if !app.jobs.progress(&place).goes_on() {
        app.home
            .change(&place, |record| record.facts.inches = words.inches)?;
    }
    // What is wrong with the capture is on its page.
    aside(move || {
        let _ = work::measure(&app, &place);
        Ok(())
    })
    .await?;
    Ok(to)
}

/// Stops; what is done is kept.
pub(super) async fn stop(State(app): Shared, Path(id): Path<String>) -> Answer {
    let place = place(&app, &id)?;
    if let Some(job) = app.jobs.of(&place.id) {
        job.cancel.store(true, Ordering::Relaxed);
        let mut looks = job.sender.subscribe();
        // The page that comes back shows it, unless a stage takes its time.
        let over = looks.wait_for(|now| !now.goes_on());
        let _ = tokio::time::timeout(std::time::Duration::from_secs(2), over).await;
    }
    Ok(back(&place))
}

/// Takes a photo out.
pub(super) async fn remove_file(
    State(app): Shared,
    Path((id, number)): Path<(String, u32)>,
) -> Answer {
    let to = back(&place(&app, &id)?);
    super::api::delete_file(State(app), Path((id, number))).await?;
    Ok(to)
}

/// Asks once more.
pub(super) async fn ask_delete(
    State(app): Shared,
    Extension(words): Reader,
    Path(id): Path<String>,
) -> Answer {
    let place = place(&app, &id)?;
    let record = place.record()?;
    let results = place.out().exists();
    Ok(html(detail::delete(words, &place, &record, results)))
}

/// Removes a capture for good, and shows what went.
pub(super) async fn delete(
    State(app): Shared,
    Extension(words): Reader,
    Path(id): Path<String>,
) -> Answer {
    let place = place(&app, &id)?;
    let name = detail::name(words, &place.record()?);
    let gone = aside(move || delete::delete(&app, &place)).await?;
    Ok(html(detail::gone(words, &name, &gone)))
}

/// Outlines, to be corrected.
pub(super) async fn brush(
    State(app): Shared,
    Extension(words): Reader,
    Path(id): Path<String>,
) -> Answer {
    let place = place(&app, &id)?;
    let record = place.record()?;
    let corrected = masks::are_corrected(&place);
    Ok(html(pages::brush::brush(words, &place, &record, corrected)))
}

/// Takes all corrections of outlines back.
pub(super) async fn forget_masks(State(app): Shared, Path(id): Path<String>) -> Answer {
    let place = place(&app, &id)?;
    let to = Redirect::to(&format!("/captures/{}/masks", place.id)).into_response();
    aside(move || masks::forget(&app, &place)).await?;
    Ok(to)
}

/// Whatever is not there.
pub(super) async fn nowhere() -> Answer {
    Err(Wrong::missing())
}

/// The first page without the token, or with a wrong one.
pub(super) fn refused(words: Words, why: &'static str) -> Response {
    let page = pages::wrong(words, &words.text(why));
    (StatusCode::FORBIDDEN, html(page)).into_response()
}
