//! Forgetting, tried with random captures, random faults, and a disk that ends at any of its steps: afterwards the
//! bytes of the store are searched for what only the captures had. `ENGINE_FORGETS=1000` takes so many stories,
//! `ENGINE_FORGETS_SEED` other ones.

mod story;

use super::forget::forget;
use super::simulated::{Simulated, after_loss, below, laid};
use super::{StoreError, retention};
use crate::own;
use proof::Dice;
use std::path::PathBuf;
use story::Story;

fn rounds(usual: u64) -> std::ops::Range<u64> {
    let number = |name: &str, usual| std::env::var(name).map_or(usual, |n| n.parse().unwrap());
    let seed = number("ENGINE_FORGETS_SEED", 1) << 32;
    seed..seed + number("ENGINE_FORGETS", usual)
}

/// So many steps of a disk in all, where no story takes more.
const MOST_STEPS: usize = 400;

#[test]
fn nothing_of_a_capture_is_left_whatever_happened_before() {
    for seed in rounds(80) {
        let mut dice = Dice(seed);
        let story = Story::new(&mut dice);
        let sound = dice.unit() < 0.3;
        // Some runs are killed at a step of theirs.
        let ends = (!sound && dice.unit() < 0.5).then(|| dice.bits() as usize % MOST_STEPS);
        let disk = Simulated {
            ends,
            ..Simulated::default()
        };
        if let Ok(store) = story.store(&disk) {
            for capture in &story.captures {
                let _ = story.run(&store, capture, &mut dice);
            }
        }
        for _ in 0..if sound { 0 } else { dice.bits() % 4 } {
            story.spoil(&mut dice);
        }
        let mut folder = story.captures[0].folder.clone();
        // A capture may have been moved; without its note only its files identify it.
        if sound && dice.unit() < 0.5 {
            let moved = story.place.path().join("moved");
            std::fs::rename(&folder, &moved).unwrap();
            folder = moved;
        }
        let store = story.store(&Simulated::default()).unwrap();
        let forgotten = forget(&store, &folder).unwrap();
        let round = format!("seed {seed}: {forgotten:?}");
        assert_eq!(forgotten.unread, Vec::<String>::new(), "{round}");
        story.clean(&round);
        // What is broken of the rest is put aside, and nothing of it is this one's.
        retention::verify(&store).unwrap();
        assert_eq!(retention::verify(&store).unwrap(), 0, "{round}");
        story.clean(&round);
        assert_eq!(own::stranger(store.root()).unwrap(), None, "{round}");
        if sound {
            assert!(
                forgotten.known && forgotten.broken + forgotten.untraced == 0,
                "{round}"
            );
            // The rest keep all that they had, shared blobs too.
            for capture in &story.captures[1..] {
                let left = below(&story.root());
                let has = |path: &PathBuf| {
                    let bytes = std::fs::read(path).unwrap();
                    String::from_utf8_lossy(&bytes).contains(&capture.name)
                };
                assert!(left.iter().any(has), "{round}");
            }
            for key in own::shelf(store.root(), "ac").unwrap() {
                let record = store.record(key).unwrap();
                assert!(store.holds(record.content), "{round}");
            }
        }
    }
}

#[test]
fn forgetting_that_is_killed_at_any_step_is_done_by_the_next_one() {
    for seed in rounds(1) {
        for ends in 0.. {
            let mut dice = Dice(seed);
            let story = Story::new(&mut dice);
            let store = story.store(&Simulated::default()).unwrap();
            for capture in &story.captures {
                story.run(&store, capture, &mut dice).unwrap();
            }
            let folder = &story.captures[0].folder;
            let disk = Simulated {
                ends: Some(ends),
                ..Simulated::default()
            };
            let round = format!("seed {seed}, ended at step {ends}");
            let first = story.store(&disk).and_then(|store| forget(&store, folder));
            let left = story.left();
            let next = forget(&story.store(&Simulated::default()).unwrap(), folder).unwrap();
            story.clean(&round);
            assert_eq!(retention::verify(&store).unwrap(), 0, "{round}");
            assert!(
                left.is_none() || next.known,
                "{round}: no record is left of {left:?}"
            );
            if disk.tried() <= ends {
                assert!(ends > 20, "only {ends} steps");
                assert!(first.is_ok(), "{round}: {first:?}");
                break;
            }
        }
    }
}

