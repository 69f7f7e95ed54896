//! Landmarks and girths that foreign programs found: taken, or refused with a reason.

use super::place::Place;

/// A box of a metre, as PLY.
const CUBE: &str = "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n\
    element face 12\nproperty list uchar int vertex_indices\nend_header\n-100 -100 0\n100 -100 0\n\
    -100 100 0\n100 100 0\n-100 -100 1000\n100 -100 1000\n-100 100 1000\n100 100 1000\n3 0 2 1\n\
    3 1 2 3\n3 4 5 6\n3 5 7 6\n3 0 1 4\n3 1 5 4\n3 2 6 3\n3 3 6 7\n3 0 4 2\n3 2 4 6\n3 1 3 5\n\
    3 3 7 5\n";

/// Kind, file, and the message about it.
type Case = (&'static str, String, &'static str);

/// What is taken, and what the file shows that is written again; what is not, and why.
fn cases() -> (Vec<Case>, Vec<Case>) {
    let plane =
        |at: &str, normal: &str| format!(r#""plane":{{"point_mm":[0,0,{at}],"normal":{normal}}}"#);
    let file = |kind: &str, unit: &str, one: &str| {
        format!(r#"{{"unit":"{unit}","{kind}":[{{"name":"WC",{one}}}]}}"#)
    };
    let level = plane("500", "[0,0,1]");
    let mark = |one: &str| file("landmarks", "mm", one);
    let tape = |one: &str| file("girths", "cm", one);
    let good = vec![
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
        // The mean of both arms is written without a plane, and again from them.
        (
            "girths",
            format!(
                r#"{{"unit":"cm","girths":[{{"name":"AC_L","tape_cm":30,{level}}},{{"name":"AC_R","tape_cm":31,{level}}},{{"name":"AC","tape_cm":30.5}}]}}"#
            ),
            "\"tape_cm\": 30.5",
        ),
    ];
    let bad = vec![
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
    (good, bad)
}

/// A pipeline whose program writes this text.
fn pipeline(kind: &str, text: &str) -> String {
    let text = text.replace('{', "{{").replace('}', "}}");
    format!(
        "goal = \"{kind}\"\n[input.surface]\nfiles = \"*.ply\"\n[node.body]\nstage = \"capture.surface\"\n\
                 from = {{ files = \"@surface\" }}\n[node.{kind}]\nstage = \"exec\"\nout = \"{kind}\"\n\
                 from = {{ mesh = \"body\" }}\n\
                 command = [\"sh\", \"-c\", 'printf %s \"$2\" > $1', \"sh\", \"{{out}}\", '{text}', \"{{from.mesh}}\"]\n"
    )
}

#[test]
fn landmarks_and_girths_of_a_program_are_taken_and_what_cannot_be_is_refused() {
    let place = Place::new();
    place.write("body/cube.ply", CUBE);
    let (good, bad) = cases();
    let write = |kind: &str, text: &str| place.write("p.toml", pipeline(kind, text));
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
        let reported = place
            .run("run p.toml --input surface=body --allow-exec")
            .code(1);
        assert!(reported.err.contains(why), "{why}: {}", reported.err);
    }
}
