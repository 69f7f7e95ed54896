//! Getting to know a place: whether it is there, whose it is, and whether it keeps its word.

use buckets::{Created, Objects, Trouble, whole};
use stage::Hash;
use std::thread::Builder;

/// What `format` begins with: `stage shared store 1 IDENTITY`.
const FORMAT: &str = "stage shared store 1 ";

/// What it began with while the engine bore the name of its first product: the same layout.
const FORMER: &str = "tailor shared store 1 ";

const NAME: &str = "format";

/// Which store it is; another one after it was swept.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Identity(pub(super) [u8; 32]);

/// What a place does when two ask it to create one object.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Honest {
    /// One of them wins.
    Creates,
    /// Both are answered that they won.
    Overwrites,
}

/// A hash that nobody else has.
pub(in crate::store) fn fresh() -> Hash {
    use std::sync::atomic::{AtomicU64, Ordering};
    #[cfg(test)]
    if let Some(count) = system::clock::simulated::count() {
        return blake3::hash(&count.to_le_bytes());
    }
    static COUNT: AtomicU64 = AtomicU64::new(0);
    let count = COUNT.fetch_add(1, Ordering::Relaxed);
    let (id, now) = (std::process::id(), system::clock::now_ns());
    // Seeded by the system, each differently.
    let system = std::hash::BuildHasher::hash_one(&std::hash::RandomState::new(), count);
    blake3::hash(format!("{id} {count} {now} {system}").as_bytes())
}

/// The identity of the store there. One that is not there yet is made, unless nothing is to be written.
///
/// # Errors
///
/// The place does not answer or refuses; it holds something else; or there is none.
pub(super) fn identity(objects: &dyn Objects, read_only: bool) -> Result<Identity, Trouble> {
    if let Some(found) = whole(objects, NAME, 4096)? {
        return read(&found);
    }
    // A bucket that is not there answers that it has no such object, too; a listing shows which it is.
    let mut strange = None;
    objects.list("", &mut |page| {
        strange = page.into_iter().next().map(|object| object.name);
        strange.is_none()
    })?;
    if let Some(strange) = strange {
        // Somebody may have made it meanwhile.
        return match whole(objects, NAME, 4096)? {
            Some(found) => read(&found),
            None => Err(Trouble::Refused(format!(
                "it is not empty and holds no store ({strange} is there): nothing was written; give another prefix"
            ))),
        };
    }
    if read_only {
        return Err(Trouble::Refused(
            "there is no store yet, and nothing is to be written: run something with --store and \
             without --store-read-only first"
                .into(),
        ));
    }
    let own = text(fresh());
    let created = objects.create(NAME, own.as_bytes())?;
    match whole(objects, NAME, 4096)? {
        Some(found) => read(&found),
        None => Err(nothing_there(&[created])),
    }
}

/// Gives the store another identity: what caches know of it no longer counts.
///
/// # Errors
///
/// The place does not answer, or refuses.
pub(super) fn renew(objects: &dyn Objects) -> Result<(), Trouble> {
    objects.put(NAME, text(fresh()).as_bytes())
}

fn text(identity: Hash) -> String {
    format!("{FORMAT}{}\n", identity.to_hex())
}

fn read(bytes: &[u8]) -> Result<Identity, Trouble> {
    let text = String::from_utf8_lossy(bytes);
    let marks = [FORMAT, FORMER].iter();
    let hex = marks.filter_map(|m| text.trim().strip_prefix(m)).next();
    let hash = hex.and_then(|hex| Hash::from_hex(hex).ok());
    hash.map(|hash| Identity(*hash.as_bytes())).ok_or_else(|| {
        let found: String = text.trim().chars().filter(|c| !c.is_control()).take(40).collect();
        Trouble::Refused(format!(
            "its layout is another ({found:?}): another version of the program made it, use that or give another prefix"
        ))
    })
}

fn unreliable(what: &str) -> Trouble {
    Trouble::Refused(format!(
        "{what}: nothing of ours is kept in a store that does not keep what it is given"
    ))
}

/// Nothing is there after it was created: lost, if an answer was that it is new; else all met a conflict, which passes
/// and is asked again.
fn nothing_there(created: &[Created]) -> Trouble {
    match created.contains(&Created::New) {
        true => unreliable("what was written a moment ago is not there"),
        false => Trouble::Down("it reports a conflict about an object that is not there".into()),
    }
}

/// Whether of two that create one object one wins, and whether the place gives back what it was given.
/// What was written for it is removed.
///
/// # Errors
///
/// The place does not answer, refuses, or gives back something else.
pub(super) fn probe(objects: &dyn Objects) -> Result<Honest, Trouble> {
    let name = format!("probe/{}", fresh().to_hex());
    let one = |n: u8| format!("{n} {}", fresh().to_hex()).into_bytes();
    let texts = [one(1), one(2)];
    let create = |text: &Vec<u8>| objects.create(&name, text);
    let came = match system::clock::is_simulated() {
        true => [create(&texts[0]), create(&texts[1])],
        false => std::thread::scope(|scope| {
            // Without a thread of its own the first one comes after the second.
            let first = Builder::new().spawn_scoped(scope, || create(&texts[0]));
            let second = create(&texts[1]);
            let first = first.map(|thread| thread.join().expect("bug: a probe panicked"));
            [first.unwrap_or_else(|_| create(&texts[0])), second]
        }),
    };
    let found = whole(objects, &name, 4096);
    let _ = objects.remove(&name);
    let [first, second] = came;
    let (first, second, found) = (first?, second?, found?);
    let Some(found) = found else {
        return Err(nothing_there(&[first, second]));
    };
    if !texts.contains(&found) {
        return Err(unreliable("it gives other bytes than it was given"));
    }
    // An answer that was lost and asked for again may be "there" for both: one object all the same.
    match [first, second] {
        [Created::New, Created::New] => Ok(Honest::Overwrites),
        _ => Ok(Honest::Creates),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_was_new_is_lost_and_a_conflict_is_asked_again() {
        use Created::{New, There};
        assert!(matches!(nothing_there(&[There, There]), Trouble::Down(_)));
        assert!(matches!(nothing_there(&[There, New]), Trouble::Refused(_)));
    }
}
