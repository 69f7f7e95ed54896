//! Words for mistakes: all at once, each where it was made; words for one thing and for many.

use super::place::{Place, SMALL};

#[test]
fn open_ports_are_reported_with_the_other_mistakes() {
    let place = Place::new();
    let wrong = "goal = [\"a\", \"b\", \"c\"]\n[node.solid]\nstage = \"synth.solid\"\nwith = { stature = 1 }\n\
        [node.a]\nstage = \"synth.body\"\n[node.b]\nstage = \"synth.sway\"\nfrom = []\n\
        [node.c]\nstage = \"synth.body\"\nfrom = { solid = \"nobody\" }\n";
    place.write("wrong.toml", wrong);
    let printed = place.run("check wrong.toml").code(2).err;
    for what in [
        "node `a`: port `solid` wants solid",
        "node `b`: port `cameras` wants cameras",
        "there is no node `nobody`",
        "there is no param `stature`",
    ] {
        assert!(printed.contains(what), "{what}: {printed}");
    }
    assert!(!printed.contains("node `c`"), "printed already: {printed}");
}

#[test]
fn what_the_command_line_sets_is_not_looked_for_in_the_file() {
    let place = Place::new();
    for (args, expected) in [
        (
            "run small.toml --set body.cell_mm=0",
            "`--set body.cell_mm=0`: ",
        ),
        ("run small.toml --set body.cel=1", "`--set body.cel=1`: "),
        (
            "run small.toml --set solid.veiws=3 --set body.cell_mm=x",
            "`--set body.cell_mm=x`: ",
        ),
        (
            "run small.toml --input p=.",
            "`--input p`: there is no input `p`",
        ),
        (
            "sweep small.toml --sweep body.cell_mm=0,1",
            "`--sweep body.cell_mm=0`: ",
        ),
        (
            "sweep small.toml --sweep body.cell_mm=10..20",
            "body.cell_mm=10..20/5 is five",
        ),
    ] {
        let printed = place.run(args).code(2).err;
        assert!(printed.contains(expected), "{args}: {printed}");
        assert!(!printed.contains("--> small.toml"), "{args}: {printed}");
    }
}

#[test]
fn names_of_girths_that_are_taken_are_refused_before_anything_runs() {
    let place = Place::new();
    let own = |name: &str, part: &str| format!("[girth.{name}]\npart = \"{part}\"\nat = 0.4\n");
    for (girths, expected) in [
        (own("WC", "trunk"), "`girth.WC` is taken"),
        (own("TC", "thigh"), "`girth.TC` is taken: TC_L is a girth"),
        (
            own("thigh2", "thigh") + &own("thigh2_L", "trunk"),
            "`girth.thigh2` is taken: a side of `[girth.thigh2_L]`",
        ),
    ] {
        place.write("own.toml", format!("extends = \"body\"\n{girths}"));
        let printed = place.run("check own.toml").code(2).err;
        assert!(
            printed.contains(expected) && printed.contains("own.toml:2:"),
            "{printed}"
        );
    }
    place.write(
        "own.toml",
        format!("extends = \"body\"\n{}", own("thigh2", "thigh")),
    );
    place.run("check own.toml").code(0);
    let set = "landmarks.girth.NC.part=trunk --set landmarks.girth.NC.at=0.9";
    let printed = place.run(&format!("plan body --set {set}")).code(2).err;
    assert!(printed.contains("`girth.NC` is taken"), "{printed}");
    let printed = place.run("plan body --set hull.voxel=2").code(2).err;
    assert!(printed.contains("did you mean `voxel_mm`"), "{printed}");
}

#[test]
fn both_places_of_a_duplicate_are_named() {
    let place = Place::new();
    for (more, line) in [
        ("with = { cell_mm = 40.0 }\nwith = { cell_mm = 1.0 }\n", 8),
        ("[node.solid]\nstage = \"synth.solid\"\n", 3),
    ] {
        let text = SMALL.replace("with = { cell_mm = 40.0 }\n", more);
        place.write("twice.toml", text);
        let printed = place.run("check twice.toml").code(2).err;
        assert!(
            printed.contains(&format!("the first is in line {line}")),
            "{printed}"
        );
    }
}

