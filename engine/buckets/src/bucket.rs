//! Buckets and shared folders by the crate `object_store`: `s3://`, `gs://`, `az://`, `file://`.
//!
//! Who may read and write is given by the usual variables of the environment (`AWS_…`, `GOOGLE_…`,
//! `AZURE_…`), and for S3 by a profile (`profile.rs`); by nothing else: an address that holds a secret is refused, and what a query of an
//! address holds is cut out of every text.

use crate::answer::{absent, plain, trouble};
use crate::clients::{ADDRESSES, of_scheme};
use crate::cut_off;
use crate::network::network;
use crate::objects::{Created, Got, Object, Objects, Trouble};
use crate::pace::Pace;
use crate::patience::Patience;
use futures_util::{FutureExt, StreamExt, TryStreamExt};
use object_store::local::LocalFileSystem;
use object_store::path::Path;
use object_store::{ObjectStore, ObjectStoreExt, PutMode, PutOptions, PutPayload};
use std::time::SystemTime;
use tokio::runtime::Runtime;

/// A bucket, or a shared folder.
struct Bucket {
    name: String,
    prefix: Path,
    store: Box<dyn ObjectStore>,
    /// As `store`, with time for a large result to get there.
    writes: Box<dyn ObjectStore>,
    /// What waits for the network, on the thread that asks; what a folder is asked for is never waited for.
    runtime: Option<Runtime>,
    /// Where it is, if it is a folder.
    folder: Option<std::path::PathBuf>,
}

/// The place of an address; how long an answer is waited for.
///
/// # Errors
///
/// The address is none, or what the environment has for it is not enough.
pub fn open(address: &str, patience: Patience) -> Result<Box<dyn Objects>, Trouble> {
    let refuse = |why: &str| Trouble::Refused(why.to_owned());
    let (scheme, rest) = address.split_once("://").ok_or_else(|| refuse(ADDRESSES))?;
    if rest.contains('@') || rest.contains('?') || rest.contains('#') {
        return Err(refuse(
            "its address holds more than a bucket and a prefix: who may use it is set in the environment (AWS_ACCESS_KEY_ID, AWS_SECRET_ACCESS_KEY, …)",
        ));
    }
    let (bucket, prefix) = rest.split_once('/').unwrap_or((rest, ""));
    let prefix = prefix.trim_end_matches('/');
    let _ = rustls::crypto::ring::default_provider().install_default();
    if scheme == "file" && bucket.is_empty() {
        return folder(rest);
    }
    if bucket.is_empty() {
        return Err(refuse(ADDRESSES));
    }
    let (answer, large) = (patience.of_an_answer(), patience.of_a_large_answer());
    let pace = Pace::of(answer);
    let store = of_scheme(scheme, bucket, answer, &pace)?;
    let writes = of_scheme(scheme, bucket, large, &pace)?;
    let name = match prefix {
        "" => format!("{scheme}://{bucket}"),
        _ => format!("{scheme}://{bucket}/{prefix}"),
    };
    made(name, prefix, [store, writes], None)
}

/// A folder that is there.
fn folder(path: &str) -> Result<Box<dyn Objects>, Trouble> {
    let open = || {
        LocalFileSystem::new_with_prefix(path).map_err(|e| {
            Trouble::Refused(format!(
                "{path} is no folder here: make or mount it first ({e})"
            ))
        })
    };
    let stores: [Box<dyn ObjectStore>; 2] = [Box::new(open()?), Box::new(open()?)];
    made(format!("file://{path}"), "", stores, Some(path.into()))
}

fn made(
    name: String,
    prefix: &str,
    [store, writes]: [Box<dyn ObjectStore>; 2],
    folder: Option<std::path::PathBuf>,
) -> Result<Box<dyn Objects>, Trouble> {
    let prefix =
        Path::parse(prefix).map_err(|e| Trouble::Refused(format!("its prefix is none: {e}")))?;
    let runtime = folder.is_none().then(network).transpose()?;
    Ok(Box::new(Bucket {
        name,
        prefix,
        store,
        writes,
        runtime,
        folder,
    }))
}

impl Bucket {
    /// What comes of an answer, waited for.
    fn wait<T>(&self, answer: impl Future<Output = T>) -> T {
        match &self.runtime {
            Some(runtime) => runtime.block_on(answer),
            None => answer.now_or_never().expect("bug: a folder waits"),
        }
    }

    /// Makes the folders of an object for their owner only, before it is written into them.
    fn before(&self, name: &str) {
        if let Some(folder) = &self.folder {
            system::shared_folders(folder, name);
        }
    }

    /// Lets an object be read by who may read the folder of the store, if anybody.
    fn after(&self, name: &str) {
        if let Some(folder) = &self.folder {
            system::shared_file(folder, name);
        }
    }

    fn path(&self, name: &str) -> Path {
        let parts = name.split('/').filter(|part| !part.is_empty());
        parts.fold(self.prefix.clone(), |path, part| path.join(part))
    }

    fn relative(&self, path: &Path) -> String {
        let whole = path.as_ref();
        let rest = whole.strip_prefix(self.prefix.as_ref()).unwrap_or(whole);
        rest.trim_start_matches('/').to_owned()
    }
}

impl Objects for Bucket {
    fn name(&self) -> &str {
        &self.name
    }

