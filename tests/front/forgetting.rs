//! Forgotten means gone, whatever happened to the cache before: broken records, killed runs, moved captures.

use super::place::Place;
use super::privacy::{TURN, all, holds};
use std::fs;
use std::path::PathBuf;

/// A place with a capture that was run, and bytes that only its first photo has.
fn ran() -> (Place, Vec<u8>) {
    let place = Place::new();
    place.write("turn.toml", TURN);
    place.photos("anna", 3);
    place.run("run turn.toml --input photos=anna").code(0);
    let photo = fs::read(place.path("anna/0000.jpg")).unwrap();
    let inner = photo[2000..2400].to_vec();
    assert!(holds(&place, &inner));
    (place, inner)
}

/// The files of a folder of the cache that hold a text.
fn files_with(place: &Place, folder: &str, text: &str) -> Vec<PathBuf> {
    let has = |path: &PathBuf| {
        let file = fs::read(path).unwrap_or_default();
        String::from_utf8_lossy(&file).contains(text)
    };
    let found = all(&place.path(folder));
    found.into_iter().filter(has).collect()
}

/// Holds the cache to having nothing of the capture.
#[track_caller]
fn gone(place: &Place, inner: &[u8]) {
    assert!(!holds(place, inner), "photos are left");
    for name in [&b"/anna\""[..], b"/anna/"] {
        assert!(!holds(place, name), "its name is left");
    }
    place.sound();
}

#[test]
fn a_broken_record_hides_nothing_from_forgetting() {
    let (place, inner) = ran();
    let records = files_with(&place, "cache/ac", "capture.load v");
    for record in &records {
        let mut bytes = fs::read(record).unwrap();
        let at = bytes.len() / 2;
        bytes[at] ^= 1;
        fs::write(record, bytes).unwrap();
    }
    assert_eq!(records.len(), 1);
    let printed = place.run("cache forget anna").code(1);
    assert!(printed.err.contains("could not be read"), "{}", printed.err);
    gone(&place, &inner);
    assert_eq!(
        files_with(&place, "cache/ac", "pose.tags"),
        [""; 0].map(PathBuf::from)
    );
}

#[test]
fn a_result_whose_record_was_never_written_is_forgotten() {
    let (place, inner) = ran();
    // As a run leaves it that was killed between the photos and their record.
    for left in ["ac", "runs"] {
        fs::remove_dir_all(place.path(&format!("cache/{left}"))).unwrap();
    }
    for left in ["index", "last-run", "files.json"] {
        fs::remove_file(place.path(&format!("cache/{left}"))).unwrap();
    }
    assert!(holds(&place, &inner));
    place.run("cache forget anna").code(0);
    gone(&place, &inner);
}

#[test]
fn records_of_a_newer_program_are_named_and_forgetting_is_no_success() {
    let (place, inner) = ran();
    let record = files_with(&place, "cache/ac", "capture.load v").remove(0);
    let text = fs::read_to_string(&record).unwrap();
    let (_, body) = text.split_once('\n').unwrap();
    let at = body.find("\"version\": ").unwrap() + "\"version\": ".len();
    let body = format!("{}9{}", &body[..at], &body[at..]);
    let hash = blake3::hash(body.as_bytes()).to_hex();
    fs::write(&record, format!("{hash}\n{body}")).unwrap();
    let key = record.file_name().unwrap().to_str().unwrap()[..12].to_owned();
    let printed = place.run("cache forget anna").code(1);
    let text = format!("{}{}", printed.out, printed.err);
    assert!(text.contains(&key) && text.contains("newer"), "{text}");
    assert!(!holds(&place, &inner), "what it names goes all the same");
    // Once more, now by a program that reads it: here the record is taken away.
    fs::remove_file(&record).unwrap();
    place.run("cache forget anna").code(0);
    gone(&place, &inner);
}

