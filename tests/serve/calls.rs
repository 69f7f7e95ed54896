//! What the calls of a test have in common with those of a page: progress, read as events.

use super::server::Server;
use serde_json::Value;

/// The states that a measuring went through while somebody looked, until it was over.
pub(crate) fn events(server: &Server, id: &str) -> Vec<Value> {
    let answer = server
        .ask("GET", &format!("/api/captures/{id}/events"), &Value::Null)
        .is(200);
    assert_eq!(answer.header("content-type"), "text/event-stream");
    let text = answer.text();
    let data = text.lines().filter_map(|line| line.strip_prefix("data: "));
    data.map(|data| serde_json::from_str(data).unwrap())
        .collect()
}
