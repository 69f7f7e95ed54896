//! Nothing that who measures people reads is English where German is asked for.

use super::place::{Place, Printed};

/// The same line in English, and as `german` has it.
fn both(place: &Place, line: &str, german: &str) -> [Printed; 2] {
    let tailor = env!("CARGO_BIN_EXE_tailor");
    let bash = |env: &str| place.bash(&format!("LC_ALL= {env} {tailor} {line}"));
    match german {
        "LANG" => ["LANG=C", "LANG=de_DE.UTF-8"].map(bash),
        flag => [place.run(line), place.run(&format!("{line} {flag}"))],
    }
}

#[test]
fn what_doctor_prints_has_no_line_in_german_that_is_english() {
    let place = Place::sharing();
    let bad = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("samples/bad");
    let mut seen = 0;
    for folder in ["moving-light", "feet-cut-off", "empty-photo"] {
        let folder = bad.join(folder);
        for more in [
            "",
            "--turning --mat-tag 60 --stature 178",
            "--plate 0007.jpg",
        ] {
            let line = format!("doctor {} {more}", folder.display());
            let [english, german] = both(&place, &line, "--lang de").map(|printed| printed.out);
            let lines = |text: &str| text.lines().map(str::to_owned).collect::<Vec<_>>();
            let (english, german) = (lines(&english), lines(&german));
            assert_eq!(english.len(), german.len(), "{english:#?} {german:#?}");
            let same = german
                .iter()
                .filter(|line| !line.is_empty() && english.contains(line));
            assert_eq!(same.collect::<Vec<_>>(), [""; 0], "{german:#?}");
            seen += german.len();
        }
    }
    assert!(seen > 60, "{seen}");
    let line = format!("doctor {}", bad.join("moving-light").display());
    let [english, german] = both(&place, &line, "LANG");
    assert_ne!(english.out, german.out);
}

