//! Raw photos: a made DNG through dcraw_emu, and what is none.

use crate::films;

use capture::{Raw, RawInput, RawParams};
use films::files;
use shape::Photos;
use stage::{Ctx, Stage, Stop};
use std::path::Path;

fn dcraw() -> bool {
    proof::program("dcraw_emu", "libraw-bin")
}

const WIDTH: u32 = 256;
const HEIGHT: u32 = 160;

/// What a tag holds.
enum Holds {
    Text(&'static str),
    Bytes(Vec<u8>),
    Shorts(Vec<u16>),
    Longs(Vec<u32>),
    /// In ten-thousandths.
    Ratios(u16, Vec<i32>),
}

/// A directory of a TIFF that begins at `base`, with what does not fit into it behind it.
fn directory(base: usize, tags: &[(u16, Holds)]) -> Vec<u8> {
    let (mut table, mut behind) = (Vec::new(), Vec::new());
    let start = base + 2 + 12 * tags.len() + 4;
    table.extend((tags.len() as u16).to_le_bytes());
    for (tag, holds) in tags {
        let shorts = |all: &[u16]| {
            all.iter()
                .flat_map(|v| v.to_le_bytes())
                .collect::<Vec<u8>>()
        };
        let (kind, count, mut bytes): (u16, usize, Vec<u8>) = match holds {
            Holds::Text(text) => (2, text.len() + 1, [text.as_bytes(), b"\0"].concat()),
            Holds::Bytes(all) => (1, all.len(), all.clone()),
            Holds::Shorts(all) => (3, all.len(), shorts(all)),
            Holds::Longs(all) => (
                4,
                all.len(),
                all.iter().flat_map(|v| v.to_le_bytes()).collect(),
            ),
            Holds::Ratios(kind, all) => {
                let ratio = |v: &i32| [v.to_le_bytes(), 10_000i32.to_le_bytes()].concat();
                (*kind, all.len(), all.iter().flat_map(ratio).collect())
            }
        };
        table.extend(tag.to_le_bytes());
        table.extend(kind.to_le_bytes());
        table.extend((count as u32).to_le_bytes());
        if bytes.len() <= 4 {
            bytes.resize(4, 0);
            table.extend(bytes);
        } else {
            table.extend(((start + behind.len()) as u32).to_le_bytes());
            behind.extend(bytes);
            behind.resize(behind.len().next_multiple_of(2), 0);
        }
    }
    table.extend(0u32.to_le_bytes());
    table.extend(behind);
    table
}

/// A DNG of a sensor with an RGGB mosaic: red grows to the right, blue downward, green is even.
fn dng(orientation: u16) -> Vec<u8> {
    let sample = |i: u32| {
        let (x, y) = (i % WIDTH, i / WIDTH);
        let share = match (x % 2, y % 2) {
            (0, 0) => f64::from(x) / f64::from(WIDTH),
            (1, 1) => f64::from(y) / f64::from(HEIGHT),
            _ => 0.5,
        };
        (1000.0 + 60_000.0 * share) as u16
    };
    let raw: Vec<u8> = (0..WIDTH * HEIGHT)
        .flat_map(|i| sample(i).to_le_bytes())
        .collect();
    let one = |v: u32| Holds::Longs(vec![v]);
    let short = |v: u16| Holds::Shorts(vec![v]);
    let tags = |data: u32, exif: u32| {
        [
            (254, one(0)),
            (256, one(WIDTH)),
            (257, one(HEIGHT)),
            (258, short(16)),
            (259, short(1)),
            (262, short(32803)),
            (271, Holds::Text("Made")),
            (272, Holds::Text("Raw One")),
            (273, one(data)),
            (274, short(orientation)),
            (277, short(1)),
            (278, one(HEIGHT)),
            (279, one(raw.len() as u32)),
            (33421, Holds::Shorts(vec![2, 2])),
            (33422, Holds::Bytes(vec![0, 1, 1, 2])),
            (34665, one(exif)),
            (50706, Holds::Bytes(vec![1, 4, 0, 0])),
            (50708, Holds::Text("Made Raw One")),
            (50714, short(1000)),
            (50717, one(61_000)),
            (
                50721,
                Holds::Ratios(10, vec![10_000, 0, 0, 0, 10_000, 0, 0, 0, 10_000]),
            ),
            (50728, Holds::Ratios(5, vec![10_000; 3])),
            (50778, short(21)),
        ]
    };
    let exif = [
        (0x9003, Holds::Text("2026:01:02 03:04:05")),
        (0xa405, short(26)),
    ];
    let at = 8 + directory(8, &tags(0, 0)).len();
    let exif = directory(at, &exif);
    let mut file = b"II*\0\x08\0\0\0".to_vec();
    file.extend(directory(8, &tags((at + exif.len()) as u32, at as u32)));
    file.extend(exif);
    file.extend(raw);
    file
}

fn read(folder: &Path, names: &[&str]) -> Result<Photos, String> {
    let input = RawInput {
        files: files(folder, names),
    };
    match Raw::run(&RawParams::default(), input, &Ctx::alone()) {
        Ok(photos) => Ok(photos),
        Err(Stop::Failed(error)) => Err(error.to_string()),
        Err(Stop::Cancelled) => panic!("nobody asked to stop"),
    }
}

#[test]
fn raw_photos_are_developed_upright_with_their_facts_of_the_lens() {
    if !dcraw() {
        return;
    }
    let place = tempfile::tempdir().unwrap();
    for (name, orientation) in [("a.dng", 1), ("B.DNG", 6), ("plate.dng", 3)] {
        std::fs::write(place.path().join(name), dng(orientation)).unwrap();
    }
    let photos = read(place.path(), &["a.dng", "B.DNG", "plate.dng"]).unwrap();
    let plate = photos.plate.as_ref().unwrap();
    assert_eq!(
        (plate.name.as_str(), plate.width, plate.height),
        ("plate.jpg", 256, 160)
    );
    let [a, b] = photos.photos.as_slice() else {
        panic!("{} photos", photos.photos.len());
    };
    assert_eq!((a.name.as_str(), b.name.as_str()), ("a.jpg", "B.jpg"));
    assert_eq!((a.width, a.height, b.width, b.height), (256, 160, 160, 256));
    assert_eq!(
        (a.focal_35mm, a.device.as_str()),
        (Some(26.0), "Made Raw One")
    );
    assert!(a.time_s.is_some());
    // Red grows to the right, blue downward; turned by a quarter, red grows downward.
    let (a, b) = (a.decode().unwrap(), b.decode().unwrap());
    let grows = |from: [u8; 3], to: [u8; 3], c: usize| i32::from(to[c]) - i32::from(from[c]);
    assert!(grows(a.at(20, 80), a.at(230, 80), 0) > 100);
    assert!(grows(a.at(128, 10), a.at(128, 150), 2) > 100);
    assert!(grows(b.at(80, 20), b.at(80, 230), 0) > 100);
    assert_eq!((b.width, b.height), (160, 256));
}

#[test]
fn what_is_no_raw_photo_is_named_with_the_programs_message() {
    if !dcraw() {
        return;
    }
    let place = tempfile::tempdir().unwrap();
    std::fs::write(place.path().join("text.dng"), "no photo").unwrap();
    std::fs::write(place.path().join("cut.dng"), &dng(1)[..5000]).unwrap();
    for name in ["text.dng", "cut.dng"] {
        let why = read(place.path(), &[name]).unwrap_err();
        assert!(
            why.contains(name) && why.contains("is no raw photo"),
            "{why}"
        );
        assert!(!why.contains(&*place.path().to_string_lossy()), "{why}");
    }
    assert!(
        read(place.path(), &[])
            .unwrap_err()
            .contains("photos in turning order: 0")
    );
}