#[test]
fn what_is_missing_or_leads_out_is_named() {
    let place = Place::new();
    let turn = "goal = \"photos\"\n[input.photos]\nfiles = \"*.jpg\"\n[node.photos]\n\
        stage = \"capture.load\"\nfrom = { files = \"@photos\" }\n";
    place.write("turn.toml", turn);
    for args in ["run turn.toml --input photos=no/where", "measure no/where"] {
        let printed = place.run(args).code(2).err;
        assert!(printed.contains("no/where"), "{printed}");
    }
    for files in [
        "../../../etc/passwd",
        "/etc/passwd",
        "a/../../b",
        "{x,..}/y",
    ] {
        place.write("out.toml", turn.replace("*.jpg", files));
        for verb in ["check out.toml", "run out.toml --input photos=."] {
            let printed = place.run(verb).code(2).err;
            assert!(
                printed.contains("stays in the input's folder"),
                "{files}: {printed}"
            );
        }
    }
}

#[test]
fn odd_names_of_files_are_printed_and_steer_no_terminal() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let place = Place::new();
    // Words of a pipeline's own.
    place.write("esc.toml", SMALL.replace("a doll", "a \\u001b[31mdoll"));
    place.run("run esc.toml").code(0);
    let reported = place.run("cache runs").code(0).out;
    assert!(reported.contains("a \\u{1b}[31mdoll"), "{reported:?}");
    let turn = "goal = \"photos\"\n[input.photos]\nfiles = \"*.jpg\"\n[node.photos]\n\
        stage = \"capture.load\"\nfrom = { files = \"@photos\" }\n";
    place.write("turn.toml", turn);
    for (bytes, expected) in [
        (&b"a\x1b[31m.jpg"[..], "control characters"),
        (b"a\nb.jpg", "control characters"),
        (b"\xff.jpg", "is not UTF-8"),
    ] {
        place.photos("turn", 3);
        let odd = place.path("turn").join(OsStr::from_bytes(bytes));
        std::fs::write(&odd, "x").unwrap();
        let printed = place.run("run turn.toml --input photos=turn").code(2).err;
        assert!(printed.contains(expected), "{printed:?}");
        assert!(
            !printed.contains('\u{1b}') && printed.lines().count() == 1,
            "{printed:?}"
        );
        std::fs::remove_file(odd).unwrap();
        // What does not fit is nobody's business.
        let other = place.path("turn").join(OsStr::from_bytes(b"\xff.txt"));
        std::fs::write(other, "x").unwrap();
        place.run("run turn.toml --input photos=turn").code(0);
    }
}

#[test]
fn one_of_something_is_reported_as_one() {
    let place = Place::new();
    let plan = place.run("plan small.toml ring --strands").code(0).out;
    assert!(
        plan.contains("1 strand, ") && !plan.contains("1 strands"),
        "{plan}"
    );
    assert!(plan.contains(" 0.0 s") && !plan.contains("-0.0"), "{plan}");
    place.run("run small.toml ring").code(0);
    let whole = place.run("cache du").code(0).out;
    assert!(whole.starts_with("1 result, "), "{whole}");
    let swept = place.run("cache gc --max-size 1G --dry-run").code(0).out;
    assert!(swept.contains("0 records of runs"), "{swept}");
    let swept = place.run("sweep small.toml --over body.cell_mm=40").code(0);
    assert!(swept.out.contains("\n1 point: "), "{}", swept.out);
    assert!(
        swept.err.starts_with("1 point, 4 results unless cached"),
        "{}",
        swept.err
    );
}

#[test]
fn a_built_in_pipeline_is_compared_by_its_name() {
    let place = Place::new();
    let printed = place.run("compare paper rigid weighted_median").code(2).err;
    assert!(printed.contains("input `photos`"), "{printed}");
    let printed = place.run("compare paper rigid weightd_median").code(2).err;
    assert!(
        printed.contains("did you mean `weighted_median`"),
        "{printed}"
    );
    let printed = place.run("compare papr rigid weighted_median").code(2).err;
    assert!(printed.contains("`papr` is no folder"), "{printed}");
    place.run("run small.toml --out paper").code(0);
    place.run("compare paper last").code(0);
}
