//! Masks from elsewhere: named, sized and the right way around, or a sentence with what is wrong.

use shape::{Mask, Masks, Photo, PhotoId, Photos, Rgb, gray_to_png, rgb_to_png};
use silhouette::{Body, Import, ImportInput, ImportParams};
use stage::{Ctx, FileEntry, Files, Stage, Stop, hash};
use std::sync::Arc;

fn photos(count: usize) -> Photos {
    let photo = |i: usize| {
        Photo::of(
            format!("{i:04}.jpg"),
            [40, 60],
            rgb_to_png(&Rgb::filled(40, 60, [90; 3])),
        )
    };
    Photos {
        photos: (0..count).map(photo).collect(),
        ..Photos::default()
    }
}

/// A body in the middle of the photo, in a shade on another.
fn mask(body: u8, ground: u8) -> Mask {
    let mut mask = Mask::filled(40, 60, ground);
    for y in 10..55 {
        (12..30).for_each(|x| *mask.at_mut(x, y) = body);
    }
    mask
}

/// What comes of files with these names and contents.
fn import(files: &[(&str, Vec<u8>)], count: usize, body: Body) -> Result<Masks, String> {
    let folder = tempfile::tempdir().unwrap();
    let mut entries = Vec::new();
    for (name, bytes) in files {
        std::fs::write(folder.path().join(name), bytes).unwrap();
        entries.push(FileEntry {
            name: (*name).into(),
            content: hash(bytes),
            size: bytes.len() as u64,
        });
    }
    let files = Files {
        root: folder.path().into(),
        entries,
    };
    let input = ImportInput {
        files: Arc::new(files),
        photos: Arc::new(photos(count)),
    };
    Import::run(&ImportParams { body }, input, &Ctx::alone()).map_err(|stop| match stop {
        Stop::Failed(why) => why.to_string(),
        Stop::Cancelled => "cancelled".into(),
    })
}

#[test]
fn either_polarity_gives_the_same_masks() {
    let file = |body, ground| gray_to_png(&mask(body, ground));
    let white = import(
        &[("0000.png", file(255, 0)), ("0001_mask.png", file(255, 0))],
        2,
        Body::Auto,
    )
    .unwrap();
    let black = import(
        &[("0000.jpg.png", file(0, 255)), ("0001.png", file(0, 255))],
        2,
        Body::Auto,
    )
    .unwrap();
    assert_eq!(white, black);
    assert_eq!(white.views.get(PhotoId(1)), Some(&mask(255, 0).into()));
    let reported = import(&[("0000.png", file(0, 255))], 1, Body::White).unwrap();
    assert_eq!(reported.views.get(PhotoId(0)), Some(&mask(0, 255).into()));
}

#[test]
fn a_photo_without_a_mask_is_left_out() {
    let masks = import(&[("0001.png", gray_to_png(&mask(255, 0)))], 3, Body::Auto).unwrap();
    assert_eq!(masks.views.len(), 1);
}

#[test]
fn what_is_wrong_is_reported_with_the_files_name() {
    let good = gray_to_png(&mask(255, 0));
    let refused_with = |files: &[(&str, Vec<u8>)], words: &[&str]| {
        let error = import(files, 2, Body::Auto).unwrap_err();
        assert!(words.iter().all(|w| error.contains(w)), "{error}");
    };
    refused_with(&[("a.png", good.clone())], &["0000.png", "named"]);
    refused_with(
        &[("0000.png", gray_to_png(&Mask::filled(40, 60, 0)))],
        &["0000.png", "all black"],
    );
    refused_with(
        &[("0000.png", gray_to_png(&Mask::filled(40, 60, 255)))],
        &["0000.png", "all white"],
    );
    refused_with(
        &[("0001.png", gray_to_png(&Mask::filled(20, 30, 0)))],
        &["0001.png", "20×30", "40×60"],
    );
    refused_with(
        &[("0000.png", b"no image".to_vec())],
        &["0000.png", "cannot be read"],
    );
    refused_with(
        &[("0000.png", good.clone()), ("0000_mask.png", good.clone())],
        &["0000_mask.png", "keep one"],
    );
    let three = [
        ("0000.png", good.clone()),
        ("0001.png", gray_to_png(&mask(0, 255))),
    ];
    refused_with(&three, &["0001.png", "inverted"]);
}
