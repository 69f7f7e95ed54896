//! Today, for keys that expire.

/// Nanoseconds of a day.
const DAY_NS: i128 = 86_400_000_000_000;

/// Today, in days since 1970-01-01, by this machine's clock and UTC.
pub(crate) fn today() -> i64 {
    system::clock::now_ns().div_euclid(DAY_NS) as i64
}
