//! Videos of a turn: which frames are taken, what phones do to them, and what is no video of a turn.

mod films;

use capture::{Video, VideoInput, VideoParams};
use films::{PHONE, angles, ffmpeg, files, film, frame};
use shape::Photos;
use stage::{Ctx, Hash, Host, Stage, Stop, to_bytes};
use std::path::Path;
use std::process::Command;
use std::sync::Mutex;

/// Who is told.
#[derive(Default)]
struct Told {
    warnings: Mutex<Vec<String>>,
    cancelled: bool,
}

impl Host for Told {
    fn warn(&self, text: &str) {
        self.warnings.lock().unwrap().push(text.into());
    }
    fn cancelled(&self) -> bool {
        self.cancelled
    }
}

fn read(folder: &Path, names: &[&str], p: &VideoParams) -> Result<(Photos, Vec<String>), String> {
    let told = Told::default();
    let none = Hash::from_bytes([0; 32]);
    let ctx = Ctx::new(&told, none, none);
    let files = files(folder, names);
    match Video::run(p, VideoInput { files }, &ctx) {
        Ok(photos) => Ok((photos, told.warnings.into_inner().unwrap())),
        Err(Stop::Failed(error)) => Err(error.to_string()),
        Err(Stop::Cancelled) => panic!("nobody asked to stop"),
    }
}

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
    let (photos, told) = read(place.path(), &["turn.mp4"], &VideoParams::default()).unwrap();
    let numbers = numbers(&photos);
    assert_eq!(numbers.len(), 36, "{told:?}");
    assert_eq!(told, Vec::<String>::new());
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
fn a_video_on_its_side_with_uneven_times_stands_upright_and_says_nothing_of_the_place() {
    if !ffmpeg() {
        return;
    }
    let place = tempfile::tempdir().unwrap();
    let (lying, file) = (
        place.path().join("lying.mp4"),
        place.path().join("turn.mov"),
    );
    let angles = angles(0, 150, 0, 1.0);
    let mut more = PHONE.to_vec();
    // Turned by a quarter, as a phone's sensor lies; every fifth frame late.
    let chain = format!(
        "transpose=clock,settb=1/90000,setpts=N*3000+eq(mod(N\\,5)\\,4)*1800,{}",
        PHONE[1]
    );
    more[1] = &chain;
    more.extend(["-fps_mode", "passthrough", "-enc_time_base", "1:90000"]);
    film(&lying, angles.iter().map(|a| frame(*a)), &more);
    let mut command = Command::new("ffmpeg");
    command.args(["-v", "error", "-y", "-i"]).arg(&lying);
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
    let (photos, told) = read(place.path(), &names, &VideoParams::default()).unwrap();
    assert_eq!(photos.photos.len(), 36, "{told:?}");
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

#[test]
fn what_is_no_video_of_a_turn_is_told_with_what_to_do() {
    if !ffmpeg() {
        return;
    }
    let place = tempfile::tempdir().unwrap();
    let at = |name: &str| place.path().join(name);
    let told = |names: &[&str]| read(place.path(), names, &VideoParams::default()).unwrap_err();
    let turn = || angles(0, 60, 0, 1.0).into_iter().map(frame);
    film(&at("turn.mp4"), turn(), &PHONE);
    let whole = std::fs::read(at("turn.mp4")).unwrap();
    std::fs::write(at("cut.mp4"), &whole[..whole.len() / 2]).unwrap();
    assert!(
        told(&["cut.mp4"]).contains("copied whole"),
        "{}",
        told(&["cut.mp4"])
    );
    std::fs::write(at("text.mp4"), "no video at all, said at length").unwrap();
    assert!(told(&["text.mp4"]).contains("is no video that can be read"));
    std::fs::write(at("empty.mp4"), "").unwrap();
    assert!(told(&["empty.mp4"]).contains("is no video that can be read"));
    // A playlist that leads elsewhere is no video.
    let list = format!(
        "ffconcat version 1.0\nfile '{}'\n",
        at("turn.mp4").display()
    );
    std::fs::write(at("list.mp4"), list).unwrap();
    assert!(
        told(&["list.mp4"]).contains("is no video that can be read"),
        "{}",
        told(&["list.mp4"])
    );
    film(&at("one.mp4"), turn().take(1), &PHONE);
    assert!(told(&["one.mp4"]).contains("1 frames: a turn has at least three"));
    film(&at("still.mp4"), (0..60).map(|_| frame(0.0)), &PHONE);
    assert!(told(&["still.mp4"]).contains("nothing turns in still.mp4"));
    let sound = ["-v", "error", "-y", "-f", "lavfi", "-i", "sine=d=1"];
    assert!(
        Command::new("ffmpeg")
            .args(sound)
            .arg(at("sound.mp4"))
            .status()
            .unwrap()
            .success()
    );
    assert!(told(&["sound.mp4"]).contains("no moving pictures"));
    let both = told(&["turn.mp4", "still.mp4"]);
    assert!(both.contains("there are 2 videos") && both.contains("tailor measure turn.mp4"));
    assert!(told(&[]).contains("there is no video here"));
    let short = VideoParams {
        minutes: 0.01,
        ..VideoParams::default()
    };
    let long = read(place.path(), &["turn.mp4"], &short).unwrap_err();
    assert!(long.contains("more than 0.01 min"), "{long}");
    assert!(!long.contains(&*place.path().to_string_lossy()));
}

#[test]
fn part_of_a_turn_and_a_stop_are_told() {
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
    let (photos, told) = read(place.path(), &["part.mp4"], &VideoParams::default()).unwrap();
    assert!(
        told.iter().any(|t| t.contains("is this a whole turn?")),
        "{told:?}"
    );
    assert!(photos.photos.len() > 30);
    let stopped = Told {
        cancelled: true,
        ..Told::default()
    };
    let none = Hash::from_bytes([0; 32]);
    let ctx = Ctx::new(&stopped, none, none);
    let input = VideoInput {
        files: files(place.path(), &["part.mp4"]),
    };
    let run = Video::run(&VideoParams::default(), input, &ctx);
    assert!(matches!(run, Err(Stop::Cancelled)));
}
