//! One simulation of the engine: machines with their disks and clocks, a store that they share, and everything that may
//! happen to them, on one thread and out of one seed. Store, leases, walks, `work`, `gc`, `forget`, pins, uploads and
//! permissions are the real code, on a real folder; disk, clock and shared store are simulated at their seams (`Disk`,
//! `clock.rs`, `Objects`). At any step of a disk or request to the shared store another process may act meanwhile, the
//! process may be killed, the disk be full, the network be cut.
//!
//! `story.rs` (what happens; out of a seed by `teller.rs`) → `process.rs` → `seam.rs` (where disk, shared store, keys and stages reach the story) →
//! `disk.rs`, `server.rs`, `keys.rs`, `application.rs` (stages), `programs.rs` → `machine.rs` (with `captures.rs`, `known.rs`), `world.rs` (time, who acts; `gone.rs`),
//! `around.rs`, `opened.rs` → `oracle.rs`, `oracle_forgotten.rs`, `oracle_there.rs` (what must hold) → `acts.rs`, `working.rs`, `mishaps.rs`, `forge.rs`
//! (what is done) → `played.rs` → `shrink.rs`.
//!
//! `ENGINE_STORIES=100000` takes so many stories, `ENGINE_STORIES_SEED=7` begins with that one;
//! `ENGINE_STORY=7` prints one story step by step.

mod acts;
mod application;
mod around;
mod captures;
mod disk;
mod forge;
mod gone;
mod keys;
mod known;
mod machine;
mod mishaps;
mod opened;
mod oracle;
mod oracle_forgotten;
mod oracle_there;
mod played;
mod process;
mod programs;
mod seam;
mod server;
mod shrink;
mod story;
mod teller;
mod working;
mod world;

use played::played;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use story::{Act, Setup, Story, Use, What};

/// How many stories, by default: `.ci/run` plays ten times as many.
const USUAL_STORIES: u64 = 1_000;

fn number(name: &str) -> Option<u64> {
    std::env::var(name)
        .ok()
        .map(|n| n.parse().expect("a number"))
}

/// The first of these stories in which something does not hold, and what: each on one thread, as many side by side as
/// there are processors.
fn first_broken(seeds: std::ops::Range<u64>) -> Option<(u64, String)> {
    let (next, broken) = (
        AtomicU64::new(seeds.start),
        Mutex::new(None::<(u64, String)>),
    );
    let many = std::thread::available_parallelism().map_or(1, usize::from);
    let play = || loop {
        let seed = next.fetch_add(1, Ordering::Relaxed);
        let earlier = |found: &Option<(u64, String)>| found.as_ref().is_none_or(|f| seed < f.0);
        if !seeds.contains(&seed) || !earlier(&broken.lock().expect("no panic")) {
            return;
        }
        if let Some(what) = played(&Story::new(seed)).1 {
            let mut broken = broken.lock().expect("no panic");
            if earlier(&broken) {
                *broken = Some((seed, what));
            }
        }
    };
    std::thread::scope(|scope| (0..many).for_each(|_| _ = scope.spawn(play)));
    broken.into_inner().expect("no panic")
}

#[test]
fn whatever_happens_what_is_promised_holds() {
    if let Some(seed) = number("ENGINE_STORY") {
        let story = Story::new(seed);
        println!("{story:#?}");
        let (log, broken) = played(&story);
        println!("{}", log.join("\n"));
        assert_eq!(broken, None);
        return;
    }
    let first = number("ENGINE_STORIES_SEED").unwrap_or(1);
    let count = number("ENGINE_STORIES").unwrap_or(USUAL_STORIES);
    if let Some((seed, broken)) = first_broken(first..first + count) {
        let story = Story::new(seed);
        let (short, why) = shrink::shortest(story, broken.clone());
        panic!(
            "story {seed} ({} of {count}): {broken}\nthe shortest that fails, of {} acts: {why}\n{short:#?}\n{}",
            seed - first + 1,
            short.acts.len(),
            played(&short).0.join("\n")
        );
    }
}

fn act(machine: usize, what: What) -> Act {
    Act {
        machine,
        what,
        kill: None,
        fail: None,
        lost: None,
        beside: vec![],
    }
}

/// Two machines that believe everybody.
fn open(acts: Vec<Act>) -> Story {
    let setup = Setup {
        uses: Use::Open,
        ahead_s: 0,
        drift: 0,
        key_days: None,
    };
    Story {
        machines: vec![setup.clone(), setup],
        honest: true,
        late: true,
        strange_days: None,
        turn: 0,
        acts,
    }
}

#[test]
fn what_is_forgotten_during_an_upload_does_not_come_back() {
    let mut met = 0;
    for step in 0..40 {
        let mut upload = act(0, What::Upload);
        upload.beside = vec![(step, act(0, What::Forget { capture: 0 }))];
        let story = open(vec![act(0, What::Run { capture: 0, n: 1 }), upload]);
        let (log, broken) = played(&story);
        assert_eq!(broken, None, "{log:#?}");
        let used = |line: &String| line.contains("Forget") && line.contains("is using the cache");
        met += usize::from(log.iter().any(used));
    }
    assert!(met > 4, "{met}");
}

