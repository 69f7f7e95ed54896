//! Bodies of calls as JSON objects, the version that they mean; and what the router refuses by itself, answered as all else.

use super::answer::Wrong;
use crate::words::language::Words;
use axum::Json;
use axum::body::to_bytes;
use axum::extract::{FromRequest, Request};
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::Response;
use serde::de::DeserializeOwned;
use serde_json::Value;

/// A body: a JSON object.
pub(super) struct Object<T>(pub(super) T);

impl<T: DeserializeOwned, S: Send + Sync> FromRequest<S> for Object<T> {
    type Rejection = Wrong;

    async fn from_request(request: Request, state: &S) -> Result<Self, Wrong> {
        let read = Json::<Value>::from_request(request, state).await;
        let Json(value) = read.map_err(|why| {
            let key = match why.status() {
                StatusCode::BAD_REQUEST => "wrong-json",
                StatusCode::UNSUPPORTED_MEDIA_TYPE => "wrong-media",
                _ => "wrong-request",
            };
            Wrong::new(why.status(), key).put("why", why.body_text())
        })?;
        // A list would be taken for the fields in their order.
        if !value.is_object() {
            return Err(Wrong::new(StatusCode::UNPROCESSABLE_ENTITY, "wrong-object"));
        }
        serde_json::from_value(value)
            .map(Object)
            .map_err(Wrong::unfit)
    }
}

/// The tag of a version.
pub(super) fn tag(version: u64) -> String {
    format!("\"{version}\"")
}

/// Whether a call means what there is by now: without `If-Match` it means whatever there is.
///
/// # Errors
///
/// It means another version.
pub(super) fn means(headers: &HeaderMap, version: u64) -> Result<(), Wrong> {
    let Some(asked) = headers.get(header::IF_MATCH) else {
        return Ok(());
    };
    let asked = asked.to_str().unwrap_or_default();
    let fits = |one: &str| one == "*" || one == tag(version);
    match asked.split(',').map(str::trim).any(fits) {
        true => Ok(()),
        false => Err(Wrong::new(StatusCode::PRECONDITION_FAILED, "wrong-stale")),
    }
}

/// The longest text of the router's own. \[bytes\]
const MOST: usize = 4 << 10;

/// What the router refused by itself, in plain text or without one, as all other refusals are answered.
pub(super) async fn as_all_else(answer: Response, words: Words, page: bool) -> Response {
    let status = answer.status();
    let media_type = answer.headers().get(header::CONTENT_TYPE);
    let media_type = media_type.and_then(|media| media.to_str().ok());
    let plain = media_type.is_none_or(|media| media.starts_with("text/plain"));
    if !(status.is_client_error() || status.is_server_error()) || !plain {
        return answer;
    }
    let allowed = answer.headers().get(header::ALLOW).cloned();
    let text = to_bytes(answer.into_body(), MOST).await.unwrap_or_default();
    let wrong = match status {
        StatusCode::METHOD_NOT_ALLOWED => Wrong::new(status, "wrong-method"),
        _ => Wrong::new(status, "wrong-request").put("why", String::from_utf8_lossy(&text)),
    };
    let mut answer = wrong.answer(words, page);
    if let Some(allowed) = allowed {
        answer.headers_mut().insert(header::ALLOW, allowed);
    }
    answer
}
