//! What is answered when something is wrong: for programs as JSON, for people as a page, in their language.

use super::pages;
use crate::words::language::Words;
use axum::Json;
use axum::http::StatusCode;
use axum::response::{Html, IntoResponse, Response};
use serde_json::json;
use std::io::ErrorKind;

/// Why a request came to nothing: a text of `words/`, with what is put in.
#[derive(Debug, Clone)]
pub(super) struct Wrong {
    status: StatusCode,
    key: &'static str,
    put: Vec<(&'static str, String)>,
}

/// What comes of a request.
pub(super) type Answer = Result<Response, Wrong>;

impl Wrong {
    /// A text without places.
    pub(super) fn new(status: StatusCode, key: &'static str) -> Wrong {
        Wrong {
            status,
            key,
            put: vec![],
        }
    }

    /// With something put in.
    pub(super) fn put(mut self, place: &'static str, text: impl ToString) -> Wrong {
        self.put.push((place, text.to_string()));
        self
    }

    /// There is no such thing.
    pub(super) fn missing() -> Wrong {
        Wrong::new(StatusCode::NOT_FOUND, "wrong-missing")
    }

    /// The request's content is wrong.
    pub(super) fn unfit(why: impl ToString) -> Wrong {
        Wrong::new(StatusCode::UNPROCESSABLE_ENTITY, "wrong-said").put("why", why)
    }

    /// A task of the server's broke off.
    pub(super) fn broken(why: impl ToString) -> Wrong {
        Wrong::new(StatusCode::INTERNAL_SERVER_ERROR, "wrong-broken").put("why", why)
    }

    /// As JSON, or as a page.
    pub(super) fn answer(&self, words: Words, page: bool) -> Response {
        let put: Vec<_> = self
            .put
            .iter()
            .map(|(k, v)| (*k, v.as_str().into()))
            .collect();
        let text = words.with(self.key, &put);
        match page {
            true => (self.status, Html(pages::wrong(words, &text).into_string())).into_response(),
            false => (
                self.status,
                Json(json!({ "error": text, "code": self.key })),
            )
                .into_response(),
        }
    }
}

impl From<std::io::Error> for Wrong {
    fn from(why: std::io::Error) -> Wrong {
        match why.kind() {
            ErrorKind::StorageFull | ErrorKind::QuotaExceeded | ErrorKind::FileTooLarge => {
                Wrong::new(StatusCode::INSUFFICIENT_STORAGE, "wrong-full")
            }
            _ => Wrong::broken(why),
        }
    }
}

impl IntoResponse for Wrong {
    /// The language is known where all answers pass: see `routes.rs`.
    fn into_response(self) -> Response {
        let mut answer = self.status.into_response();
        answer.extensions_mut().insert(self);
        answer
    }
}

/// Something that takes a while, beside the server's own threads.
///
/// # Errors
///
/// Its own body, or that it broke off.
pub(super) async fn aside<T: Send + 'static>(
    what: impl FnOnce() -> Result<T, Wrong> + Send + 'static,
) -> Result<T, Wrong> {
    tokio::task::spawn_blocking(what)
        .await
        .map_err(Wrong::broken)?
}
