//! Files that are handed out: the report, the other results, what pages are made of.

use super::answer::{Answer, Wrong, aside};
use super::api::place;
use super::app::App;
use super::pages::result;
use axum::extract::{Path, State};
use axum::http::header;
use axum::response::IntoResponse;
use std::sync::Arc;

type Shared = State<Arc<App>>;

/// The report may run its own scripts and nothing else: it is a stranger to the page.
const SANDBOX: &str = "sandbox allow-scripts allow-downloads allow-modals; default-src 'none'; \
    script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; connect-src data: blob:; font-src data:";

/// The report.
pub(super) async fn report(State(app): Shared, Path(id): Path<String>) -> Answer {
    let file = place(&app, &id)?.out().join("report.html");
    let page = aside(move || std::fs::read(file).map_err(|_| Wrong::missing())).await?;
    let headers = [
        (header::CONTENT_TYPE, "text/html; charset=utf-8"),
        (header::CONTENT_SECURITY_POLICY, SANDBOX),
    ];
    Ok((headers, page).into_response())
}

/// A file of the results, to be kept.
pub(super) async fn out(State(app): Shared, Path((id, file)): Path<(String, String)>) -> Answer {
    let known = result::FILES.iter().find(|(name, _)| *name == file);
    let (name, media) = *known.ok_or_else(Wrong::missing)?;
    let path = place(&app, &id)?.out().join(name);
    let bytes = aside(move || std::fs::read(path).map_err(|_| Wrong::missing())).await?;
    let kept = format!("attachment; filename=\"{name}\"");
    Ok((
        [
            (header::CONTENT_TYPE, media.to_owned()),
            (header::CONTENT_DISPOSITION, kept),
        ],
        bytes,
    )
        .into_response())
}

/// Files of the pages themselves.
const ASSETS: [(&str, &str, &str); 6] = [
    (
        "page.css",
        "text/css; charset=utf-8",
        include_str!("assets/page.css"),
    ),
    ("icon.svg", "image/svg+xml", include_str!("assets/icon.svg")),
    (
        "drop.js",
        "text/javascript; charset=utf-8",
        include_str!("assets/drop.js"),
    ),
    (
        "brush.js",
        "text/javascript; charset=utf-8",
        include_str!("assets/brush.js"),
    ),
    (
        "live.js",
        "text/javascript; charset=utf-8",
        include_str!("assets/live.js"),
    ),
    (
        "table.js",
        "text/javascript; charset=utf-8",
        include_str!("assets/table.js"),
    ),
];

/// A file of the pages themselves.
pub(super) async fn asset(Path(name): Path<String>) -> Answer {
    let found = ASSETS.iter().find(|(n, ..)| *n == name);
    let (_, media, text) = found.ok_or_else(Wrong::missing)?;
    let headers = [
        (header::CONTENT_TYPE, *media),
        (header::CACHE_CONTROL, "private, max-age=60"),
    ];
    Ok((headers, *text).into_response())
}

/// The calls, as OpenAPI 3.1 names them.
pub const OPENAPI: &str = include_str!("../../docs/api/openapi.json");

/// What the calls are, for programs.
pub(super) async fn openapi() -> Answer {
    let media = [(header::CONTENT_TYPE, "application/json")];
    Ok((media, OPENAPI).into_response())
}
