//! What a shared store holds, how it answers, and what is old enough to go. Ages are by its own clock.

use super::handshake::{self, Honest, fresh};
use super::link::Link;
use super::uploads::Sharing;
use buckets::{FOLDERS, Object, Objects, Trouble};
use std::time::{Duration, Instant, SystemTime};

/// A shared store, looked at.
#[derive(Debug, Clone, PartialEq)]
pub struct Looked {
    /// Records.
    pub records: usize,
    /// Blobs beside them.
    pub blobs: usize,
    /// Size of all. \[bytes\]
    pub bytes: u64,
    /// How long a small request took, of three the middle one. \[s\]
    pub answer_s: f64,
    /// By how much its clock is ahead of this machine's. \[s\]
    pub ahead_s: f64,
    /// What it does when two create one object; `None` if nothing is to be written.
    pub honest: Option<Honest>,
}

/// What went, or would go.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SweptThere {
    /// Records.
    pub records: usize,
    /// Blobs.
    pub blobs: usize,
    /// Plans.
    pub plans: usize,
    /// Uploads that were cut off.
    pub cut_off: usize,
    /// Size of all. \[bytes\]
    pub bytes: u64,
}

impl Sharing {
    /// Looks at the place.
    ///
    /// # Errors
    ///
    /// It does not answer, or refuses.
    pub fn look(&self) -> Result<Looked, Trouble> {
        let link = self.link();
        let (mut records, mut blobs, mut bytes) = (0, 0, 0);
        link.objects.list("", &mut |page| {
            for object in page {
                bytes += object.bytes;
                records += usize::from(object.name.starts_with("ac/"));
                blobs += usize::from(object.name.starts_with("cas/"));
            }
            true
        })?;
        let mut answers = [0.0; 3];
        for answer in &mut answers {
            let start = Instant::now();
            link.objects.size("format")?;
            *answer = start.elapsed().as_secs_f64();
        }
        answers.sort_by(f64::total_cmp);
        let (honest, ahead_s) = match link.is_read_only() {
            true => (None, 0.0),
            false => {
                let now = now_there(&*link.objects)?;
                let now = now
                    .duration_since(SystemTime::UNIX_EPOCH)
                    .unwrap_or_default();
                let ahead = (now.as_nanos() as i128 - system::clock::now_ns()) as f64 / 1e9;
                (Some(link.honest()?), ahead)
            }
        };
        Ok(Looked {
            records,
            blobs,
            bytes,
            answer_s: answers[1],
            ahead_s,
            honest,
        })
    }

    /// Removes what was written longer ago than `older`: records first, then blobs, which a younger record
    /// may share (whoever reads that makes it again), and plans.
    ///
    /// # Errors
    ///
    /// It does not answer, or refuses; what went by then is gone.
    pub fn sweep(&self, older: Duration, dry_run: bool) -> Result<SweptThere, Trouble> {
        self.link().sweep(older, dry_run)
    }
}

impl Link {
    /// See [`Sharing::sweep`].
    pub(crate) fn sweep(&self, older: Duration, dry_run: bool) -> Result<SweptThere, Trouble> {
        let objects = &*self.objects;
        // Asked as all else is: only of a place whose layout is known to be ours.
        let before = self.ask(&|| now_there(objects))? - older;
        let mut swept = SweptThere::default();
        let mut going: Vec<Vec<Object>> = Vec::new();
        for folder in FOLDERS {
            let mut old = Vec::new();
            objects.list(folder, &mut |page| {
                old.extend(page.into_iter().filter(|object| object.modified < before));
                true
            })?;
            swept.bytes += old.iter().map(|object| object.bytes).sum::<u64>();
            going.push(old);
        }
        let plans = going[2].iter().filter(|o| !o.name.ends_with(".seal"));
        (swept.records, swept.blobs, swept.plans) = (going[0].len(), going[1].len(), plans.count());
        let (cut_off, bytes) = objects.sweep_cut_off(before, dry_run)?;
        swept.cut_off = cut_off;
        swept.bytes += bytes;
        if dry_run || going.iter().all(Vec::is_empty) {
            return Ok(swept);
        }
        // From now on nobody relies on what they knew to be there; and once more when all is gone, for
        // those who learned of it meanwhile.
        self.ask(&|| handshake::renew(objects))?;
        for object in going.iter().flatten() {
            self.ask(&|| objects.remove(&object.name))?;
        }
        self.ask(&|| handshake::renew(objects))?;
        Ok(swept)
    }
}

/// The time by the place's own clock: what is written there is dated by it.
fn now_there(objects: &dyn Objects) -> Result<SystemTime, Trouble> {
    let name = format!("probe/{}", fresh().to_hex());
    objects.put(&name, b"now")?;
    let mut now = None;
    let listed = objects.list("probe", &mut |page| {
        let own = page.into_iter().find(|object| object.name == name);
        now = own.map(|object| object.modified);
        now.is_none()
    });
    let _ = objects.remove(&name);
    listed?;
    now.ok_or_else(|| Trouble::Refused("what was written a moment ago is not listed".into()))
}
