//! What is dropped besides photos of a turn: a video, photos of a phone in HEIC, photos of a walk.

use super::chromium::Tab;
use super::server::{Server, photos};
use super::whole::{complaints, tab, whole};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Runs a program that must succeed.
fn run(program: &str, words: &[&str]) {
    let done = Command::new(program).args(words).output().unwrap();
    let stderr = String::from_utf8_lossy(&done.stderr);
    assert!(done.status.success(), "{program}: {stderr}");
}

/// The sample's turn as a small video: still, round, still again.
fn film(place: &Path) -> PathBuf {
    let all = photos();
    let still = std::iter::repeat_n(&all[0], 8);
    let turn = still.clone().chain(&all[1..18]).chain(still);
    for (at, photo) in turn.enumerate() {
        std::fs::copy(photo, place.join(format!("frame{at:03}.jpg"))).unwrap();
    }
    let (frames, film) = (place.join("frame%03d.jpg"), place.join("turn.mp4"));
    let [frames, into] = [&frames, &film].map(|path| path.to_str().unwrap());
    let small = "scale=400:600,framerate=fps=24";
    run(
        "ffmpeg",
        &[
            "-v",
            "error",
            "-framerate",
            "6",
            "-i",
            frames,
            "-vf",
            small,
            "-pix_fmt",
            "yuv420p",
            into,
        ],
    );
    film
}

/// The capture whose page is open, as the API has it.
fn opened(tab: &mut Tab, server: &Server) -> (String, Value) {
    let id = tab.value("location.pathname.split('/')[2]");
    let id = id.as_str().unwrap().to_owned();
    let path = format!("/api/captures/{id}");
    let capture = server.ask("GET", &path, &Value::Null).is(200).json();
    (id, capture)
}

/// Chooses files and waits until they are looked at.
fn drop(tab: &mut Tab, server: &Server, files: &[PathBuf]) {
    tab.go(&server.url());
    tab.choose("input[name=files]", files);
    tab.until_within(300, "location.pathname.startsWith('/captures/') && document.readyState === 'complete' && document.querySelector('.can')");
}

/// Starts to measure and waits until that holds; its state then.
fn begun(tab: &mut Tab, server: &Server, holds: impl Fn(&Value) -> bool) -> Value {
    let (id, _) = opened(tab, server);
    tab.click("form[action$='/measure'] button");
    server.until(&id, 300, |capture| {
        let measuring = &capture["measuring"];
        holds(measuring) || ["failed", "done"].contains(&measuring["state"].as_str().unwrap())
    })
}

/// What became of a step.
fn step<'a>(measuring: &'a Value, node: &str) -> Option<&'a str> {
    let steps = measuring["steps"].as_array()?;
    let step = steps.iter().find(|s| s["node"] == node)?;
    step["state"].as_str()
}

#[test]
fn a_video_is_dropped_looked_at_and_its_frames_are_measured() {
    if !proof::program("ffmpeg", "ffmpeg") {
        return;
    }
    let (server, place) = (Server::new(), tempfile::tempdir().unwrap());
    let film = film(place.path());
    let mut tab = tab("de");
    drop(&mut tab, &server, &[film]);
    let (_, capture) = opened(&mut tab, &server);
    assert_eq!(capture["files"]["1"]["video"], true, "{capture}");
    let seen = tab.value("document.querySelector('main').textContent");
    let seen = seen.as_str().unwrap();
    assert!(
        seen.contains("turn.mp4") && seen.contains("400 × 600 px"),
        "{seen}"
    );
    whole(&mut tab, "video");
    let capture = begun(&mut tab, &server, |m| step(m, "tags") == Some("made"));
    let measuring = &capture["measuring"];
    assert_eq!(step(measuring, "tags"), Some("made"), "{measuring}");
    assert_eq!(step(measuring, "frames"), Some("found"), "{measuring}");
    let path = format!("/api/captures/{}/stop", capture["id"].as_str().unwrap());
    server.ask("POST", &path, &Value::Null).is(204);
    assert_eq!(complaints(&mut tab, &server), Vec::<String>::new());
}

