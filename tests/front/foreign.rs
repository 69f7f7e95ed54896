//! Foreign programs in the product: the shipped pipeline with ffmpeg, kinds that programs may make.

use super::place::Place;
use std::path::Path;

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
    let reported = more.out + &more.err;
    assert!(
        reported.contains("has 6 frames, fewer than 7"),
        "{reported}"
    );
}

#[test]
fn tags_and_tracks_of_a_program_are_taken_and_what_cannot_be_is_refused() {
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
        let reported = place
            .run("run p.toml --input photos=shots --allow-exec")
            .code(1);
        assert!(
            reported.err.contains("is not JSON") || reported.err.contains("is wanted"),
            "{}",
            reported.err
        );
    }
}

const ONE: &str = "goal = \"x\"\n[node.x]\nstage = \"exec\"\nout = \"document\"\n\
    command = [\"sh\", \"-c\", \"echo ran > $0/x.txt\", \"{out}\"]\n";

#[test]
fn a_cache_that_came_with_a_pipeline_permits_nothing() {
    let (theirs, ours) = (Place::new(), Place::new());
    theirs.write("p.toml", ONE);
    theirs.run("run p.toml --allow-exec").code(0);
    theirs.run("run p.toml").code(0);
    // All that they have: their results, what earlier versions wrote as permission, their folder of state.
    std::fs::create_dir(theirs.path("cache/allowed")).unwrap();
    let copy = format!(
        "cp -a {0}/p.toml {0}/cache .; mkdir -p cache/state; cp -a {0}/state/. cache/state",
        theirs.path("").display()
    );
    ours.bash(&copy).code(0);
    let reported = ours.run("run p.toml").code(2).err;
    assert!(
        reported.contains("that you have not allowed") && reported.contains("--allow-exec"),
        "{reported}"
    );
    assert!(
        reported.contains("cache/allowed is no longer read"),
        "{reported}"
    );
    ours.run("run p.toml --allow-exec").code(0);
    ours.run("run p.toml").code(0);
}

#[test]
fn no_program_runs_without_a_sandbox_where_one_is_required() {
    let place = Place::new();
    place.write("p.toml", ONE);
    let run = |words: &str| {
        let exe = env!("CARGO_BIN_EXE_tailor");
        place.bash(&format!(
            "PATH=/no/such/folder exec {exe} run p.toml --allow-exec {words}"
        ))
    };
    let reported = run("--sandbox required").code(2).err;
    assert!(
        reported.contains("`bwrap`) is not installed") && reported.contains("--sandbox required"),
        "{reported}"
    );
    assert!(
        !place.path("cache/exec").exists()
            || std::fs::read_dir(place.path("cache/exec")).unwrap().count() == 0
    );
}
