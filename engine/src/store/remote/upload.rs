//! Uploading one result: its blob before its record, and the record only if there is none.

use super::super::record::{Origin, Unread};
use super::framed::{self, SMALL};
use super::handshake::{Honest, fresh};
use super::link::Link;
use super::reads::{Theirs, object};
use crate::store::{Blob, Record, Store};
use buckets::{Created, Trouble};
use stage::Hash;
use system::clock;

/// What came of it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Came {
    /// It was written now.
    Sent,
    /// It was there, and is the same.
    There,
    /// Somebody else's result of the same key has another content: the stage is not deterministic.
    Differs(String),
    /// There is no such record here yet, or its result is gone: nothing to upload.
    Nothing,
}

/// Blobs of which it is asked first whether they are there: the question costs less than the bytes.
const WORTH_ASKING: usize = 1 << 20;

/// How often a record is created that is neither there nor taken.
const CREATES: usize = 8;

/// Uploads the result of a key.
pub(super) fn upload(store: &Store, link: &Link, key: Hash) -> Result<Came, Trouble> {
    let honest = link.honest()?;
    let (record, origin) = match store.read_with_origin(key) {
        Ok(read) => read,
        Err(Unread::Disk(why)) => return Err(Trouble::Refused(why.to_string())),
        Err(_) => return Ok(Came::Nothing),
    };
    let blob = store.blob_on_disk(record.content);
    let Some(blob) = blob.map_err(|why| Trouble::Refused(why.to_string()))? else {
        return Ok(Came::Nothing);
    };
    let small = blob.len() <= SMALL;
    if !small {
        keep(link, record.content, &blob)?;
    }
    let file = record.file();
    let nonce = fresh().to_hex().to_string();
    let may_sign = match origin {
        Some(Origin::Here(mark)) => store.mark() == Some(mark.as_str()),
        Some(Origin::Brought { signature, .. }) => {
            signature.is_some_and(|word| link.vouched(key, file.as_bytes(), &word))
        }
        None => false,
    };
    let signature = link.sign(key, file.as_bytes()).filter(|_| may_sign);
    match (link.signs() && signature.is_none(), may_sign) {
        (true, true) => link.warn_expired(),
        (true, false) => link.report_unsigned(),
        (false, _) => {}
    }
    let object = framed::bytes(
        &nonce,
        file.as_bytes(),
        small.then_some(&blob),
        signature.as_deref(),
    );
    publish(link, key, &record, (&object, signature.is_some()), honest)
}

/// Writes a blob that is not there yet, or not what its name promises.
fn keep(link: &Link, content: Hash, blob: &Blob) -> Result<(), Trouble> {
    let name = object("cas", content);
    let bad = link.queue().bad.contains(content.as_bytes());
    if bad {
        link.ask(&|| link.objects.put(&name, blob))?;
        link.queue().bad.remove(content.as_bytes());
        return Ok(());
    }
    let is_there = |size: Option<u64>| size == Some(blob.len() as u64);
    if blob.len() > WORTH_ASKING && is_there(link.ask(&|| link.objects.size(&name))?) {
        return Ok(());
    }
    // Equal names are equal bytes: nothing is lost where both write.
    match link.ask(&|| link.objects.create(&name, blob))? {
        Created::New => Ok(()),
        Created::There => match is_there(link.ask(&|| link.objects.size(&name))?) {
            true => Ok(()),
            // Of another size, or not there yet: another request was under way.
            false => link.ask(&|| link.objects.put(&name, blob)),
        },
    }
}

/// Creates the record, signed or not; whoever was first counts.
fn publish(
    link: &Link,
    key: Hash,
    record: &Record,
    (bytes, signed): (&[u8], bool),
    honest: Honest,
) -> Result<Came, Trouble> {
    let name = object("ac", key);
    for tried in 0..CREATES {
        let created = match honest {
            Honest::Creates => link.ask(&|| link.objects.create(&name, bytes))?,
            Honest::Overwrites => match link.record(key)? {
                Theirs::Absent => {
                    link.ask(&|| link.objects.put(&name, bytes))?;
                    Created::New
                }
                _ => Created::There,
            },
        };
        if created == Created::New {
            return Ok(Came::Sent);
        }
        match link.record(key)? {
            // A create of ours that was cut off comes back as "there", too; the same result is the same.
            Theirs::Whole(theirs) if theirs.record.content == record.content => {
                // What nobody signed is signed by us.
                if theirs.signature.is_some() || !signed {
                    return Ok(Came::There);
                }
                link.ask(&|| link.objects.put(&name, bytes))?;
                return Ok(Came::Sent);
            }
            Theirs::Whole(theirs) => {
                let content = theirs.record.content.to_hex();
                return Ok(Came::Differs(content[..12].to_owned()));
            }
            Theirs::Other => return Ok(Came::There),
            Theirs::Stranger => {
                link.report_stranger(&name);
                if !signed {
                    return Ok(Came::There);
                }
                link.ask(&|| link.objects.put(&name, bytes))?;
                return Ok(Came::Sent);
            }
            Theirs::Corrupt => {
                link.report(&format!(
                    "{name} was not what its name promises: written anew"
                ));
                link.ask(&|| link.objects.put(&name, bytes))?;
                return Ok(Came::Sent);
            }
            // Two requests met (409), and none of them won.
            Theirs::Absent => clock::pause(std::time::Duration::from_millis(10 << tried)),
        }
    }
    Err(Trouble::Down(format!(
        "{name} can neither be created nor read"
    )))
}