#[test]
fn forgetting_that_is_killed_leads_the_next_one_to_what_is_left_in_the_shared_store() {
    let mut left = 0;
    for step in 0..60 {
        let mut killed = act(0, What::Forget { capture: 0 });
        killed.kill = Some(step);
        // Only a note shows what the capture was: it was edited, and the record of its run is gone.
        let story = open(vec![
            act(0, What::Run { capture: 0, n: 1 }),
            act(0, What::Upload),
            act(1, What::Run { capture: 0, n: 2 }),
            act(1, What::Upload),
            act(
                0,
                What::Gc {
                    most: 1 << 20,
                    keep: 0,
                },
            ),
            act(0, What::Edit { capture: 0 }),
            killed,
            act(0, What::Forget { capture: 0 }),
        ]);
        let (log, broken) = played(&story);
        assert_eq!(broken, None, "{log:#?}");
        left += usize::from(
            log.iter()
                .any(|line| line.contains("Forget") && line.contains("killed")),
        );
    }
    assert!(left > 20, "{left}");
}

#[test]
fn who_begins_to_sign_signs_nothing_of_a_stranger_s() {
    for node in 0..4 {
        for uses in [Use::Open, Use::Believing] {
            let forge = What::Forge {
                capture: 0,
                n: 1,
                node,
                signed: uses == Use::Believing,
            };
            let run = || What::Run { capture: 0, n: 1 };
            // A shared store that was swept lacks it: then it would go there again.
            let sweep = What::SweepStore { older_s: 0 };
            let acts = [forge, run(), What::Sign, sweep, run(), What::Upload];
            let mut story = open(acts.map(|what| act(0, what)).into());
            story.machines[0].uses = uses;
            story.machines[1].uses = Use::Strict;
            // What it has at the end, the other one takes from the shared store.
            let (log, broken) = played(&story);
            assert_eq!(broken, None, "{log:#?}");
        }
    }
}

#[test]
fn what_a_killed_run_left_of_a_program_is_forgotten() {
    let mut killed = 0;
    for step in 0..40 {
        let mut ask = act(
            0,
            What::Ask {
                program: 0,
                capture: 0,
            },
        );
        ask.kill = Some(step);
        let allow = act(0, What::Allow { program: 0 });
        let story = open(vec![allow, ask, act(0, What::Forget { capture: 0 })]);
        let (log, broken) = played(&story);
        assert_eq!(broken, None, "{log:#?}");
        killed += usize::from(log[1].contains("killed"));
    }
    assert!(killed > 20, "{killed}");
}

#[test]
fn what_is_broken_in_the_shared_store_is_named_by_forgetting() {
    let mut named = 0;
    for object in 0..6 {
        let story = open(vec![
            act(0, What::Run { capture: 0, n: 1 }),
            act(0, What::Upload),
            // Another one has the photos, and made something else of them.
            act(1, What::Run { capture: 0, n: 2 }),
            // Another bit in the middle.
            act(
                0,
                What::SpoilThere {
                    object,
                    how: 3 | 300 << 8,
                },
            ),
            act(1, What::Forget { capture: 0 }),
        ]);
        let (log, broken) = played(&story);
        assert_eq!(broken, None, "{log:#?}");
        named += usize::from(log.iter().any(|line| line.contains("unread [\"sim://")));
    }
    assert!(named > 0, "nothing broken was named");
}

#[test]
fn what_is_made_again_outlives_a_loss_of_power() {
    for loss in 0..12 {
        let run = |machine| act(machine, What::Run { capture: 0, n: 1 });
        let gc = What::Gc { most: 0, keep: 0 };
        // Brought and so not synced, its result gone, made again.
        let story = open(vec![
            run(0),
            act(0, What::Upload),
            run(1),
            act(1, What::Run { capture: 1, n: 2 }),
            act(1, gc),
            run(1),
            act(1, What::PowerLoss(loss)),
        ]);
        let (log, broken) = played(&story);
        assert_eq!(broken, None, "{log:#?}");
    }
}

#[test]
fn what_is_brought_takes_no_safety_from_what_is_there() {
    for loss in 0..40 {
        let run = |n| act(1, What::Run { capture: 0, n });
        // Another result of the very bytes that were made here and synced.
        let forge = What::Forge {
            capture: 0,
            n: 0,
            node: 3,
            signed: false,
        };
        let power = What::PowerLoss(loss);
        let story = open(vec![run(1), act(0, forge), run(0), act(1, power)]);
        let (log, broken) = played(&story);
        assert_eq!(broken, None, "{log:#?}");
    }
}

#[test]
fn a_story_run_twice_is_the_same() {
    for seed in 1..40 {
        let story = Story::new(seed);
        let (first, second) = (played(&story), played(&story));
        assert_eq!(first.0, second.0, "story {seed}");
    }
}