    fn get(&self, name: &str, take: &mut dyn FnMut(&[u8]) -> bool) -> Result<Got, Trouble> {
        let path = self.path(name);
        self.wait(async {
            let got = match self.store.get(&path).await {
                Err(error) => return absent(&error).map(|()| Got::Absent),
                Ok(got) => got,
            };
            let (size, mut came) = (got.meta.size, 0);
            let mut parts = got.into_stream();
            while let Some(part) = parts.next().await {
                let part = part.map_err(|e| Trouble::Down(plain(&e)))?;
                came += part.len() as u64;
                if !take(&part) {
                    return Ok(Got::Stopped);
                }
            }
            match came == size {
                true => Ok(Got::Whole),
                false => Err(Trouble::Down(format!("{came} of {size} bytes came"))),
            }
        })
    }

    fn put(&self, name: &str, bytes: &[u8]) -> Result<(), Trouble> {
        let payload = PutPayload::from(bytes.to_vec());
        let path = self.path(name);
        let put = self.writes.put(&path, payload);
        self.before(name);
        let put = self.wait(put);
        self.after(name);
        put.map_err(|e| trouble(&e)).map(|_| ())
    }

    fn create(&self, name: &str, bytes: &[u8]) -> Result<Created, Trouble> {
        let payload = PutPayload::from(bytes.to_vec());
        let path = self.path(name);
        let put = self
            .writes
            .put_opts(&path, payload, PutOptions::from(PutMode::Create));
        self.before(name);
        let put = self.wait(put);
        if put.is_ok() {
            self.after(name);
        }
        match put {
            Ok(_) => Ok(Created::New),
            // 409 comes as this, too; who reads it back knows.
            Err(
                object_store::Error::AlreadyExists { .. }
                | object_store::Error::Precondition { .. },
            ) => Ok(Created::There),
            Err(error) => Err(trouble(&error)),
        }
    }

    fn size(&self, name: &str) -> Result<Option<u64>, Trouble> {
        let path = self.path(name);
        match self.wait(self.store.head(&path)) {
            Ok(meta) => Ok(Some(meta.size)),
            Err(error) => absent(&error).map(|()| None),
        }
    }

    fn list(&self, folder: &str, take: &mut dyn FnMut(Vec<Object>) -> bool) -> Result<(), Trouble> {
        let path = self.path(folder);
        let path = (!path.as_ref().is_empty()).then_some(&path);
        let object = |meta: object_store::ObjectMeta| Object {
            name: self.relative(&meta.location),
            bytes: meta.size,
            modified: meta.last_modified.into(),
        };
        self.wait(async {
            let mut pages = self.store.list(path).try_chunks(1000);
            while let Some(page) = pages.next().await {
                let page = page.map_err(|e| trouble(&e.1))?;
                if !take(page.into_iter().map(object).collect()) {
                    break;
                }
            }
            Ok(())
        })
    }

    fn remove(&self, name: &str) -> Result<(), Trouble> {
        let parts = self
            .folder
            .as_ref()
            .map(|root| cut_off::remove_of(root, name));
        parts.transpose().map_err(refused)?;
        let path = self.path(name);
        match self.wait(self.store.delete(&path)) {
            Ok(()) => Ok(()),
            Err(error) => absent(&error),
        }
    }

    fn sweep_cut_off(&self, before: SystemTime, looks: bool) -> Result<(usize, u64), Trouble> {
        let swept = |root| cut_off::sweep(root, before, looks);
        let swept = self.folder.as_deref().map(swept);
        Ok(swept.transpose().map_err(refused)?.unwrap_or_default())
    }
}

fn refused(why: std::io::Error) -> Trouble {
    Trouble::Refused(why.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_cut_off_while_it_was_written_goes_with_its_object() {
        let place = tempfile::tempdir().unwrap();
        let address = format!("file://{}", place.path().display());
        let objects = open(&address, Patience::default()).unwrap();
        objects.put("cas/ab/abc", b"whole").unwrap();
        let file = |name: &str| place.path().join("cas/ab").join(name);
        for part in ["abc#1", "abc#12", "abd#1"] {
            std::fs::write(file(part), "half").unwrap();
        }
        objects.remove("cas/ab/abc").unwrap();
        let left = ["abc", "abc#1", "abc#12", "abd#1"].map(|name| file(name).exists());
        assert_eq!(left, [false, false, false, true]);
        // It never had its name.
        objects.remove("cas/ab/abd").unwrap();
        objects.remove("cas/cd/cde").unwrap();
        assert!(!file("abd#1").exists());
    }

    #[test]
    fn what_was_cut_off_and_nobody_knows_is_swept_once_it_is_old() {
        let place = tempfile::tempdir().unwrap();
        let address = format!("file://{}", place.path().display());
        let objects = open(&address, Patience::default()).unwrap();
        let hash = "ab".repeat(32);
        let parts = ["format#1", "cas/ab/HASH#2", "plans/HASH.seal#1"];
        let strange = ["notes#1", "cas/ab/notes#1", "mine/HASH#1", "cas/ab/HASH"];
        let path = |name: &str| place.path().join(name.replace("HASH", &hash));
        for name in parts.iter().chain(&strange) {
            std::fs::create_dir_all(path(name).parent().unwrap()).unwrap();
            std::fs::write(path(name), "half").unwrap();
        }
        let written = |name: &str| path(name).metadata().unwrap().modified().unwrap();
        let begun = parts.map(written).into_iter().min().unwrap();
        let later = begun + std::time::Duration::from_secs(3600);
        let there = || parts.map(|name| path(name).exists());
        assert_eq!(objects.sweep_cut_off(begun, false), Ok((0, 0)));
        assert_eq!(objects.sweep_cut_off(later, true), Ok((3, 12)));
        assert_eq!(there(), [true; 3]);
        assert_eq!(objects.sweep_cut_off(later, false), Ok((3, 12)));
        assert_eq!(there(), [false; 3]);
        assert!(strange.iter().all(|name| path(name).exists()));
    }
}
