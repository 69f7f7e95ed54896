//! How fast the bytes of a place's answers come: one that lets them drip is one that does not answer.
//!
//! As long as any answer's bytes are waited for, patience runs down; as much as rides in a record fills it up. So whatever
//! a place does, it costs one answer's time and what its bytes are worth.

use crate::objects::SMALL_BYTES;
use http_body::{Body, Frame, SizeHint};
use object_store::ClientOptions;
use object_store::client::{
    HttpClient, HttpConnector, HttpError, HttpErrorKind, HttpRequest, HttpResponse,
    HttpResponseBody, HttpService, ReqwestConnector,
};
use std::pin::Pin;
use std::sync::{Arc, Mutex, MutexGuard};
use std::task::{Context, Poll};
use std::time::{Duration, Instant};
use tokio::time::Sleep;

/// So many answers may be waited for in the time of one, once patience has run out: a place that is quick again is seen.
const ANSWERS: u32 = 64;

/// How much longer the bytes of answers are waited for, all answers of a place together.
#[derive(Debug, Clone)]
pub(crate) struct Pace(Arc<Mutex<Left>>);

#[derive(Debug)]
struct Left {
    /// When nothing is waited for, and bytes have come.
    full: Duration,
    left: Duration,
    /// Until when waiting is counted.
    counted: Instant,
    /// How many answers are waited for.
    waiting: usize,
}

impl Left {
    /// How long so many bytes may take.
    fn worth(&self, bytes: usize) -> Duration {
        self.full.mul_f64(bytes as f64 / SMALL_BYTES as f64)
    }

    fn count(&mut self) {
        let now = Instant::now();
        if self.waiting > 0 {
            self.left = self.left.saturating_sub(now - self.counted);
        }
        self.counted = now;
    }
}

/// Nothing came.
#[derive(Debug, thiserror::Error)]
#[error("no answer in time")]
struct Silent;

/// Fewer bytes came than that.
#[derive(Debug, thiserror::Error)]
#[error("its answer drips")]
struct Drips;

impl Pace {
    /// Of a place whose answers are waited for so long.
    pub(crate) fn of(answer: Duration) -> Pace {
        Pace(Arc::new(Mutex::new(Left {
            full: answer,
            left: answer,
            counted: Instant::now(),
            waiting: 0,
        })))
    }

    /// What is left by now.
    fn left(&self) -> MutexGuard<'_, Left> {
        let mut left = self.0.lock().expect("bug: poisoned");
        left.count();
        left
    }

    fn came(&self, bytes: usize) {
        let mut left = self.left();
        left.left = left.full.min(left.left + left.worth(bytes));
    }
}

/// Has requests answered at a pace.
#[derive(Debug)]
pub(crate) struct Connector {
    pub(crate) pace: Pace,
    /// How long an answer is waited for, to its first byte, once what is asked has been sent.
    pub(crate) answer: Duration,
}

impl HttpConnector for Connector {
    fn connect(&self, options: &ClientOptions) -> object_store::Result<HttpClient> {
        Ok(HttpClient::new(Client {
            client: ReqwestConnector::default().connect(options)?,
            pace: self.pace.clone(),
            answer: self.answer,
        }))
    }
}

#[derive(Debug)]
struct Client {
    client: HttpClient,
    pace: Pace,
    answer: Duration,
}

/// An answer, or why there is none.
type Answer = Result<HttpResponse, HttpError>;

impl HttpService for Client {
    fn call<'a, 'b>(
        &'a self,
        request: HttpRequest,
    ) -> Pin<Box<dyn Future<Output = Answer> + Send + 'b>>
    where
        'a: 'b,
    {
        Box::pin(async move {
            let sent = self.pace.left().worth(request.body().content_length());
            let answer = self.client.execute(request);
            let answer = tokio::time::timeout(self.answer + sent, answer).await;
            let answer = answer.map_err(|_| HttpError::new(HttpErrorKind::Timeout, Silent))??;
            let paced = |body| HttpResponseBody::new(Paced::new(body, self.pace.clone()));
            Ok(answer.map(paced))
        })
    }
}

/// The bytes of an answer.
struct Paced {
    body: HttpResponseBody,
    pace: Pace,
    /// Until when it is waited for whatever is left.
    surely: Instant,
    waits: bool,
    until: Pin<Box<Sleep>>,
}

impl Paced {
    fn new(body: HttpResponseBody, pace: Pace) -> Paced {
        let surely = Instant::now() + pace.left().full / ANSWERS;
        Paced {
            body,
            pace,
            surely,
            waits: false,
            until: Box::pin(tokio::time::sleep(Duration::ZERO)),
        }
    }

    /// Waits from now on, if it did not; how much longer, if at all.
    fn waits(&mut self) -> Option<Duration> {
        let mut left = self.pace.left();
        if !std::mem::replace(&mut self.waits, true) {
            left.waiting += 1;
        }
        let surely = self.surely.saturating_duration_since(left.counted);
        Some(left.left.max(surely)).filter(|left| !left.is_zero())
    }

