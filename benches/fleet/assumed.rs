//! What the fleet on paper assumes.

/// A capture: seconds (and below bytes) of each node of `body.toml`, as one run of a made person wrote them into `run.json`
/// (two cores that other people used, too; 266 s).
#[rustfmt::skip]
pub(crate) const SECONDS: [f64; 20] = [
    1.72, 0.0, 0.0, 1.90, 0.04, 0.0, 25.56, 0.02, 1.78, 21.49,
    3.97, 80.89, 27.21, 25.46, 13.85, 47.50, 0.76, 1.50, 10.46, 1.87,
];

#[rustfmt::skip]
pub(crate) const BYTES: [u64; 20] = [
    4_706_861, 69, 192, 12_520, 3_648, 3_648, 931_472,
    3_648, 2_593_408, 3_648, 2_591_360, 519_296, 3_648, 68_960,
    272_768, 1_063_936, 32_747, 36_559, 15_065_088, 3_939_545,
];

/// From a request to the first byte of its answer. \[s\]
pub(crate) const ANSWER_S: f64 = 0.05;
/// What a part of the bucket takes: requests that read and requests that write. \[1/s\]
pub(crate) const READS: f64 = 5500.0;
pub(crate) const WRITES: f64 = 3500.0;
/// Of one worker. \[bytes/s\]
pub(crate) const WORKER_BYTES: f64 = 50e6;
/// A node takes up to so much more or less than the one above.
pub(crate) const SPREAD: f64 = 0.3;
/// Results up to this size ride in the record; of larger ones than that it is asked first.
pub(crate) const SMALL: u64 = 64 << 10;
pub(crate) const WORTH_ASKING: u64 = 1 << 20;
/// Of a plan, a capture's share: 36 files by name, hash and size, and its strand. \[bytes\]
pub(crate) const PLAN_BYTES: f64 = 4500.0;
/// A page of a listing, and how many are read before the store is found to be too large. \[bytes\]
pub(crate) const LIST_BYTES: f64 = 3e5;
pub(crate) const LISTED: u8 = 11;
pub(crate) const RECORD_BYTES: f64 = 2e3;
/// List prices of a large provider, in dollars: a thousand reads, a thousand writes, a GB kept for a month.
pub(crate) const PRICE: [f64; 3] = [0.0004, 0.005, 0.023];
