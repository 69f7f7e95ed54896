//! Every call, and what all of them pass: who may ask, in which language, under which rules of the browser.

use super::answer::Wrong;
use super::app::App;
use super::guard::{Asked, Refused};
use super::{api, body, events, handed, visits};
use crate::words::language::{Language, Words};
use axum::Router;
use axum::extract::{DefaultBodyLimit, Request, State};
use axum::http::{HeaderMap, HeaderValue, Method, StatusCode, header};
use axum::middleware::{Next, from_fn_with_state};
use axum::response::{IntoResponse, Response};
use axum::routing::{MethodRouter, delete, get, post, put};
use std::sync::Arc;

/// A path with what answers it.
type Route = (&'static str, MethodRouter<Arc<App>>);

/// Bodies of calls other than files. \[bytes\]
const MOST_SENT: usize = 64 << 10;

/// Every call; `docs/api/openapi.json` names the same, by test.
fn routes() -> Vec<Route> {
    let capture = "/api/captures/{id}";
    let files = DefaultBodyLimit::disable();
    vec![
        ("/", get(visits::start)),
        ("/rows", get(visits::rows)),
        ("/measure", post(visits::measure_all)),
        ("/girths.csv", get(visits::girths)),
        ("/settings", post(visits::settings)),
        ("/assets/{name}", get(handed::asset)),
        ("/captures/{id}", get(visits::visit)),
        ("/captures/{id}/look", post(visits::look)),
        ("/captures/{id}/facts", post(visits::facts)),
        ("/captures/{id}/measure", post(visits::measure)),
        ("/captures/{id}/stop", post(visits::stop)),
        (
            "/captures/{id}/files/{number}/remove",
            post(visits::remove_file),
        ),
        (
            "/captures/{id}/delete",
            get(visits::ask_delete).post(visits::delete),
        ),
        ("/captures/{id}/masks", get(visits::brush)),
        ("/captures/{id}/masks/forget", post(visits::forget_masks)),
        ("/captures/{id}/report", get(handed::report)),
        ("/captures/{id}/out/{file}", get(handed::out)),
        ("/api/openapi.json", get(handed::openapi)),
        ("/api/captures", get(api::list).post(api::create)),
        (capture, get(api::read).delete(api::delete)),
        (
            "/api/captures/{id}/files/{number}",
            put(api::put_file)
                .layer(files)
                .merge(delete(api::delete_file)),
        ),
        (
            "/api/captures/{id}/files/{number}/small/{side}",
            get(api::photo),
        ),
        ("/api/captures/{id}/masks", delete(api::delete_masks)),
        (
            "/api/captures/{id}/masks/{number}",
            get(api::mask)
                .put(api::put_mask)
                .layer(DefaultBodyLimit::disable()),
        ),
        (
            "/api/captures/{id}/facts",
            put(api::put_facts).patch(api::patch_facts),
        ),
        ("/api/captures/{id}/look", post(api::look)),
        ("/api/captures/{id}/measure", post(api::measure)),
        ("/api/captures/{id}/stop", post(api::stop)),
        ("/api/captures/{id}/events", get(events::events)),
        ("/api/captures/{id}/pictures/{node}", get(api::picture)),
    ]
}

/// The paths of all calls.
pub fn paths() -> Vec<&'static str> {
    routes().into_iter().map(|(path, _)| path).collect()
}

/// All calls, guarded.
pub(super) fn router(app: Arc<App>) -> Router {
    let mut router = Router::new();
    for (path, answers) in routes() {
        router = router.route(path, answers);
    }
    router
        .fallback(visits::nowhere)
        .layer(DefaultBodyLimit::max(MOST_SENT))
        .layer(from_fn_with_state(Arc::clone(&app), pass))
        .with_state(app)
}

fn text<'a>(headers: &'a HeaderMap, name: &str) -> Option<&'a str> {
    headers.get(name)?.to_str().ok()
}

