//! The first screen of `measure`: what it found, parts in words, the girths, warnings; in a pipe, on a terminal, in German.

use super::first_answer::{begun, printed, quick};
use super::place::{Place, Printed};

/// Columns of a terminal as it comes.
const COLUMNS: usize = 80;

/// Names of nodes that mean nothing to who measures.
const NODES: [&str; 4] = ["calibrated", "compensated", "evidence", "keypoints"];

/// The places of these in a text, which must come in this order.
#[track_caller]
fn in_order(text: &str, parts: &[&str]) {
    let mut rest = text;
    for part in parts {
        let at = rest.find(part);
        let at =
            at.unwrap_or_else(|| panic!("`{part}` is not there, or not in its place:\n{text}"));
        rest = &rest[at + part.len()..];
    }
}

/// The first measuring again, with more words.
fn again(more: &str) -> String {
    format!("measure turn --out out {} {more}", quick())
}

#[test]
fn a_measuring_tells_what_it_found_then_its_parts_and_ends_with_girths_and_warnings() {
    // A capture that nobody named is called after its folder.
    let (place, printed) = (begun(), printed());
    let found = "turn: 9 photos of 0.2 megapixels, with the empty scene, a mat of 12 tags\n";
    assert!(printed.err.starts_with(found), "{}", printed.err);
    in_order(
        &printed.err,
        &[
            "Photos: done\n",
            "Cameras: done\n",
            "Outlines: done\n",
            "Hull: done\n",
            "Surface: done\n",
            "Girths: done\n",
            "Report: done\n",
        ],
    );
    in_order(
        &printed.out,
        &[
            "turn: 9 of 9 photos",
            "girth ",
            "waist (WC)",
            " warning",
            "all files: out\n",
            "report:    out",
        ],
    );
    for text in [&printed.out, &printed.err] {
        assert!(!text.contains(['\r', '\u{1b}']), "{text:?}");
        assert!(!NODES.iter().any(|node| text.contains(node)), "{text}");
        let wide = text.lines().filter(|l| l.chars().count() > COLUMNS);
        assert_eq!(wide.collect::<Vec<_>>(), [""; 0]);
    }
    in_other_ways(&place, printed);
    // The page is of what was found.
    let page = std::fs::read_to_string(place.path("out/report.html")).unwrap();
    for part in [
        "<title>tailor: turn</title>",
        "<h1>turn</h1>",
        "<p class=\"warn\">this body (81 cm tall) ",
    ] {
        assert!(page.contains(part), "{part}");
    }
    on_a_terminal(&place);
}

/// The same in German, quiet, and by node.
fn in_other_ways(place: &Place, printed: &Printed) {
    // Nothing is made anew in another language, and the numbers are the same.
    let german = place.run(&again("--lang de")).code(0);
    in_order(
        &german.err,
        &[
            "turn: 9 Fotos mit je 0,2 Megapixeln",
            "Umrisse: schon im Zwischenspeicher\n",
            "Bericht: ",
        ],
    );
    in_order(
        &german.out,
        &[
            "Umfang ",
            "Bereich (90 %)",
            "Taille (WC)",
            " Warnung",
            "alle Dateien: out\n",
        ],
    );
    let wide = german.out.lines().filter(|l| l.chars().count() > COLUMNS);
    assert_eq!(wide.collect::<Vec<_>>(), [""; 0]);
    let numbers = |text: &str| {
        let row = text.lines().find(|l| l.contains("(HC)")).unwrap();
        row.replace(',', ".")
            .split_whitespace()
            .filter(|w| w.parse::<f64>().is_ok())
            .map(str::to_owned)
            .collect::<Vec<_>>()
    };
    assert_eq!(numbers(&german.out), numbers(&printed.out));
    let line = format!(
        "LC_ALL= LANG=de_DE.UTF-8 {} {}",
        env!("CARGO_BIN_EXE_tailor"),
        again("")
    );
    assert_eq!(place.bash(&line).code(0).out, german.out);
    let quiet = place.run(&again("--quiet")).code(0);
    assert_eq!((quiet.err, quiet.out), (String::new(), printed.out.clone()));
    let nodes = place.run(&again("--verbose")).code(0);
    assert!(nodes.err.contains("] calibrated   found"), "{}", nodes.err);
}

/// On a terminal one line lives, and is gone at the end.
fn on_a_terminal(place: &Place) {
    if !cfg!(target_os = "linux") {
        return;
    }
    // A round more, so that something is made.
    let line = format!(
        "{} measure turn --out out {}",
        env!("CARGO_BIN_EXE_tailor"),
        quick().replace(" coarse.rounds=1", " coarse.rounds=2")
    );
    let seen = place.bash(&format!(
        "script -qec 'stty rows 24 cols 80; {line}' /dev/null"
    ));
    let seen = seen.code(0).out;
    assert!(seen.contains("/7] ") && seen.contains('\u{1b}'), "{seen:?}");
    let plain = !seen.contains("Surface: done") && !seen.contains("made in");
    assert!(plain, "{seen:?}");
    in_order(
        &seen,
        &[
            "turn: 9 photos",
            "/7] Surface, ",
            "turn: 9 of 9 photos",
            "girth ",
        ],
    );
    // A narrow one has shorter lines.
    let narrow = place.bash(&format!(
        "script -qec 'stty rows 24 cols 60; {line}' /dev/null"
    ));
    let narrow = narrow.code(0).out;
    let plain = narrow.lines().filter(|l| !l.contains('\u{1b}'));
    let plain: Vec<&str> = plain.map(str::trim_end).collect();
    assert!(plain.iter().any(|l| l.starts_with("girth ")), "{narrow:?}");
    let wide: Vec<_> = plain.iter().filter(|l| l.chars().count() > 60).collect();
    assert!(wide.is_empty(), "{wide:#?}");
}

#[test]
fn what_was_warned_of_is_shown_where_nothing_comes_of_it() {
    let place = Place::new();
    place.photos("turn", 9);
    place.write("turn/raw.cr2", "x");
    // A mat that is not there.
    let wrong = "--mat-tag 60 --mat-ids 100-111 --mat-ring 100";
    let printed = place.run(&format!(
        "measure turn --out out --set photos.stop=false {wrong}"
    ));
    in_order(
        &printed.code(1).err,
        &[
            "turn: 9 photos",
            "\n2 warnings\n",
            "raw.cr2",
            "another mat than is given",
            "calibrated failed: ",
        ],
    );
    // In German as far as it has codes, and nothing is made again.
    let german = place.run(&format!(
        "measure turn --out out --set photos.stop=false {wrong} --lang de"
    ));
    let german = german.code(1).err;
    in_order(
        &german,
        &["\n2 Warnungen\n", "calibrated: ", "Wiederholen: "],
    );
    assert!(!german.contains(" failed: "), "{german}");
    let german = place
        .run("measure turn --stature 1.76 --lang de")
        .code(2)
        .err;
    assert!(german.contains("sind 1.76m gemeint?"), "{german}");
}
