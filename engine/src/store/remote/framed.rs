//! A record as it is in a shared store: the file that it is on disk, and behind it a small result.
//!
//! ```text
//! stage shared 1 NONCE RECORD_BYTES BLOB_BYTES\n
//! or, if somebody signs: stage shared 2 NONCE RECORD_BYTES BLOB_BYTES SIGNATURE\n
//! the file of the record
//! the result, if it is small; else it is a blob of its own
//! ```
//!
//! The nonce shows who wrote it, where an answer was lost. All that is read is data from strangers.

use super::super::record::{Record, Unread, parse as parse_record};
use buckets::SMALL_BYTES;
use stage::Hash;

const MAGIC: &str = "stage shared ";

/// What it was while the engine bore the name of its first product: the same layout.
const FORMER: &str = "tailor shared ";
const VERSION: &str = "1";

/// With a signature.
const SIGNED: &str = "2";

/// Results up to this size ride in the record; in tests less, where only that there are larger ones counts. \[bytes\]
pub(crate) const SMALL: usize = if cfg!(test) { 1 << 10 } else { SMALL_BYTES };

/// No record with its small result is larger. \[bytes\]
pub(super) const MOST: usize = 8 << 20;

/// No blob is larger. \[bytes\]
pub(super) const MOST_BLOB: u64 = 16 << 30;

/// What was read.
pub(super) struct Framed {
    pub(super) record: Record,
    /// The file of the record.
    pub(super) file: Vec<u8>,
    /// The result, if it is small.
    pub(super) blob: Option<Vec<u8>>,
    pub(super) signature: Option<String>,
}

/// The bytes of an object.
pub(super) fn bytes(
    nonce: &str,
    file: &[u8],
    blob: Option<&[u8]>,
    signature: Option<&str>,
) -> Vec<u8> {
    let size = blob.map_or("-".to_owned(), |blob| blob.len().to_string());
    let length = file.len();
    let head = match signature {
        None => format!("{MAGIC}{VERSION} {nonce} {length} {size}\n"),
        Some(word) => format!("{MAGIC}{SIGNED} {nonce} {length} {size} {word}\n"),
    };
    [head.as_bytes(), file, blob.unwrap_or_default()].concat()
}

/// The object of a key. Its record must be of that key, and its result the one that the record names.
pub(super) fn parse(object: &[u8], key: Hash) -> Result<Framed, Unread> {
    let end = object.iter().take(HEAD_MOST).position(|b| *b == b'\n');
    let end = end.ok_or(Unread::Corrupt)?;
    let head = std::str::from_utf8(&object[..end]).map_err(|_| Unread::Corrupt)?;
    let words = head.strip_prefix(MAGIC).or(head.strip_prefix(FORMER));
    let words = words.ok_or(Unread::Corrupt)?;
    let words: Vec<&str> = words.split(' ').collect();
    let (record, blob, signature) = match words[..] {
        [VERSION, _, record, blob] => (record, blob, None),
        [SIGNED, _, record, blob, word] => (record, blob, Some(word.to_owned())),
        [VERSION | SIGNED, ..] => return Err(Unread::Corrupt),
        _ => return Err(Unread::OtherVersion),
    };
    let length: usize = record.parse().map_err(|_| Unread::Corrupt)?;
    let rest = &object[end + 1..];
    let (file, tail) = rest.split_at_checked(length).ok_or(Unread::Corrupt)?;
    let record = parse_record(file)?;
    // The size that it gives decides what goes when the store grows.
    let whole = match blob {
        "-" => tail.is_empty() && record.bytes <= MOST_BLOB,
        size => {
            size.parse() == Ok(tail.len())
                && record.bytes == tail.len() as u64
                && blake3::hash(tail) == record.content
        }
    };
    if !whole || record.key() != key || !is_plain(&record) {
        return Err(Unread::Corrupt);
    }
    Ok(Framed {
        record,
        file: file.to_vec(),
        blob: (blob != "-").then(|| tail.to_vec()),
        signature,
    })
}

/// The record of an object, if it can be read.
#[cfg(test)]
pub(crate) fn readable(object: &[u8], key: Hash) -> Option<Record> {
    parse(object, key).ok().map(|framed| framed.record)
}

const HEAD_MOST: usize = 400;

/// Texts that are shown to people move no cursor and ring no bell.
fn is_plain(record: &Record) -> bool {
    let plain = |text: &str| {
        !text
            .chars()
            .any(|c| c.is_control() && c != '\n' && c != '\t')
    };
    let metrics = record.metrics.iter();
    let mut names = metrics.flat_map(|m| [m.name.as_str(), m.unit.as_str()]);
    record.warnings.iter().all(|w| w.all_texts(&plain)) && names.all(plain)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(blob: &[u8]) -> Record {
        Record {
            provenance: vec![("stage".into(), "toy v1".into())],
            content: blake3::hash(blob),
            bytes: blob.len() as u64,
            seconds: 0.5,
            metrics: vec![],
            warnings: vec!["so so".into()],
        }
    }

    #[test]
    fn what_is_cut_changed_or_of_another_key_is_refused() {
        let (blob, record) = (b"small".as_slice(), record(b"small"));
        let key = record.key();
        let file = record.file();
        for (blob, word) in [(None, None), (Some(blob), None), (Some(blob), Some("a:b"))] {
            let object = bytes("n0nce", file.as_bytes(), blob, word);
            let read = parse(&object, key).ok().expect("whole");
            assert_eq!((&read.record, read.blob.as_deref()), (&record, blob));
            assert_eq!(read.signature.as_deref(), word);
            let former = [FORMER.as_bytes(), &object[MAGIC.len()..]].concat();
            assert_eq!(parse(&former, key).ok().expect("whole").record, record);
            for end in 0..object.len() {
                assert!(parse(&object[..end], key).is_err(), "{end}");
            }
            for at in 0..object.len() {
                let mut other = object.clone();
                other[at] ^= 1;
                let same = parse(&other, key).ok().is_none_or(|o| o.record == record);
                assert!(same, "{at}");
            }
            assert!(parse(&object, Hash::from_bytes([1; 32])).is_err());
            assert!(parse(&[object.as_slice(), b"x"].concat(), key).is_err());
        }
        let later = String::from_utf8(bytes("n", file.as_bytes(), None, None)).unwrap();
        let later = later.replacen("shared 1", "shared 3", 1);
        assert!(matches!(
            parse(later.as_bytes(), key),
            Err(Unread::OtherVersion)
        ));
    }

    #[test]
    fn a_size_that_is_not_the_blob_s_and_a_time_that_nobody_has_are_refused() {
        let object = |change: &dyn Fn(&mut Record), blob: Option<&[u8]>| {
            let mut bad = record(b"small");
            change(&mut bad);
            let read = parse(&bytes("n", bad.file().as_bytes(), blob, None), bad.key());
            read.is_ok()
        };
        let blob = Some(b"small".as_slice());
        assert!(object(&|_| (), blob) && object(&|_| (), None));
        assert!(!object(&|r| r.bytes = u64::MAX, blob));
        assert!(!object(&|r| r.bytes = u64::MAX, None));
        for seconds in [1e308, -1.0] {
            assert!(!object(&|r| r.seconds = seconds, blob), "{seconds}");
        }
    }

    #[test]
    fn texts_that_would_move_a_cursor_are_refused() {
        let mut bad = record(b"x");
        bad.warnings = vec!["\u{1b}[2J".into()];
        let object = bytes("n", bad.file().as_bytes(), Some(b"x"), None);
        assert!(parse(&object, bad.key()).is_err());
    }
}
