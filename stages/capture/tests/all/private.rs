//! What a camera writes beside the picture stays with the user: places, names, comments and previews never get into the
//! photos' artifact; what the program reads does.

use crate::films;

use capture::{Load, LoadInput, LoadParams};
use films::{HEIGHT, WIDTH, files, frame};
use image::{ExtendedColorType, ImageEncoder};
use shape::{Photo, Photos, Rgb, rgb_to_jpeg};
use stage::{Ctx, Stage, to_bytes};
use std::path::Path;

const NEEDLE: &str = "NEEDLE";

/// An entry of a TIFF directory whose value is a number.
fn number(tag: u16, kind: u16, value: u32) -> Vec<u8> {
    entry(tag, kind, 1, value)
}

fn entry(tag: u16, kind: u16, count: u32, value: u32) -> Vec<u8> {
    let mut bytes = [tag.to_le_bytes(), kind.to_le_bytes()].concat();
    bytes.extend(count.to_le_bytes());
    bytes.extend(value.to_le_bytes());
    bytes
}

fn directory(entries: &[Vec<u8>], next: u32) -> Vec<u8> {
    let mut bytes = (entries.len() as u16).to_le_bytes().to_vec();
    entries.iter().for_each(|e| bytes.extend(e));
    bytes.extend(next.to_le_bytes());
    bytes
}

const ASCII: u16 = 2;
const SHORT: u16 = 3;
const LONG: u16 = 4;

/// EXIF as a phone writes it: what the program reads, and what it must not keep.
fn exif(orientation: u32) -> Vec<u8> {
    let texts: [(&str, u32); 4] = [
        ("NEEDLE artist, 1 Needle Street\0", 600),
        ("NEEDLE make\0", 700),
        ("2026:11:24 10:30:05\0", 800),
        ("NEEDLE comment of some length\0", 900),
    ];
    let text = |tag, at: usize| entry(tag, ASCII, texts[at].0.len() as u32, texts[at].1);
    let first = directory(
        &[
            text(0x010e, 0),
            text(0x010f, 1),
            number(0x0112, SHORT, orientation),
            text(0x013b, 0),
            number(0x8769, LONG, 200),
            number(0x8825, LONG, 400),
        ],
        500,
    );
    let own = directory(
        &[
            text(0x9003, 2),
            entry(0x9286, 7, 30, 900),
            number(0xa405, SHORT, 26),
            text(0xa430, 0),
        ],
        0,
    );
    let place = directory(
        &[entry(0x0001, ASCII, 2, u32::from(b'N')), text(0x001b, 3)],
        0,
    );
    let preview = directory(&[text(0x010e, 0)], 0);
    let mut tiff = vec![0; 1000];
    tiff[..8].copy_from_slice(b"II*\0\x08\0\0\0");
    for (at, bytes) in [(8, first), (200, own), (400, place), (500, preview)] {
        tiff[at..at + bytes.len()].copy_from_slice(&bytes);
    }
    for (text, at) in texts {
        tiff[at as usize..][..text.len()].copy_from_slice(text.as_bytes());
    }
    tiff
}

fn segment(marker: u8, bytes: &[u8]) -> Vec<u8> {
    let mut all = vec![0xff, marker];
    all.extend(((bytes.len() + 2) as u16).to_be_bytes());
    all.extend(bytes);
    all
}

fn picture(turns: f64) -> Rgb {
    let pixels = frame(turns);
    Rgb {
        width: WIDTH,
        height: HEIGHT,
        data: pixels.chunks_exact(3).map(|p| [p[0], p[1], p[2]]).collect(),
    }
}

/// A JPEG as a phone writes it, with all that it may hold beside the picture.
fn jpeg(plain: &[u8], orientation: u32) -> Vec<u8> {
    let mut all = plain[..2].to_vec();
    let exif = [b"Exif\0\0", exif(orientation).as_slice()].concat();
    all.extend(segment(0xe1, &exif));
    all.extend(segment(
        0xe1,
        b"http://ns.adobe.com/xap/1.0/\0<x>NEEDLE xmp</x>",
    ));
    all.extend(segment(0xe2, b"MPF\0NEEDLE others"));
    all.extend(segment(0xed, b"Photoshop 3.0\0NEEDLE caption"));
    all.extend(segment(0xfe, b"NEEDLE comment"));
    all.extend(&plain[2..]);
    all.extend(b"NEEDLE trailer");
    all
}

fn chunk(name: &[u8; 4], data: &[u8]) -> Vec<u8> {
    let mut crc = u32::MAX;
    for byte in name.iter().chain(data) {
        crc ^= u32::from(*byte);
        for _ in 0..8 {
            crc = (crc >> 1) ^ (0xedb8_8320 & (0u32.wrapping_sub(crc & 1)));
        }
    }
    let length = (data.len() as u32).to_be_bytes();
    [&length[..], name, data, &(!crc).to_be_bytes()].concat()
}

fn png(rgb: &Rgb) -> Vec<u8> {
    let mut bytes = Vec::new();
    let (w, h) = (rgb.width as u32, rgb.height as u32);
    let encoder = image::codecs::png::PngEncoder::new(&mut bytes);
    let data = rgb.data.as_flattened();
    encoder
        .write_image(data, w, h, ExtendedColorType::Rgb8)
        .unwrap();
    bytes
}

/// A PNG with EXIF and texts.
fn described_png(plain: &[u8], orientation: u32) -> Vec<u8> {
    // Signature and header.
    let (head, rest) = plain.split_at(8 + 25);
    let mut all = head.to_vec();
    all.extend(chunk(b"tEXt", b"Author\0NEEDLE author"));
    all.extend(chunk(b"eXIf", &exif(orientation)));
    all.extend(rest);
    all.extend(b"NEEDLE trailer");
    all
}

