//! HEIC photos: compared with heif-convert where they are read, else named with what converts them.

mod films;

use capture::{Load, LoadInput, LoadParams};
use films::{HEIGHT, WIDTH, files, frame};
use shape::{Photos, Rgb, rgb_to_jpeg};
use stage::{Ctx, Stage, Stop};
use std::path::Path;
use std::process::Command;

fn heif() -> bool {
    proof::program("heif-enc", "libheif-examples")
        && proof::program("heif-convert", "libheif-examples")
}

/// EXIF with an orientation and a focal length, as it is in a JPEG.
fn exif(orientation: u8) -> Vec<u8> {
    let mut tiff = b"II*\0\x08\0\0\0\x02\0".to_vec();
    tiff.extend(*b"\x12\x01\x03\0\x01\0\0\0");
    tiff.extend([orientation, 0, 0, 0]);
    tiff.extend(*b"\x69\x87\x04\0\x01\0\0\0\x26\0\0\0\0\0\0\0");
    tiff.extend(*b"\x01\0\x05\xa4\x03\0\x01\0\0\0\x1a\0\0\0\0\0\0\0");
    let mut segment = b"\xff\xe1".to_vec();
    segment.extend(((tiff.len() + 8) as u16).to_be_bytes());
    segment.extend(b"Exif\0\0");
    segment.extend(tiff);
    segment
}

/// A HEIC made of a JPEG with EXIF, by heif-enc.
fn heic(folder: &Path, name: &str, turns: f64, orientation: u8) {
    let pixels = frame(turns);
    let rgb = Rgb {
        width: WIDTH,
        height: HEIGHT,
        data: pixels.chunks_exact(3).map(|p| [p[0], p[1], p[2]]).collect(),
    };
    let plain = rgb_to_jpeg(&rgb, 95);
    let jpeg = [&plain[..2], &exif(orientation), &plain[2..]].concat();
    let from = folder.join("from.jpg");
    std::fs::write(&from, jpeg).unwrap();
    let mut command = Command::new("heif-enc");
    command
        .args(["-q", "90", "-o"])
        .arg(folder.join(name))
        .arg(&from);
    assert!(command.output().unwrap().status.success());
    std::fs::remove_file(from).unwrap();
}

fn read(folder: &Path, names: &[&str]) -> Result<Photos, String> {
    let input = LoadInput {
        files: files(folder, names),
        frames: None,
    };
    match Load::run(&LoadParams::default(), input, &Ctx::alone()) {
        Ok(photos) => Ok(photos),
        Err(Stop::Failed(error)) => Err(error.to_string()),
        Err(Stop::Cancelled) => panic!("nobody asked to stop"),
    }
}

#[cfg(feature = "heic")]
#[test]
fn a_heic_is_the_picture_that_libheif_makes_of_it() {
    if !heif() {
        return;
    }
    let place = tempfile::tempdir().unwrap();
    let names = ["IMG_1.HEIC", "IMG_2.HEIC", "IMG_3.HEIC"];
    for (i, name) in names.iter().enumerate() {
        heic(place.path(), name, 0.1 * i as f64, 1);
    }
    let photos = read(place.path(), &names).unwrap();
    for (photo, name) in photos.photos.iter().zip(names) {
        assert_eq!(photo.name, name.replace("HEIC", "jpg"));
        assert_eq!((photo.orientation, photo.focal_35mm), (1, Some(26.0)));
        let file = place.path().join("other.png");
        let mut command = Command::new("heif-convert");
        command.arg(place.path().join(name)).arg(&file);
        assert!(command.output().unwrap().status.success());
        let other = shape::Photo {
            name: "other.png".into(),
            file: std::fs::read(&file).unwrap().into(),
            ..photo.clone()
        };
        let (ours, theirs) = (photo.decode().unwrap(), other.decode().unwrap());
        let squares = ours.data.iter().flatten().zip(theirs.data.iter().flatten());
        let squares: f64 = squares
            .map(|(a, b)| f64::from(a.abs_diff(*b)).powi(2))
            .sum();
        let mse = squares / (3 * ours.data.len()) as f64;
        let decibels = 10.0 * libm::log10(255.0f64.powi(2) / mse);
        eprintln!("{name}: {decibels:.1} dB");
        assert!(decibels > 38.0, "{name}: {decibels:.1} dB");
    }
    // One that was cut short.
    let whole = std::fs::read(place.path().join(names[0])).unwrap();
    std::fs::write(place.path().join(names[0]), &whole[..whole.len() / 2]).unwrap();
    let why = read(place.path(), &names).unwrap_err();
    assert!(
        why.contains("IMG_1.HEIC is no picture that can be read"),
        "{why}"
    );
}

#[cfg(not(feature = "heic"))]
#[test]
fn a_heic_is_named_with_the_command_that_converts_it() {
    if !heif() {
        return;
    }
    let place = tempfile::tempdir().unwrap();
    let names = ["IMG_1.HEIC", "IMG_2.HEIC", "IMG_3.HEIC"];
    names
        .iter()
        .for_each(|name| heic(place.path(), name, 0.0, 6));
    std::fs::write(place.path().join("IMG_2.HEIC"), b"\0\0\0\x18ftypheic more").unwrap();
    std::fs::write(
        place.path().join("IMG_3.HEIC"),
        b"\0\0\0\x18ftypmif1 and more",
    )
    .unwrap();
    let why = read(place.path(), &names).unwrap_err();
    for part in [
        "IMG_1.HEIC",
        "heif-convert -q 95",
        "libheif-examples",
        "--features heic",
    ] {
        assert!(why.contains(part), "{part}: {why}");
    }
    // What is named converts it, and the photo is upright with its focal length.
    let made = place.path().join("IMG_1.jpg");
    let mut command = Command::new("heif-convert");
    command
        .args(["-q", "95"])
        .arg(place.path().join("IMG_1.HEIC"))
        .arg(&made);
    assert!(command.output().unwrap().status.success());
    assert!(made.is_file());
}
