//! When work is done and when not: what ran, on a chain clean → mid → final.

use crate::place::{Log, NONE, Place, chain, graph};
use engine::store::{Store, retention};
use engine::walk::Status;

#[test]
fn a_touched_file_reruns_nothing_and_a_comment_reruns_one() {
    let place = Place::new("hello\n");
    place.run(1);
    place.write("hello\n");
    assert_eq!(place.run(1), NONE);
    place.write("# a comment\nhello\n");
    assert_eq!(place.run(1), ["clean"], "equal output stops there");
    place.write("hello\n");
    assert_eq!(place.run(1), NONE, "revert is a hit");
}

#[test]
fn a_param_reruns_what_is_downstream_and_back_is_a_hit() {
    let place = Place::new("hello\n");
    place.run(1);
    assert_eq!(place.run(2), ["final", "mid"]);
    assert_eq!(place.run(1), NONE);
}

#[test]
fn a_flipped_byte_is_found_put_aside_and_rebuilt() {
    let place = Place::new("hello\n");
    place.run(1);
    for blob in place.shelf("cas") {
        let mut bytes = std::fs::read(&blob).unwrap();
        let last = bytes.len() - 1;
        bytes[last] ^= 1;
        std::fs::write(&blob, bytes).unwrap();
        assert_eq!(place.run(1).len(), 1, "one is rebuilt");
        assert_eq!(place.run(1), NONE);
    }
    assert!(place.cache().join("quarantine").is_dir());
    assert_eq!(
        retention::verify(&Store::open(&place.cache()).unwrap()).unwrap(),
        0
    );
}

#[test]
fn a_moved_store_still_hits() {
    let place = Place::new("hello\n");
    place.run(1);
    let moved = place.path().join("elsewhere");
    std::fs::rename(place.cache(), &moved).unwrap();
    assert_eq!(place.run_in(&chain(1), &moved, 1), NONE);
}

#[test]
fn a_moved_source_still_hits() {
    let place = Place::new("hello\n");
    place.run(1);
    let moved = place.path().join("moved");
    std::fs::create_dir(&moved).unwrap();
    std::fs::copy(place.src().join("a.txt"), moved.join("a.txt")).unwrap();
    std::fs::remove_dir_all(place.src()).unwrap();
    std::fs::rename(&moved, place.src()).unwrap();
    assert_eq!(
        place.run(1),
        NONE,
        "another inode, another time, the same content"
    );
}

#[test]
fn a_failure_is_not_cached_and_the_rest_goes_on() {
    let place = Place::new("hello\n");
    for _ in 0..2 {
        let made = place.run(13);
        assert!(!made.contains(&"mid".to_owned()) && !made.contains(&"final".to_owned()));
    }
    assert_eq!(place.run(1), ["final", "mid"]);
}

#[test]
fn a_store_of_another_layout_is_refused() {
    let place = Place::new("hello\n");
    place.run(1);
    std::fs::write(place.cache().join("format"), "stage store 99\n").unwrap();
    let Err(error) = Store::open(&place.cache()) else {
        panic!("it was opened")
    };
    let error = error.to_string();
    assert!(error.contains("another layout (stage store 99)"), "{error}");
    // What a loss of power leaves is no layout.
    for torn in [&b""[..], &[0; 15]] {
        std::fs::write(place.cache().join("format"), torn).unwrap();
        assert_eq!(place.run(1), NONE);
    }
}

#[test]
fn a_lost_intermediate_is_made_again_only_when_somebody_reads_it() {
    let place = Place::new("hello\n");
    place.run(1);
    std::fs::remove_file(place.blob(1, "mid")).unwrap();
    std::fs::remove_file(place.blob(1, "clean")).unwrap();
    assert_eq!(place.run(1), NONE, "nobody reads it");
    assert_eq!(
        place.run(2),
        ["clean", "final", "mid"],
        "mid of 2 reads clean"
    );
}

#[test]
fn one_file_more_redoes_one_part_and_a_failed_stage_goes_on_at_its_last_step() {
    let place = Place::new("hello\n");
    let parts = |stop: u32| {
        let nodes = format!(
            "[node.p]\nstage = \"toy.parts\"\nfrom = {{ files = \"@src\" }}\nwith = {{ n = 9, sleep_ms = {stop} }}\n"
        );
        let graph = graph(&["p"], &nodes);
        let outcome = place.outcome(&graph, &place.cache(), 1, &Log::default());
        let done = outcome.nodes[0].clone().unwrap();
        (
            done.status,
            done.metrics.iter().map(|m| m.value).collect::<Vec<_>>(),
        )
    };
    for i in 0..17 {
        std::fs::write(place.src().join(format!("{i}.txt")), format!("{i}\n")).unwrap();
    }
    assert_eq!(parts(0), (Status::Executed, vec![18.0, 9.0]));
    std::fs::write(place.src().join("3.txt"), "another\n").unwrap();
    assert_eq!(
        parts(0),
        (Status::Executed, vec![1.0, 9.0]),
        "one photo of eighteen"
    );
    for part in place.shelf("parts") {
        let bytes = std::fs::read(&part).unwrap();
        std::fs::write(&part, &bytes[..bytes.len() * 2 / 3]).unwrap();
    }
    std::fs::write(place.src().join("3.txt"), "a third\n").unwrap();
    let torn = (Status::Executed, vec![18.0, 9.0]);
    assert_eq!(parts(0), torn, "torn parts are made again");
    // Each under the key of another: none is what it promises.
    let all = place.shelf("parts");
    let bytes: Vec<_> = all
        .iter()
        .map(|part| std::fs::read(part).unwrap())
        .collect();
    for (i, part) in all.iter().enumerate() {
        std::fs::write(part, &bytes[(i + 1) % all.len()]).unwrap();
    }
    std::fs::write(place.src().join("3.txt"), "a fourth\n").unwrap();
    assert_eq!(parts(0), torn, "exchanged parts are made again");
    assert!(matches!(parts(6).0, Status::Failed(_)));
    assert_eq!(
        parts(6),
        (Status::Executed, vec![0.0, 3.0]),
        "from the sixth step"
    );
}
