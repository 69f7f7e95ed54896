//! Files that come in: streamed to the disk for their owner only, limited, and looked at before they are kept.

use super::answer::Wrong;
use super::app::App;
use super::guard::random;
use super::home::{self, Place};
use super::record::{Kept, tidy};
use super::sniff::{HEAD, Strange, sniff};
use axum::body::Body;
use axum::http::StatusCode;
use http_body_util::BodyExt;
use std::path::{Path, PathBuf};
use std::time::Duration;
use tokio::io::AsyncWriteExt;

/// A photo is no larger. \[bytes\]
pub(super) const MOST_PHOTO: u64 = 80 << 20;
/// A video is no larger. \[bytes\]
pub(super) const MOST_VIDEO: u64 = 2 << 30;
/// A capture is no larger. \[bytes\]
pub(super) const MOST_CAPTURE: u64 = 6 << 30;
/// A capture has no more files.
pub(super) const MOST_FILES: u32 = 400;
/// What is left free on the disk. \[bytes\]
const SPARE: u64 = 512 << 20;
/// Nobody keeps the server waiting for longer.
const PATIENCE: Duration = Duration::from_secs(60);

fn large(most: u64) -> Wrong {
    Wrong::new(StatusCode::PAYLOAD_TOO_LARGE, "wrong-large").put("most", most >> 20)
}

/// Keeps a file as the photo of a number.
///
/// # Errors
///
/// It is too large, no photo, or the disk refuses.
pub(super) async fn keep(
    app: &App,
    place: &Place,
    number: u32,
    name: &str,
    length: Option<u64>,
    mut body: Body,
) -> Result<Kept, Wrong> {
    let kept = receive(app, place, number, name, length, &mut body).await;
    if kept.is_err() {
        // A browser reads no answer before it has sent all.
        let rest = async { while body.frame().await.is_some_and(|f| f.is_ok()) {} };
        let _ = tokio::time::timeout(PATIENCE, rest).await;
    }
    kept
}

async fn receive(
    app: &App,
    place: &Place,
    number: u32,
    name: &str,
    length: Option<u64>,
    body: &mut Body,
) -> Result<Kept, Wrong> {
    if !(1..=MOST_FILES).contains(&number) {
        let wrong = Wrong::new(StatusCode::PAYLOAD_TOO_LARGE, "wrong-many");
        return Err(wrong.put("most", MOST_FILES));
    }
    let before = place.record()?.bytes();
    let coming = length.unwrap_or(0);
    if coming > MOST_VIDEO {
        return Err(large(MOST_VIDEO));
    }
    if before + coming > MOST_CAPTURE {
        return Err(large(MOST_CAPTURE));
    }
    if app.home.free().is_some_and(|free| free < coming + SPARE) {
        return Err(Wrong::new(StatusCode::INSUFFICIENT_STORAGE, "wrong-full"));
    }
    let incoming = place.folder.join("incoming");
    home::make(&incoming)?;
    let part = Part(incoming.join(random(8)?));
    let (head, bytes) = stream(body, &part.0, MOST_CAPTURE - before).await?;
    let (path, called) = (part.0.clone(), tidy(name));
    let asked = called.clone();
    let sniffed = tokio::task::spawn_blocking(move || sniff(&path, &head, &asked)).await;
    let sniffed = sniffed.map_err(Wrong::broken)?.map_err(strange)?;
    let file = format!("{number:04}.{}", sniffed.ending);
    let kept = Kept {
        name: called,
        file,
        bytes,
        size: sniffed.size,
        video: sniffed.video,
    };
    // A capture that is being measured keeps its files.
    if app
        .jobs
        .of(&place.id)
        .is_some_and(|job| job.sender.borrow().goes_on())
    {
        return Err(Wrong::new(StatusCode::CONFLICT, "wrong-busy"));
    }
    app.home.change(place, |record| {
        if let Some(old) = record.files.insert(number, kept.clone()) {
            let _ = std::fs::remove_file(place.photos().join(old.file));
        }
        std::fs::rename(&part.0, place.photos().join(&kept.file))
    })??;
    place.outdated();
    Ok(kept)
}

pub(super) fn strange(why: Strange) -> Wrong {
    match why {
        Strange::Kind => Wrong::new(StatusCode::UNSUPPORTED_MEDIA_TYPE, "wrong-kind"),
        Strange::Heic => Wrong::new(StatusCode::UNSUPPORTED_MEDIA_TYPE, "wrong-heic"),
        Strange::Broken(why) => {
            Wrong::new(StatusCode::UNPROCESSABLE_ENTITY, "wrong-header").put("why", why)
        }
        Strange::Large {
            width,
            height,
            most,
        } => {
            let wrong = Wrong::new(StatusCode::PAYLOAD_TOO_LARGE, "wrong-pixels");
            wrong
                .put("width", width)
                .put("height", height)
                .put("most", most)
        }
    }
}

/// What has come in, gone again unless it gets its name.
struct Part(PathBuf);

impl Drop for Part {
    fn drop(&mut self) {
        let _ = std::fs::remove_file(&self.0);
    }
}

/// The body into a new file: its first bytes, and how many there were.
async fn stream(body: &mut Body, path: &Path, free: u64) -> Result<(Vec<u8>, u64), Wrong> {
    let mut options = tokio::fs::OpenOptions::new();
    let mut file = options
        .write(true)
        .create_new(true)
        .mode(0o600)
        .open(path)
        .await?;
    let (mut head, mut bytes) = (Vec::new(), 0);
    loop {
        let frame = tokio::time::timeout(PATIENCE, body.frame()).await;
        let slow = |_| Wrong::new(StatusCode::REQUEST_TIMEOUT, "wrong-slow");
        let Some(frame) = frame.map_err(slow)? else {
            break;
        };
        let frame = frame.map_err(|e| Wrong::unfit(e.to_string()))?;
        let Some(data) = frame.data_ref() else {
            continue;
        };
        head.extend(data.iter().take(HEAD - head.len()));
        bytes += data.len() as u64;
        let video = matches!(head.as_slice(), [_, _, _, _, b'f', b't', b'y', b'p', ..])
            || matches!(
                head.as_slice(),
                [0x1a, 0x45, 0xdf, 0xa3, ..] | [b'R', b'I', b'F', b'F', ..]
            );
        let most = if video { MOST_VIDEO } else { MOST_PHOTO };
        if bytes > most.min(free) {
            return Err(large(most.min(free)));
        }
        file.write_all(data).await?;
    }
    file.flush().await?;
    Ok((head, bytes))
}
