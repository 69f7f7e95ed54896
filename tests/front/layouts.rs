//! Every layout of a folder that docs/captures.md names: `init` writes a file by which `doctor` and `measure` read
//! the same photos and the same plate.

use super::place::Place;
use image::DynamicImage;
use std::path::Path;
use std::sync::LazyLock;

/// A line of the table: patterns of files, and the flags.
type Layout = (Vec<String>, Vec<String>);

/// What is in backticks.
fn quoted(cell: &str) -> Vec<String> {
    let parts = cell.split('`').skip(1).step_by(2);
    parts.map(str::to_owned).collect()
}

/// The lines of the table.
fn layouts() -> Vec<Layout> {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/captures.md");
    let text = std::fs::read_to_string(page).unwrap();
    let (_, table) = text
        .split_once("| files | what to say |\n|---|---|\n")
        .unwrap();
    let lines = table.lines().take_while(|line| line.starts_with("| "));
    let line = |line: &str| {
        let cells: Vec<&str> = line.split(" |").collect();
        (quoted(cells[0]), quoted(cells[1]))
    };
    lines.map(line).collect()
}

/// How many photos a layout is given: as few as there are patterns and more than carve a body.
const COUNT: usize = 4;

/// Photos of the sample so small that nothing but reading them takes time, and its plate.
static SMALL: LazyLock<(Vec<DynamicImage>, DynamicImage)> = LazyLock::new(|| {
    let sample = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples/mannequin/images");
    let small = |name: &str| image::open(sample.join(name)).unwrap().thumbnail(64, 96);
    let photos = (0..COUNT).map(|i| small(&format!("{i:04}.jpg")));
    (photos.collect(), small("plate.jpg"))
});

/// Small photos of the sample, named by the patterns, and how many plates are among them.
fn lay_out(place: &Place, folder: &str, patterns: &[String]) -> usize {
    let put = |photo: &DynamicImage, to: &str| {
        let path = place.path(folder).join(to);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        photo.save(path).unwrap();
    };
    let (photos, plate) = &*SMALL;
    let names: Vec<&str> = patterns.iter().map(|p| &p["DIR/".len()..]).collect();
    let (turn, plates): (Vec<&str>, Vec<&str>) = names.into_iter().partition(|n| n.contains('*'));
    for i in 0..COUNT {
        let pattern = turn[i * turn.len() / COUNT];
        put(&photos[i], &pattern.replace('*', &format!("IMG_{i}")));
    }
    plates.iter().for_each(|name| put(plate, name));
    plates.len()
}

#[test]
fn init_doctor_and_measure_read_every_layout_of_the_docs() {
    let place = Place::new();
    let layouts = layouts();
    assert!(layouts.len() > 10, "{layouts:?}");
    for (at, (patterns, words)) in layouts.iter().enumerate() {
        let words = match words.is_empty() {
            true => vec![String::new()],
            false => words.clone(),
        };
        for (way, words) in words.iter().enumerate() {
            let folder = format!("turn-{at}-{way}");
            let plates = lay_out(&place, &folder, patterns);
            let reported = format!("{patterns:?} {words}");
            // What was given for the folder is in the file from here on.
            place.run(&format!("init {folder} {words}")).code(0);
            let file = std::fs::read_to_string(place.path(&folder).join("capture.toml")).unwrap();
            let reported = format!("{reported}\n{file}");
            let seen = place.run(&format!("doctor {folder} --json"));
            let found = || seen.out.clone() + &seen.err;
            assert!(!found().contains("photos failed"), "{reported}{}", found());
            let seen = seen.json();
            assert_eq!(seen["photos"], COUNT, "{reported}{seen}");
            assert_eq!(seen["plate"].is_string(), plates == 1, "{reported}{seen}");
            // Photos so small have no cameras; that they were read is what matters here.
            // So few are taken where their step is given.
            let run = place.run(&format!(
                "measure {folder} --step 20 --fast --set photos.stop=false"
            ));
            assert!(!run.err.contains("photos failed"), "{reported}{}", run.err);
        }
    }
    // None of them failed before its photos were read.
    let made = place.events();
    let read = made
        .iter()
        .filter(|e| e["node"] == "photos" && e["event"] == "done");
    assert!(read.clone().all(|e| e["status"] != "failed"), "{made:?}");
    assert!(read.count() >= layouts.len());
}

#[test]
fn a_plate_that_is_not_there_is_refused_with_those_that_are() {
    let place = Place::new();
    lay_out(
        &place,
        "turn",
        &["DIR/images/*.jpg", "DIR/images/plate.jpg"].map(str::to_owned),
    );
    for named in ["plate.png", "room/plate.jpg", "palte.jpg"] {
        let printed = place.run(&format!("doctor turn --plate {named}")).code(1);
        for expected in [named, "images/plate.jpg"] {
            assert!(
                printed.err.contains(expected),
                "{expected}: {}",
                printed.err
            );
        }
    }
}