/// Folders and files of which nothing will come, and one of which something may.
fn folders() -> Place {
    let place = Place::new();
    place.photos("turn", 9);
    place.photos("two", 2);
    place.photos("mine", 9);
    for file in ["raw/a.webp", "text.txt", "empty/notes.txt", "mat.txt"] {
        place.write(file, "x");
    }
    place.write("bare/0000.jpg", "x");
    place.photos("masked", 4);
    place.write("masked/masks/other.png", "x");
    place.write("torn.ply", "x");
    let cloud = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
    let cloud = format!(
        "{cloud}element face 0\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n"
    );
    place.write("cloud.ply", cloud);
    place.photos("many", 9);
    place.write("many/a\nb.jpg", "x");
    place.write("mine/capture.toml", "");
    place.write("viewless/cameras.json", "{}");
    place.write("relative/girths.json", r#"{ "unit": "relative" }"#);
    for (at, known) in MISTAKES.iter().enumerate() {
        let folder = format!("known/{at}");
        place.photos(&folder, 9);
        place.write(&format!("{folder}/capture.toml"), known);
    }
    place
}

/// What may be wrong in a `capture.toml`.
const MISTAKES: [&str; 18] = [
    "step_deg = \"twenty\"",
    "plate = 5",
    "images = [5]",
    "camera = 5",
    "camera.centre_px = [1]",
    "date = \"2026-02-30\"",
    "reference.kind = \"points\"",
    "reference = { kind = \"points\", length_mm = 297 }",
    "reference = { kind = \"a\", length_mm = 297, seen.a = [1, 2, 3, 4] }",
    "reference = { kind = \"points\", length_mm = 297, seen.a = [1, 2, 3] }",
    "mat = { family = \"tag16h5\", count = 3, tag_size_mm = 60, ring_radius_mm = 187 }",
    "mat = { ids = [9, 3], tag_size_mm = 60, ring_radius_mm = 187 }",
    "mat = { ids = [0, 9], count = 3, tag_size_mm = 60, ring_radius_mm = 187 }",
    "mat = { count = 3, tag_size_mm = 60 }",
    "rim = { count = 3, tag_size_mm = 24 }",
    "rim = { count = 3, tag_size_mm = 24 }\nmat = { count = 3, tag_size_mm = 60, ring_radius_mm = 187 }",
    "subject.sex = \"f\"",
    "subject = { born = \"2016-05-01\", age_years = 9 }",
];

/// Values that are none.
const FLAGS: [&str; 21] = [
    "--stature tall",
    "--stature 1.76",
    "--weight heavy",
    "--weight 560",
    "--age old",
    "--age 200",
    "--views some",
    "--focal wide",
    "--steps 0",
    "--mat-ids 5",
    "--rim-ids 9-3",
    "--centre-px 5",
    "--reference 5",
    "--reference tag_size=wide",
    "--seen here",
    "--seen a=1,2,3,4 --seen a=1,2,3,4",
    "--fact here",
    "--images ../*.jpg",
    "--video",
    "--mat none.pdf",
    "--mat mat.txt",
];

/// What may be wrong in a `--set`.
const SETS: [&str; 13] = [
    "foo",
    "nope.x=3",
    "hul.voxel_mm=3",
    "hull.x=3",
    "hull.voxel_mm=tall",
    "hull.voxel_mm=-4",
    "hull.memory_mb=0.5",
    "photos.stop=[1]",
    "params.foo=3",
    "girths.girth.mine=3",
    "girths.girth.mine.part=3",
    "girths.girth.mine.foo=3",
    "photos.facts=3",
];

/// What may be wrong of places, runs and sides.
const LINES: [&str; 25] = [
    "measure turn --out mine",
    "measure turn --out turn/below",
    "measure turn --out text.txt",
    "measure turn --cache text.txt",
    "measure turn --cache mine",
    "measure turn/../many",
    "measure masked",
    "measure cloud.ply",
    "measure torn.ply",
    "measure turn two --profile p.json",
    "measure turn/0000.jpg turn/0001.jpg",
    "measure turn turn --out one",
    "measure empty empty/../raw --out one",
    "compare turn",
    "compare turn empty",
    "compare nowhere elsewhere",
    "compare last~999 turn",
    "compare turn turn --replicate 2",
    "compare body as-is nothing",
    "compare body as-is quick=2",
    "score turn --truth turn --require WC",
    "score turn --truth turn --require WC=1",
    "score turn --truth turn --require-surface WC=1",
    "score viewless --truth viewless",
    "score relative --truth turn",
];

#[test]
fn no_error_that_who_measures_meets_is_the_same_in_german() {
    let place = folders();
    let given = FLAGS.map(|flag| format!("turn {flag}"));
    let folders = [
        "nowhere",
        "text.txt",
        "empty",
        "raw",
        "turn/0000.jpg",
        "two",
        "bare",
    ]
    .map(str::to_owned);
    let looked = given.into_iter().chain(folders).flat_map(|words| {
        let verbs = ["measure", "doctor"];
        verbs.map(|verb| (format!("{verb} {words}"), "--lang de"))
    });
    let out = |line: &str| (line.to_owned(), "--lang de");
    let sets = SETS.map(|set| (format!("measure turn --set {set}"), "--lang de"));
    let known = (0..MISTAKES.len()).map(|at| format!("measure known/{at}"));
    let known = known.map(|line| (line, "--lang de"));
    let verbs = [
        "init turn/0000.jpg",
        "init mine",
        "mat --diameter-mm 600 -o mat.png",
        "mat --diameter-mm 300 --tag-mm 100 --count 16 -o mat.svg",
        "mat --diameter-mm 600 --first-id 580 -o mat.svg",
        "mat --diameter-mm 600 --rim-mm 30 --rim-tag-mm 29 -o mat.svg",
        "mat --diameter-mm 600 --rim-mm 30 --rim-count 200 -o mat.svg",
    ];
    let verbs = verbs.map(|line| (line.to_owned(), "LANG"));
    for (line, german) in looked
        .chain(LINES.map(out))
        .chain(sets)
        .chain(known)
        .chain(verbs)
    {
        let [english, german] = both(&place, &line, german).map(|printed| printed.err);
        // Names of folders and nodes are the same.
        let sentence = |line: &&str| line.split_whitespace().count() > 2;
        let english = english.replace(" failed: ", ": ");
        let english: Vec<&str> = english.lines().filter(sentence).collect();
        let german: Vec<&str> = german.lines().filter(sentence).collect();
        let same = german.iter().find(|line| english.contains(line));
        assert!(
            same.is_none() && !english.is_empty() && !german.is_empty(),
            "{line}: {english:#?} {german:#?}"
        );
    }
}

#[test]
fn compare_and_score_print_german() {
    let place = Place::new();
    place.run("run small.toml --out one").code(0);
    place
        .run("run small.toml --out two --set body.cell_mm=50")
        .code(0);
    place.photos("turn", 2);
    for line in ["compare one two", "score turn --truth turn"] {
        let [english, german] = both(&place, line, "--lang de").map(|printed| printed.out);
        let words = |line: &&str| line.contains(|c: char| c.is_alphabetic());
        let same = |line: &&str| german.contains(line) && !line.contains("cell_mm");
        // Nodes have their names in every language.
        let same: Vec<&str> = english.lines().filter(words).filter(same).collect();
        let nodes = same.iter().filter(|line| line.starts_with("| "));
        assert_eq!(nodes.count(), same.len(), "{line}: {same:#?} {german}");
        assert_ne!(english, german);
    }
}
