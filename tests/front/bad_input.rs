//! What is wrong with a user's input is reported, and nothing is lost or half-written.

use super::place::{Place, SMALL};

const LOAD: &str = "goal = \"photos\"\n[input.files]\nfiles = \"*.{jpg,png}\"\n[node.photos]\n\
    stage = \"capture.load\"\nfrom = { files = \"@files\" }\n";

#[test]
fn all_mistakes_of_a_pipeline_come_at_once_each_with_its_place() {
    let place = Place::new();
    let wrong = "goal = [\"sway\", \"bodi\"]\n[input.f]\nfiles = 3\n[node.solid]\nstage = \"synth.sollid\"\n\
        [node.body]\nstage = \"synth.body\"\nfrom = { solid = \"ring\" }\nwith = { cell_mm = 90.0, cel = 1 }\n\
        [node.ring]\nstage = \"synth.ring\"\ncolour = 1\n[node.sway]\nstage = \"synth.sway\"\nfrom = { cameras = \"rng\" }\n\
        [node.\"../up\"]\nstage = \"synth.ring\"\n";
    place.write("wrong.toml", wrong);
    let printed = place.run("check wrong.toml").code(2);
    for (place, what) in [
        (
            "wrong.toml:1:17",
            "there is no node `bodi`; did you mean `body`?",
        ),
        ("wrong.toml:3:9", "a pattern must be a text"),
        ("wrong.toml:5:9", "did you mean `synth.solid`?"),
        (
            "wrong.toml:8:18",
            "port `solid` wants solid, but `ring` makes cameras",
        ),
        ("wrong.toml:9:20", "0.2..=50"),
        ("wrong.toml:9:26", "there is no param `cel`; known: cell_mm"),
        ("wrong.toml:12:1", "there is no key `colour`"),
        ("wrong.toml:15:20", "did you mean `ring`?"),
        ("wrong.toml:16:7", "`../up` is no name"),
    ] {
        assert!(printed.err.contains(what), "{what}: {}", printed.err);
        assert!(printed.err.contains(place), "{place}: {}", printed.err);
    }
    let json = place.run("check wrong.toml --json").code(2).json();
    assert_eq!(json["code"], 2);
    let mistakes = json["mistakes"].as_array().unwrap();
    assert!(mistakes.len() >= 9 && mistakes.iter().all(|m| m["line"].is_u64()));
    place.write("torn.toml", &SMALL[..SMALL.len() / 2]);
    let printed = place.run("run torn.toml").code(2);
    assert!(printed.err.contains("torn.toml:"), "{}", printed.err);
    for (text, expected) in [
        (&b""[..], "name what is wanted"),
        (b"\xff\xfe", "cannot be read"),
    ] {
        place.write("odd.toml", text);
        let printed = place.run("check odd.toml").code(2);
        assert!(printed.err.contains(expected), "{}", printed.err);
    }
    let printed = place.run("run absent.toml").code(2);
    assert!(
        printed.err.contains("absent.toml cannot be read"),
        "{}",
        printed.err
    );
    assert!(
        !place.path("cache").exists(),
        "nothing is made for what cannot run"
    );
}

#[test]
fn the_command_line_is_checked() {
    let place = Place::new();
    place.write("load.toml", LOAD);
    for (args, expected) in [
        ("run small.toml nobody", "there is no node `nobody`"),
        ("run small.toml --variant fast", "variant `fast`"),
        ("run small.toml --set body.cell_mm=x", "wants a number"),
        ("run small.toml --set body.cell_mm=0", "out of range"),
        (
            "run small.toml --input photos=.",
            "there is no input `photos`",
        ),
        ("run load.toml --input files", "give NAME=FOLDER"),
        (
            "run load.toml",
            "`files` is missing: add --input files=FOLDER",
        ),
        ("run load.toml --input files=nowhere", "nowhere"),
        (
            "run load.toml --input files=.",
            "has no file that fits *.{jpg,png}",
        ),
        ("run small.toml --threads 0", "--threads"),
        ("cache gc --max-size lots", "lots"),
        ("cache du --cache nowhere", "there is no cache at nowhere"),
        ("graph small.toml --as png", "dot, mermaid"),
        ("graph small.toml --as svg", "`dot -Tsvg` draws it"),
        (
            "show body --pipeline small.toml -o x.ply",
            "run the pipeline first",
        ),
        ("stages nobody", "nobody"),
    ] {
        let printed = place.run(args).code(2);
        assert!(printed.err.contains(expected), "{args}: {}", printed.err);
    }
    assert!(!place.path("nowhere").exists());
}