#[test]
fn photos_called_a_walk_are_taken_as_one_and_record_when_they_were_taken() {
    let (server, place) = (Server::new(), tempfile::tempdir().unwrap());
    let mut files = vec![];
    for (k, photo) in photos()[..6].iter().enumerate() {
        let small = image::open(photo).unwrap().thumbnail(200, 300).to_rgb8();
        let pixels = shape::Rgb {
            width: small.width() as usize,
            height: small.height() as usize,
            data: small.pixels().map(|p| p.0).collect(),
        };
        let file = place.path().join(format!("{k}.jpg"));
        let jpeg = shape::rgb_to_jpeg(&pixels, 85);
        std::fs::write(&file, with_time(&jpeg, 3 * k)).unwrap();
        files.push(file);
    }
    let mut tab = tab("en");
    drop(&mut tab, &server, &files);
    let taken = tab.value("document.querySelector('.photos li:nth-child(3) dl').textContent");
    assert!(taken.as_str().unwrap().contains("Taken+6 s"), "{taken}");
    tab.click("[name=walk]");
    tab.click("form[action$='/facts'] button");
    tab.until_within(300, "document.readyState === 'complete' && document.querySelector('.can') && document.querySelector('[name=walk]').checked");
    // They are of a turn: the walk's own steps run, see it, and report what to do.
    let capture = begun(&mut tab, &server, |_| false);
    let measuring = &capture["measuring"];
    assert_eq!(measuring["state"], "failed", "{measuring}");
    assert_eq!(step(measuring, "calibrated"), None, "{measuring}");
    assert!(step(measuring, "walked").is_some(), "{measuring}");
    tab.until_within(
        60,
        "document.querySelector('main .alert')?.textContent.includes('the camera did not walk')",
    );
    assert_eq!(complaints(&mut tab, &server), Vec::<String>::new());
}

/// A JPEG whose EXIF records that it was taken so many seconds after noon.
fn with_time(jpeg: &[u8], seconds: usize) -> Vec<u8> {
    let time = format!("2026:05:01 12:00:{seconds:02}\0");
    // One directory with one entry that points to the directory of EXIF, which holds DateTimeOriginal.
    let mut exif =
        b"Exif\0\0MM\0*\0\0\0\x08\0\x01\x87\x69\0\x04\0\0\0\x01\0\0\0\x1a\0\0\0\0".to_vec();
    exif.extend(b"\0\x01\x90\x03\0\x02\0\0\0\x14\0\0\0\x2c\0\0\0\0");
    exif.extend(time.as_bytes());
    let mut file = jpeg[..2].to_vec();
    file.extend([0xff, 0xe1]);
    file.extend((exif.len() as u16 + 2).to_be_bytes());
    file.extend(exif);
    file.extend(&jpeg[2..]);
    file
}

#[test]
fn photos_that_this_build_cannot_read_are_refused_with_what_to_do() {
    if !proof::program("heif-enc", "libheif-examples") {
        return;
    }
    let (server, place) = (Server::new(), tempfile::tempdir().unwrap());
    let heic = place.path().join("IMG_1.HEIC");
    let small = place.path().join("small.png");
    image::open(&photos()[0])
        .unwrap()
        .thumbnail(200, 300)
        .save(&small)
        .unwrap();
    run(
        "heif-enc",
        &[small.to_str().unwrap(), "-o", heic.to_str().unwrap()],
    );
    let mut tab = tab("en");
    tab.go(&server.url());
    tab.choose("input[name=files]", &[heic]);
    if cfg!(feature = "heic") {
        return tab.until("location.pathname.startsWith('/captures/')");
    }
    tab.until("document.querySelector('#drop-word').textContent.includes('HEIC photo')");
    let message = tab.value("document.querySelector('#drop-word').textContent");
    let message = message.as_str().unwrap();
    assert!(
        message.contains("IMG_1.HEIC") && message.contains("Most Compatible"),
        "{message}"
    );
    assert_eq!(tab.value("location.pathname"), json!("/"));
}
