//! Programs of others in the product: the shipped pipeline with ffmpeg, kinds that programs may make.

use crate::place::Place;
use std::path::Path;

/// A box of a metre, as PLY.
const CUBE: &str = "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n\
    element face 12\nproperty list uchar int vertex_indices\nend_header\n-100 -100 0\n100 -100 0\n\
    -100 100 0\n100 100 0\n-100 -100 1000\n100 -100 1000\n-100 100 1000\n100 100 1000\n3 0 2 1\n\
    3 1 2 3\n3 4 5 6\n3 5 7 6\n3 0 1 4\n3 1 5 4\n3 2 6 3\n3 3 6 7\n3 0 4 2\n3 2 4 6\n3 1 3 5\n\
    3 3 7 5\n";

/// A turn of photos.
const PHOTOS: &str = "[input.photos]\nfiles = [\"*.jpg\"]\n\
    [node.photos]\nstage = \"capture.load\"\nfrom = { files = \"@photos\" }\n";

#[test]
fn frames_of_a_video_are_taken_by_ffmpeg_at_even_times() {
    if !proof::program("ffmpeg", "ffmpeg") {
        return;
    }
    let place = Place::new();
    place.photos("shots", 6);
    let film = "mkdir film && ffmpeg -v error -framerate 6 -i shots/%04d.jpg -c:v mjpeg -q:v 2 film/turn.avi";
    place.bash(film).code(0);
    let pipeline = Path::new(env!("CARGO_MANIFEST_DIR")).join("pipelines/foreign/ffmpeg.toml");
    let run = |frames: usize| {
        let pipeline = pipeline.display();
        place.run(&format!(
            "run {pipeline} photos --input video=film --set photos.frames={frames} --allow-exec --json"
        ))
    };
    run(3).code(0);
    let (pipeline, set) = (pipeline.display(), "--set photos.frames=3");
    let shown = format!("show photos --pipeline {pipeline} --input video=film {set} -o shown");
    place.run(&shown).code(0);
    let frames = std::fs::read_dir(place.path("shown/images")).unwrap();
    assert_eq!(frames.count(), 3);
    let more = run(7).code(1);
    let told = more.out + &more.err;
    assert!(told.contains("has 6 frames, fewer than 7"), "{told}");
}

#[test]
fn tags_and_tracks_of_a_program_are_taken_and_what_cannot_be_is_told() {
    let place = Place::new();
    place.photos("shots", 3);
    let node = |kind: &str, text: &str| {
        format!(
            "goal = \"{kind}\"\n{PHOTOS}[node.{kind}]\nstage = \"exec\"\nout = \"{kind}\"\nfrom = [\"photos\"]\n\
             command = [\"sh\", \"-c\", 'printf %s \"$2\" > $1', \"sh\", \"{{out}}\", '{}']\n",
            text.replace('{', "{{").replace('}', "}}")
        )
    };
    let seen = |photo: &str| format!(r#"{{"photo":{photo},"at_px":[5,6],"scale_px":2.5}}"#);
    let tags = r#"[{"photo":1,"tags":[{"id":7,"corners":[[1,1],[9,1],[9,9],[1,9]]}]}]"#;
    let tracks = format!("[[{},{}]]", seen(r#""0000.jpg""#), seen("2"));
    for (kind, text, holds) in [
        ("tags", tags, "\"id\": 7"),
        ("tracks", &tracks, "\"scale_px\":2.5"),
    ] {
        place.write("p.toml", node(kind, text));
        place
            .run("run p.toml --input photos=shots --allow-exec")
            .code(0);
        place
            .run(&format!(
                "show {kind} --pipeline p.toml --input photos=shots --as json -o {kind}.json"
            ))
            .code(0);
        let shown = std::fs::read_to_string(place.path(&format!("{kind}.json"))).unwrap();
        assert!(shown.contains(holds), "{shown}");
        place.write(
            "p.toml",
            node(kind, &text.replace("\"photo\":", "\"photo\":1")),
        );
        let told = place
            .run("run p.toml --input photos=shots --allow-exec")
            .code(1);
        assert!(
            told.err.contains("is not JSON") || told.err.contains("is wanted"),
            "{}",
            told.err
        );
    }
}

#[test]
fn landmarks_and_girths_of_a_program_are_taken_and_what_cannot_be_is_told() {
    let place = Place::new();
    place.write("body/cube.ply", CUBE);
    let plane =
        |at: &str, normal: &str| format!(r#""plane":{{"point_mm":[0,0,{at}],"normal":{normal}}}"#);
    let file = |kind: &str, unit: &str, one: &str| {
        format!(r#"{{"unit":"{unit}","{kind}":[{{"name":"WC",{one}}}]}}"#)
    };
    let level = plane("500", "[0,0,1]");
    let mark = |one: &str| file("landmarks", "mm", one);
    let tape = |one: &str| file("girths", "cm", one);
    let good = [
        (
            "landmarks",
            mark(&format!(r#""part":"Trunk",{level}"#)),
            "\"part\": \"Trunk\"",
        ),
        (
            "girths",
            tape(&format!(r#""tape_cm":80,{level}"#)),
            "\"tape_cm\": 80.0",
        ),
    ];
    let bad = [
        ("landmarks", mark(&level), "missing field `part`"),
        (
            "landmarks",
            mark(&format!(r#""part":"Trunk",{}"#, plane("5", "[0,0,0]"))),
            "has no direction",
        ),
        (
            "landmarks",
            file(
                "landmarks",
                "relative",
                &format!(r#""part":"Trunk",{level}"#),
            ),
            "lengths are relative there",
        ),
        (
            "landmarks",
            mark(&format!(
                r#""part":"Trunk","sigma":{{"level_mm":-1}},{level}"#
            )),
            "below 0",
        ),
        ("girths", tape(&level), "has no `tape_cm`"),
        (
            "girths",
            tape(&format!(r#""tape_cm":80,"interval_cm":[81,82],{level}"#)),
            "does not hold its tape",
        ),
        ("girths", tape(r#""tape_cm":80"#), "missing field `plane`"),
    ];
    let write = |kind: &str, text: &str| {
        let text = text.replace('{', "{{").replace('}', "}}");
        place.write(
            "p.toml",
            format!(
                "goal = \"{kind}\"\n[input.surface]\nfiles = \"*.ply\"\n[node.body]\nstage = \"capture.surface\"\n\
                 from = {{ files = \"@surface\" }}\n[node.{kind}]\nstage = \"exec\"\nout = \"{kind}\"\n\
                 from = {{ mesh = \"body\" }}\n\
                 command = [\"sh\", \"-c\", 'printf %s \"$2\" > $1', \"sh\", \"{{out}}\", '{text}', \"{{from.mesh}}\"]\n"
            ),
        );
    };
    for (kind, text, holds) in &good {
        write(kind, text);
        place
            .run("run p.toml --input surface=body --allow-exec")
            .code(0);
        let show =
            format!("show {kind} --pipeline p.toml --input surface=body --as json -o {kind}.json");
        place.run(&show).code(0);
        let shown = std::fs::read_to_string(place.path(&format!("{kind}.json"))).unwrap();
        assert!(shown.contains(holds), "{shown}");
    }
    for (kind, text, why) in &bad {
        write(kind, text);
        let told = place
            .run("run p.toml --input surface=body --allow-exec")
            .code(1);
        assert!(told.err.contains(why), "{why}: {}", told.err);
    }
}
