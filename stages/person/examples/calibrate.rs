//! How often what the network calls body, with such log-odds, is body: for `models/person/calibrate.py`.
//!
//! `cargo run --release -p person --features tables --example calibrate -- PHOTOS MASKS [PHOTOS MASKS]...` prints a line of JSON a pair of folders:
//! by step of log-odds (sixteenths of a nat, -127 to 127), how many pixels of all photos are background, and how many body.

use person::Networks;
use shape::Rgb;
use std::error::Error;
use std::path::{Path, PathBuf};

/// Every so many-th pixel of rows and columns is counted.
const STEP: usize = 3;

fn main() -> Result<(), Box<dyn Error>> {
    let networks = Networks::built_in()?;
    let folders: Vec<PathBuf> = std::env::args().skip(1).map(PathBuf::from).collect();
    for pair in folders.chunks(2) {
        let [photos, masks] = pair else {
            return Err("give pairs of folders: photos and their true masks".into());
        };
        let mut counts = vec![[0u64; 2]; 255];
        for path in files(photos)? {
            let mask = masks.join(path.file_name().unwrap_or_default());
            let mask = mask.with_extension("png");
            if mask.exists() {
                count(&networks, &decoded(&path)?, &decoded(&mask)?, &mut counts);
            }
        }
        let rows: Vec<String> = counts.iter().map(|[b, f]| format!("[{b},{f}]")).collect();
        println!(
            "{{\"photos\": {photos:?}, \"counts\": [{}]}}",
            rows.join(",")
        );
    }
    Ok(())
}

/// The photos of a folder, by name.
fn files(folder: &Path) -> Result<Vec<PathBuf>, Box<dyn Error>> {
    let all = std::fs::read_dir(folder)?.map(|entry| Ok(entry?.path()));
    let mut all = all.collect::<Result<Vec<_>, std::io::Error>>()?;
    all.sort();
    Ok(all)
}

fn decoded(path: &Path) -> Result<Rgb, Box<dyn Error>> {
    let rgb = image::open(path)?.into_rgb8();
    let (width, height) = (rgb.width() as usize, rgb.height() as usize);
    Ok(Rgb {
        width,
        height,
        data: rgb.pixels().map(|p| p.0).collect(),
    })
}

fn count(networks: &Networks, photo: &Rgb, mask: &Rgb, counts: &mut [[u64; 2]]) {
    let people = networks.people(photo);
    let Some(found) = people.first() else {
        return;
    };
    for y in (0..photo.height).step_by(STEP) {
        for x in (0..photo.width).step_by(STEP) {
            let at = nalgebra::Point2::new(x as f64, y as f64);
            if let Some(odds) = found.log_odds(at) {
                let bin = (i32::from(shape::Found::kept(odds)) + 127) as usize;
                let body = mask.at(x, y)[1] > 127;
                counts[bin.min(254)][usize::from(body)] += 1;
            }
        }
    }
}
