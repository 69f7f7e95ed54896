//! What is known of a capture, given on the command line; and folders as people have them.

use super::place::Place;

const LOAD: &str = "goal = \"photos\"\n[input.files]\nfiles = [\"*.{jpg,png}\", \"capture.toml\"]\n[node.photos]\n\
    stage = \"capture.load\"\nfrom = { files = \"@files\" }\n";

/// A place with `load.toml` and a turn of six photos.
fn turn() -> Place {
    let place = Place::new();
    place.write("load.toml", LOAD);
    place.photos("turn", 6);
    place
}

#[test]
fn facts_are_in_the_key_and_in_the_provenance_and_win_over_the_file() {
    let place = turn();
    place.write("turn/capture.toml", "[subject]\nheight_cm = 165\n");
    let run = |set: &str| {
        let run = place.run(&format!(
            "run load.toml --input files=turn --json --out out {set}"
        ));
        run.code(0).json()["nodes"][0].clone()
    };
    let (plain, printed) = (run(""), run("--set photos.facts.subject.height_cm=178"));
    assert_ne!(plain["key"], printed["key"]);
    assert_ne!(plain["content"], printed["content"]);
    assert!(
        printed["provenance"].to_string().contains("height_cm"),
        "{printed}"
    );
    let reported = std::fs::read_to_string(place.path("out/photos/capture.toml")).unwrap();
    assert!(reported.contains("subject.height_cm = 178.0"), "{reported}");
    // The same content from the file instead is another key, with equal results.
    place.write("turn/capture.toml", "[subject]\nheight_cm = 178\n");
    let file = run("");
    assert_ne!(file["key"], printed["key"]);
    assert_eq!(file["content"], printed["content"]);
}

#[test]
fn flags_that_cannot_be_are_refused_as_they_were_given_before_anything_runs() {
    let place = turn();
    place.write("mat.txt", "a mat, but no word of it");
    for (flags, expected) in [
        ("--stature 1780", "`1780` is not from 10 to 300 cm"),
        ("--stature 1.78", "did you mean 1.78m?"),
        ("--stature tall", "--stature: `tall` is not a length"),
        ("--weight 80cm", "--weight: `80cm` is not a weight"),
        ("--steps 0", "--steps 0"),
        ("--mat-ids 11", "give FIRST-LAST"),
        ("--mat mat.txt", "it describes no mat"),
        ("--mat nowhere.pdf", "nowhere.pdf"),
        ("--fact subject.hight_cm=178", "did you mean `height_cm`"),
        ("--images ../other/*.jpg", "leads out of turn"),
        ("--unit ell", "ell"),
    ] {
        let printed = place.run(&format!("measure turn {flags}")).code(2);
        assert!(printed.err.contains(expected), "{flags}: {}", printed.err);
    }
    assert!(!place.path("cache").exists());
}

#[test]
fn the_folder_of_images_is_taken_and_one_that_is_not_there_is_refused() {
    let place = turn();
    place.write(
        "turn/selfie.jpg",
        std::fs::read(place.path("turn/0005.jpg")).unwrap(),
    );
    place.write("turn/capture.toml", "images = \"000*.jpg\"\nviews = 6\n");
    let run = "run load.toml --input files=turn";
    place.run(run).code(0);
    place.write(
        "turn/capture.toml",
        "images = [\"0003.jpg\", \"0001.jpg\", \"0002.jpg\"]\n",
    );
    place.run(&format!("{run} --out out")).code(0);
    assert!(place.path("out/photos/images/0001.jpg").exists());
    assert!(!place.path("out/photos/images/0004.jpg").exists());
    place.write("turn/capture.toml", "images = \"IMG*.jpg\"\n");
    let printed = place.run(run).code(1).err;
    assert!(
        printed.contains("IMG*.jpg") && printed.contains("0000.jpg"),
        "{printed}"
    );
    place.write("turn/capture.toml", "images = 3\n");
    let printed = place.run(run).code(1).err;
    assert!(
        printed.contains("`images` wants a text or a list of texts"),
        "{printed}"
    );
}

#[test]
fn a_copy_is_left_out_and_sizes_that_differ_are_refused_with_what_to_do() {
    let place = turn();
    place.write(
        "turn/0002 copy.jpg",
        std::fs::read(place.path("turn/0002.jpg")).unwrap(),
    );
    let run = "run load.toml --input files=turn";
    let printed = place.run(run).code(0).err;
    assert!(
        printed.contains("is the same file as") && printed.contains("was left out"),
        "{printed}"
    );
    let selfie = shape::Rgb::filled(30, 40, [9, 99, 200]);
    place.write("turn/selfie.png", shape::rgb_to_png(&selfie));
    let printed = place.run(run).code(1).err;
    for expected in ["6 are 400×600", "selfie.png is 30×40", "--images"] {
        assert!(printed.contains(expected), "{expected}: {printed}");
    }
}

