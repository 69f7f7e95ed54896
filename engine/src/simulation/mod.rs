//! One simulation of the engine: machines with their disks and clocks, a store that they share, and everything that may
//! happen to them, on one thread and out of one seed. Store, leases, walks, `work`, `gc`, `forget`, pins, uploads and
//! permissions are the real code, on a real folder; disk, clock and shared store are simulated at their seams (`Disk`,
//! `clock.rs`, `Objects`). At any step of a disk or request to the shared store another process may act meanwhile, the
//! process may be killed, the disk be full, the network be cut.
//!
//! `story.rs` (what happens, out of a seed) → `process.rs` → `seam.rs` (where disk, shared store and stages reach the story) → `disk.rs`,
//! `server.rs`, `trade.rs` (stages) → `world.rs` (machines with `captures.rs` and `known.rs`, time, who acts), `opened.rs` → `oracle.rs`,
//! `oracle_there.rs` (what must hold) → `acts.rs`, `mishaps.rs`, `forge.rs` (what is done) → `played.rs` → `shrink.rs`.
//!
//! `ENGINE_STORIES=100000` takes so many stories, `ENGINE_STORIES_SEED=7` begins with that one;
//! `ENGINE_STORY=7` tells one story step by step.

mod acts;
mod captures;
mod disk;
mod forge;
mod known;
mod mishaps;
mod opened;
mod oracle;
mod oracle_there;
mod played;
mod process;
mod seam;
mod server;
mod shrink;
mod story;
mod trade;
mod world;

use played::played;
use story::{Act, Setup, Story, Use, What};

/// How many stories, and which is the first, if nothing else is said.
const USUAL_STORIES: u64 = 1200;

fn number(name: &str) -> Option<u64> {
    std::env::var(name)
        .ok()
        .map(|n| n.parse().expect("a number"))
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
    for seed in first..first + count {
        let story = Story::new(seed);
        let Some(broken) = played(&story).1 else {
            continue;
        };
        let (short, why) = shrink::shortest(story, broken.clone());
        panic!(
            "story {seed} ({} of {count}): {broken}\nthe shortest that fails, of {} acts: {why}\n{short:#?}\n{}",
            seed - first + 1,
            short.acts.len(),
            played(&short).0.join("\n")
        );
    }
}

#[test]
fn what_is_broken_in_the_shared_store_is_named_by_forgetting() {
    let act = |machine, what| Act {
        machine,
        what,
        kill: None,
        fail: None,
        lost: None,
        beside: vec![],
    };
    let setup = Setup {
        uses: Use::Open,
        ahead_s: 0,
        drift: 0,
    };
    let mut named = 0;
    for object in 0..6 {
        let story = Story {
            machines: vec![setup.clone(), setup.clone()],
            honest: true,
            late: true,
            acts: vec![
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
            ],
        };
        let (log, broken) = played(&story);
        assert_eq!(broken, None, "{log:#?}");
        named += usize::from(log.iter().any(|line| line.contains("unread [\"sim://")));
    }
    assert!(named > 0, "nothing broken was named");
}

#[test]
fn a_story_told_twice_is_the_same() {
    for seed in 1..40 {
        let story = Story::new(seed);
        let (first, second) = (played(&story), played(&story));
        assert_eq!(first.0, second.0, "story {seed}");
    }
}