    fn waits_no_more(&mut self) {
        if std::mem::take(&mut self.waits) {
            self.pace.left().waiting -= 1;
        }
    }
}

impl Body for Paced {
    type Data = <HttpResponseBody as Body>::Data;
    type Error = HttpError;

    fn poll_frame(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<Self::Data>, HttpError>>> {
        if let Poll::Ready(frame) = Pin::new(&mut self.body).poll_frame(context) {
            self.waits_no_more();
            if let Some(bytes) = frame.as_ref().and_then(|f| f.as_ref().ok()?.data_ref()) {
                self.pace.came(bytes.len());
            }
            return Poll::Ready(frame);
        }
        while let Some(left) = self.waits() {
            self.until
                .as_mut()
                .reset(tokio::time::Instant::now() + left);
            if self.until.as_mut().poll(context).is_pending() {
                return Poll::Pending;
            }
        }
        self.waits_no_more();
        let drips = HttpError::new(HttpErrorKind::Timeout, Drips);
        Poll::Ready(Some(Err(drips)))
    }

    fn is_end_stream(&self) -> bool {
        self.body.is_end_stream()
    }

    fn size_hint(&self) -> SizeHint {
        self.body.size_hint()
    }
}

impl Drop for Paced {
    fn drop(&mut self) {
        self.waits_no_more();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clients::retry;
    use object_store::aws::{AmazonS3, AmazonS3Builder};
    use object_store::{ObjectStoreExt, PutPayload};
    use std::io::{Read, Result, Write};
    use std::net::{TcpListener, TcpStream};

    const ANSWER: Duration = Duration::from_millis(400);

    /// Whether asking a server that does this comes to something, and how long it took.
    fn asked<T>(
        serves: fn(TcpStream) -> Result<()>,
        ask: impl AsyncFnOnce(AmazonS3) -> object_store::Result<T>,
    ) -> (bool, Duration) {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let address = listener.local_addr().unwrap();
        std::thread::spawn(move || serves(listener.accept()?.0));
        let _ = rustls::crypto::ring::default_provider().install_default();
        let store = AmazonS3Builder::new()
            .with_bucket_name("b")
            .with_access_key_id("a")
            .with_secret_access_key("b")
            .with_endpoint(format!("http://{address}"))
            .with_allow_http(true)
            .with_retry(retry(ANSWER))
            .with_http_connector(Connector {
                pace: Pace::of(ANSWER),
                answer: ANSWER,
            })
            .build()
            .unwrap();
        let mut runtime = tokio::runtime::Builder::new_current_thread();
        let runtime = runtime.enable_all().build().unwrap();
        let begun = Instant::now();
        let came = runtime.block_on(ask(store));
        (came.is_ok(), begun.elapsed())
    }

    /// Sends an object in so many parts of so many bytes, one every ten milliseconds.
    fn sends(mut stream: TcpStream, parts: usize, bytes: usize) -> Result<()> {
        let _ = stream.read(&mut [0; 4096])?;
        let head = format!(
            "HTTP/1.1 200 OK\r\nContent-Length: {}\r\nETag: \"a\"\r\n\
             Last-Modified: Tue, 01 Jan 2030 00:00:00 GMT\r\n\r\n",
            parts * bytes
        );
        stream.write_all(head.as_bytes())?;
        for _ in 0..parts {
            stream.write_all(&vec![b'a'; bytes])?;
            std::thread::sleep(Duration::from_millis(10));
        }
        Ok(())
    }

    /// Takes what is sent, and answers when that took longer than an answer is waited for.
    fn takes(mut stream: TcpStream) -> Result<()> {
        stream.set_read_timeout(Some(2 * ANSWER))?;
        while stream.read(&mut [0; 4096]).is_ok_and(|n| n > 0) {}
        stream.write_all(b"HTTP/1.1 200 OK\r\nContent-Length: 0\r\nETag: \"a\"\r\n\r\n")
    }

    #[test]
    fn a_place_whose_bytes_drip_is_not_waited_for() {
        let get = async |store: AmazonS3| store.get(&"object".into()).await?.bytes().await;
        // Twenty seconds of single bytes.
        let (came, took) = asked(|stream| sends(stream, 2000, 1), get);
        assert!(!came && took < Duration::from_secs(10), "{came} {took:?}");
        // Longer than an answer is waited for, and many times as fast as must be.
        let (came, took) = asked(|stream| sends(stream, 60, 50 * SMALL_BYTES), get);
        assert!(came && took > ANSWER, "{came} {took:?}");
    }

    #[test]
    fn what_is_large_has_time_to_be_sent() {
        let put = async |store: AmazonS3, bytes: usize| {
            let payload = PutPayload::from(vec![0; bytes]);
            store.put(&"object".into(), payload).await
        };
        let (came, took) = asked(takes, async |store| put(store, 400 * SMALL_BYTES).await);
        assert!(came && took > ANSWER, "{came} {took:?}");
        let (came, took) = asked(takes, async |store| put(store, 1).await);
        assert!(!came && took < Duration::from_secs(10), "{came} {took:?}");
    }
}
