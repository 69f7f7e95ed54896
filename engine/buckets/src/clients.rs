//! Clients of buckets by the crate `object_store`: who asks, and how long an answer is waited for.

use crate::answer::plain;
use crate::objects::Trouble;
use crate::pace::{Connector, Pace};
use crate::profile;
use object_store::aws::AmazonS3Builder;
use object_store::azure::MicrosoftAzureBuilder;
use object_store::gcp::GoogleCloudStorageBuilder;
use object_store::{BackoffConfig, ClientOptions, ObjectStore, RetryConfig};
use std::time::Duration;

/// The message for an address that is none.
pub(crate) const ADDRESSES: &str = "its address is none: give s3://BUCKET/PREFIX, gs://BUCKET/PREFIX, az://CONTAINER/PREFIX or file:///FOLDER";

/// A bucket whose answers are waited for so long, and come at a pace.
pub(crate) fn of_scheme(
    scheme: &str,
    bucket: &str,
    answer: Duration,
    pace: &Pace,
) -> Result<Box<dyn ObjectStore>, Trouble> {
    let paced = || Connector {
        pace: pace.clone(),
        answer,
    };
    let store: Result<Box<dyn ObjectStore>, _> = match scheme {
        "s3" => amazon()?
            .with_bucket_name(bucket)
            .with_client_options(client(answer))
            .with_http_connector(paced())
            .with_allow_http(allowed())
            .with_retry(retry(answer))
            .build()
            .map(|s| Box::new(s) as _),
        "gs" => GoogleCloudStorageBuilder::from_env()
            .with_bucket_name(bucket)
            .with_client_options(client(answer))
            .with_http_connector(paced())
            .with_retry(retry(answer))
            .build()
            .map(|s| Box::new(s) as _),
        "az" => MicrosoftAzureBuilder::from_env()
            .with_container_name(bucket)
            .with_client_options(client(answer))
            .with_http_connector(paced())
            .with_allow_http(allowed())
            .with_retry(retry(answer))
            .build()
            .map(|s| Box::new(s) as _),
        _ => return Err(Trouble::Refused(ADDRESSES.to_owned())),
    };
    store.map_err(|e| Trouble::Refused(plain(&e)))
}

/// By the environment, and where it has nothing, by a profile.
fn amazon() -> Result<AmazonS3Builder, Trouble> {
    let env = |name: &str| std::env::var(name).ok();
    let reply = |names: &[&str]| names.iter().any(|n| env(n).is_some_and(|v| !v.is_empty()));
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
    if let Some(region) = profile.region.filter(|_| !reply(&REGION)) {
        builder = builder.with_region(region);
    }
    if let Some(endpoint) = profile.endpoint.filter(|_| !reply(&ENDPOINT)) {
        builder = builder.with_endpoint(endpoint);
    }
    Ok(builder)
}

const REGION: [&str; 2] = ["AWS_REGION", "AWS_DEFAULT_REGION"];

const ENDPOINT: [&str; 3] = ["AWS_ENDPOINT_URL", "AWS_ENDPOINT_URL_S3", "AWS_ENDPOINT"];

/// HTTP without TLS, where the environment allows it: servers of one's own.
fn allowed() -> bool {
    let reply = |name: &str| std::env::var(name).is_ok_and(|v| v == "true" || v == "1");
    reply("AWS_ALLOW_HTTP") || reply("AZURE_ALLOW_HTTP")
}

fn client(answer: Duration) -> ClientOptions {
    ClientOptions::new()
        .with_connect_timeout(answer.min(Duration::from_secs(5)))
        // A large result may take its time, at a pace.
        .with_timeout(Duration::from_secs(600))
}

pub(crate) fn retry(answer: Duration) -> RetryConfig {
    RetryConfig {
        backoff: BackoffConfig {
            init_backoff: Duration::from_millis(50),
            max_backoff: Duration::from_secs(2),
            base: 2.0,
        },
        max_retries: 3,
        retry_timeout: answer.min(Duration::from_secs(15)),
    }
}
