//! `why`: every cause at once, against the last run of the same, by the names of files.

use super::place::{Place, SMALL};
use serde_json::Value;

/// Node and lines of each cause.
fn causes(place: &Place, args: &str) -> Vec<(String, Vec<String>)> {
    let why = place.run(&format!("why {args} --json")).code(0).json();
    let line = |c: &Value| format!("{}: {} -> {}", c[0], c[1], c[2]).replace('"', "");
    let cause = |c: &Value| {
        let lines = c["changes"].as_array().unwrap().iter().map(line).collect();
        (c["node"].as_str().unwrap().to_owned(), lines)
    };
    why["chain"].as_array().unwrap().iter().map(cause).collect()
}

const TURN: &str = "goal = \"tags\"\n[input.photos]\nfiles = \"*.jpg\"\n\
    [node.photos]\nstage = \"capture.load\"\nfrom = { files = \"@photos\" }\n\
    [node.tags]\nstage = \"pose.tags\"\nfrom = [\"photos\"]\n";

#[test]
fn all_causes_come_at_once_and_files_by_their_names() {
    let place = Place::new();
    place.write("turn.toml", TURN);
    place.photos("turn", 4);
    let of = "turn.toml --input photos=turn";
    place.run(&format!("run {of}")).code(0);
    std::fs::rename(place.path("turn/0003.jpg"), place.path("turn/0009.jpg")).unwrap();
    std::fs::copy(place.path("turn/0001.jpg"), place.path("turn/0002.jpg")).unwrap();
    let reported = causes(&place, &format!("tags {of}"));
    let photos = &reported.iter().find(|c| c.0 == "photos").unwrap().1;
    assert!(photos[0].starts_with("from files: "), "{photos:?}");
    assert!(photos[1].starts_with("file 0002.jpg: "), "{photos:?}");
    assert_eq!(
        photos[2..],
        ["file 0009.jpg: none -> new", "file 0003.jpg: there -> gone"]
    );
    // Two params of two nodes.
    place.run("run small.toml").code(0);
    let reported = causes(
        &place,
        "body small.toml --set solid.stature_mm=1500 --set body.cell_mm=30",
    );
    assert_eq!(reported[0].0, "body");
    assert_eq!(
        reported[1],
        (
            "solid".into(),
            vec!["with stature_mm: 1750.0 -> 1500.0".into()]
        )
    );
}

#[test]
fn the_last_run_is_the_last_of_the_same_and_what_counts_is_now() {
    let place = Place::new();
    let variant = "[variant.fine]\nwith.body = { cell_mm = 30.0 }\n";
    place.write("small.toml", SMALL.to_owned() + variant);
    place.write("other.toml", SMALL.replace("40.0", "45.0"));
    place.run("run small.toml").code(0);
    place.run("run small.toml --variant fine").code(0);
    place.run("run other.toml").code(0);
    // Runs of other pipelines came between: nothing is new for this one.
    let (nothing, as_it_is) = (Vec::<String>::new(), "body small.toml");
    place.run("run small.toml").code(0);
    assert_eq!(
        causes(&place, as_it_is),
        [("body".to_owned(), nothing.clone())]
    );
    let reported = causes(&place, "body other.toml --set body.cell_mm=44");
    assert_eq!(reported[0].1, ["with cell_mm: 45.0 -> 44.0"]);
    // What the last run made, it made for a reason, however many runs ago that was otherwise.
    place.run("run small.toml --set body.cell_mm=35").code(0);
    let set = "body small.toml --set body.cell_mm=35";
    assert_eq!(causes(&place, set)[0].1, ["with cell_mm: 40.0 -> 35.0"]);
    for _ in 0..3 {
        place.run("run small.toml --set body.cell_mm=35").code(0);
    }
    assert_eq!(causes(&place, set)[0].1, nothing, "found by the last run");
    // Back is in the cache, but otherwise than in the last run.
    assert_eq!(
        causes(&place, as_it_is)[0].1,
        ["with cell_mm: 35.0 -> 40.0"]
    );
    let printed = place
        .run("why body small.toml --set body.cell_mm=35")
        .code(0)
        .out;
    assert_eq!(printed, "body: cached, as in the last run\n");
}
