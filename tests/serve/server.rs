//! The program, serving, and calls to it over plain sockets: no client of somebody's mends what is wrong.

pub(crate) use crate::small::photos;
use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// A server in a folder of its own.
pub(crate) struct Server {
    pub(crate) child: Child,
    pub(crate) port: u16,
    pub(crate) token: String,
    /// The address for a phone.
    pub(crate) lan: Option<String>,
    place: tempfile::TempDir,
}

/// What it answered.
pub(crate) struct Answer {
    pub(crate) status: u16,
    pub(crate) headers: Vec<(String, String)>,
    pub(crate) body: Vec<u8>,
}

impl Answer {
    #[track_caller]
    pub(crate) fn is(self, status: u16) -> Answer {
        assert_eq!(self.status, status, "{}", self.text());
        self
    }

    pub(crate) fn text(&self) -> String {
        String::from_utf8_lossy(&self.body).into_owned()
    }

    #[track_caller]
    pub(crate) fn json(&self) -> Value {
        serde_json::from_slice(&self.body).unwrap_or_else(|e| panic!("{e}: {}", self.text()))
    }

    pub(crate) fn header(&self, name: &str) -> &str {
        let found = self
            .headers
            .iter()
            .find(|(n, _)| n.eq_ignore_ascii_case(name));
        found.map_or("", |(_, value)| value)
    }
}

/// `before` is what a shell does first, in the same process.
fn start(place: &Path, before: &str, flags: &str) -> Result<(Child, Value), String> {
    let mut command = Command::new("bash");
    let line = format!(
        "{before} exec {} serve --json --cache cache --dir captures {flags}",
        env!("CARGO_BIN_EXE_tailor")
    );
    command.args(["-c", &line]);
    command.current_dir(place).env_remove("TAILOR_CACHE");
    let mut child = command
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let mut line = String::new();
    let mut out = BufReader::new(child.stdout.take().unwrap());
    out.read_line(&mut line).unwrap();
    let started: Value = serde_json::from_str(&line).unwrap_or_else(|e| panic!("{e}: {line}"));
    match started["error"].as_str() {
        Some(why) => Err(why.to_owned()),
        None => Ok((child, started)),
    }
}

/// The port and the token of an address.
fn parts(url: &str) -> (u16, String) {
    let (address, token) = url.split_once("/?token=").unwrap();
    let port = address.rsplit_once(':').unwrap().1.parse().unwrap();
    (port, token.to_owned())
}

impl Server {
    pub(crate) fn new() -> Server {
        Server::started("", "").unwrap()
    }

    /// Also for the local network; why not, where there is none.
    pub(crate) fn lan() -> Result<Server, String> {
        Server::started("", "--lan")
    }

    fn started(before: &str, flags: &str) -> Result<Server, String> {
        let place = tempfile::tempdir().unwrap();
        let (child, started) = start(place.path(), before, flags)?;
        let (port, token) = parts(started["url"].as_str().unwrap());
        let lan = started["lan"].as_str().map(str::to_owned);
        Ok(Server {
            child,
            port,
            token,
            lan,
            place,
        })
    }

    /// Under a limit on the size of files, which takes the place of a full disk. \[KiB\]
    pub(crate) fn limited(kib: usize) -> Server {
        let before = format!("trap '' XFSZ; ulimit -f {kib};");
        Server::started(&before, "").unwrap()
    }

    /// Killed, as by a power cut, and started again.
    pub(crate) fn kill_and_start(&mut self) {
        self.child.kill().unwrap();
        self.child.wait().unwrap();
        let (child, started) = start(self.place.path(), "", "").unwrap();
        self.child = child;
        (self.port, self.token) = parts(started["url"].as_str().unwrap());
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.place.path().join(name)
    }

    /// The address that the program prints.
    #[cfg(chromium)]
    pub(crate) fn url(&self) -> String {
        format!("http://127.0.0.1:{}/?token={}", self.port, self.token)
    }

    /// The origin of its pages.
    #[cfg(chromium)]
    pub(crate) fn origin(&self) -> String {
        format!("http://127.0.0.1:{}", self.port)
    }

