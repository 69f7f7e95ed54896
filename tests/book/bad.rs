//! A rehearsal of `samples/bad` as the page on a first capture has it: what is worse comes first, and what stops is no success.

use super::run;

/// What `doctor` finds of a bad capture: the grades in their order, and its whole answer.
fn found(folder: &str, code: i32) -> (Vec<String>, String) {
    let out = run(&format!("tailor doctor samples/bad/{folder}"));
    let printed = String::from_utf8_lossy(&out.stdout).into_owned();
    assert_eq!(out.status.code(), Some(code), "{folder}: {printed}");
    let words = printed
        .lines()
        .filter_map(|l| l.strip_prefix("  ")?.split(' ').next());
    let grades = words.filter(|w| ["stop", "doubt", "hint"].contains(w));
    (grades.map(str::to_owned).collect(), printed)
}

#[test]
fn light_that_changes_is_a_doubt() {
    let (grades, printed) = found("moving-light", 0);
    assert_eq!(grades, ["doubt", "hint", "hint"], "{printed}");
}

#[test]
fn feet_that_all_photos_cut_off_stop() {
    let (grades, printed) = found("feet-cut-off", 1);
    assert_eq!(grades, ["stop", "hint"], "{printed}");
    let cut: Vec<&str> = printed
        .lines()
        .filter(|l| l.contains("lower edge"))
        .collect();
    assert!(cut.len() == 1 && cut[0].starts_with("  stop "), "{printed}");
    assert!(
        cut[0].contains("(16 photos)") && cut[0].contains("no girth"),
        "{printed}"
    );
    assert!(printed.contains("cameras  no, as it is"), "{printed}");
    // Waist and hip of somebody who turns on the spot show without them.
    let out = run("tailor doctor samples/bad/feet-cut-off --turning");
    let turning = String::from_utf8_lossy(&out.stdout).into_owned();
    assert!(out.status.success(), "{turning}");
    for line in [
        "turning  a person turns before a fixed camera",
        "give --turning",
    ] {
        assert!(
            printed.contains(line) && turning.contains(line),
            "{turning}"
        );
    }
    // `measure` agrees.
    let out = run("tailor measure samples/bad/feet-cut-off");
    let printed = String::from_utf8_lossy(&out.stderr).into_owned();
    assert_eq!(out.status.code(), Some(1), "{printed}");
    assert!(
        printed.contains("in_view failed") && printed.contains("no girth"),
        "{printed}"
    );
}

#[test]
fn an_empty_photo_stops_and_who_is_missing_is_a_doubt_before_hints() {
    let (grades, printed) = found("empty-photo", 1);
    assert_eq!(grades, ["stop", "doubt", "hint", "hint"], "{printed}");
    // Named, it is what was missing.
    let out = run("tailor doctor samples/bad/empty-photo --plate 0007.jpg");
    let printed = String::from_utf8_lossy(&out.stdout).into_owned();
    assert!(
        out.status.success() && printed.contains("with the empty scene (0007.jpg)"),
        "{printed}"
    );
}