/// Runs the sample's photos with one of them spoilt; what it prints.
fn spoilt(spoil: impl Fn(&Place), code: i32) -> String {
    let place = Place::new();
    place.write("load.toml", LOAD);
    place.photos("turn", 4);
    spoil(&place);
    let command = "run load.toml --input files=turn";
    let printed = place.run(command).code(code);
    place.sound();
    assert!(!place.has("photos", "done", "made"));
    // Failures are never kept: with the photo as it was, the same command makes it.
    let _ = std::fs::remove_file(place.path("turn/0002.jpg"));
    place.photos("turn", 4);
    place.run(command).code(0);
    printed.err
}

#[test]
fn a_photo_of_no_byte_or_cut_off_or_of_another_kind_is_named() {
    let names: [fn(&Place); 3] = [
        |p| p.write("turn/0002.jpg", b""),
        |p| {
            let whole = std::fs::read(p.path("turn/0002.jpg")).unwrap();
            p.write("turn/0002.jpg", &whole[..whole.len() / 2]);
        },
        |p| p.write("turn/0002.jpg", b"This is a letter, not a photo."),
    ];
    for spoil in names {
        let printed = spoilt(spoil, 1);
        assert!(
            printed.contains("photos failed") && printed.contains("0002.jpg"),
            "{printed}"
        );
        assert!(printed.contains("to repeat it: "), "{printed}");
    }
}

#[test]
fn photos_of_several_sizes_are_no_turn_but_may_be_a_walk() {
    let place = Place::new();
    place.photos("walk", 6);
    let name = place.path("walk/0002.jpg");
    let upright = image::open(&name).unwrap();
    upright.rotate90().save(&name).unwrap();
    let printed = place.run("run body --input photos=walk photos").code(1);
    for expected in ["5 are 400×600", "0002.jpg is 600×400", "--walk"] {
        assert!(
            printed.err.contains(expected),
            "{expected}: {}",
            printed.err
        );
    }
    let printed = place.run("run walk --input photos=walk photos").code(0);
    assert!(!printed.err.contains("warning"), "{}", printed.err);
}

#[test]
fn a_photo_that_cannot_be_read_is_named() {
    let dangling = |p: &Place| {
        std::fs::remove_file(p.path("turn/0002.jpg")).unwrap();
        std::os::unix::fs::symlink("gone.jpg", p.path("turn/0002.jpg")).unwrap();
    };
    let printed = spoilt(dangling, 2);
    assert!(
        printed.contains("input `files`") && printed.contains("0002.jpg"),
        "{printed}"
    );
}

#[test]
fn a_full_disk_is_reported_and_what_is_half_written_is_nowhere() {
    let place = Place::new();
    let command = "run small.toml --set body.cell_mm=12 --out out";
    let printed = place.run_limited(16, command).code(1);
    assert!(
        printed.err.contains("body failed") && printed.err.contains("free space"),
        "{}",
        printed.err
    );
    place.sound();
    assert!(!place.path("out").exists());
    // The cache has it, and the folder for the results takes no more.
    place.run("run small.toml --set body.cell_mm=12").code(0);
    let printed = place.run_limited(16, command).code(1);
    assert!(printed.err.contains("body.ply"), "{}", printed.err);
    for left in std::fs::read_dir(place.path("out")).unwrap() {
        let name = left.unwrap().file_name().into_string().unwrap();
        assert!(
            ["run.json", "sway.artifact"].contains(&&*name),
            "{name}: what is there is whole"
        );
    }
    place.run(command).code(0);
    assert!(place.path("out/body.ply").exists());
}

#[test]
fn a_cache_that_cannot_be_made_or_is_of_another_layout_is_refused() {
    let place = Place::new();
    place.write("a-file", b"not a folder");
    for cache in ["a-file", "a-file/below"] {
        let printed = place
            .run(&format!("run small.toml --cache {cache}"))
            .code(2);
        assert!(
            printed.err.contains("give another with --cache"),
            "{}",
            printed.err
        );
    }
    place.run("run small.toml").code(0);
    place.write("cache/format", "tailor store 99\n");
    for command in ["run small.toml", "plan small.toml", "cache gc --max-size 0"] {
        let printed = place.run(command).code(2);
        assert!(
            printed.err.contains("another layout (tailor store 99)"),
            "{}",
            printed.err
        );
    }
    place.write("cache/format", "tailor store 1\n");
    let run = place.run("run small.toml --json").code(0).json();
    let nodes = run["nodes"].as_array().unwrap();
    assert!(
        nodes.iter().all(|n| n["status"] == "found"),
        "nothing was lost"
    );
}
