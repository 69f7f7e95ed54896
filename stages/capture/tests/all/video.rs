//! Videos of a turn: which frames are taken, and what phones do to them.

use crate::films;

use capture::VideoParams;
use films::{PHONE, angles, ffmpeg, film, frame, read};
use shape::Photos;
use stage::to_bytes;
use std::process::Command;

fn numbers(photos: &Photos) -> Vec<usize> {
    let number = |name: &str| {
        let (_, number) = name.split_once('#').unwrap();
        number.trim_end_matches(".jpg").parse().unwrap()
    };
    photos.photos.iter().map(|p| number(&p.name)).collect()
}

/// Mean brightness of a photo's middle.
fn level(photos: &Photos, at: usize) -> f64 {
    let rgb = photos.photos[at].decode().unwrap();
    let sum: u64 = rgb.data.iter().flatten().map(|c| u64::from(*c)).sum();
    sum as f64 / (3 * rgb.data.len()) as f64
}

#[test]
fn one_frame_a_step_is_taken_from_one_turn_and_none_twice() {
    if !ffmpeg() {
        return;
    }
    let place = tempfile::tempdir().unwrap();
    // Still, 1.15 turns, still.
    let angles = angles(15, 138, 12, 1.15);
    film(
        &place.path().join("turn.mp4"),
        angles.iter().map(|a| frame(*a)),
        &PHONE,
    );
    let (photos, warnings) = read(place.path(), &["turn.mp4"], &VideoParams::default()).unwrap();
    let numbers = numbers(&photos);
    assert_eq!(numbers.len(), 36, "{warnings:?}");
    assert_eq!(warnings, Vec::<String>::new());
    let turned: Vec<f64> = numbers.iter().map(|i| 360.0 * angles[*i]).collect();
    let span = turned[35] - turned[0];
    assert!((342.0..358.0).contains(&span), "{span}");
    let step = |w: &[f64]| w[1] - w[0];
    assert!(
        turned.windows(2).all(|w| (3.0..17.0).contains(&step(w))),
        "{turned:?}"
    );
    let first = &photos.photos[0];
    assert_eq!((first.width, first.height), (216, 384));
    assert_eq!((first.orientation, first.focal_35mm), (1, None));
    proof::near(first.time_s.unwrap(), numbers[0] as f64 / 30.0, 1e-3);
    // The picture is the frame.
    let (rgb, true_one) = (first.decode().unwrap(), frame(angles[numbers[0]]));
    let off = rgb.data.iter().flatten().zip(&true_one);
    let off: f64 = off.map(|(a, b)| f64::from(a.abs_diff(*b))).sum();
    let off = off / true_one.len() as f64;
    assert!(off < 4.0, "{off}");
    // The same bytes with any number of threads.
    let again = |threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| {
            read(place.path(), &["turn.mp4"], &VideoParams::default())
                .unwrap()
                .0
        })
    };
    let bytes = to_bytes(&photos);
    assert!(to_bytes(&again(1)) == bytes && to_bytes(&again(3)) == bytes);
    let fewer = VideoParams {
        step_deg: 20.0,
        longest: 320,
        ..VideoParams::default()
    };
    let (photos, _) = read(place.path(), &["turn.mp4"], &fewer).unwrap();
    assert_eq!(photos.photos.len(), 18);
    assert_eq!(
        (photos.photos[0].width, photos.photos[0].height),
        (180, 320)
    );
}