/// A TIFF with an artist.
fn tiff(rgb: &Rgb) -> Vec<u8> {
    let data = rgb.data.as_flattened();
    let (w, h) = (rgb.width as u32, rgb.height as u32);
    let artist = b"NEEDLE artist\0";
    let (bits, strip) = (400, 500);
    let entries = [
        number(0x0100, LONG, w),
        number(0x0101, LONG, h),
        entry(0x0102, SHORT, 3, bits),
        number(0x0103, SHORT, 1),
        number(0x0106, SHORT, 2),
        number(0x0111, LONG, strip),
        number(0x0112, SHORT, 1),
        number(0x0115, SHORT, 3),
        number(0x0116, LONG, h),
        number(0x0117, LONG, data.len() as u32),
        entry(0x013b, ASCII, artist.len() as u32, 450),
    ];
    let mut all = vec![0; strip as usize];
    all[..8].copy_from_slice(b"II*\0\x08\0\0\0");
    let directory = directory(&entries, 0);
    all[8..8 + directory.len()].copy_from_slice(&directory);
    all[bits as usize..][..6].copy_from_slice(&[8, 0, 8, 0, 8, 0]);
    all[450..450 + artist.len()].copy_from_slice(artist);
    all.extend(data);
    all
}

fn load(folder: &Path, named: &[(&str, Vec<u8>)]) -> Photos {
    for (name, bytes) in named {
        std::fs::write(folder.join(name), bytes).unwrap();
    }
    let names: Vec<&str> = named.iter().map(|(name, _)| *name).collect();
    let input = LoadInput {
        files: files(folder, &names),
        frames: None,
    };
    Load::run(&LoadParams::default(), input, &Ctx::alone()).unwrap()
}

#[track_caller]
fn clean(photos: &Photos) {
    let bytes = to_bytes(photos);
    let text = String::from_utf8_lossy(&bytes);
    // The make is kept, as the device.
    let text = text.replace("NEEDLE make", "");
    let at = text.find(NEEDLE);
    assert_eq!(
        at.map(|at| text[at..].chars().take(30).collect::<String>()),
        None
    );
}

#[track_caller]
fn keeps_facts(photo: &Photo, orientation: u8) {
    assert_eq!(
        (photo.orientation, photo.focal_35mm),
        (orientation, Some(26.0))
    );
    assert_eq!(
        (photo.device.as_str(), photo.time_s),
        ("NEEDLE make", Some(0.0))
    );
}

#[test]
fn what_a_camera_writes_beside_the_picture_is_in_no_artifact() {
    let place = tempfile::tempdir().unwrap();
    let pictures = [0.0, 0.1, 0.2].map(picture);
    let plain = pictures.each_ref().map(|p| rgb_to_jpeg(p, 95));
    let names = ["1.jpg", "2.jpg", "3.jpg"];
    for orientation in [1, 6] {
        let named_jpeg = |i: usize| (names[i], jpeg(&plain[i], orientation));
        let photos = load(place.path(), &[named_jpeg(0), named_jpeg(1), named_jpeg(2)]);
        clean(&photos);
        for (photo, plain) in photos.photos.iter().zip(&plain) {
            keeps_facts(photo, orientation as u8);
            let bare = Photo {
                file: plain.clone().into(),
                ..photo.clone()
            };
            assert_eq!(photo.decode().unwrap().data, bare.decode().unwrap().data);
        }
        // Read once more, as by whoever gets them: the same photos.
        let again: Vec<(&str, Vec<u8>)> = names
            .iter()
            .zip(&photos.photos)
            .map(|(name, photo)| (*name, photo.file.to_vec()))
            .collect();
        assert_eq!(load(place.path(), &again).photos, photos.photos);
    }
}

#[test]
fn texts_of_a_png_and_tags_of_a_tiff_are_in_no_artifact() {
    let place = tempfile::tempdir().unwrap();
    let pictures = [0.0, 0.1, 0.2].map(picture);
    let names = ["1.png", "2.png", "3.png"];
    let of = |i: usize| (names[i], described_png(&png(&pictures[i]), 6));
    let photos = load(place.path(), &[of(0), of(1), of(2)]);
    clean(&photos);
    photos.photos.iter().for_each(|photo| keeps_facts(photo, 6));
    let names = ["1.tif", "2.tif", "3.tif"];
    let of = |i: usize| (names[i], tiff(&pictures[i]));
    let photos = load(place.path(), &[of(0), of(1), of(2)]);
    clean(&photos);
    for (photo, picture) in photos.photos.iter().zip(&pictures) {
        assert_eq!(photo.decode().unwrap().data, picture.data);
    }
}

#[test]
fn files_without_anything_beside_the_picture_stay_byte_for_byte() {
    let place = tempfile::tempdir().unwrap();
    let pictures = [0.0, 0.1, 0.2].map(picture);
    let jpegs = pictures.each_ref().map(|p| rgb_to_jpeg(p, 95));
    let pngs = pictures.each_ref().map(png);
    for (ending, files) in [("jpg", jpegs), ("png", pngs)] {
        let names = ["1", "2", "3"].map(|n| format!("{n}.{ending}"));
        let named: Vec<(&str, Vec<u8>)> = names
            .iter()
            .map(String::as_str)
            .zip(files.clone())
            .collect();
        let photos = load(place.path(), &named);
        for (photo, file) in photos.photos.iter().zip(&files) {
            assert_eq!(&photo.file[..], &file[..], "{ending}");
        }
    }
}