#[test]
fn folders_of_killed_runs_go_though_their_number_is_used_again() {
    let (place, inner) = ran();
    // This test's own process lives, and holds none of them.
    let id = std::process::id();
    place.write(&format!("cache/exec/{id}-0-1a/lock"), "");
    place.write(&format!("cache/exec/{id}-0-1a/in/files/0000.jpg"), &inner);
    place.write(&format!("cache/tmp/{id}-0-1a"), &inner);
    place.write("cache/quarantine/notes", &inner);
    place.run("cache forget anna").code(0);
    assert!(place.path("cache/quarantine/notes").exists(), "not ours");
    fs::remove_file(place.path("cache/quarantine/notes")).unwrap();
    gone(&place, &inner);
    assert!(!place.path(&format!("cache/exec/{id}-0-1a")).exists());
    // Of a program of before, which locked none: whose it is nobody can tell.
    place.write(&format!("cache/exec/{id}-0-1b/in/0000.jpg"), &inner);
    place.run("run turn.toml --input photos=anna").code(0);
    let printed = place.run("cache forget anna").code(1);
    assert!(
        printed.err.contains(&format!("{id}-0-1b")),
        "{}",
        printed.err
    );
}

#[test]
fn a_capture_that_was_moved_is_found_by_its_photos() {
    let (place, inner) = ran();
    fs::rename(place.path("anna"), place.path("elsewhere")).unwrap();
    // One photo less, and a note beside them.
    fs::remove_file(place.path("elsewhere/0002.jpg")).unwrap();
    place.write("elsewhere/notes.txt", "a note");
    place.run("cache forget elsewhere").code(0);
    gone(&place, &inner);
    let printed = place.run("cache forget elsewhere").code(1);
    assert!(printed.err.contains("nothing"), "{}", printed.err);
}

#[test]
fn a_capture_of_links_is_found_by_what_they_led_to_and_a_lost_link_by_its_name() {
    let (place, inner) = ran();
    place.run("cache forget anna").code(0);
    let link = |from: &str, to: &str| {
        std::os::unix::fs::symlink(place.path(from), place.path(to)).unwrap();
    };
    // Photos that are links into the folder that is named.
    fs::create_dir(place.path("links")).unwrap();
    for i in 0..3 {
        link(&format!("anna/000{i}.jpg"), &format!("links/000{i}.jpg"));
    }
    place.run("run turn.toml --input photos=links").code(0);
    assert!(holds(&place, &inner));
    place.run("cache forget anna").code(0);
    assert!(!holds(&place, &inner));
    // A folder that was named by a link, which is gone.
    fs::remove_dir_all(place.path("links")).unwrap();
    link("anna", "today");
    place.run("run turn.toml --input photos=today").code(0);
    fs::remove_file(place.path("today")).unwrap();
    place.run("cache forget today").code(0);
    gone(&place, &inner);
    assert!(!holds(&place, b"/today\""));
}

#[test]
fn other_captures_keep_what_they_share() {
    let (place, inner) = ran();
    place.photos("bert", 4);
    fs::remove_file(place.path("bert/0000.jpg")).unwrap();
    // One photo of four is the same as one of anna's, as a plate may be.
    fs::remove_file(place.path("bert/0001.jpg")).unwrap();
    let other = fs::read(place.path("bert/0003.jpg")).unwrap();
    for (name, cut) in [("0004.jpg", 1), ("0005.jpg", 2)] {
        let mut photo = other.clone();
        photo.extend(vec![0; cut]);
        place.write(&format!("bert/{name}"), photo);
    }
    place.run("run turn.toml --input photos=bert").code(0);
    place.run("cache forget anna").code(0);
    gone(&place, &inner);
    let run = place
        .run("run turn.toml --input photos=bert --json")
        .code(0);
    for node in run.json()["nodes"].as_array().unwrap() {
        assert_eq!(node["status"], "found", "{node}");
    }
}

#[test]
fn a_result_folder_of_a_killed_run_is_emptied_of_what_it_was_writing() {
    let place = Place::new();
    place.write("turn.toml", TURN);
    place.photos("anna", 3);
    place
        .run("run turn.toml photos --input photos=anna --out out")
        .code(0);
    let id = std::process::id();
    place.write(&format!("out/photos/images/.writing-{id}-7-1a"), "half");
    place.run("cache forget anna --out out").code(0);
    assert!(!place.path("out").exists());
}
