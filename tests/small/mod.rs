//! The sample's photos at half their size, for tests that ask nothing of more pixels: most of what a photo takes is a quarter.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

/// Where the photos are at their own size.
pub(crate) fn sample() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("samples/mannequin")
}

/// Its photos at their own size in turning order, the plate last.
pub(crate) fn photos() -> Vec<PathBuf> {
    let entries = std::fs::read_dir(sample().join("images")).unwrap();
    let mut all: Vec<PathBuf> = entries.map(|e| e.unwrap().path()).collect();
    all.sort();
    all
}

/// A photo of the sample by its name, smaller, with its EXIF: made once for all tests.
pub(crate) fn photo(name: &str) -> Arc<[u8]> {
    static MADE: Mutex<BTreeMap<String, Arc<[u8]>>> = Mutex::new(BTreeMap::new());
    let mut made = MADE.lock().unwrap();
    let halved = || halved(name).into();
    made.entry(name.to_owned()).or_insert_with(halved).clone()
}

fn halved(name: &str) -> Vec<u8> {
    let bytes = std::fs::read(sample().join("images").join(name)).unwrap();
    let exif = exif(&bytes).to_vec();
    let pixels = shape::Photo::of(name, [800, 1200], bytes).decode().unwrap();
    let jpeg = shape::rgb_to_jpeg(&pixels.reduced(2), 92);
    [&jpeg[..2], &exif, &jpeg[2..]].concat()
}

/// Every so manyth photo of the turn and the plate, in a folder: their paths, the plate's last.
pub(crate) fn turn_in(folder: &Path, step: usize) -> Vec<PathBuf> {
    let turn = (0..18).step_by(step).map(|i| format!("{i:04}.jpg"));
    let put = |name: String| {
        let path = folder.join(&name);
        std::fs::write(&path, photo(&name)).unwrap();
        path
    };
    turn.chain(["plate.jpg".to_owned()]).map(put).collect()
}

/// The segment of a JPEG with its EXIF; none is empty.
fn exif(jpeg: &[u8]) -> &[u8] {
    let mut at = 2;
    while let [0xff, kind, high, low, ..] = jpeg[at..] {
        let end = at + 2 + usize::from(u16::from_be_bytes([high, low]));
        match kind {
            0xe1 => return &jpeg[at..end],
            // The picture begins.
            0xda => break,
            _ => at = end,
        }
    }
    &[]
}
