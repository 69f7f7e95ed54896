//! A first answer comes while the whole is made, and its page says so when the whole does not come.

use crate::place::{Place, signal};
use std::io::{BufRead, BufReader};
use std::path::Path;

#[test]
fn a_first_answer_whose_whole_is_stopped_says_so() {
    let place = Place::new();
    place.photos("turn/images", 18);
    let sample = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples/mannequin");
    for name in ["capture.toml", "images/plate.jpg"] {
        let bytes = std::fs::read(sample.join(name)).unwrap();
        place.write(&format!("turn/{name}"), bytes);
    }
    // The whole must still be under way when its first answer is there.
    let mut child = place.start("measure turn --out out --set body.rounds=60");
    let mut said = BufReader::new(child.stderr.take().unwrap())
        .lines()
        .map(Result::unwrap);
    let mut before = said
        .by_ref()
        .take_while(|l| !l.starts_with("first report:"));
    assert!(
        before.any(|l| l.starts_with("first answer from the coarse surface")),
        "no first answer"
    );
    before.for_each(drop);
    let page = || std::fs::read_to_string(place.path("out/report.html")).unwrap();
    assert!(page().contains("the full one follows"));
    signal(&child, "INT");
    let left: Vec<String> = said.collect();
    assert_eq!(child.wait().unwrap().code(), Some(130), "{left:?}");
    assert!(page().contains("the full one failed or was stopped"));
    assert!(!place.path("out/girths.csv").exists());
}