#[test]
fn what_cannot_be_read_is_named_with_the_command_that_converts_it() {
    let place = turn();
    place.write("a/IMG_1.HEIC", "x");
    let printed = place.run("measure a").code(2).err;
    assert!(printed.contains("heif-convert"), "{printed}");
    // Videos and raw photos go to programs, which find that these are none.
    for (file, name) in [("b/walk.MOV", "walk.MOV"), ("c/b.DNG", "b.DNG")] {
        place.write(file, "x");
        let printed = place.run(&format!("measure {}", &file[..1])).code(1).err;
        assert!(printed.contains(name), "{file}: {printed}");
    }
    let printed = place.run("measure nowhere").code(2).err;
    assert!(printed.contains("nowhere"), "{printed}");
    place.photos("few", 3);
    let printed = place.run("measure few").code(2).err;
    for expected in ["few has 3 photos", "18 to 36", "tailor mat", "--step"] {
        assert!(printed.contains(expected), "{expected}: {printed}");
    }
}

#[test]
fn several_folders_are_measured_each_on_its_own() {
    let place = turn();
    place.write("a/walk.HEIC", "x");
    let printed = place.run("measure a nowhere").code(1).err;
    for expected in ["a holds no photo", "nowhere", "2 of 2 captures"] {
        assert!(printed.contains(expected), "{expected}: {printed}");
    }
    let reported = place.run("measure a nowhere --json").code(1).json();
    let folders: Vec<_> = reported
        .as_array()
        .unwrap()
        .iter()
        .map(|t| &t["folder"])
        .collect();
    assert_eq!(folders, ["a", "nowhere"]);
    assert!(
        reported[0]["error"]
            .as_str()
            .unwrap()
            .contains("heif-convert"),
        "{reported}"
    );
    // Each is a row with its reason, on the screen and in files.
    assert!(
        reported[1]["row"]["why"]
            .as_str()
            .unwrap()
            .contains("nowhere"),
        "{reported}"
    );
    let ran = place.run("measure a nowhere --out all").code(1);
    assert!(
        ran.out.contains("heif-convert") || ran.out.contains("a holds no photo"),
        "{}",
        ran.out
    );
    let csv = std::fs::read_to_string(place.path("all/cohort.csv")).unwrap();
    let lines: Vec<&str> = csv.lines().collect();
    assert_eq!(
        lines[0],
        "capture,unit,scale,stature,missing,warnings,trouble"
    );
    assert!(
        lines[1].starts_with("a,,,,,,") && lines[1].contains("holds no photo"),
        "{csv}"
    );
    assert!(lines[2].starts_with("nowhere,,,,,,"), "{csv}");
    let json = std::fs::read(place.path("all/cohort.json")).unwrap();
    let json: serde_json::Value = serde_json::from_slice(&json).unwrap();
    let done: Vec<_> = json["captures"]
        .as_array()
        .unwrap()
        .iter()
        .map(|c| &c["done"])
        .collect();
    assert_eq!(done, [false, false]);
    // Two of one name would overwrite each other.
    place.photos("p1/scan", 3);
    place.photos("p2/scan", 3);
    let printed = place.run("measure p1/scan p2/scan").code(2).err;
    assert!(printed.contains("would both be written to"), "{printed}");
}

#[test]
fn a_mat_tells_of_itself_at_its_foot_and_beside_it() {
    let place = Place::new();
    place
        .run("mat --diameter-mm 450 --rim-mm 40 -o mat.pdf")
        .code(0);
    let print = std::fs::read(place.path("mat.pdf")).unwrap();
    let beside: toml::Table = std::fs::read_to_string(place.path("mat.pdf.toml"))
        .unwrap()
        .parse()
        .unwrap();
    assert_eq!(beside["disk"]["diameter_cm"].as_float(), Some(45.0));
    // Words of the first page, behind what is attached, one a line, from the first table on.
    let text = String::from_utf8_lossy(&print).into_owned();
    let page = text.split("endstream").nth(1).unwrap();
    let words = page
        .lines()
        .filter_map(|l| l.split_once(" Td (")?.1.strip_suffix(") Tj ET"));
    let foot: Vec<&str> = words.skip_while(|w| !w.starts_with('[')).collect();
    let foot: toml::Table = foot.join("\n").parse().unwrap();
    assert_eq!(foot, beside, "the foot is TOML and has the same");
    // It is what a capture reads.
    place.write("load.toml", LOAD);
    place.photos("turn", 6);
    let sets: Vec<String> = beside["mat"]
        .as_table()
        .unwrap()
        .iter()
        .map(|(k, v)| {
            format!(
                "--set photos.facts.mat.{k}={}",
                v.to_string().replace(' ', "")
            )
        })
        .collect();
    place
        .run(&format!(
            "run load.toml --input files=turn {}",
            sets.join(" ")
        ))
        .code(0);
}

#[test]
fn of_more_photos_than_are_of_use_the_sharpest_of_even_stretches_are_taken() {
    let place = turn();
    place.write("turn/capture.toml", "step_deg = 20.0\n");
    let run = "run load.toml --input files=turn --set photos.most=3 --out out";
    let printed = place.run(run).code(0).err;
    assert!(
        printed.contains("6 photos are more than are of use"),
        "{printed}"
    );
    let taken = std::fs::read_dir(place.path("out/photos/images")).unwrap();
    let mut names: Vec<String> = taken
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    assert_eq!(names.len(), 3);
    for (name, pair) in names
        .iter()
        .zip([["0000", "0001"], ["0002", "0003"], ["0004", "0005"]])
    {
        assert!(pair.iter().any(|p| name.starts_with(p)), "{names:?}");
    }
    // Steps between them are no longer even, so none is given.
    let reported = std::fs::read_to_string(place.path("out/photos/capture.toml")).unwrap();
    assert!(!reported.contains("step_deg"), "{reported}");
}
