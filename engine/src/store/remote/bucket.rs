//! Buckets and shared folders by the crate `object_store`: `s3://`, `gs://`, `az://`, `file://`.
//!
//! Who may read and write is told by the usual variables of the environment (`AWS_…`, `GOOGLE_…`,
//! `AZURE_…`), and for S3 by a profile (`profile.rs`); by nothing else: an address that holds a secret is refused, and what a query of an
//! address holds is cut out of every text.

use super::answer::{absent, plain, trouble};
use super::objects::{Created, Got, Object, Objects, Trouble};
use super::profile;
use futures_util::{StreamExt, TryStreamExt};
use object_store::aws::AmazonS3Builder;
use object_store::azure::MicrosoftAzureBuilder;
use object_store::gcp::GoogleCloudStorageBuilder;
use object_store::local::LocalFileSystem;
use object_store::path::Path;
use object_store::{
    BackoffConfig, ClientOptions, ObjectStore, ObjectStoreExt, PutMode, PutOptions, PutPayload,
    RetryConfig,
};
use std::time::Duration;
use tokio::runtime::Runtime;

/// A bucket, or a folder on a disk that machines share.
struct Bucket {
    name: String,
    prefix: Path,
    store: Box<dyn ObjectStore>,
    runtime: Runtime,
}

/// The place of an address.
///
/// # Errors
///
/// The address is none, or what the environment says of it is not enough.
pub fn open(address: &str) -> Result<Box<dyn Objects>, Trouble> {
    let refuse = |why: &str| Trouble::Refused(why.to_owned());
    let (scheme, rest) = address.split_once("://").ok_or_else(|| refuse(ADDRESSES))?;
    if rest.contains('@') || rest.contains('?') || rest.contains('#') {
        return Err(refuse(
            "its address holds more than a bucket and a prefix: who may use it is said by the environment (AWS_ACCESS_KEY_ID, AWS_SECRET_ACCESS_KEY, …)",
        ));
    }
    let (bucket, prefix) = rest.split_once('/').unwrap_or((rest, ""));
    let prefix = prefix.trim_end_matches('/');
    let _ = rustls::crypto::ring::default_provider().install_default();
    let store: Result<Box<dyn ObjectStore>, _> = match scheme {
        "file" if bucket.is_empty() => return folder(rest),
        _ if bucket.is_empty() => return Err(refuse(ADDRESSES)),
        "s3" => amazon()?
            .with_bucket_name(bucket)
            .with_client_options(client())
            .with_allow_http(allowed())
            .with_retry(retry())
            .build()
            .map(|s| Box::new(s) as _),
        "gs" => GoogleCloudStorageBuilder::from_env()
            .with_bucket_name(bucket)
            .with_client_options(client())
            .with_retry(retry())
            .build()
            .map(|s| Box::new(s) as _),
        "az" => MicrosoftAzureBuilder::from_env()
            .with_container_name(bucket)
            .with_client_options(client())
            .with_allow_http(allowed())
            .with_retry(retry())
            .build()
            .map(|s| Box::new(s) as _),
        _ => return Err(refuse(ADDRESSES)),
    };
    let store = store.map_err(|e| Trouble::Refused(plain(&e)))?;
    let name = match prefix {
        "" => format!("{scheme}://{bucket}"),
        _ => format!("{scheme}://{bucket}/{prefix}"),
    };
    made(name, prefix, store)
}

/// As the environment says, and where it says nothing, a profile.
fn amazon() -> Result<AmazonS3Builder, Trouble> {
    let env = |name: &str| std::env::var(name).ok();
    let said = |names: &[&str]| names.iter().any(|n| env(n).is_some_and(|v| !v.is_empty()));
    let profile = profile::chosen(&env).map_err(Trouble::Refused)?;
    let mut builder = AmazonS3Builder::from_env();
    if let Some(keys) = profile.keys {
        builder = builder
            .with_access_key_id(keys.id)
            .with_secret_access_key(keys.secret);
        if let Some(token) = keys.token {
            builder = builder.with_token(token);
        }
    }
    if let Some(region) = profile.region.filter(|_| !said(&REGION)) {
        builder = builder.with_region(region);
    }
    if let Some(endpoint) = profile.endpoint.filter(|_| !said(&ENDPOINT)) {
        builder = builder.with_endpoint(endpoint);
    }
    Ok(builder)
}

const REGION: [&str; 2] = ["AWS_REGION", "AWS_DEFAULT_REGION"];

const ENDPOINT: [&str; 3] = ["AWS_ENDPOINT_URL", "AWS_ENDPOINT_URL_S3", "AWS_ENDPOINT"];

const ADDRESSES: &str = "its address is none: say s3://BUCKET/PREFIX, gs://BUCKET/PREFIX, az://CONTAINER/PREFIX or file:///FOLDER";

/// A folder that is there.
fn folder(path: &str) -> Result<Box<dyn Objects>, Trouble> {
    let store = LocalFileSystem::new_with_prefix(path).map_err(|e| {
        Trouble::Refused(format!(
            "{path} is no folder here: make or mount it first ({e})"
        ))
    })?;
    made(format!("file://{path}"), "", Box::new(store))
}

fn made(
    name: String,
    prefix: &str,
    store: Box<dyn ObjectStore>,
) -> Result<Box<dyn Objects>, Trouble> {
    let prefix =
        Path::parse(prefix).map_err(|e| Trouble::Refused(format!("its prefix is none: {e}")))?;
    let mut runtime = tokio::runtime::Builder::new_multi_thread();
    let runtime = runtime.worker_threads(2).enable_all().build();
    let runtime = runtime.map_err(|e| Trouble::Refused(e.to_string()))?;
    Ok(Box::new(Bucket {
        name,
        prefix,
        store,
        runtime,
    }))
}

/// HTTP without TLS, where the environment allows it: servers of one's own.
fn allowed() -> bool {
    let said = |name: &str| std::env::var(name).is_ok_and(|v| v == "true" || v == "1");
    said("AWS_ALLOW_HTTP") || said("AZURE_ALLOW_HTTP")
}

fn client() -> ClientOptions {
    ClientOptions::new()
        .with_connect_timeout(Duration::from_secs(5))
        // From one byte to the next; a large result may take its time.
        .with_read_timeout(Duration::from_secs(20))
        .with_timeout(Duration::from_secs(600))
}

fn retry() -> RetryConfig {
    RetryConfig {
        backoff: BackoffConfig {
            init_backoff: Duration::from_millis(50),
            max_backoff: Duration::from_secs(2),
            base: 2.0,
        },
        max_retries: 3,
        retry_timeout: Duration::from_secs(15),
    }
}

impl Bucket {
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
        self.runtime.block_on(async {
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
        let put = self.store.put(&path, payload);
        self.runtime
            .block_on(put)
            .map_err(|e| trouble(&e))
            .map(|_| ())
    }

    fn create(&self, name: &str, bytes: &[u8]) -> Result<Created, Trouble> {
        let payload = PutPayload::from(bytes.to_vec());
        let path = self.path(name);
        let put = self
            .store
            .put_opts(&path, payload, PutOptions::from(PutMode::Create));
        match self.runtime.block_on(put) {
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
        match self.runtime.block_on(self.store.head(&path)) {
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
        self.runtime.block_on(async {
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
        let path = self.path(name);
        match self.runtime.block_on(self.store.delete(&path)) {
            Ok(()) => Ok(()),
            Err(error) => absent(&error),
        }
    }
}
