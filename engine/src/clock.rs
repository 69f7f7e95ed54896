//! The one clock: for names, stamps and durations, never for a key or a result.

/// Nanoseconds since 1970.
pub fn now_ns() -> i128 {
    #[expect(
        clippy::disallowed_methods,
        reason = "the one clock, outside of keys and results"
    )]
    let now = std::time::SystemTime::now();
    now.duration_since(std::time::UNIX_EPOCH)
        .map_or(0, |d| d.as_nanos() as i128)
}
