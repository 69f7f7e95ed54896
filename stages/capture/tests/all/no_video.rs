//! What is no video of a turn, or only a part of one; and a stop.

use crate::films;

use capture::{Video, VideoInput, VideoParams};
use films::{Collected, PHONE, angles, ffmpeg, files, film, frame, read};
use stage::{Ctx, Hash, Stage, Stop};
use std::process::Command;

#[test]
fn what_is_no_video_of_a_turn_is_refused_with_what_to_do() {
    if !ffmpeg() {
        return;
    }
    let place = tempfile::tempdir().unwrap();
    let at = |name: &str| place.path().join(name);
    let refused = |names: &[&str]| read(place.path(), names, &VideoParams::default()).unwrap_err();
    let turn = || angles(0, 60, 0, 1.0).into_iter().map(frame);
    film(&at("turn.mp4"), turn(), &PHONE);
    let whole = std::fs::read(at("turn.mp4")).unwrap();
    std::fs::write(at("cut.mp4"), &whole[..whole.len() / 2]).unwrap();
    assert!(
        refused(&["cut.mp4"]).contains("copied whole"),
        "{}",
        refused(&["cut.mp4"])
    );
    std::fs::write(at("text.mp4"), "no video at all, in many words").unwrap();
    assert!(refused(&["text.mp4"]).contains("is no video that can be read"));
    std::fs::write(at("empty.mp4"), "").unwrap();
    assert!(refused(&["empty.mp4"]).contains("is no video that can be read"));
    // A playlist that leads elsewhere is no video.
    let list = format!(
        "ffconcat version 1.0\nfile '{}'\n",
        at("turn.mp4").display()
    );
    std::fs::write(at("list.mp4"), list).unwrap();
    assert!(
        refused(&["list.mp4"]).contains("is no video that can be read"),
        "{}",
        refused(&["list.mp4"])
    );
    film(&at("one.mp4"), turn().take(1), &PHONE);
    assert!(refused(&["one.mp4"]).contains("1 frames: a turn has at least three"));
    film(&at("still.mp4"), (0..60).map(|_| frame(0.0)), &PHONE);
    assert!(refused(&["still.mp4"]).contains("nothing turns in still.mp4"));
    let sound = ["-v", "error", "-y", "-f", "lavfi", "-i", "sine=d=1"];
    assert!(
        Command::new("ffmpeg")
            .args(sound)
            .arg(at("sound.mp4"))
            .status()
            .unwrap()
            .success()
    );
    assert!(refused(&["sound.mp4"]).contains("no moving pictures"));
    let both = refused(&["turn.mp4", "still.mp4"]);
    assert!(both.contains("there are 2 videos") && both.contains("tailor measure turn.mp4"));
    assert!(refused(&[]).contains("there is no video here"));
    let short = VideoParams {
        minutes: 0.01,
        ..VideoParams::default()
    };
    let long = read(place.path(), &["turn.mp4"], &short).unwrap_err();
    assert!(long.contains("more than 0.01 min"), "{long}");
    assert!(!long.contains(&*place.path().to_string_lossy()));
}

#[test]
fn part_of_a_turn_and_a_stop_are_reported() {
    if !ffmpeg() {
        return;
    }
    let place = tempfile::tempdir().unwrap();
    let part = angles(10, 100, 10, 0.7);
    film(
        &place.path().join("part.mp4"),
        part.into_iter().map(frame),
        &PHONE,
    );
    let (photos, warnings) = read(place.path(), &["part.mp4"], &VideoParams::default()).unwrap();
    assert!(
        warnings.iter().any(|t| t.contains("is this a whole turn?")),
        "{warnings:?}"
    );
    assert!(photos.photos.len() > 30);
    let stopped = Collected {
        cancelled: true,
        ..Collected::default()
    };
    let none = Hash::from_bytes([0; 32]);
    let ctx = Ctx::new(&stopped, none, none);
    let input = VideoInput {
        files: files(place.path(), &["part.mp4"]),
    };
    let run = Video::run(&VideoParams::default(), input, &ctx);
    assert!(matches!(run, Err(Stop::Cancelled)));
}