fn cookie<'a>(headers: &'a HeaderMap, name: &str) -> Option<&'a str> {
    let pairs = text(headers, "cookie")?.split(';');
    pairs
        .filter_map(|p| p.trim().split_once('='))
        .find(|(n, _)| *n == name)
        .map(|(_, v)| v)
}

/// What the reader wants to read: what he chose, else what his browser asks for.
fn words(headers: &HeaderMap) -> Words {
    let chosen = cookie(headers, "lang").and_then(Language::of);
    let asked = || text(headers, "accept-language").and_then(Language::asked);
    Words {
        language: chosen.or_else(asked).unwrap_or(Language::En),
        inches: cookie(headers, "unit") == Some("in"),
    }
}

/// The token of the address that the program printed.
fn token(request: &Request) -> Option<&str> {
    let mut pairs = request
        .uri()
        .query()?
        .split('&')
        .filter_map(|p| p.split_once('='));
    let at_start = request.uri().path() == "/" && request.method() == Method::GET;
    pairs
        .find(|(name, _)| at_start && *name == "token")
        .map(|(_, token)| token)
}

/// Lets a request through, or refuses it; and what the browser may do with the answer.
async fn pass(State(app): State<Arc<App>>, mut request: Request, next: Next) -> Response {
    let (headers, words) = (request.headers(), words(request.headers()));
    let asked = Asked {
        reads: [Method::GET, Method::HEAD].contains(request.method()),
        host: text(headers, "host"),
        origin: text(headers, "origin"),
        site: text(headers, "sec-fetch-site"),
        cookie: text(headers, "cookie"),
        authorization: text(headers, "authorization"),
    };
    let page = !request.uri().path().starts_with("/api/");
    let entered = token(&request).filter(|t| app.guard.is_token(t)).is_some();
    let mut answer = match (app.guard.is_from_here(&asked), app.guard.admits(&asked)) {
        // The token leaves the address line, and what the browser remembers of it.
        (Ok(()), _) if entered => {
            let cookie = app.guard.set_cookie();
            (
                StatusCode::SEE_OTHER,
                [
                    (header::SET_COOKIE, cookie),
                    (header::LOCATION, "/".to_owned()),
                ],
            )
                .into_response()
        }
        (_, Err(why)) => refused(words, why, page, asked.reads),
        _ => {
            request.extensions_mut().insert(words);
            next.run(request).await
        }
    };
    answer = match answer.extensions_mut().remove::<Wrong>() {
        Some(wrong) => wrong.answer(words, page),
        None => body::as_all_else(answer, words, page).await,
    };
    rules(answer.headers_mut());
    answer
}

fn refused(words: Words, why: Refused, page: bool, reads: bool) -> Response {
    let key = match why {
        // Somebody followed a link to it: a terminal in a browser, a notebook, mail.
        Refused::Origin if page && reads => "refused-address",
        Refused::Host => "refused-host",
        Refused::Origin => "refused-origin",
        Refused::Token => "refused-token",
    };
    match page {
        true => visits::refused(words, key),
        false => Wrong::new(StatusCode::FORBIDDEN, key).answer(words, false),
    }
}

/// Rules for the browser, unless an answer has its own.
fn rules(headers: &mut HeaderMap) {
    let policy = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; connect-src 'self'; \
        form-action 'self'; base-uri 'none'; frame-ancestors 'none'";
    for (name, value) in [
        (header::CONTENT_SECURITY_POLICY, policy),
        (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (header::X_FRAME_OPTIONS, "DENY"),
        (header::REFERRER_POLICY, "same-origin"),
        (header::CACHE_CONTROL, "no-store"),
        (header::VARY, "Cookie, Accept-Language"),
        (
            header::HeaderName::from_static("cross-origin-resource-policy"),
            "same-origin",
        ),
        (
            header::HeaderName::from_static("cross-origin-opener-policy"),
            "same-origin",
        ),
        (
            header::HeaderName::from_static("permissions-policy"),
            "camera=(), microphone=(), geolocation=()",
        ),
    ] {
        headers
            .entry(name)
            .or_insert(HeaderValue::from_static(value));
    }
}