    /// A call as it is written, without any header that is not.
    pub(crate) fn raw(&self, head: &str, body: &[u8]) -> Answer {
        let mut socket = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        socket
            .set_read_timeout(Some(Duration::from_secs(300)))
            .unwrap();
        // What is refused at once may not be read to its end.
        let _ = socket
            .write_all(head.as_bytes())
            .and_then(|()| socket.write_all(body));
        let mut all = Vec::new();
        let _ = socket.read_to_end(&mut all);
        let end = all
            .windows(4)
            .position(|w| w == b"\r\n\r\n")
            .expect("an answer");
        let lines = String::from_utf8_lossy(&all[..end]).into_owned();
        let mut lines = lines.lines();
        let status = lines
            .next()
            .unwrap()
            .split(' ')
            .nth(1)
            .unwrap()
            .parse()
            .unwrap();
        let pair = |line: &str| {
            line.split_once(": ")
                .map(|(n, v)| (n.to_owned(), v.to_owned()))
        };
        let headers: Vec<_> = lines.filter_map(pair).collect();
        let mut answer = Answer {
            status,
            headers,
            body: all[end + 4..].to_vec(),
        };
        if answer.header("transfer-encoding") == "chunked" {
            answer.body = dechunked(&answer.body);
        }
        answer
    }

    /// A call with headers, and `Host` and the length, which every client sends.
    pub(crate) fn call(
        &self,
        method: &str,
        path: &str,
        headers: &[(&str, &str)],
        body: &[u8],
    ) -> Answer {
        let mut head = format!(
            "{method} {path} HTTP/1.1\r\nConnection: close\r\nContent-Length: {}\r\n",
            body.len()
        );
        if !headers.iter().any(|(name, _)| *name == "Host") {
            head += &format!("Host: 127.0.0.1:{}\r\n", self.port);
        }
        headers
            .iter()
            .for_each(|(name, value)| head += &format!("{name}: {value}\r\n"));
        self.raw(&(head + "\r\n"), body)
    }

    /// A program's call, with the token.
    pub(crate) fn ask(&self, method: &str, path: &str, body: &Value) -> Answer {
        let bearer = format!("Bearer {}", self.token);
        let headers = [
            ("Authorization", bearer.as_str()),
            ("Content-Type", "application/json"),
        ];
        let bytes = if body.is_null() {
            vec![]
        } else {
            body.to_string().into_bytes()
        };
        self.call(method, path, &headers, &bytes)
    }

    /// A file, sent as a photo of a number.
    pub(crate) fn send(&self, id: &str, number: u32, name: &str, bytes: &[u8]) -> Answer {
        let bearer = format!("Bearer {}", self.token);
        let path = format!("/api/captures/{id}/files/{number}?name={name}");
        self.call("PUT", &path, &[("Authorization", &bearer)], bytes)
    }

    /// A new capture: its ID.
    pub(crate) fn capture(&self, name: &str) -> String {
        let answer = self
            .ask("POST", "/api/captures", &json!({ "name": name }))
            .is(201);
        answer.json()["id"].as_str().unwrap().to_owned()
    }

    /// A capture of the sample's photos and its plate.
    pub(crate) fn sample(&self, name: &str) -> String {
        let id = self.capture(name);
        // Every second photo, and the plate, which is the last: a turn that takes half of the time.
        let photos: Vec<_> = photos().into_iter().step_by(2).collect();
        for (at, photo) in photos.iter().enumerate() {
            let bytes = std::fs::read(photo).unwrap();
            let name = photo.file_name().unwrap().to_str().unwrap();
            self.send(&id, at as u32 + 1, name, &bytes).is(200);
        }
        // The mat's edge, as `capture.toml` of the sample has it.
        let facts = json!({ "plate": photos.len(), "mat_tag_mm": 60.0, "steps": 9 });
        self.ask("PUT", &format!("/api/captures/{id}/facts"), &facts)
            .is(204);
        id
    }

    /// A capture's state, once it holds.
    #[track_caller]
    pub(crate) fn until(&self, id: &str, seconds: u64, holds: impl Fn(&Value) -> bool) -> Value {
        let since = Instant::now();
        loop {
            let capture = self
                .ask("GET", &format!("/api/captures/{id}"), &Value::Null)
                .is(200)
                .json();
            if holds(&capture) {
                return capture;
            }
            let late = since.elapsed() > Duration::from_secs(seconds);
            assert!(!late, "not within {seconds} s: {}", capture["measuring"]);
            std::thread::sleep(Duration::from_millis(100));
        }
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn dechunked(mut body: &[u8]) -> Vec<u8> {
    let mut whole = Vec::new();
    while let Some(end) = body.windows(2).position(|w| w == b"\r\n") {
        let length = std::str::from_utf8(&body[..end]).ok();
        let length = length
            .and_then(|l| usize::from_str_radix(l.trim(), 16).ok())
            .unwrap_or(0);
        let rest = &body[end + 2..];
        if length == 0 || rest.len() < length {
            break;
        }
        whole.extend(&rest[..length]);
        body = rest.get(length + 2..).unwrap_or_default();
    }
    whole
}