#[test]
fn a_video_on_its_side_with_uneven_times_is_upright_and_without_its_place() {
    if !ffmpeg() {
        return;
    }
    let place = tempfile::tempdir().unwrap();
    let (turned, file) = (
        place.path().join("turned.mp4"),
        place.path().join("turn.mov"),
    );
    let angles = angles(0, 150, 0, 1.0);
    let mut more = PHONE.to_vec();
    // Turned by a quarter, as a phone's sensor is; every fifth frame late.
    let chain = format!(
        "transpose=clock,settb=1/90000,setpts=N*3000+eq(mod(N\\,5)\\,4)*1800,{}",
        PHONE[1]
    );
    more[1] = &chain;
    more.extend(["-fps_mode", "passthrough", "-enc_time_base", "1:90000"]);
    film(&turned, angles.iter().map(|a| frame(*a)), &more);
    let mut command = Command::new("ffmpeg");
    command.args(["-v", "error", "-y", "-i"]).arg(&turned);
    command.args([
        "-c",
        "copy",
        "-metadata",
        "location=+48.8577+002.295/",
        "-metadata:s:v:0",
        "rotate=90",
    ]);
    assert!(command.arg(&file).status().unwrap().success());
    std::fs::copy(&file, place.path().join("plate.mov")).unwrap();
    let names = ["turn.mov", "plate.mov"];
    let (photos, warnings) = read(place.path(), &names, &VideoParams::default()).unwrap();
    assert_eq!(photos.photos.len(), 36, "{warnings:?}");
    let plate = photos.plate.as_ref().unwrap();
    assert!(plate.name.starts_with("plate.mov#") && plate.time_s.is_none());
    let first = &photos.photos[0];
    assert_eq!((first.width, first.height), (216, 384), "upright");
    let (rgb, true_one) = (first.decode().unwrap(), frame(angles[numbers(&photos)[0]]));
    let off = rgb.data.iter().flatten().zip(&true_one);
    let off: f64 = off.map(|(a, b)| f64::from(a.abs_diff(*b))).sum();
    assert!(
        off / (true_one.len() as f64) < 4.0,
        "turned the right way: {off}"
    );
    let late = photos
        .photos
        .iter()
        .zip(numbers(&photos))
        .find(|(_, n)| n % 5 == 4);
    let (late, number) = late.expect("a frame that is late");
    proof::near(late.time_s.unwrap(), number as f64 / 30.0 + 0.02, 2e-3);
    let bytes = to_bytes(&photos);
    assert!(!bytes.windows(8).any(|w| w == b"+48.8577"));
}

#[test]
fn a_phones_hdr_comes_out_as_bright_as_a_screen_shows_it() {
    if !ffmpeg() {
        return;
    }
    let place = tempfile::tempdir().unwrap();
    let angles = angles(0, 60, 0, 1.0);
    let frames = || angles.iter().map(|a| frame(*a));
    film(&place.path().join("plain.mp4"), frames(), &PHONE);
    let p = VideoParams {
        step_deg: 30.0,
        ..VideoParams::default()
    };
    let plain = read(place.path(), &["plain.mp4"], &p).unwrap().0;
    for (transfer, name) in [("smpte2084", "pq.mp4"), ("arib-std-b67", "hlg.mp4")] {
        let chain = format!(
            "{},setparams=colorspace=bt709:color_primaries=bt709:color_trc=iec61966-2-1:range=tv,\
             zscale=p=2020:t={transfer}:m=2020_ncl:r=tv:npl=203,format=yuv420p10le",
            PHONE[1].replace("yuv420p", "yuv444p")
        );
        let tags = [
            "-color_trc",
            transfer,
            "-colorspace",
            "bt2020nc",
            "-color_primaries",
            "bt2020",
        ];
        let mut more = vec!["-vf", &chain, "-c:v", "libx265", "-preset", "ultrafast"];
        more.extend(
            ["-x265-params", "log-level=none", "-tag:v", "hvc1"]
                .iter()
                .chain(&tags),
        );
        film(&place.path().join(name), frames(), &more);
        let bright = read(place.path(), &[name], &p).unwrap().0;
        assert_eq!(bright.photos.len(), plain.photos.len());
        let (a, b) = (level(&plain, 3), level(&bright, 3));
        // Tone mapping bends what is bright.
        assert!((0.85..1.1).contains(&(b / a)), "{name}: {b} for {a}");
    }
}