/// A capture that was edited, all of it, between two runs, and that is now called otherwise: by a link that is lost, or
/// since it was moved; what it is called.
fn called_otherwise(story: &Story, moved: bool, dice: &mut Dice) -> PathBuf {
    let store = story.store(&Simulated::default()).unwrap();
    let capture = &story.captures[0];
    story.run(&store, capture, dice).unwrap();
    for photo in 0..3 {
        let path = capture.folder.join(format!("{photo}.jpg"));
        std::fs::write(path, format!("other {photo}")).unwrap();
    }
    story.run(&store, capture, dice).unwrap();
    let called = story.place.path().join("elsewhere");
    match moved {
        true => std::fs::rename(&capture.folder, &called).unwrap(),
        false => store.note_link(&called, &capture.folder),
    }
    called
}

#[test]
fn what_leads_to_other_notes_goes_after_them() {
    for seed in 0..12 {
        let forgotten = |ends: usize| {
            let (mut dice, disk) = (Dice(seed), Simulated::default());
            let story = Story::new(&mut dice);
            let called = called_otherwise(&story, seed % 2 == 0, &mut dice);
            let ends = Some(ends);
            let disk = Simulated { ends, ..disk };
            let _ = story.store(&disk).and_then(|store| forget(&store, &called));
            let next = forget(&story.store(&Simulated::default()).unwrap(), &called);
            story.clean(&format!("seed {seed}, ended at step {ends:?}: {next:?}"));
            disk.tried()
        };
        // Notes go in the last steps, each by itself.
        let all = forgotten(usize::MAX);
        (all - 40..all).for_each(|ends| _ = forgotten(ends));
    }
}

/// A flipped bit in the folder that a plan names leaves JSON that names another one.
#[test]
fn a_plan_whose_bytes_changed_goes_and_counts_as_broken() {
    let (mut dice, disk) = (Dice(1), Simulated::default());
    let story = Story::new(&mut dice);
    let store = story.store(&disk).unwrap();
    let capture = &story.captures[0];
    story.run(&store, capture, &mut dice).unwrap();
    let names = own::files(store.root(), "plans", own::is_hash).unwrap();
    let [name] = names.as_slice() else {
        panic!("{names:?}");
    };
    let plan = store.root().join("plans").join(name);
    let place = story.place.path().display().to_string();
    let text = std::fs::read_to_string(&plan).unwrap();
    std::fs::write(&plan, text.replace(&place, "/elsewhere")).unwrap();
    let forgotten = forget(&store, &capture.folder).unwrap();
    assert_eq!(forgotten.broken, 1);
    story.clean(&format!("{forgotten:?}"));
}

#[test]
fn what_was_forgotten_does_not_come_back_with_a_loss_of_power() {
    for seed in rounds(4) {
        let mut dice = Dice(seed);
        let (story, disk) = (Story::new(&mut dice), Simulated::default());
        let store = story.store(&disk).unwrap();
        for capture in &story.captures {
            story.run(&store, capture, &mut dice).unwrap();
        }
        forget(&store, &story.captures[0].folder).unwrap();
        let steps = disk.steps.lock().unwrap().clone();
        for loss in 0..8 {
            let left = after_loss(&steps, &story.root(), &mut dice);
            std::fs::remove_dir_all(story.root()).unwrap();
            std::fs::create_dir(story.root()).unwrap();
            laid(&left, &story.root(), &story.root());
            story.clean(&format!("seed {seed}, loss {loss}"));
        }
    }
}

#[test]
fn a_step_of_forgetting_that_fails_is_reported_and_what_leads_to_the_rest_stays() {
    let mut dice = Dice(7);
    for fails in 0..60 {
        let story = Story::new(&mut dice);
        let store = story.store(&Simulated::default()).unwrap();
        for capture in &story.captures {
            story.run(&store, capture, &mut dice).unwrap();
        }
        let disk = Simulated {
            fails: Some(fails),
            ..Simulated::default()
        };
        let folder = &story.captures[0].folder;
        let first = story.store(&disk).and_then(|store| forget(&store, folder));
        if disk.tried() > fails {
            let reported = matches!(first, Err(StoreError::Left(_) | StoreError::Disk { .. }));
            assert!(reported, "step {fails}: {first:?}");
        }
        forget(&store, folder).unwrap();
        story.clean(&format!("step {fails} fails"));
    }
}
